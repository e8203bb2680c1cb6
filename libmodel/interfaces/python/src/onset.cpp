#include "fpz/onset.hpp"

#include "arrays.hpp"
#include "material.hpp"

namespace fpz::python {

namespace {

py::dict critical_plane(const PyMaterial& material, const py::object& stress, double scan_degrees) {
  if (!(scan_degrees >= 0.0 && scan_degrees <= 90.0)) throw py::value_error("scan_degrees must be from 0 to 90");
  return with_dim(material.dim(), [&](auto dim) {
    constexpr int Dim = decltype(dim)::value;
    const Tensor<double, Dim> s = read_vector<tensor_size<Dim>>(stress, "stress");
    if (!is_finite(s)) throw py::value_error("stress is not finite");
    Options o = material.behaviour.options;
    if (scan_degrees > 0.0) o.scan_resolution_deg = scan_degrees;
    const Plane<double, Dim> plane = find_plane<Dim>(material.behaviour.material, o, s);
    py::dict d;
    d["failure_value"] = plane.failure_value;
    d["normal"] = to_array(Vec<double, Dim>(plane.frame.row(0).transpose()));
    d["traction"] = to_array(plane.traction);
    return d;
  });
}

/// F on planes with the given normals, which are normalised.
template <int Dim>
py::array_t<double> failure_values(const PyMaterial& material, const py::object& stress, const DoubleArray& normals) {
  const Tensor<double, Dim> s = read_vector<tensor_size<Dim>>(stress, "stress");
  if (normals.ndim() != 2 || normals.shape(1) != Dim) {
    throw py::value_error("normals has the shape " + shape_text(normals) + "; it must be (count, " +
                          std::to_string(Dim) + ")");
  }
  py::array_t<double> values(normals.shape(0));
  for (py::ssize_t k = 0; k < normals.shape(0); ++k) {
    Vec<double, Dim> n;
    for (int i = 0; i < Dim; ++i) n[i] = normals.at(k, i);
    const double length = n.norm();
    if (!(length > 0.0)) throw py::value_error("normals[" + std::to_string(k) + "] has no direction");
    n /= length;
    const Vec<double, Dim> t = to_matrix<double, Dim>(s) * n;
    const double normal = t.dot(n);
    values.mutable_at(k) =
        material.behaviour.material.law.surface.value_at(normal, std::max(t.squaredNorm() - normal * normal, 0.0), 1.0);
  }
  return values;
}

}  // namespace

void add_onset(py::module_& m) {
  m.def("critical_plane", &critical_plane, py::arg("material"), py::arg("stress"), py::kw_only(),
        py::arg("scan_degrees") = 0.0,
        "The plane on which an uncracked point with this stress (Pa, shape (3,) or (6,)) is closest to failure: a "
        "dictionary with failure_value (F, Pa; >= 0: it cracks), normal and traction (Pa, in the frame of the plane). "
        "In closed form, or by the paper's scan of all planes at so many degrees.");
  m.def(
      "failure_values",
      [](const PyMaterial& material, const py::object& stress, const DoubleArray& normals) {
        return with_dim(material.dim(),
                        [&](auto dim) { return failure_values<decltype(dim)::value>(material, stress, normals); });
      },
      py::arg("material"), py::arg("stress"), py::arg("normals"),
      "The yield value F (Pa) of an uncracked point with this stress (Pa) on the planes with these normals, shape "
      "(count, dim): the onset scan. Returns shape (count,).");
}

}  // namespace fpz::python
