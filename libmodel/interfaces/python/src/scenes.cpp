// Specimens of the particle method.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <csignal>
#include <exception>

#include "errors.hpp"
#include "fpz/specimen/run.hpp"
#include "fpz/specimen/vtu.hpp"
#include "running.hpp"

namespace fpz::python {

namespace {

namespace sp = fpz::specimen;

volatile std::sig_atomic_t interrupted = 0;
void (*python_handler)(int) = nullptr;

/// Python's own handler only notes the signal for the next look at it; a run polls a flag.
extern "C" void on_interrupt(int signal) {
  interrupted = 1;
  if (python_handler != nullptr) python_handler(signal);
}

/// While it lives Ctrl-C also ends the step loop, unless the program has made SIGINT something else than Python's.
class InterruptFlag {
 public:
  InterruptFlag() {
    interrupted = 0;
    struct sigaction now {};
    sigaction(SIGINT, nullptr, &earlier_);
    const bool plain = (earlier_.sa_flags & SA_SIGINFO) == 0 && earlier_.sa_handler != SIG_IGN &&
                       earlier_.sa_handler != SIG_DFL && earlier_.sa_handler != &on_interrupt;
    if (!plain) return;
    python_handler = earlier_.sa_handler;
    now = earlier_;
    now.sa_handler = &on_interrupt;
    installed_ = sigaction(SIGINT, &now, nullptr) == 0;
  }
  InterruptFlag(const InterruptFlag&) = delete;
  InterruptFlag& operator=(const InterruptFlag&) = delete;
  ~InterruptFlag() {
    if (installed_) sigaction(SIGINT, &earlier_, nullptr);
  }

 private:
  struct sigaction earlier_ {};
  bool installed_ = false;
};

sp::Scene read(const std::optional<std::string>& text, const std::string& file, const sp::Overrides& overrides) {
  if (!text) return sp::read_scene(file, overrides);
  return saying_no_line(file, [&] { return sp::parse_scene(*text, file, overrides); });
}

py::dict info_of(const sp::Progress& p) {
  py::dict d;
  d["fraction"] = p.fraction;
  d["seconds"] = p.seconds;
  d["time"] = p.time;
  d["load"] = p.load;
  d["damaged"] = p.damaged;
  d["steps_per_second"] = p.steps_per_second;
  return d;
}

struct Request {
  std::filesystem::path out;
  bool force = false, resume = false;
  int threads = 0;
  long long most_steps = 0;
};

sp::RunResult run(const sp::Scene& scene, const Request& wanted, const py::object& progress) {
  sp::RunRequest request;
  request.folder = wanted.out;
  request.force = wanted.force;
  request.resume = wanted.resume;
  request.keep_checkpoint = true;
  request.threads = wanted.threads;
  request.most_steps = wanted.most_steps;
  request.interrupt = &interrupted;
  Watch watch(progress);
  std::exception_ptr raised;
  request.progress = [&](const sp::Progress& p) {
    try {
      if (raised == nullptr) watch.look([&p] { return info_of(p); });
    } catch (...) {  // the run ends with a checkpoint first
      raised = std::current_exception();
      interrupted = 1;
    }
  };
  std::vector<std::string> before;
  request.warn = [&before](const std::vector<std::string>& lines) { before = lines; };
  sp::RunResult result;
  bool stopped = false;
  {
    const InterruptFlag flag;
    const py::gil_scoped_release others_may_run;
    result = sp::run_scene(scene, request);
    stopped = interrupted != 0;
  }
  warn(before);
  if (raised != nullptr) std::rethrow_exception(raised);
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (stopped) {  // by a signal that another thread of Python gets
    PyErr_SetString(PyExc_KeyboardInterrupt, result.reason.c_str());
    throw py::error_already_set();
  }
  return result;
}

py::dict run_scene(const std::optional<std::string>& text, const std::string& file, const sp::Overrides& overrides,
                   const std::filesystem::path& out, const py::object& progress, bool force, bool resume, int threads,
                   long long most_steps) {
  const sp::Scene scene = read(text, file, overrides);
  std::vector<std::string> warnings;
  for (const std::string& w : scene.warnings) warnings.push_back(text ? without_line(w, file) : w);
  warn(warnings);
  const sp::RunResult result = run(scene, {out, force, resume, threads, most_steps}, progress);
  warn(result.warnings);
  py::dict d;
  py::list frames;
  for (const sp::Frame& f : result.frames) {
    frames.append(py::make_tuple(f.time, (sp::RunFiles(out).collection.parent_path() / f.file).string()));
  }
  d["name"] = scene.name;
  d["status"] = to_string(result.ending);
  d["message"] = result.reason;
  d["history"] = records(result.history.columns, result.history.values);
  d["frames"] = frames;
  d["report"] = result.report;
  d["warnings"] = result.warnings;
  d["notes"] = scene.conversions;
  d["crack_file"] = sp::RunFiles(out).crack.string();
  d["summary_file"] = sp::RunFiles(out).summary.string();
  return d;
}

py::dict read_frame(const std::filesystem::path& file) {
  const sp::PointCloud cloud = sp::read_vtk(file);
  const auto array = [&cloud](const std::vector<double>& values, int components) {
    const auto count = static_cast<py::ssize_t>(cloud.size());
    std::vector<py::ssize_t> shape{count};
    if (components > 1) shape.push_back(components);
    return py::array_t<double>(shape, values.data());
  };
  py::dict d;
  d["points"] = array(cloud.points, 3);
  for (const sp::PointData& data : cloud.data) d[py::str(data.name)] = array(data.values, data.components);
  return d;
}

}  // namespace

void add_scenes(py::module_& m) {
  m.def("_run_scene", &run_scene, py::arg("text"), py::arg("file"), py::arg("overrides"), py::arg("out"),
        py::arg("progress"), py::arg("force"), py::arg("resume"), py::arg("threads"), py::arg("most_steps"),
        "Runs a scene of the particle method: fpz.run_scene().");
  m.def("_read_frame", &read_frame, py::arg("file"), "Reads a frame: fpz.read_frame().");
}

}  // namespace fpz::python
