#include <random>

#include "fpz/onset.hpp"
#include "studies.hpp"

namespace fpz::bench {
namespace {

/// A random stress state that fails at load factor 1 (by bisection on the reference search over planes).
template <int Dim>
struct Sample {
  Tensor<double, Dim> stress;  ///< at onset
  test::Vector3 normal;        ///< critical normal there
};

template <int Dim>
std::vector<Sample<Dim>> samples(const Material<double>& m, int count) {
  const test::ReferenceIntegrator reference(test::table1(), m.setting);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Sample<Dim>> out;
  while (static_cast<int>(out.size()) < count) {
    Tensor<double, Dim> s;
    for (int k = 0; k < tensor_size<Dim>; ++k) s[k] = 1e6 * uniform(generator);
    const auto failure = [&](double x) {
      return reference.critical_plane(test::to_matrix3<Dim>(Tensor<double, Dim>(s * x)), test::Vector3::UnitX());
    };
    if (failure(50.0).failure_value < 0.0) continue;  // all-round compression never fails
    double lo = 0.0;
    double hi = 50.0;
    for (int k = 0; k < 60; ++k) {
      const double mid = 0.5 * (lo + hi);
      (failure(mid).failure_value < 0.0 ? lo : hi) = mid;
    }
    out.push_back({Tensor<double, Dim>(s * hi), failure(hi).normal});
  }
  return out;
}

/// Angle to the critical normal or to its conjugate, which mirrors it at the largest principal axis.
template <int Dim>
double angle_error(const Sample<Dim>& sample, const Vec<double, Dim>& normal) {
  const Eigen::SelfAdjointEigenSolver<test::Matrix3> eigen(test::to_matrix3<Dim>(sample.stress));
  test::Vector3 n = test::Vector3::Zero();
  n.head<Dim>() = normal;
  test::Vector3 axis = eigen.eigenvectors().col(2);
  if constexpr (Dim == 2) {  // the largest in-plane one
    const test::Matrix3 stress = test::to_matrix3<Dim>(sample.stress);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> plane(stress.topLeftCorner<2, 2>());
    axis << plane.eigenvectors().col(1), 0.0;
  }
  const test::Vector3 conjugate = 2.0 * axis.dot(sample.normal) * axis - sample.normal;
  return std::min(n.cross(sample.normal).norm(), n.cross(conjugate).norm()) / fpz::degree;
}

/// Relative error of the load factor at which the search first sees F >= 0.
template <int Dim, class Search>
double stress_error(const Sample<Dim>& sample, const Search& search) {
  double x = 1.0;
  double lo = 1.0 - 1e-9;
  double hi = 1.0;
  double f_hi = search(Tensor<double, Dim>(sample.stress * hi)).failure_value;
  double f_lo = search(Tensor<double, Dim>(sample.stress * lo)).failure_value;
  for (int k = 0; k < 60; ++k) {  // secant; F of a finite set of planes is convex and piecewise smooth
    const double next = hi - f_hi * (hi - lo) / (f_hi - f_lo);
    if (!std::isfinite(next) || std::abs(next - x) < 1e-14) break;
    lo = hi;
    f_lo = f_hi;
    hi = x = next;
    f_hi = search(Tensor<double, Dim>(sample.stress * hi)).failure_value;
    if (f_hi == 0.0 || hi == lo) break;
  }
  return std::abs(x - 1.0);
}

template <int Dim>
int add_rows(const std::vector<double>& resolutions, int count, OnsetStudy& study) {
  const Material<double> m = johnstone<Dim>();
  const std::vector<Sample<Dim>> all = samples<Dim>(m, count);
  for (const double degrees : resolutions) {
    const auto search = [&](const Tensor<double, Dim>& s) {
      return degrees > 0.0 ? scan_planes<Dim>(m, s, degrees) : critical_plane<Dim>(m, s);
    };
    OnsetRow row{Dim, degrees, 0.0, 0.0, 0.0};
    for (const Sample<Dim>& sample : all) {
      const Plane<double, Dim> plane = search(sample.stress);
      row.angle_error_deg = std::max(row.angle_error_deg, angle_error<Dim>(sample, plane.frame.row(0).transpose()));
      row.stress_error = std::max(row.stress_error, stress_error(sample, search));
    }
    const auto all_searches = [&] {
      for (const Sample<Dim>& sample : all) keep(search(sample.stress));
    };
    row.nanoseconds = 1e9 * time_interleaved({all_searches}, 0.15)[0] / static_cast<double>(all.size());
    study.rows.push_back(row);
  }
  return static_cast<int>(all.size());
}

}  // namespace

OnsetStudy study_onset() {
  OnsetStudy study;
  study.samples_2d = add_rows<2>({0.0, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0}, 200, study);
  study.samples_3d = add_rows<3>({0.0, 1.0, 2.0, 5.0, 10.0}, 30, study);
  return study;
}

}  // namespace fpz::bench
