#include "fpz/batch.hpp"

#include <optional>
#include <span>
#include <vector>

#include "arrays.hpp"
#include "errors.hpp"
#include "fpz/point/point_update.hpp"
#include "material.hpp"

namespace fpz::python {

std::string shape_text(const py::array& a) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < a.ndim(); ++k) text += (k > 0 ? ", " : "") + std::to_string(a.shape(k));
  return text + (a.ndim() == 1 ? ",)" : ")");
}

namespace {

std::string name_of(const py::dtype& d) { return py::str(static_cast<const py::object&>(d)).cast<std::string>(); }

/// The array itself when its memory can be used as it is, else a contiguous copy (of inputs only).
py::array contiguous(const py::array& a) {
  if ((a.flags() & py::array::c_style) != 0) return a;
  return py::module_::import("numpy").attr("ascontiguousarray")(a).cast<py::array>();
}

void require_dtype(const py::array& a, const py::dtype& wanted, const char* what, const char* remedy) {
  if (a.dtype().equal(wanted)) return;
  std::string found = name_of(a.dtype());
  if (found.size() > 60) found = "a record of other fields";
  throw py::type_error(std::string(what) + " has the type " + found + "; " + remedy);
}

void require_shape(const py::array& a, const std::vector<py::ssize_t>& wanted, const char* what) {
  bool fits = a.ndim() == static_cast<py::ssize_t>(wanted.size());
  for (std::size_t k = 0; fits && k < wanted.size(); ++k) fits = a.shape(static_cast<py::ssize_t>(k)) == wanted[k];
  if (fits) return;
  std::string text = "(";
  for (std::size_t k = 0; k < wanted.size(); ++k) text += (k > 0 ? ", " : "") + std::to_string(wanted[k]);
  text += wanted.size() == 1 ? ",)" : ")";
  throw py::value_error(std::string(what) + " has the shape " + shape_text(a) + "; it must be " + text);
}

void require_writeable(const py::array& a, const char* what) {
  if (!a.writeable()) throw py::value_error(std::string(what) + " is read-only");
}

/// Whether two arrays use the same bytes, by the ends of their memory.
bool overlap(const py::array& a, const py::array& b) {
  return py::module_::import("numpy").attr("may_share_memory")(a, b).cast<bool>();
}

template <class T>
std::span<T> span_of(const py::array& a) {
  return {static_cast<T*>(const_cast<void*>(a.data())), static_cast<std::size_t>(a.shape(0))};
}

/// The first record that is no state.
template <int Dim>
std::optional<std::size_t> first_alien(std::span<const State<double, Dim>> states) {
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (!is_state<Dim>(&states[k])) return k;
  }
  return std::nullopt;
}

template <int Dim>
BatchReport update_batch(const PyMaterial& material, const py::array& states, const py::array& increments,
                         const py::object& out, const py::object& tangents, int threads, bool check) {
  constexpr py::ssize_t n = tensor_size<Dim>;
  const py::dtype record = state_dtype<Dim>();
  constexpr const char* make_them = "make them with Material.fresh_states()";
  require_dtype(states, record, "states", make_them);
  if (states.ndim() != 1) throw py::value_error("states has the shape " + shape_text(states) + "; it must be (count,)");
  const py::ssize_t count = states.shape(0);
  require_dtype(increments, py::dtype::of<double>(), "strain_increments", "it must be float64");
  require_shape(increments, {count, n}, "strain_increments");

  const py::array end = out.is_none() ? states : out.cast<py::array>();
  const char* end_name = out.is_none() ? "states (the result goes there where `out` is not given)" : "out";
  require_dtype(end, record, end_name, make_them);
  require_shape(end, {count}, end_name);
  require_writeable(end, end_name);
  if ((end.flags() & py::array::c_style) == 0) {
    throw py::value_error(std::string(end_name) + " is not contiguous, and results are not copied");
  }
  const py::array begin = contiguous(states);
  const py::array in = contiguous(increments);
  if (begin.data() != end.data() && overlap(begin, end)) {
    throw py::value_error("out overlaps states; it may be the same array or another one");
  }
  if (overlap(in, end)) throw py::value_error("strain_increments is part of the states that are written");

  std::span<Tangent<Dim>> c;
  if (!tangents.is_none()) {
    const auto t = tangents.cast<py::array>();
    require_dtype(t, py::dtype::of<double>(), "tangents", "it must be float64");
    require_shape(t, {count, n, n}, "tangents");
    require_writeable(t, "tangents");
    constexpr py::ssize_t d = sizeof(double);
    if (count > 0 && (t.strides(2) != n * d || t.strides(1) != d || (count > 1 && t.strides(0) != n * n * d))) {
      throw py::value_error("tangents is stored in another order; make it with Material.fresh_tangents()");
    }
    if (overlap(t, in) || overlap(t, begin) || overlap(t, end)) {
      throw py::value_error("tangents shares its memory with the other arrays");
    }
    c = span_of<Tangent<Dim>>(t);
  }

  const auto b = span_of<const State<double, Dim>>(begin);
  const auto e = span_of<const Tensor<double, Dim>>(in);
  if (const auto alien = first_alien<Dim>(b)) {
    throw py::value_error("states[" + std::to_string(*alien) + "] " + not_a_state);
  }
  BatchReport report;
  {
    const py::gil_scoped_release others_may_run;
    report = fpz::update_batch<Dim>(material.behaviour.material, material.behaviour.options, b, e,
                                    span_of<State<double, Dim>>(end), c, threads);
  }
  if (report.ok()) return report;
  // Once more for the words, and for the capture where one is wanted. The begin state is still there.
  State<double, Dim> unused;
  const point::Outcome outcome =
      point::update_point<Dim>(material.behaviour, b[report.first_failed], e[report.first_failed], unused, nullptr);
  const std::string text = std::to_string(report.failed) + " of " + std::to_string(count) + " points failed; point " +
                           std::to_string(report.first_failed) + ": " +
                           (outcome.ok() ? "its tangent does not exist" : point::last_message());
  if (check) raise_update_error(text, report.first_status, report.first_failed);
  return report;
}

BatchReport update_any(const PyMaterial& material, const py::array& states, const py::array& increments,
                       const py::object& out, const py::object& tangents, int threads, bool check) {
  if (threads < 0) throw py::value_error("threads must be 0 (all) or more");
  return with_dim(material.dim(), [&](auto dim) {
    return update_batch<decltype(dim)::value>(material, states, increments, out, tangents, threads, check);
  });
}

}  // namespace

void add_batch(py::module_& m) {
  py::class_<BatchReport>(m, "BatchReport", "What happened to a batch.")
      .def_readonly("failed", &BatchReport::failed, "Number of points that failed; they keep their begin state.")
      .def_property_readonly(
          "first_failed",
          [](const BatchReport& r) { return r.ok() ? py::object(py::none()) : py::object(py::int_(r.first_failed)); },
          "Lowest index of a failed point, or None.")
      .def_property_readonly(
          "first_status", [](const BatchReport& r) { return to_string(r.first_status); },
          "Why that one failed: \"snap_back\", ...; \"ok\" where none did.")
      .def_readonly("cracked", &BatchReport::cracked, "Points cracked at the end.")
      .def_readonly("new_cracks", &BatchReport::new_cracks, "Points that cracked in this call.")
      .def_readonly("iterations", &BatchReport::iterations, "Of the integrator, over all points.")
      .def_property_readonly("ok", &BatchReport::ok, "Whether no point failed.");

  m.def("update_batch", &update_any, py::arg("material"), py::arg("states"), py::arg("strain_increments"),
        py::arg("out") = py::none(), py::arg("tangents") = py::none(), py::kw_only(), py::arg("threads") = 0,
        py::arg("check") = true, R"(Updates many points in one call, on the arrays' own memory.

states             (count,) records of Material.fresh_states(); begin, and where `out` is None also the end
strain_increments  (count, 3) in 2-D, (count, 6) in 3-D, float64, tensor components
out                (count,) records for the end states; contiguous
tangents           (count, n, n) of Material.fresh_tangents(): gets d(stress)/d(strain), Pa
threads            0: all. The result does not depend on it
check              raise UpdateError when a point fails (the others are updated all the same); else look at the
                   report: a failed point keeps its begin state

Inputs that are not contiguous are copied first; outputs never are. Other Python threads run meanwhile, and must leave
the arrays alone.)");
  m.def(
      "state_dtype",
      [](int dim) {
        if (dim != 2 && dim != 3) throw py::value_error("dim must be 2 or 3");
        return with_dim(dim, [](auto d) { return state_dtype<decltype(d)::value>(); });
      },
      py::arg("dim"), "Type of the records that hold states, for dim 2 or 3. See Material.fresh_states().");
}

}  // namespace fpz::python
