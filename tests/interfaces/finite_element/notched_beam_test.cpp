// The finite-element example against the straight cohesive crack of data/reference, which is another method.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Table = std::map<std::string, std::vector<double>>;

/// Columns by name; an empty field is NaN. Lines that begin with # are left out.
Table read(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> names;
  Table table;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> fields;
    std::istringstream cells(line + ',');
    for (std::string cell; std::getline(cells, cell, ',');) fields.push_back(cell);
    if (names.empty()) {
      names = fields;
      continue;
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      table[names[k]].push_back(k < fields.size() && !fields[k].empty() ? std::stod(fields[k]) : NAN);
    }
  }
  return table;
}

double largest(const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); }

/// The load at an opening, between rows.
double load_at(const Table& t, double opening) {
  const std::vector<double>& x = t.at("cmod");
  const auto k = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), opening) - x.begin());
  const std::vector<double>& y = t.at("load");
  return y[k - 1] + (opening - x[k - 1]) / (x[k] - x[k - 1]) * (y[k] - y[k - 1]);
}

/// Work to an opening of 60 um, N m.
double work(const Table& t) {
  double sum = 0.0;
  constexpr double step = 1e-7;
  for (double x = 0.5 * step; x < 60e-6; x += step) sum += step * load_at(t, x);
  return sum;
}

class NotchedBeam : public testing::Test {
 protected:
  static Table run(const std::string& size, const std::string& integrator = "accurate") {
    const fs::path file = fs::path(testing::TempDir()) / ("beam_" + size + "_" + integrator + ".csv");
    const std::string command =
        std::string(FPZ_FE_BEAM) + " " + size + " " + file.string() + " " + integrator + " > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    Table t = read(file);
    fs::remove(file);
    return t;
  }

  const Table reference_ = read(fs::path(FPZ_DATA_DIR) / "reference" / "beam_3pb_rollers_8mm.csv");
};

TEST_F(NotchedBeam, CurveIsThatOfAStraightCrack) {
  const Table coarse = run("0.008"), fine = run("0.004");
  const auto peak_error = [this](const Table& t) {
    return largest(t.at("load")) / largest(reference_.at("load")) - 1.0;
  };
  EXPECT_LT(std::abs(peak_error(coarse)), 0.03);
  EXPECT_LT(std::abs(peak_error(fine)), 0.03);
  EXPECT_LT(std::abs(peak_error(fine)), std::abs(peak_error(coarse)));
  EXPECT_LT(std::abs(work(fine) / work(reference_) - 1.0), 0.03);
  for (const double opening : {5e-6, 20e-6, 30e-6, 40e-6, 50e-6}) {
    EXPECT_LT(std::abs(load_at(fine, opening) / load_at(reference_, opening) - 1.0), 0.07) << opening;
  }
}

TEST_F(NotchedBeam, NewtonConvergesQuadratically) {
  for (const char* integrator : {"accurate", "implicit"}) {
    const Table t = run("0.008", integrator);
    std::vector<double> orders;
    for (const double p : t.at("order")) {
      if (!std::isnan(p)) orders.push_back(p);
    }
    ASSERT_GT(orders.size(), t.at("order").size() / 2) << integrator;
    std::sort(orders.begin(), orders.end());
    EXPECT_GT(orders[orders.size() / 2], 1.9) << integrator;
    EXPECT_GT(orders[orders.size() / 10], 1.6) << integrator;
    EXPECT_LE(largest(t.at("iterations")), 9.0) << integrator;
  }
}

TEST_F(NotchedBeam, MistakesAreSaid) {
  const std::string program = FPZ_FE_BEAM;
  EXPECT_NE(std::system((program + " 0.003 /dev/null 2> /dev/null").c_str()), 0);
  EXPECT_NE(std::system((program + " 0.008 /dev/null fast 2> /dev/null").c_str()), 0);
}

}  // namespace
