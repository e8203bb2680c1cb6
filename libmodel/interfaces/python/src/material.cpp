#include "material.hpp"

#include <pybind11/stl.h>

#include <stdexcept>

#include "arrays.hpp"
#include "errors.hpp"
#include "fpz/io/material_file.hpp"
#include "fpz/tangent.hpp"

namespace fpz::python {

namespace {

constexpr const char* origin = "material";

template <class E>
E word_of(const std::string& word, const char* what) {
  if (const std::optional<E> value = from_word<E>(word)) return *value;
  throw io::InputError(std::string(what) + " " + io::in_quotes(word) + io::suggestion(word, word_list<E>));
}

/// The dictionary of a material: what the source says, and the keywords that replace parts of it.
py::dict tree_of(const py::object& source, const py::dict& keywords) {
  py::dict tree;
  if (py::isinstance<py::str>(source) || py::hasattr(source, "__fspath__")) {
    tree["file"] = source;
  } else if (py::hasattr(source, "items")) {
    tree.attr("update")(source);
  } else if (!source.is_none()) {
    throw py::type_error("the material is neither the name of a file nor a dictionary: " +
                         py::repr(source).cast<std::string>());
  }
  tree.attr("update")(keywords);
  return tree;
}

/// Reads the material; `rve_length` joins its parameters before they are checked.
io::MaterialFile read_tree(const py::dict& tree, double rve_length, Setting setting,
                           std::vector<std::string>& warnings) {
  const auto text = py::module_::import("fpz._json").attr("text_of")(tree).cast<std::string>();
  const io::ReadLimits limits;
  io::Problems problems(limits.problems);
  io::JsonValue root;
  std::optional<io::MaterialFile> material;
  saying_no_line(origin, [&] {
    if (io::parse_json(text, origin, limits, problems, root)) {
      const io::InputReader reader(origin, limits, problems);
      material = io::material_at(reader, io::Place(root), [&reader](const io::Place& name) {
        return io::load_named_material(reader, name, std::filesystem::path());
      });
    }
    if (material) {
      material->parameters.rve_length = rve_length;
      const io::Location of_length{origin, 0, "rve_length"};
      warnings = io::check_material(*material, material->parameters, setting, of_length, problems);
    }
    problems.throw_if_any();
  });
  for (std::string& w : warnings) w = without_line(w, origin);
  return *material;
}

/// Sets the options that the dictionary names; a word alone is the name of the integrator.
Options read_options(const py::object& given) {
  Options o;
  if (given.is_none()) return o;
  py::dict left;
  if (py::isinstance<py::str>(given)) {
    left["name"] = given;
  } else {
    left = py::dict(given);
  }
  std::vector<std::string_view> keys;
  visit_options(o, [&](const char* key, auto& option) {
    keys.emplace_back(key);
    if (!left.contains(key)) return;
    const py::object value = left.attr("pop")(key);
    using Option = std::remove_cvref_t<decltype(option)>;
    if constexpr (Worded<Option>) {
      option = word_of<Option>(py::str(value).cast<std::string>(), "integrator: name:");
    } else if constexpr (std::is_arithmetic_v<Option>) {
      try {
        option = value.cast<Option>();
      } catch (const py::cast_error&) {
        throw py::type_error("integrator: " + std::string(key) + ": " + py::repr(value).cast<std::string>() +
                             " is not a number of the kind that is needed");
      }
    } else {
      option = read_vector<3>(value, key);
    }
  });
  for (const auto& item : left) {
    const auto key = py::str(item.first).cast<std::string>();
    throw io::InputError("integrator: " + io::in_quotes(key) + " is no option" + io::suggestion(key, keys));
  }
  return o;
}

point::Behaviour behaviour_of(Setting setting, const point::Statement& statement) {
  try {
    return point::make_behaviour(setting, statement);
  } catch (const std::invalid_argument& e) {
    throw io::InputError(e.what());
  }
}

MaterialHandle make(const py::object& source, const std::string& setting, const py::object& rve_length,
                    const py::object& integrator, const py::kwargs& parameters) {
  if (rve_length.is_none()) {
    throw io::InputError("rve_length is missing: H, the size across the fracture that the point stands for, m");
  }
  auto material = std::make_shared<PyMaterial>();
  const auto kind = word_of<Setting>(setting, "setting:");
  const Options options = read_options(integrator);
  io::MaterialFile file = read_tree(tree_of(source, parameters), rve_length.cast<double>(), kind, material->warnings);
  material->behaviour = behaviour_of(kind, {file.parameters, options});
  material->name = std::move(file.name);
  material->notes = std::move(file.conversions);
  warn(material->warnings);
  return material;
}

MaterialHandle with_rve_length(const PyMaterial& material, double rve_length) {
  auto other = std::make_shared<PyMaterial>(material);
  Parameters p = material.behaviour.parameters;
  p.rve_length = rve_length;
  other->behaviour = behaviour_of(material.behaviour.setting, {p, material.behaviour.options});
  return other;
}

py::dict parameters_of(const PyMaterial& material) {
  py::dict d;
  const Parameters& p = material.behaviour.parameters;
  for (const ParameterInfo<double>& info : parameter_table<double>) d[py::str(std::string(info.name))] = p.*info.member;
  visit_choices(p.choices, [&d](const char* key, auto choice) { d[key] = to_string(choice); });
  return d;
}

py::dict options_of(const PyMaterial& material) {
  py::dict d;
  visit_options(material.behaviour.options, [&d](const char* key, const auto& option) {
    using Option = std::remove_cvref_t<decltype(option)>;
    if constexpr (Worded<Option>) {
      d[key] = to_string(option);
    } else if constexpr (std::is_arithmetic_v<Option>) {
      d[key] = option;
    } else {
      d[key] = to_array(option);
    }
  });
  return d;
}

std::string repr(const PyMaterial& material) {
  const Parameters& p = material.behaviour.parameters;
  std::string text = "<fpz.Material " + io::in_quotes(material.name) + ", " + to_string(material.behaviour.setting);
  for (const ParameterInfo<double>& info : parameter_table<double>) {
    text += ", " + std::string(info.symbol) + " = " + io::exact(p.*info.member) + (info.unit.empty() ? "" : " ") +
            std::string(info.unit);
  }
  return text + ">";
}

py::array empty_states(const PyMaterial& material, py::ssize_t count) {
  return with_dim(material.dim(), [count](auto dim) -> py::array {
    constexpr int Dim = decltype(dim)::value;
    const py::array states(state_dtype<Dim>(), std::vector<py::ssize_t>{count});
    auto* s = static_cast<State<double, Dim>*>(const_cast<void*>(states.data()));
    std::uninitialized_fill_n(s, count, State<double, Dim>{});
    return states;
  });
}

/// Tensors d(stress)/d(strain) that update_batch() can write: [point, stress, strain], stored column by column.
py::array_t<double> empty_tangents(const PyMaterial& material, py::ssize_t count) {
  const py::ssize_t n = material.dim() == 3 ? 6 : 3;
  const py::ssize_t d = sizeof(double);
  return py::array_t<double>(std::vector<py::ssize_t>{count, n, n}, std::vector<py::ssize_t>{n * n * d, d, n * d});
}

}  // namespace

void add_material(py::module_& m) {
  py::class_<PyMaterial, MaterialHandle>(m, "Material", R"(A material, its setting and its integration.

Material("rock.json", rve_length=0.004)
Material(young_modulus=22.1e9, poisson_ratio=0.19, ..., rve_length=0.004, setting="plane_stress")
Material("rock.json", rve_length=0.004, cohesion=25e6)            # a file, and what differs from it

source       name of a material file, or a dictionary with the keys of one, or None
setting      "plane_strain", "plane_stress" (2-D: components xx, yy, xy) or "3d" (xx, yy, zz, xy, xz, yz)
rve_length   H, m: the size across the fracture that a point stands for. Required
integrator   name ("accurate", "implicit", "paper"), or a dictionary: name, tolerance, max_iterations,
             max_substeps, scan_degrees, preferred_normal (three components)
**kwargs     the keys of material files (docs/path-files.md): young_modulus (Pa), ..., or quantities they follow
             from: bulk_modulus, toughness, ..., also with a unit: {"value": 22.1, "unit": "GPa"}

SI units, angles in degrees, tension positive, shear strains are tensor components. A material does not change.
Raises InputError with all that is wrong, and warns (FpzWarning) about what is doubtful.)")
      .def(py::init(&make), py::arg("source") = py::none(), py::kw_only(), py::arg("setting") = "plane_strain",
           py::arg("rve_length") = py::none(), py::arg("integrator") = py::none())
      .def_property_readonly(
          "name", [](const PyMaterial& self) { return self.name; }, "Name in the file, or the file's.")
      .def_property_readonly(
          "setting", [](const PyMaterial& self) { return to_string(self.behaviour.setting); },
          "\"plane_strain\", \"plane_stress\" or \"3d\".")
      .def_property_readonly("dim", &PyMaterial::dim, "2 or 3.")
      .def_property_readonly("parameters", &parameters_of,
                             "All parameters and choices under the names of material files, and rve_length. A copy.")
      .def_property_readonly("integrator", &options_of, "The options of the integrator. A copy.")
      .def_property_readonly(
          "rve_length", [](const PyMaterial& self) { return self.behaviour.parameters.rve_length; }, "H, m.")
      .def_property_readonly(
          "snap_back_length", [](const PyMaterial& self) { return self.behaviour.snap_back_length; },
          "Largest H without snap-back under strain control in mode I, m.")
      .def_property_readonly(
          "notes", [](const PyMaterial& self) { return self.notes; },
          "Which parameters follow from other quantities, and how: a list of sentences.")
      .def_property_readonly(
          "warnings", [](const PyMaterial& self) { return self.warnings; },
          "What is doubtful, as it was warned about: a list of sentences.")
      .def("with_rve_length", &with_rve_length, py::arg("rve_length"), "The same material with another H (m).")
      .def(
          "elastic_tangent",
          [](const PyMaterial& self) {
            return with_dim(self.dim(), [&self](auto dim) {
              return to_array(elastic_tangent<decltype(dim)::value>(self.behaviour.material.bulk));
            });
          },
          "d(stress)/d(strain) of the bulk, Pa, shape (n, n) with n = 3 in 2-D and 6 in 3-D; tensor shear strains.")
      .def("fresh_states", &empty_states, py::arg("count"),
           "Array of `count` states without strain, for update_batch(). Its fields: strain, stress (Pa), cracked, and "
           "with a meaning only where cracked: frame (columns n, s1[, s2]), traction (Pa), jump, plastic_jump, offset, "
           "slip (m), integrity (1 - D), dissipated (J/m^2 of crack).")
      .def("fresh_tangents", &empty_tangents, py::arg("count"),
           "Array of shape (count, n, n) with the memory layout that update_batch() writes tangents in. Not filled.")
      .def("__repr__", &repr);
}

}  // namespace fpz::python
