#include "reference_curve.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "fpz/io/input_error.hpp"
#include "support/temporary_folder.hpp"

namespace {

using fpz::report::Condition;
using fpz::report::read_reference_curve;

const std::vector<Condition> wanted = {{"shape", "beam"}, {"span", "0.24"}, {"density", "2400", false}};

std::filesystem::path file_with(const std::string& header) {
  const auto file = fpz::test::fresh_path("curve").replace_extension(".csv");
  std::ofstream(file) << header << "load,cmod,deflection_mid_depth\n0,0,0\n2,3e-6,4e-6\n";
  return file;
}

/// What reading complains about.
std::string complaint(const std::filesystem::path& file) {
  try {
    (void)read_reference_curve(file, wanted);
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ReferenceCurve, IsReadWhenItsConditionsAreTheWantedOnes) {
  const auto curve = read_reference_curve(
      file_with("# Some words.\n# shape = beam\n# span = 0.24000000000000002\n# density = 1\n# more = 3\n"), wanted);
  EXPECT_EQ(curve.load, (std::vector<double>{0.0, 2.0}));
  EXPECT_EQ(curve.cmod, (std::vector<double>{0.0, 3e-6}));
  EXPECT_EQ(curve.deflection_mid_depth, (std::vector<double>{0.0, 4e-6}));
}

TEST(ReferenceCurve, OtherwiseTheMessageNamesFileKeyAndCommand) {
  const auto other = file_with("# shape = beam\n# span = 0.25\n");
  const std::string command = "fpz-notched-reference --shape=beam --span=0.24 --density=2400 -o " + other.string();
  EXPECT_EQ(complaint(other),
            other.string() + ": span is 0.25, the run has 0.24; a matching file is made by\n  " + command);
  const auto without = file_with("# span = 0.24\n");
  EXPECT_NE(complaint(without).find("does not state \"shape\"; a matching file is made by"), std::string::npos);
  const auto missing = fpz::test::fresh_path("none.csv");
  EXPECT_NE(complaint(missing).find(missing.string() + ": cannot be read"), std::string::npos);
  EXPECT_NE(complaint(missing).find("--span=0.24 --density=2400 -o "), std::string::npos);
}

}  // namespace
