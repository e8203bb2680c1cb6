// What an outside program does: state a material, have it checked, update points singly and in a batch.
#include <cstdio>
#include <vector>

#include "fpz/batch.hpp"

int main() {
  fpz::Parameters p;
  p.young_modulus = 0.4e9;
  p.poisson_ratio = 0.25;
  p.density = 1540.0;
  p.tensile_strength = 0.6e6;
  p.cohesion = 1.0e6;
  p.friction_angle_deg = 33.0;
  p.dilation_angle_deg = 4.0;
  p.delta0 = 18e-6;
  p.normal_stiffness = 1e13;
  p.shear_stiffness = 1e11;
  p.rve_length = 4e-3;

  const fpz::Validation good = fpz::validate(p, fpz::Setting::plane_strain);
  if (!good.ok()) {
    std::fputs(good.report().c_str(), stderr);
    return 1;
  }
  const auto material = fpz::make_material(p, fpz::Setting::plane_strain);
  std::printf("lambda = %g Pa, mu = %g Pa\n", material.bulk.lambda, material.bulk.mu);

  std::vector<fpz::State2> points(100);
  fpz::Tensor<double, 2> stretch;
  stretch << 3e-3, 0.0, 0.0;
  const std::vector<fpz::Tensor<double, 2>> increments(points.size(), stretch);
  const fpz::Options options;
  const fpz::BatchReport batch = fpz::update_batch<2>(material, options, points, increments, points);
  fpz::State2 point;
  const fpz::Report single = fpz::update<2>(material, options, point, stretch, point);
  std::printf("D = %g in all %zu points\n", fpz::damage(point), batch.cracked);
  if (!batch.ok() || !single.ok() || batch.cracked != points.size() || points.back().stress != point.stress) return 1;

  p.cohesion = 0.3e6;
  const fpz::Validation bad = fpz::validate(p, fpz::Setting::plane_strain);
  std::fputs(bad.report().c_str(), stdout);
  return bad.ok() ? 1 : 0;
}
