#include "running.hpp"

#include <algorithm>

namespace fpz::python {

py::array records(const std::vector<std::string>& names, const std::vector<double>& values) {
  py::list n, formats, offsets;
  for (std::size_t k = 0; k < names.size(); ++k) {
    n.append(names[k]);
    formats.append("f8");
    offsets.append(k * sizeof(double));
  }
  const auto rows = static_cast<py::ssize_t>(names.empty() ? 0 : values.size() / names.size());
  return py::array(py::dtype(n, formats, offsets, static_cast<py::ssize_t>(names.size() * sizeof(double))),
                   std::vector<py::ssize_t>{rows}, values.data());
}

}  // namespace fpz::python
