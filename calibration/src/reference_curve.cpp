// fpz-notched-reference: load, opening of the notch and deflection of a notched specimen with a straight crack in pure
// mode I, as a CSV file whose first lines state everything that the curve follows from. The validation report of the
// particle method reads such files from data/reference. Exit status: 0 success; 1 the curve cannot be computed; 2 bad
// usage or an unwritable file.
#include <CLI/CLI.hpp>
#include <iostream>

#include "fpz/calibration/notched_specimen.hpp"
#include "fpz/io/output.hpp"
#include "fpz/io/problems.hpp"

namespace {

namespace io = fpz::io;
using fpz::calibration::FractureCurve;
using fpz::calibration::NotchedSpecimen;
using fpz::calibration::SpecimenShape;

/// What a curve follows from. Of the material only what acts in pure mode I matters beyond rounding.
struct Conditions {
  NotchedSpecimen specimen;
  fpz::Parameters material;
  double end_load = 0.05;  ///< where the curve ends, over the peak; stated where it is not this
};

/// A number among the conditions: an option of the program and a key of the file.
struct Number {
  std::string name, meaning;
  double& value;
  bool beam = true, semicircular = true, pulled_open = true;  ///< which shapes have it

  [[nodiscard]] bool belongs_to(SpecimenShape shape) const {
    if (is_pulled_open(shape)) return pulled_open;
    return shape == SpecimenShape::beam ? beam : semicircular;
  }
};

std::vector<Number> numbers(Conditions& c) {
  NotchedSpecimen& s = c.specimen;
  std::vector<Number> list = {
      {"length", "of the beam, or of others across the notch, m", s.length, true, false},
      {"depth", "of the beam, or of others from the face with the notch to the back, m", s.depth, true, false},
      {"radius", "of the half disc, m", s.radius, false, true, false},
      {"thickness", "m", s.thickness},
      {"span", "distance of the supports or of the two forces, m", s.span},
      {"notch", "from the face to the tip of the notch, m", s.notch},
      {"load_depth", "from the face to the two forces, m", s.load_depth, false, false},
      {"hole", "diameter of the holes that the forces act in, m; 0: none", s.hole, false, false},
      {"groove_width", "of a groove in the face, m", s.groove_width, false, false},
      {"groove_depth", "m", s.groove_depth, false, false},
      {"wedge_slope", "force in the direction of the notch on each side, over the load", s.wedge_slope, false, false},
      {"roller_width", "load and supports are even pressures over this width, m; 0: points", s.roller_width}};
  for (const auto& p : fpz::parameter_table<double>) {
    if (!p.of_material) continue;
    const std::string unit = p.unit.empty() ? "" : ", " + std::string(p.unit);
    list.push_back({std::string(p.name), std::string(p.symbol) + unit, c.material.*p.member});
  }
  return list;
}

/// The conditions by name, as they are spelt in the file and on the command line.
std::vector<std::pair<std::string, std::string>> entries(Conditions& c) {
  std::vector<std::pair<std::string, std::string>> list = {{"shape", fpz::to_string(c.specimen.shape)},
                                                           {"setting", fpz::to_string(c.specimen.setting)}};
  for (const Number& n : numbers(c)) {
    if (n.belongs_to(c.specimen.shape)) list.emplace_back(n.name, io::exact(n.value));
  }
  return list;
}

std::string file_text(Conditions& c, const FractureCurve& curve, const std::string& file) {
  std::string conditions, command = "fpz-notched-reference";
  for (const auto& [name, value] : entries(c)) {
    conditions += "# " + name + " = " + value + "\n";
    command += " --" + name + "=" + value;
  }
  if (c.end_load != Conditions{}.end_load) command += " --end_load=" + io::exact(c.end_load);
  const bool pulled_open = is_pulled_open(c.specimen.shape);
  const std::vector<double>& third = pulled_open ? curve.load_line_opening : curve.deflection_mid_depth;
  std::string text =
      "# Notched specimen with a straight cohesive crack in pure mode I, finite elements (calibration/), SI units:\n"
      "# load, opening of the notch at the face, " +
      std::string(pulled_open ? "opening on the line of the forces"
                              : "deflection at half depth relative to the supports") +
      ". Made by\n# " + command + " -o " + file + "\n" + conditions + "load,cmod," +
      (pulled_open ? "load_line_opening" : "deflection_mid_depth") + "\n";
  for (std::size_t k = 0; k < curve.load.size(); ++k) {
    text += io::exact(curve.load[k]) + "," + io::exact(curve.cmod[k]) + "," + io::exact(third[k]) + "\n";
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Load-deflection curve of a notched specimen by finite elements, for the validation report."};
  Conditions conditions;
  conditions.material.rve_length = 1e-3;  // does not enter a crack without width, but must be valid
  std::string shape, setting = "plane_strain", file;
  app.add_option("--shape", shape, fpz::all_words<SpecimenShape>())->required();
  app.add_option("--setting", setting, "plane_strain or plane_stress");
  for (const Number& n : numbers(conditions)) app.add_option("--" + n.name, n.value, n.meaning);
  app.add_option("--end_load", conditions.end_load, "load at which the curve ends, over the peak")
      ->check(CLI::Range(0.01, 0.99));
  app.add_option("-o,--out", file, "CSV file")->required();
  app.footer("The files in data/reference name the commands that made them.");
  try {
    app.parse(argc, argv);
    const auto s = fpz::from_word<SpecimenShape>(shape);
    if (!s) throw CLI::ValidationError("--shape", "must be " + fpz::all_words<SpecimenShape>());
    const auto t = fpz::from_word<fpz::Setting>(setting);
    if (!t) throw CLI::ValidationError("--setting", "must be plane_strain or plane_stress");
    conditions.specimen.shape = *s;
    conditions.specimen.setting = *t;
    const fpz::Validation valid = validate(conditions.specimen);
    if (!valid.ok()) throw CLI::ValidationError(valid.report());
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  const FractureCurve curve = fracture_curve(conditions.specimen, conditions.material, conditions.end_load);
  if (!curve.failure.empty()) {
    std::cerr << "fpz-notched-reference: " << curve.failure << "\n";
    return 1;
  }
  io::write_text(file, file_text(conditions, curve, file), true);
  std::cout << file << "\n";
  return 0;
} catch (const std::exception& e) {
  std::cerr << "fpz-notched-reference: " << e.what() << "\n";
  return 2;
}
