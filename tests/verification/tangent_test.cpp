// Derivatives of the discrete updates: against ceres::Jet through the same templates (which checks the bookkeeping of
// the chain rule) and against central differences of the plain update (which checks everything).
#include "fpz/tangent.hpp"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "fpz/energy.hpp"
#include "fpz/update.hpp"
#include "fpz/update_any_scalar.hpp"
#include "support/paths.hpp"

namespace fpz::test {
namespace {

template <int Dim>
struct Point {
  std::string name;
  Parameters parameters;
  Setting setting;
  State<double, Dim> begin;
  Tensor<double, Dim> dstrain;
};

Options options_for(Method method) {
  Options o;
  o.method = method;
  o.tolerance = 1e-10;  // keeps the noise of step control far below the differences
  return o;
}

/// Points along a path: the state before each of `count` equal increments per leg, with that increment; the paths pass
/// elastic states, onset, loading, unloading, closing, sliding and reopening.
template <int Dim>
std::vector<Point<Dim>> points_along(const Path<Dim>& path, const Options& options, int count) {
  const Material<double> m = make_material(path.parameters, path.setting);
  std::vector<Point<Dim>> points;
  State<double, Dim> s;
  for (std::size_t leg = 0; leg < path.legs.size(); ++leg) {
    for (int k = 0; k < count; ++k) {
      const Tensor<double, Dim> d = path.legs[leg] / count;
      points.push_back({path.name + " leg " + std::to_string(leg) + " increment " + std::to_string(k) + " of " +
                            std::to_string(count),
                        path.parameters, path.setting, s, d});
      const Report r = update<Dim>(m, options, s, d, s);
      EXPECT_TRUE(r.ok()) << points.back().name << ": " << to_string(r.status);
      if (!r.ok()) return points;
    }
  }
  return points;
}

template <int Dim>
std::vector<Point<Dim>> points_of(const std::vector<Path<Dim>>& paths, const Options& options) {
  std::vector<Point<Dim>> all;
  for (const Path<Dim>& path : paths) {
    for (const int count : {2, 7, 40}) {
      const auto some = points_along<Dim>(path, options, count);
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  return all;
}

std::vector<Path<2>> paths2() {
  return in_every_zone<2>({four_stage(), mixed_mode(), compressive_shear(), closing(), plane_stress_cycle()});
}

/// Skew onset planes: interior and mode I, no two principal stresses equal.
std::vector<Path<3>> paths3() {
  Path<3> inclined{"inclined", table2(0.25e-3), Setting::three_d, {strain3(5e-3, 1e-3, -8e-4, 2e-3, 1e-3, -5e-4)}};
  inclined.legs.push_back(strain3(-8e-3, 0, 0, 1e-3, 1e-3, 0));
  inclined.legs.push_back(strain3(1e-3, 0, 1e-3, 5e-3, -6e-3, 1e-3));
  Path<3> mode_one{"mode_one", table1(1e-3), Setting::three_d, {strain3(5e-3, 3e-3, 1e-3, 4e-4, 3e-4, 2e-4)}};
  mode_one.legs.push_back(strain3(1e-3, 0, 0, 2e-3, 3e-3, 0));
  mode_one.legs.push_back(strain3(-6e-3, 0, 0, -4e-3, 2e-3, 1e-3));
  Path<3> compressed{"compressed",
                     table1(0.5e-3),
                     Setting::three_d,
                     {strain3(-3e-3, -3.3e-3, -3.5e-3, 0, 0, 0), strain3(0, 1e-4, 0, 1e-2, 4e-3, 3e-3)}};
  return in_every_zone<3>({inclined, mode_one, compressed, rotating_shear()});
}

/// Differences of f(column, step) on both sides. `central` is extrapolated.
template <int Rows, int Cols>
struct Differences {
  using Matrix = Eigen::Matrix<double, Rows, Cols>;
  Matrix central, forward, backward;
  Matrix error;  ///< of `central`, estimated

  template <class F>
  Differences(const F& f, double h) {
    for (int j = 0; j < Cols; ++j) {
      const Eigen::Matrix<double, Rows, 1> here = f(j, 0.0);
      const Eigen::Matrix<double, Rows, 1> right = f(j, h);
      const Eigen::Matrix<double, Rows, 1> left = f(j, -h);
      forward.col(j) = (right - here) / h;
      backward.col(j) = (here - left) / h;
      const Eigen::Matrix<double, Rows, 1> fine = (right - left) / (2.0 * h);
      const Eigen::Matrix<double, Rows, 1> coarse = (f(j, 2.0 * h) - f(j, -2.0 * h)) / (4.0 * h);
      central.col(j) = (4.0 * fine - coarse) / 3.0;
      error.col(j) = (fine - coarse).cwiseAbs();
    }
  }

  /// The function has a kink here: its slopes on both sides differ by more than curvature explains.
  [[nodiscard]] bool kinked(double threshold) const { return (forward - backward).cwiseAbs().maxCoeff() > threshold; }

  /// Distance of a derivative from the interval between the slopes on both sides.
  [[nodiscard]] double outside(const Matrix& d) const {
    const Matrix low = forward.cwiseMin(backward);
    const Matrix high = forward.cwiseMax(backward);
    return std::max((low - d).maxCoeff(), (d - high).maxCoeff());
  }
};

/// Tangents of update_with_tangent. In pure mode I damage depends on the absolute value of the shear jump, so that the
/// update has a kink there (and at events at the very end of an increment): the tangent must then lie between the
/// slopes on both sides. Across pure shear the curvature jumps and differences converge with the first order only:
/// their own error estimate is added to the tolerance.
template <int Dim>
void check_tangents(const std::vector<Point<Dim>>& points, const Options& options, double tolerance) {
  constexpr int N = tensor_size<Dim>;
  int kinks = 0;
  int onsets = 0;
  for (const Point<Dim>& p : points) {
    SCOPED_TRACE(p.name);
    const Material<double> m = make_material(p.parameters, p.setting);
    State<double, Dim> end, plain;
    Tangent<Dim> tangent;
    const Report r = update_with_tangent<Dim>(m, options, p.begin, p.dstrain, end, tangent);
    ASSERT_TRUE(r.ok());
    ASSERT_TRUE(update<Dim>(m, options, p.begin, p.dstrain, plain).ok());
    EXPECT_EQ(end.stress, plain.stress);
    EXPECT_EQ(end.crack.integrity, plain.crack.integrity);
    onsets += r.onset;

    using Jet = ceres::Jet<double, N>;
    State<Jet, Dim> begin_jet, end_jet;
    begin_jet.strain = convert<Jet>(p.begin.strain);
    begin_jet.stress = convert<Jet>(p.begin.stress);
    begin_jet.cracked = p.begin.cracked;
    begin_jet.frame = convert<Jet>(p.begin.frame);
    begin_jet.crack = lift<Jet>(p.begin.crack);
    Tensor<Jet, Dim> d_jet;
    for (int k = 0; k < N; ++k) d_jet[k] = Jet(p.dstrain[k], k);
    ASSERT_TRUE(update<Dim>(m, options, begin_jet, d_jet, end_jet).ok());
    Tangent<Dim> jet;
    for (int k = 0; k < N; ++k) jet.row(k) = end_jet.stress[k].v.transpose();
    const double size = 2.0 * m.bulk.mu + m.bulk.lambda;
    const auto f = [&](int j, double h) -> Eigen::Matrix<double, N, 1> {
      Tensor<double, Dim> d = p.dstrain;
      d[j] += h;
      State<double, Dim> s;
      EXPECT_TRUE(update<Dim>(m, options, p.begin, d, s).ok());
      return s.stress;
    };
    const Differences<N, N> fd(f, 2e-5 * p.parameters.tensile_strength / p.parameters.young_modulus);
    if (fd.kinked(3e-4 * size)) {
      ++kinks;
      EXPECT_LE(fd.outside(tangent), 3e-4 * size) << "tangent\n" << tangent / size;
      continue;
    }
    // The same arithmetic up to the order of operations; onset adds the conditioning of the eigenvectors.
    EXPECT_LE((jet - tangent).cwiseAbs().maxCoeff(), 1e-9 * size);
    EXPECT_LE((fd.central - tangent).cwiseAbs().maxCoeff(), tolerance * size + 2.0 * fd.error.maxCoeff())
        << "differences\n"
        << fd.central / size << "\ntangent\n"
        << tangent / size;
    EXPECT_LE(fd.error.maxCoeff(), 30.0 * tolerance * size);  // the comparison means something
  }
  EXPECT_GT(onsets, 0);

  EXPECT_LE(kinks, static_cast<int>(points.size() / 3)) << "of " << points.size();
}

TEST(Tangent, Implicit2D) {
  const Options o = options_for(Method::implicit);
  check_tangents<2>(points_of<2>(paths2(), o), o, 1e-6);
}
TEST(Tangent, Accurate2D) {
  const Options o = options_for(Method::accurate);
  check_tangents<2>(points_of<2>(paths2(), o), o, 1e-6);
}
TEST(Tangent, Implicit3D) {
  const Options o = options_for(Method::implicit);
  check_tangents<3>(points_of<3>(paths3(), o), o, 1e-6);
}
TEST(Tangent, Accurate3D) {
  const Options o = options_for(Method::accurate);
  check_tangents<3>(points_of<3>(paths3(), o), o, 1e-6);
}

/// dt/du of Algorithm 1: loading, unloading, compression, in 2-D and 3-D.
template <int Dim>
void check_cohesive_tangent(Method method, CohesiveZone zone) {
  const CohesiveLaw<double> law = make_cohesive_law(with_zone(table1(), zone));
  const Options o = options_for(method);
  Vec<double, Dim> onset = Vec<double, Dim>::Zero();
  onset[1] = 0.3e6;
  onset[0] = (law.surface.cohesion - std::hypot(onset[1], law.surface.apex)) / law.surface.tan_phi;
  CohesiveState<double, Dim> z = cracked_at<double, Dim>(law, onset);
  const double moves[][3] = {{2e-6, 1e-6, 1e-6},  {5e-6, 1e-6, -1e-6}, {-2e-9, -1e-9, 0.0}, {4e-6, -9e-6, 2e-6},
                             {-3e-5, 1e-6, 1e-6}, {0.0, 2e-5, 4e-6},   {1e-7, -3e-5, 1e-5}, {6e-5, 1e-5, 1e-6}};
  for (const auto& move : moves) {
    Vec<double, Dim> du;
    for (int k = 0; k < Dim; ++k) du[k] = move[k];
    CohesiveState<double, Dim> end;
    Mat<double, Dim, Dim> tangent;
    ASSERT_TRUE(cohesive_update(law, o, z, du, end, &tangent).ok());
    const auto f = [&](int j, double h) -> Eigen::Matrix<double, Dim, 1> {
      Vec<double, Dim> d = du;
      d[j] += h;
      CohesiveState<double, Dim> s;
      EXPECT_TRUE(cohesive_update(law, o, z, d, s).ok());
      return s.traction;
    };
    const Differences<Dim, Dim> fd(f, 1e-6 * law.softening.length());
    const double size = law.surface.tensile_strength / law.softening.length() + tangent.cwiseAbs().maxCoeff();
    EXPECT_LE((fd.central - tangent).cwiseAbs().maxCoeff(), 2e-6 * size + 2.0 * fd.error.maxCoeff())
        << to_string(method) << "\n"
        << fd.central << "\ntangent\n"
        << tangent;
    EXPECT_LE(fd.error.maxCoeff(), 1e-4 * size);
    z = end;
  }
}

TEST(Tangent, CohesiveUpdate) {
  for (const CohesiveZone zone : {CohesiveZone::consistent, CohesiveZone::published}) {
    for (const Method method : {Method::implicit, Method::accurate}) {
      SCOPED_TRACE(to_string(zone));
      check_cohesive_tangent<2>(method, zone);
      check_cohesive_tangent<3>(method, zone);
    }
  }
}

/// The eleven parameters as an array.
constexpr double Parameters::*parameter_members[] = {
    &Parameters::young_modulus,      &Parameters::poisson_ratio, &Parameters::density,
    &Parameters::tensile_strength,   &Parameters::cohesion,      &Parameters::friction_angle_deg,
    &Parameters::dilation_angle_deg, &Parameters::delta0,        &Parameters::normal_stiffness,
    &Parameters::shear_stiffness,    &Parameters::rve_length};
constexpr int parameter_count = 11;
using ParameterJet = ceres::Jet<double, parameter_count>;

BasicParameters<ParameterJet> seeded(const Parameters& p) {
  ParameterJet x[parameter_count];
  for (int k = 0; k < parameter_count; ++k) x[k] = ParameterJet(p.*parameter_members[k], k);
  return {x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8], x[9], x[10], p.choices};
}

/// Stress after a whole path, for given parameters.
Tensor<double, 2> stress_after(const Path<2>& path, const Parameters& p, const Options& o, int count) {
  const Material<double> m = make_material(p, path.setting);
  State2 s;
  for (const Tensor<double, 2>& leg : path.legs) {
    const Tensor<double, 2> d = leg / count;
    for (int k = 0; k < count; ++k) EXPECT_TRUE(update<2>(m, o, s, d, s).ok());
  }
  return s.stress;
}

/// Derivatives of the stress at the end of a path (onset, loading, unloading, closing inside) with respect to every
/// parameter, carried along the whole path.
void check_parameter_derivatives(const Path<2>& path, Method method) {
  const Options o = options_for(method);
  const int count = 25;
  const Material<ParameterJet> m = make_material(seeded(path.parameters), path.setting);
  State<ParameterJet, 2> s;
  for (const Tensor<double, 2>& leg : path.legs) {
    Tensor<ParameterJet, 2> d;
    for (int k = 0; k < 3; ++k) d[k] = ParameterJet(leg[k] / count);
    for (int k = 0; k < count; ++k) ASSERT_TRUE(update<2>(m, o, s, d, s).ok());
  }
  const double size = path.parameters.tensile_strength;
  for (int j = 0; j < parameter_count; ++j) {
    SCOPED_TRACE(path.name + " " + to_string(method) + " parameter " + std::to_string(j));
    const double x = path.parameters.*parameter_members[j];
    const auto at = [&](double factor) {
      Parameters p = path.parameters;
      p.*parameter_members[j] = x * factor;
      return stress_after(path, p, o, count);
    };
    const double h = 1e-5;
    const Tensor<double, 2> fine = (at(1.0 + h) - at(1.0 - h)) / (2.0 * h);
    const Tensor<double, 2> coarse = (at(1.0 + 2.0 * h) - at(1.0 - 2.0 * h)) / (4.0 * h);
    for (int k = 0; k < 3; ++k) {
      // d stress / d log(parameter), over sigma_t0
      const double jet = s.stress[k].v[j] * x / size;
      const double fd = (4.0 * fine[k] - coarse[k]) / 3.0 / size;
      const double error = std::abs(fine[k] - coarse[k]) / size;
      EXPECT_NEAR(jet, fd, 1e-5 * (1.0 + std::abs(fd)) + 2.0 * error) << k;
      EXPECT_LE(error, 1e-3 * (1.0 + std::abs(fd))) << k;
    }
  }
}

TEST(ParameterDerivatives, Implicit) {
  for (const Path<2>& path : in_every_zone<2>({mixed_mode(), compressive_shear(), closing(), plane_stress_cycle()})) {
    check_parameter_derivatives(path, Method::implicit);
  }
}
TEST(ParameterDerivatives, Accurate) {
  for (const Path<2>& path : in_every_zone<2>({mixed_mode(), compressive_shear(), closing(), plane_stress_cycle()})) {
    check_parameter_derivatives(path, Method::accurate);
  }
}

}  // namespace
}  // namespace fpz::test
