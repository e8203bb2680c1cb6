#include "patch_trials.hpp"

#include <cmath>
#include <numbers>

#include "patch_setup.hpp"

namespace fpz::report {
namespace {

using Kind = specimen::Pattern::Kind;

NamedPattern lattice(const std::string& name, double degrees, double move) {
  specimen::Pattern p;
  p.fit = degrees == 0.0;
  p.angle = degrees * std::numbers::pi / 180.0;
  p.move = move;
  return {name, p};
}

NamedPattern of_kind(const std::string& name, Kind kind, double move, std::uint64_t seed) {
  specimen::Pattern p;
  p.kind = kind;
  p.move = move;
  p.seed = seed;
  return {name, p};
}

}  // namespace

std::vector<NamedPattern> strip_patterns() {
  return {lattice("lattice", 0.0, 0.0),
          lattice("lattice at 20 deg", 20.0, 0.0),
          lattice("lattice at 45 deg", 45.0, 0.0),
          lattice("lattice moved by 0.1", 0.0, 0.1),
          lattice("lattice moved by 0.2", 0.0, 0.2),
          lattice("lattice moved by 0.3", 0.0, 0.3),
          of_kind("scattered, seed 1", Kind::scattered, 0.0, 1),
          of_kind("scattered, seed 2", Kind::scattered, 0.0, 2),
          of_kind("scattered, seed 3", Kind::scattered, 0.0, 3)};
}

std::vector<NamedPattern> disc_patterns() {
  std::vector<NamedPattern> all = strip_patterns();
  all.push_back(of_kind("rings", Kind::rings, 0.0, 1));
  all.push_back(of_kind("rings moved by 0.3", Kind::rings, 0.3, 1));
  return all;
}

sph::RunSetup<2> patch_setup(const specimen::Body& body, const specimen::Pattern& pattern, double spacing) {
  sph::RunSetup<2> s;
  s.parameters = {30e9, 0.2, 2400.0, 3e6, 10e6, 37.0, 5.0, 16e-6, 1e14, 1e13, 0.0};
  s.setting = Setting::plane_strain;
  s.arrangement = specimen::place_specimen(body, pattern, spacing);
  s.arrangement.surface = specimen::surface_lines(body, 0.25 * spacing);
  s.options.threads = 1;
  return s;
}

void ErrorSum::add(const Tensor<double, 2>& difference, double largest_stress) {
  const double xx = difference[0], yy = difference[1], xy = difference[2];
  add(std::sqrt(xx * xx + yy * yy + 2.0 * xy * xy) / largest_stress);
}

void ErrorSum::add(double error) {
  squares_ += error * error;
  worst_ = std::max(worst_, std::abs(error));
  count_ += 1.0;
}

Errors ErrorSum::errors() const {
  if (count_ == 0.0) return {NAN, NAN};
  return {std::sqrt(squares_ / count_), worst_};
}

}  // namespace fpz::report
