#include "errors.hpp"

#include "fpz/io/output.hpp"

namespace fpz::python {

namespace {

py::module_ errors_module() { return py::module_::import("fpz._errors"); }

py::object error_class(const char* name) { return errors_module().attr(name); }

}  // namespace

void register_errors() {
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const io::InputError& e) {
      PyErr_SetString(error_class("InputError").ptr(), e.what());
    } catch (const io::OutputError& e) {
      PyErr_SetString(error_class("OutputError").ptr(), e.what());
    }
  });
}

void raise_update_error(const std::string& message, Status status, std::optional<std::size_t> index) {
  const py::object type = error_class("UpdateError");
  const py::object error = type(message, to_string(status), index ? py::object(py::int_(*index)) : py::none());
  PyErr_SetObject(type.ptr(), error.ptr());
  throw py::error_already_set();
}

void warn(const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  py::list list;
  for (const std::string& line : lines) list.append(line);
  errors_module().attr("warn")(list);
}

std::string without_line(std::string text, const std::string& origin) {
  const std::string with = origin + ":1:", without = origin + ":";
  for (std::size_t at = text.find(with); at != std::string::npos; at = text.find(with, at + without.size())) {
    text.replace(at, with.size(), without);
  }
  return text;
}

}  // namespace fpz::python
