// The MTest files that are shipped, read as far as needed and run without MTest: what they state, what they impose and
// what they assert. And their references against the originals.
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "interfaces/generic/generic_call.hpp"
#include "support/paths.hpp"
#include "support/temporary_folder.hpp"

namespace fpz {
namespace {

using test::Client;

const std::string folder = std::string(FPZ_SOURCE_DIR) + "/libmodel/interfaces/generic/examples/";

/// Rows of numbers; what stands between them does not matter. Lines that begin otherwise are left out.
std::vector<std::vector<double>> rows_of(const std::string& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in.good()) << file;
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || std::isdigit(static_cast<unsigned char>(line[0])) == 0) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    rows.emplace_back();
    std::istringstream cells(line);
    for (double x; cells >> x;) rows.back().push_back(x);
  }
  return rows;
}

/// All matches of `pattern` in the file, each with its groups.
std::vector<std::smatch> all_of(const std::string& text, const char* pattern) {
  const std::regex r(pattern);
  return {std::sregex_iterator(text.begin(), text.end(), r), std::sregex_iterator()};
}

/// The value at time t of "{0: 0, 1: 3.6e-3, ...}".
double value_at(const std::string& evolution, double t) {
  std::vector<std::pair<double, double>> points;
  for (const auto& m : all_of(evolution, R"(([-+0-9.e]+) *: *([-+0-9.e]+))")) {
    points.emplace_back(std::stod(m[1]), std::stod(m[2]));
  }
  std::size_t k = 1;
  while (k + 1 < points.size() && t > points[k].first) ++k;
  const auto [t0, v0] = points[k - 1];
  const auto [t1, v1] = points[k];
  return v0 + (v1 - v0) * (t - t0) / (t1 - t0);
}

/// Column of a component in a client's arrays: EXX and SXX are 0, ...
std::size_t component(const std::string& name) {
  const std::map<std::string, std::size_t> places = {{"XX", 0}, {"YY", 1}, {"ZZ", 2}, {"XY", 3}, {"XZ", 4}, {"YZ", 5}};
  return places.at(name.substr(1));
}

/// Runs the steps of a four-stage file and checks its assertions; returns how many.
int run(const std::string& file) {
  const std::string text = test::text_of(folder + file);
  const auto hypothesis = all_of(text, "@ModellingHypothesis '(\\w+)'");
  Client c(hypothesis.at(0)[1], test::table1());
  const auto names = &test::symbol<const char*>("Fpz_MaterialProperties");
  std::map<std::string, double> stated;
  for (const auto& m : all_of(text, "@MaterialProperty<constant> '(\\w+)' ([-+0-9.e]+);"))
    stated[m[1]] = std::stod(m[2]);
  EXPECT_EQ(stated.size(), c.properties.size());
  for (std::size_t k = 0; k < c.properties.size(); ++k) c.properties[k] = stated.at(names[k]);
  EXPECT_EQ(c.properties, test::material_properties_of(test::table1())) << file;
  EXPECT_NE(text.find("@Times {0, 1 in 200, 2 in 200, 3 in 200, 4 in 200};"), std::string::npos);
  const auto imposed = all_of(text, "@ImposedStrain<evolution> '(\\w+)' (\\{[^}]*\\});");
  const auto tests = all_of(text, "@Test<file> '([^']+)' \\{([^}]*)\\} ([-+0-9.e]+);");
  std::map<std::string, std::vector<std::vector<double>>> references;
  for (const auto& m : tests) references[m[1]] = rows_of(folder + m[1].str());
  int checks = 0;
  for (std::size_t step = 1; step <= 800; ++step) {
    for (const auto& m : imposed) c.g1[component(m[1])] = value_at(m[2], double(step) / 200.0);
    EXPECT_EQ(c.call(4), 1) << c.text();
    for (const auto& m : tests) {
      const std::string columns = m[2];
      for (const auto& column : all_of(columns, "'(\\w+)' *: *('1.4142135623730951\\*\\$)?(\\d)")) {
        const double factor = column[2].matched ? 1.4142135623730951 : 1.0;
        const double expected = factor * references[m[1]].at(step).at(std::stoul(column[3]) - 1);
        const double computed = column[1] == "damage" ? c.i1.back() : c.f1[component(column[1])];
        EXPECT_NEAR(computed, expected, std::stod(m[3])) << column[1] << ' ' << step;
        ++checks;
      }
    }
    c.update();
  }
  return checks;
}

TEST(GenericExamples, FourStageFilesHold) {
  EXPECT_EQ(run("four_stage_plane_strain.mtest"), 800 * 5);
  EXPECT_EQ(run("four_stage_tridimensional.mtest"), 800 * 5);
  EXPECT_EQ(run("four_stage_plane_stress.mtest"), 800 * 4);
}

TEST(GenericExamples, ReferenceOfPlaneStrainIsThatOfTheData) {
  const auto original = rows_of(std::string(FPZ_DATA_DIR) + "/reference/four_stage.csv");
  auto copy = rows_of(folder + "four_stage.txt");
  ASSERT_EQ(copy.size(), original.size() + 1);
  EXPECT_EQ(copy.front(), std::vector<double>(8, 0.0));
  for (std::size_t k = 0; k < original.size(); ++k) {
    EXPECT_EQ(copy[k + 1], std::vector<double>(original[k].begin(), original[k].begin() + 8));
  }
}

TEST(GenericExamples, ReferenceOfPlaneStressIsThatOfTheIndependentIntegrator) {
  const auto rows = rows_of(folder + "four_stage_plane_stress.txt");
  ASSERT_EQ(rows.size(), 801u);
  test::ReferenceIntegrator r(test::table1(), Setting::plane_stress);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const Tensor<double, 2> part = test::four_stage().legs[(k - 1) / 200] / 200.0;
    test::Matrix3 increment = test::Matrix3::Zero();
    increment(0, 0) = part[0];
    increment(0, 1) = increment(1, 0) = part[2];
    r.advance(increment, {1.0, 0.0, 0.0});
    const double strength = test::table1().tensile_strength;
    ASSERT_NEAR(rows[k][1], r.stress()(0, 0), 1e-10 * strength);
    ASSERT_NEAR(rows[k][2], r.stress()(1, 1), 1e-10 * strength);
    ASSERT_NEAR(rows[k][3], r.stress()(0, 1), 1e-10 * strength);
    ASSERT_NEAR(rows[k][4], r.state().cracked ? 1.0 - r.state().integrity : 0.0, 1e-10);
  }
  EXPECT_GT(rows.back()[4], 0.9);
}

}  // namespace
}  // namespace fpz
