#include <cstring>
#include <variant>

#include "arrays.hpp"
#include "errors.hpp"
#include "fpz/energy.hpp"
#include "fpz/jump_control.hpp"
#include "fpz/point/point_update.hpp"
#include "material.hpp"

namespace fpz::python {

namespace {

/// A state, and the update that led to it.
template <int Dim>
struct Place {
  static constexpr int dim = Dim;
  State<double, Dim> state;
  State<double, Dim> begin;
  Tensor<double, Dim> increment = Tensor<double, Dim>::Zero();
  bool has_increment = false;
};

struct PyPoint {
  MaterialHandle material;
  std::variant<Place<2>, Place<3>> place;

  explicit PyPoint(MaterialHandle m) : material(std::move(m)) {
    if (material->dim() == 3) place = Place<3>{};
  }

  [[nodiscard]] const point::Behaviour& behaviour() const { return material->behaviour; }
};

/// A property that follows from f(material, state).
template <class F>
auto of_state(F f) {
  return [f](const PyPoint& self) {
    return std::visit([&](const auto& at) { return f(self.behaviour().material, at.state); }, self.place);
  };
}

point::Outcome update(PyPoint& self, const py::object& strain_increment) {
  return std::visit(
      [&](auto& at) {
        constexpr int Dim = std::remove_cvref_t<decltype(at)>::dim;
        const Tensor<double, Dim> increment = read_vector<tensor_size<Dim>>(strain_increment, "strain_increment");
        State<double, Dim> end;
        const point::Outcome outcome = point::update_point<Dim>(self.behaviour(), at.state, increment, end, nullptr);
        if (!outcome.ok()) raise_update_error(point::last_message(), outcome.status);
        at = {end, at.state, increment, true};
        return outcome;
      },
      self.place);
}

double update_controlled(PyPoint& self, const py::object& direction, double dkappa) {
  if (!(dkappa > 0.0)) throw py::value_error("dkappa must be > 0, m");
  return std::visit(
      [&](auto& at) {
        constexpr int Dim = std::remove_cvref_t<decltype(at)>::dim;
        const Tensor<double, Dim> way = read_vector<tensor_size<Dim>>(direction, "direction");
        State<double, Dim> end;
        double load_factor = 0.0;
        const Report report = fpz::update_controlled<Dim>(self.behaviour().material, self.behaviour().options, at.state,
                                                          way, dkappa, end, load_factor);
        if (!report.ok()) {
          raise_update_error(std::string(to_string(report.status)) +
                                 ": jump control cannot go on in this direction: it must load the zone",
                             report.status);
        }
        at = {end, end, Tensor<double, Dim>::Zero(), false};
        return load_factor;
      },
      self.place);
}

py::array_t<double> tangent(const PyPoint& self) {
  return std::visit(
      [&](const auto& at) {
        constexpr int Dim = std::remove_cvref_t<decltype(at)>::dim;
        if (!at.has_increment && at.state.cracked) {
          throw py::value_error(
              "a tangent belongs to a strain increment: call update() after update_controlled() or "
              "after setting the state of a cracked point");
        }
        State<double, Dim> end;
        Tangent<Dim> c;
        const point::Outcome outcome = point::update_point<Dim>(self.behaviour(), at.begin, at.increment, end, &c);
        if (!outcome.ok()) raise_update_error(point::last_message(), outcome.status);
        return to_array(c);
      },
      self.place);
}

py::object state(const PyPoint& self) {
  return std::visit(
      [](const auto& at) -> py::object {
        constexpr int Dim = std::remove_cvref_t<decltype(at)>::dim;
        const py::array a(state_dtype<Dim>(), std::vector<py::ssize_t>{1}, &at.state);
        return a[py::int_(0)];
      },
      self.place);
}

void set_state(PyPoint& self, const py::object& record) {
  std::visit(
      [&](auto& at) {
        constexpr int Dim = std::remove_cvref_t<decltype(at)>::dim;
        const py::object dtype = py::getattr(record, "dtype", py::none());
        if (!dtype.equal(state_dtype<Dim>())) {
          throw py::type_error(
              "the state must be a record of Material.fresh_states() or the state of a point with the "
              "same number of dimensions");
        }
        const auto bytes = record.attr("tobytes")().template cast<std::string>();
        if (bytes.size() != sizeof at.state) throw py::value_error("one record is needed, not an array of them");
        if (!is_state<Dim>(bytes.data())) throw py::value_error(not_a_state);
        State<double, Dim> s;
        std::memcpy(static_cast<void*>(&s), bytes.data(), sizeof s);
        at = {s, s, Tensor<double, Dim>::Zero(), false};
      },
      self.place);
}

template <int Dim>
py::array_t<double> crack_vector(const State<double, Dim>& s, Vec<double, Dim> CohesiveState<double, Dim>::*field) {
  return to_array(Vec<double, Dim>(s.cracked ? s.crack.*field : Vec<double, Dim>::Zero()));
}

py::object normal(const PyPoint& self) {
  return std::visit(
      [](const auto& at) -> py::object {
        constexpr int Dim = std::remove_cvref_t<decltype(at)>::dim;
        if (!at.state.cracked) return py::none();
        return to_array(Vec<double, Dim>(at.state.frame.row(0).transpose()));
      },
      self.place);
}

std::string repr(const PyPoint& self) {
  return std::visit(
      [](const auto& at) {
        std::string text = "<fpz.Point, strain";
        for (const double x : at.state.strain) text += " " + py::str(py::float_(x)).template cast<std::string>();
        if (!at.state.cracked) return text + ", not cracked>";
        return text + ", cracked, D = " + py::str(py::float_(damage(at.state))).template cast<std::string>() + ">";
      },
      self.place);
}

}  // namespace

void add_point(py::module_& m) {
  py::class_<point::Outcome>(m, "UpdateReport", "What an update needed.")
      .def_readonly("iterations", &point::Outcome::iterations, "Of the integrator.")
      .def_readonly("substeps", &point::Outcome::substeps, "Of the integrator; 0 while a point stays intact.")
      .def_readonly("onset", &point::Outcome::onset, "Whether the fracture appeared in this update.");

  py::class_<PyPoint>(m, "Point", R"(A material point: one state, moved by strain increments.

point = fpz.Point(material)
point.update([1e-5, 0, 0])       # strain increment; 2-D: xx, yy, xy, 3-D: xx, yy, zz, xy, xz, yz
point.stress, point.tangent      # Pa

Shear strains are tensor components. A failing update raises UpdateError and leaves the point as it was; where the
environment variable FPZ_CAPTURE names a folder, it is written there for `fpz-driver replay`.)")
      .def(py::init<MaterialHandle>(), py::arg("material").none(false))
      .def("update", &update, py::arg("strain_increment"),
           "Moves the strain on a straight line by the increment, shape (3,) in 2-D and (6,) in 3-D.")
      .def("update_controlled", &update_controlled, py::arg("direction"), py::arg("dkappa"),
           "Jump control: advances the inelastic displacement kappa by dkappa (m) along begin + load_factor * "
           "direction / |direction|_max, and returns load_factor (a strain), negative where the path snaps back.")
      .def_property_readonly(
          "material", [](const PyPoint& self) { return self.material; }, "The material.")
      .def_property("state", &state, &set_state,
                    "The whole state as a record of a structured array (see Material.fresh_states()), a copy; setting "
                    "it puts the point there.")
      .def_property_readonly("strain", of_state([](const auto&, const auto& s) { return to_array(s.strain); }),
                             "Total strain, shape (3,) or (6,), tensor components.")
      .def_property_readonly("stress", of_state([](const auto&, const auto& s) { return to_array(s.stress); }),
                             "Stress, shape (3,) or (6,), Pa, tension positive.")
      .def_property_readonly("stress_zz", of_state([](const auto& mat, const auto& s) {
                               if constexpr (requires { stress_zz(mat, s); }) return stress_zz(mat, s);
                               return double(s.stress[2]);
                             }),
                             "Out-of-plane stress, Pa.")
      .def_property_readonly("tangent", &tangent,
                             "d(stress)/d(strain) consistent with the last update, Pa, shape (3, 3) or (6, 6), for "
                             "tensor shear strains; of the elastic bulk before the first. Computed when asked for.")
      .def_property_readonly("cracked", of_state([](const auto&, const auto& s) { return s.cracked; }),
                             "Whether the fracture exists.")
      .def_property_readonly("damage", of_state([](const auto&, const auto& s) { return damage(s); }), "D, 0 to 1.")
      .def_property_readonly("normal", &normal, "Unit normal of the crack, shape (dim,); None while there is none.")
      .def_property_readonly(
          "jump", of_state([](const auto&, const auto& s) {
            return crack_vector(s, &std::remove_cvref_t<decltype(s.crack)>::jump);
          }),
          "Displacement jump since onset in the frame of the crack (n, s1[, s2]), m; zeros while there is none.")
      .def_property_readonly("traction", of_state([](const auto&, const auto& s) {
                               return crack_vector(s, &std::remove_cvref_t<decltype(s.crack)>::traction);
                             }),
                             "Traction on the crack in its frame, Pa; zeros while there is none.")
      .def_property_readonly("stored_energy",
                             of_state([](const auto& mat, const auto& s) { return stored_energy(mat, s); }),
                             "Energy stored in bulk and zone, J/m^3.")
      .def_property_readonly("dissipated_energy",
                             of_state([](const auto& mat, const auto& s) { return dissipated_energy(mat, s); }),
                             "Energy dissipated since the beginning, J/m^3.")
      .def(
          "copy", [](const PyPoint& self) { return PyPoint(self); }, "A second point in the same state.")
      .def("__repr__", &repr);
}

}  // namespace fpz::python
