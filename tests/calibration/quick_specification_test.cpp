// A specification made of a few arguments: the same as one written by hand, or refused with the argument that settles
// it.
#include "fpz/calibration/quick_specification.hpp"

#include <gtest/gtest.h>

#include "fpz/calibration/specification.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/law/softening.hpp"
#include "support/temporary_folder.hpp"

namespace fpz::calibration {
namespace {

class QuickSpecification : public ::testing::Test {
 protected:
  QuickSpecification() {
    fit_.data = folder_.write(
        "curve.csv", "CMOD (um);Kraft (kN);Weg (mm)\n0;0;0\n5;0,8;0,01\n10;1,5;0,02\n20;2,4;0,03\n60;1,3;0,05\n");
    fit_.lengths = {{"depth", "100mm"}, {"span", "300 mm"}, {"notch", "50mm"}, {"thickness", "100mm"}};
  }

  [[nodiscard]] Specification read() const {
    return parse_specification(quick_specification(fit_, folder_.path()), folder_.path() / "specification.json");
  }
  void expect_refused(const std::string& part) const {
    try {
      (void)quick_specification(fit_, folder_.path());
      ADD_FAILURE() << "taken, without: " << part;
    } catch (const io::InputError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what() << "\nlacks: " << part;
    }
  }

  test::TemporaryFolder folder_;
  QuickFit fit_;
};

TEST_F(QuickSpecification, IsTheOneThatAPersonWouldWrite) {
  const Specification s = read();
  ASSERT_EQ(s.data.size(), 1U);
  const DataSet& set = s.data[0];
  EXPECT_EQ(set.file, "curve.csv");
  ASSERT_EQ(set.measured.size(), 5);
  EXPECT_DOUBLE_EQ(set.abscissa[3], 20e-6);
  EXPECT_DOUBLE_EQ(set.measured[3], 2400.0);
  const auto& data = std::get<NotchedData>(set.test);
  EXPECT_DOUBLE_EQ(data.test.specimen.depth, 0.1);
  EXPECT_DOUBLE_EQ(data.test.specimen.notch, 0.05);
  EXPECT_EQ(data.test.gauge, Gauge::cmod);
  EXPECT_TRUE(s[Parameter::young_modulus].fitted && s[Parameter::tensile_strength].fitted &&
              s[Parameter::delta0].fitted);
  EXPECT_FALSE(s[Parameter::cohesion].fitted);
}

TEST_F(QuickSpecification, TakesWhatIsStated) {
  fit_.young_modulus = "35 GPa";
  fit_.setting = "plane_stress";
  fit_.softening = "bilinear";
  fit_.lengths[0].second = "0.1m";  // not the unit of the others
  fit_.load.column = "2";
  fit_.load.scale = 2.0;
  const Specification s = read();
  EXPECT_FALSE(s[Parameter::young_modulus].fitted);
  EXPECT_DOUBLE_EQ(s[Parameter::young_modulus].value, 35e9);
  EXPECT_EQ(s.setting, Setting::plane_stress);
  EXPECT_STREQ(to_string(s.choices.softening), "bilinear");
  EXPECT_DOUBLE_EQ(std::get<NotchedData>(s.data[0].test).test.specimen.depth, 0.1);
  EXPECT_DOUBLE_EQ(std::get<NotchedData>(s.data[0].test).test.specimen.span, 0.3);
  EXPECT_DOUBLE_EQ(s.data[0].measured[3], 4800.0);
}

TEST_F(QuickSpecification, WedgeWithItsAngleTakesTheLoadOfTheMachine) {
  fit_.kind = "wedge_splitting";
  fit_.lengths = {{"length", "200mm"},    {"depth", "200mm"}, {"ligament", "100mm"},
                  {"thickness", "100mm"}, {"span", "60mm"},   {"load_depth", "15mm"}};
  EXPECT_DOUBLE_EQ(read().data[0].measured[3], 2400.0);
  fit_.wedge_half_angle_deg = 45.0;
  EXPECT_NEAR(read().data[0].measured[3], 1200.0, 1e-9);
  fit_.gauge = "load_line_opening";
  fit_.reading.column = "1";
  EXPECT_EQ(std::get<NotchedData>(read().data[0].test).test.gauge, Gauge::load_line_opening);
}

TEST_F(QuickSpecification, RefusesWhatIsOpen) {
  fit_.lengths[0].second = "100";
  expect_refused("--depth 100: say the unit");
  fit_.lengths[0].second = "100 kN";
  expect_refused("--depth 100 kN: unknown unit \"kN\"");
  fit_.lengths[0].second = "12,5mm";
  expect_refused("write the number with a decimal point");
  fit_.lengths[0].second = "100mm";
  fit_.load.column = "Last";
  expect_refused("--load Last");
  fit_.load = {};
  fit_.data = folder_.write("curve.csv", "CMOD;Kraft 1;Kraft 2\n0;0;0\n5;0,8;0,01\n10;1,5;0,02\n20;2,4;0,03\n");
  expect_refused("say --cmod-unit");
  fit_.reading.unit = "um";
  expect_refused("several columns may be the load; say --load");
  fit_.load.column = "3";
  expect_refused("say --load-unit");
  fit_.load.unit = "kN";
  fit_.load.scale = 1.0;
  fit_.data = folder_.write("curve.csv", "CMOD;a;b\n0;0;0\n5;-0,8;-0,01\n10;-1,5;-0,02\n20;-2,4;-0,03\n");
  expect_refused("--load-scale=-1");
}

}  // namespace
}  // namespace fpz::calibration
