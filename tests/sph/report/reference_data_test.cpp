// The curves in data/reference are those that the finite elements of calibration/ compute for what their files state.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "fpz/calibration/notched_specimen.hpp"
#include "reference_curve.hpp"

namespace {

namespace fs = std::filesystem;
using fpz::calibration::NotchedSpecimen;
using fpz::calibration::SpecimenShape;

std::map<std::string, std::string> header_of(const fs::path& file) {
  std::map<std::string, std::string> header;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line) && line.starts_with("#");) {
    const auto equals = line.find(" = ");
    if (equals != std::string::npos) header[line.substr(2, equals - 2)] = line.substr(equals + 3);
  }
  return header;
}

class ReferenceData : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceData, AgreesWithTheModelThatMakesIt) {
  const fs::path file = fs::path(FPZ_DATA_DIR) / "reference" / GetParam();
  const auto header = header_of(file);
  const auto number = [&](std::string_view name) { return std::stod(header.at(std::string(name))); };
  NotchedSpecimen s;
  if (header.at("shape") == "beam") {
    s.length = number("length");
    s.depth = number("depth");
  } else {
    s.shape = SpecimenShape::semicircular;
    s.radius = number("radius");
  }
  s.thickness = number("thickness");
  s.span = number("span");
  s.notch = number("notch");
  s.roller_width = number("roller_width");
  s.setting = *fpz::from_word<fpz::Setting>(header.at("setting"));
  fpz::Parameters p;
  for (const auto& info : fpz::parameter_table<double>) {
    p.*info.member = info.of_material ? number(info.name) : 1e-3;
  }
  const auto model = fracture_curve(s, p);
  ASSERT_EQ(model.failure, "");
  const auto data = fpz::report::read_reference_curve(file, {});
  ASSERT_GT(data.load.size(), 50u);
  ASSERT_EQ(data.load.size(), model.load.size());
  // Equilibrium is found to about 1e-10; another compiler may round differently on the way there.
  const auto near = [](const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-8 * std::abs(b[k])) << "row " << k;
  };
  near(data.load, model.load);
  near(data.cmod, model.cmod);
  near(data.deflection_mid_depth, model.deflection_mid_depth);
}

INSTANTIATE_TEST_SUITE_P(Files, ReferenceData,
                         testing::Values("beam_3pb_rollers_0mm.csv", "beam_3pb_rollers_4mm.csv",
                                         "beam_3pb_rollers_8mm.csv", "beam_3pb_rollers_16mm.csv", "scb_rollers_0mm.csv",
                                         "scb_rollers_3.8mm.csv"));

}  // namespace
