// Random strain walks: statements that hold for every admissible material and path.
#include <gtest/gtest.h>

#include <random>

#include "fpz/energy.hpp"
#include "fpz/onset.hpp"
#include "fpz/tangent.hpp"
#include "fpz/update.hpp"
#include "support/paths.hpp"

namespace fpz::test {
namespace {

using Rng = std::mt19937_64;

struct Scenario {
  std::string name;
  Parameters parameters;
  Setting setting;
  bool safe;  ///< H well below any snap-back
};

std::vector<Scenario> setups(bool three_d) {
  std::vector<Scenario> all;
  const auto add_one = [&](const std::string& name, const Parameters& p, bool safe) {
    if (three_d) {
      all.push_back({name + " 3d", p, Setting::three_d, safe});
    } else {
      all.push_back({name + " plane strain", p, Setting::plane_strain, safe});
      all.push_back({name + " plane stress", p, Setting::plane_stress, safe});
    }
  };
  const auto add = [&](const std::string& name, Parameters p, bool safe) {
    for (const Word<CohesiveZone>& zone : Words<CohesiveZone>::list) {
      for (const Word<SofteningKind>& softening : Words<SofteningKind>::list) {
        p.choices = {softening.value, zone.value};
        add_one(name + ", " + zone.text + ", " + softening.text, p, safe);
      }
    }
  };
  add("table 1, 0.5 mm", table1(0.5e-3), true);
  add("table 1, 10 mm", table1(10e-3), false);
  add("table 2, 0.05 mm", table2(0.05e-3), true);
  add("table 2, 50 mm", table2(50e-3), false);
  add("table 3, 0.05 mm", table3(0.05e-3), true);
  return all;
}

/// A strain increment: a random direction, mostly a continuation of the last one, with a size drawn over four decades.
template <int Dim>
Tensor<double, Dim> random_step(Rng& rng, Tensor<double, Dim>& direction, double scale) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  const double choice = uniform(rng);
  if (choice < 0.15 && direction.norm() > 0.0) {
    direction = -direction;  // unloading
  } else if (choice < 0.6 || direction.norm() == 0.0) {
    for (int k = 0; k < tensor_size<Dim>; ++k) direction[k] = normal(rng);
    if (uniform(rng) < 0.2) direction *= 0.0, direction[int(uniform(rng) * tensor_size<Dim>)] = 1.0;
  }
  return direction / direction.norm() * scale * std::pow(10.0, -4.0 * uniform(rng));
}

template <int Dim>
double yield_of(const Material<double>& m, const State<double, Dim>& s) {
  return m.law.surface.value_at(s.crack.traction[0], s.crack.traction.template tail<Dim - 1>().squaredNorm(),
                                s.crack.integrity);
}

/// A strain that opens a crack of about ten times delta0 over the whole walk.
double walk_scale(const Parameters& p) {
  return 1.5 * (p.tensile_strength / p.young_modulus + p.delta0 / p.rve_length);
}

/// Whether the softening law reaches w = 0.
bool softening_ends(const Material<double>& m) {
  return m.law.softening.piece_end(m.law.softening.piece(1e-300)) >= 0.0;
}

template <int Dim>
void expect_sound(const Material<double>& m, const State<double, Dim>& s, const State<double, Dim>& before) {
  ASSERT_TRUE(s.stress.allFinite() && s.crack.plastic_jump.allFinite() && std::isfinite(s.crack.integrity));
  if (!s.cracked) {
    ASSERT_LT(critical_plane<Dim>(m, s.stress).failure_value, 1e-12 * m.law.surface.cohesion);
    return;
  }
  const double size = m.law.surface.cohesion + s.crack.traction.norm();
  // Relative to the strength that is left; Kn times the rounding of the jumps limits it.
  const double jumps = s.crack.jump.norm() + s.crack.offset.norm() + s.crack.plastic_jump.norm();
  double stiffness = s.crack.traction[0] < 0.0 ? m.law.kn : m.law.kn * s.crack.integrity;
  if (m.law.zone == CohesiveZone::consistent) stiffness = std::max(1.0 / m.series.normal, 1.0 / m.series.shear);
  const double strength = m.law.surface.cohesion * s.crack.integrity + s.crack.traction.norm();
  ASSERT_LE(yield_of(m, s), 1e-8 * size);
  if (s.crack.integrity > 1e-12) {  // below, the strength left is under 1e-6 Pa
    ASSERT_LE(yield_of(m, s), 1e-8 * strength + 1e-15 * stiffness * jumps);
  }
  const Vec<double, Dim> t = local_traction<double, Dim>(s.frame, s.stress);
  const double cancel = (m.bulk.lambda + 2.0 * m.bulk.mu) * (s.strain.norm() + s.crack.jump.norm() / m.rve_length);
  ASSERT_LE((t - s.crack.traction).norm(), 1e-9 * size + 1e-14 * cancel);
  if (!before.cracked) return;
  ASSERT_LE(s.crack.integrity, before.crack.integrity);
  ASSERT_GE(s.crack.slip, before.crack.slip);
  ASSERT_GE(s.crack.dissipated,
            before.crack.dissipated - 1e-14 * m.law.surface.tensile_strength * m.law.softening.length());
  if (m.law.zone == CohesiveZone::consistent) {
    // D follows from flow, of which the slip is a part.
    ASSERT_LE(s.crack.integrity, m.law.softening.after(1.0, s.crack.slip) + 1e-6);
    ASSERT_GE(free_energy(m.law, s.crack), 0.0);
    return;
  }
  // eq 47: D follows from the inelastic jump; up_n falls never (dilation).
  ASSERT_GE(s.crack.plastic_jump[0], before.crack.plastic_jump[0] - 1e-14 * m.law.softening.length());
  const double w = m.law.softening.after(1.0, s.crack.plastic_jump[0] + s.crack.slip);
  // In `accurate` D is integrated and up_n follows from continuity: they agree to its tolerance (1e-6 here), which for
  // a law that ends is one of D itself.
  ASSERT_NEAR(s.crack.integrity, w, softening_ends(m) ? 1e-6 : 1e-6 * w);
}

template <int Dim>
void soundness(Method method) {
  Options o;
  o.method = method;
  int cracked = 0;
  int snapped = 0;
  for (const Scenario& setup : setups(Dim == 3)) {
    const Material<double> m = make_material(setup.parameters, setup.setting);
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      SCOPED_TRACE(setup.name + ", " + to_string(method) + ", seed " + std::to_string(seed));
      Rng rng(seed);
      State<double, Dim> s;
      Tensor<double, Dim> direction = Tensor<double, Dim>::Zero();
      for (int k = 0; k < 150; ++k) {
        const State<double, Dim> before = s;
        const Tensor<double, Dim> d = random_step<Dim>(rng, direction, walk_scale(setup.parameters));
        const Report r = update<Dim>(m, o, before, d, s);
        if (r.status == Status::snap_back && !setup.safe) {
          EXPECT_EQ(s.stress, before.stress);
          EXPECT_EQ(s.crack.integrity, before.crack.integrity);
          ++snapped;
          break;
        }
        ASSERT_EQ(r.status, Status::ok) << to_string(r.status) << ", step " << k;
        expect_sound<Dim>(m, s, before);
        if (testing::Test::HasFatalFailure()) {
          ADD_FAILURE() << "step " << k << " " << d.transpose();
          return;
        }
      }
      cracked += s.cracked;
    }
  }
  EXPECT_GT(cracked, 100);
  EXPECT_GT(snapped, 10);
}

TEST(RandomWalk, Accurate2DIsSound) { soundness<2>(Method::accurate); }
TEST(RandomWalk, Accurate3DIsSound) { soundness<3>(Method::accurate); }
TEST(RandomWalk, Implicit2DIsSound) { soundness<2>(Method::implicit); }
TEST(RandomWalk, Implicit3DIsSound) { soundness<3>(Method::implicit); }

/// What stress errors are measured against: sigma_t0, and in the consistent zone the traction of contact too, because
/// t = q/(b + D/K): an error of D changes it in proportion.
template <int Dim>
double stress_scale(const Parameters& p, const State<double, Dim>& s) {
  const bool by_damage = s.cracked && p.choices.cohesive_zone == CohesiveZone::consistent;
  return p.tensile_strength + (by_damage ? s.crack.traction.norm() : 0.0);
}

/// Largest difference of two states: stress over its scale, and D.
template <int Dim>
double distance(const Parameters& p, const State<double, Dim>& a, const State<double, Dim>& b) {
  return std::max((a.stress - b.stress).cwiseAbs().maxCoeff() / stress_scale(p, a), std::abs(damage(a) - damage(b)));
}

/// A fully damaged crack that closes again is a contact whose position is known to tolerance * delta0: its stress is
/// known to that times the stiffness of the bulk, in units of sigma_t0 / delta0. 1 for a crack that still carries
/// traction.
template <int Dim>
double contact_factor(const Material<double>& m, const State<double, Dim>& s) {
  if (!s.cracked || s.crack.integrity > 1e-3) return 1.0;
  return std::max(1.0, m.law.softening.length() / (m.series.normal * m.law.surface.tensile_strength));
}

/// Visits random walks of safe materials: visit(setup, material, increments).
template <int Dim, class Visit>
void each_walk(int seeds, int steps, const Visit& visit) {
  for (const Scenario& setup : setups(Dim == 3)) {
    if (!setup.safe) continue;
    const Material<double> m = make_material(setup.parameters, setup.setting);
    for (int seed = 0; seed < seeds; ++seed) {
      SCOPED_TRACE(setup.name + ", seed " + std::to_string(seed));
      Rng rng(1000 + std::uint64_t(seed));
      Tensor<double, Dim> direction = Tensor<double, Dim>::Zero();
      std::vector<Tensor<double, Dim>> walk;
      for (int k = 0; k < steps; ++k) walk.push_back(random_step<Dim>(rng, direction, walk_scale(setup.parameters)));
      visit(setup, m, walk);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

/// accurate against the independent reference along whole walks.
template <int Dim>
void against_reference() {
  Options o;
  o.tolerance = 1e-7;
  each_walk<Dim>(12, 40, [&](const Scenario& setup, const Material<double>& m, const auto& walk) {
    ReferenceIntegrator reference(setup.parameters, setup.setting);
    State<double, Dim> s;
    for (std::size_t k = 0; k < walk.size(); ++k) {
      SCOPED_TRACE("step " + std::to_string(k));
      ASSERT_EQ(update<Dim>(m, o, s, walk[k], s).status, Status::ok);
      // The reference works with unscaled tractions and loses digits where little is left.
      if (s.crack.integrity < 1e-5 || (s.crack.integrity < 0.02 && softening_ends(m))) break;
      ASSERT_NO_THROW(reference.advance(to_matrix3<Dim>(walk[k]), normal_of(s)));
      const Matrix3 difference = reference.stress() - to_matrix3<Dim>(s.stress);
      ASSERT_LE((difference.topLeftCorner<Dim, Dim>().cwiseAbs().maxCoeff()),
                o.tolerance * contact_factor(m, s) * stress_scale(setup.parameters, s) + 1e-11 * s.stress.norm());
      ASSERT_NEAR(1.0 - reference.state().integrity, damage(s), o.tolerance);
    }
  });
}
TEST(RandomWalk, Accurate2DAgreesWithTheReference) { against_reference<2>(); }
TEST(RandomWalk, Accurate3DAgreesWithTheReference) { against_reference<3>(); }

/// Work = stored + dissipated. Work by the trapezoidal rule over fine sub-increments of every step; its error is the
/// curvature of the stress within them (and a kink here and there), measured by halving.
template <int Dim>
void energy_balance() {
  Options o;
  o.tolerance = 1e-9;
  each_walk<Dim>(4, 25, [&](const Scenario& setup, const Material<double>& m, const auto& walk) {
    double work[2] = {0.0, 0.0};
    State<double, Dim> end[2];
    for (const int pass : {0, 1}) {
      const int parts = pass == 0 ? 100 : 200;
      State<double, Dim>& s = end[pass];
      for (const Tensor<double, Dim>& step : walk) {
        const Tensor<double, Dim> d = step / parts;
        for (int k = 0; k < parts; ++k) {
          const Tensor<double, Dim> before = s.stress;
          ASSERT_EQ(update<Dim>(m, o, s, d, s).status, Status::ok);
          work[pass] += 0.5 * double_dot<Dim>(Tensor<double, Dim>(before + s.stress), d);
        }
      }
    }
    const double balance = stored_energy(m, end[1]) + dissipated_energy(m, end[1]);
    const double scale = setup.parameters.tensile_strength * setup.parameters.delta0 / setup.parameters.rve_length;
    EXPECT_NEAR(work[1], balance, 4.0 * std::abs(work[1] - work[0]) + 1e-7 * scale);
    EXPECT_LE(std::abs(work[1] - work[0]), 2e-3 * (scale + std::abs(balance)));  // the comparison means something
    EXPECT_NEAR(dissipated_energy(m, end[0]), dissipated_energy(m, end[1]), 1e-7 * scale);
  });
}
TEST(RandomWalk, EnergyBalance2D) { energy_balance<2>(); }
TEST(RandomWalk, EnergyBalance3D) { energy_balance<3>(); }

/// Two half steps are one step.
template <int Dim>
void split_steps() {
  Options o;
  o.tolerance = 1e-6;
  each_walk<Dim>(15, 60, [&](const Scenario& setup, const Material<double>& m, const auto& walk) {
    State<double, Dim> one, two;
    for (const Tensor<double, Dim>& d : walk) {
      ASSERT_EQ(update<Dim>(m, o, one, d, one).status, Status::ok);
      const Tensor<double, Dim> half = 0.5 * d;
      for (int k = 0; k < 2; ++k) ASSERT_EQ(update<Dim>(m, o, two, half, two).status, Status::ok);
      ASSERT_LE(distance(setup.parameters, one, two), 2.0 * o.tolerance * contact_factor(m, one));
    }
  });
}
TEST(RandomWalk, OneStepIsTwoHalfSteps2D) { split_steps<2>(); }
TEST(RandomWalk, OneStepIsTwoHalfSteps3D) { split_steps<3>(); }

/// A zero increment in between changes nothing.
template <int Dim>
void zero_increments(Method method) {
  Options o;
  o.method = method;
  each_walk<Dim>(10, 60, [&](const Scenario& setup, const Material<double>& m, const auto& walk) {
    State<double, Dim> s;
    for (const Tensor<double, Dim>& d : walk) {
      ASSERT_EQ(update<Dim>(m, o, s, d, s).status, Status::ok);
      State<double, Dim> again = s;
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(update<Dim>(m, o, again, Tensor<double, Dim>(0.0 * d), again).status, Status::ok);
      }
      // Rounding of the strain terms that cancel in the stress of an open crack.
      const double cancel = m.bulk.mu * s.strain.norm();
      ASSERT_LE((again.stress - s.stress).norm(),
                1e-13 * cancel + 1e-12 * (s.stress.norm() + setup.parameters.cohesion));
      ASSERT_EQ(again.crack.integrity, s.crack.integrity);
      ASSERT_EQ(again.crack.slip, s.crack.slip);
      ASSERT_EQ(again.crack.dissipated, s.crack.dissipated);
    }
  });
}
TEST(RandomWalk, ZeroIncrementsChangeNothing) {
  zero_increments<2>(Method::accurate);
  zero_increments<3>(Method::accurate);
  zero_increments<2>(Method::implicit);
  zero_increments<3>(Method::implicit);
}

template <int Dim>
Mat<double, Dim, Dim> random_rotation(Rng& rng, bool mirror) {
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, Dim, Dim> a;
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) a(i, j) = normal(rng);
  }
  Eigen::Matrix<double, Dim, Dim> q = a.householderQr().householderQ();
  if ((q.determinant() < 0.0) != mirror) q.row(0) *= -1.0;
  return q;
}

template <int Dim>
Tensor<double, Dim> rotated(const Tensor<double, Dim>& a, const Mat<double, Dim, Dim>& q) {
  const Mat<double, Dim, Dim> b = q * to_matrix<double, Dim>(a) * q.transpose();
  Tensor<double, Dim> r;
  if constexpr (Dim == 2) {
    r << b(0, 0), b(1, 1), b(0, 1);
  } else {
    r << b(0, 0), b(1, 1), b(2, 2), b(0, 1), b(0, 2), b(1, 2);
  }
  return r;
}

/// Rotated or mirrored strain gives rotated or mirrored stress. The preferred normal goes along, so that the same of
/// two conjugate planes is meant.
template <int Dim>
void frame_invariance(bool mirror) {
  each_walk<Dim>(15, 40, [&](const Scenario& setup, const Material<double>& m, const auto& walk) {
    Rng rng(7);
    const Mat<double, Dim, Dim> q = random_rotation<Dim>(rng, mirror);
    Options o, oq;
    o.tolerance = oq.tolerance = 1e-7;
    Vec<double, Dim> preferred;
    for (int k = 0; k < Dim; ++k) preferred[k] = 0.3 + 0.4 * k;
    o.preferred_normal.head<Dim>() = preferred;
    oq.preferred_normal.head<Dim>() = q * preferred;
    for (const Method method : {Method::implicit, Method::accurate}) {
      o.method = oq.method = method;
      State<double, Dim> s, sq;
      for (const Tensor<double, Dim>& d : walk) {
        ASSERT_EQ(update<Dim>(m, o, s, d, s).status, Status::ok);
        ASSERT_EQ(update<Dim>(m, oq, sq, rotated<Dim>(d, q), sq).status, Status::ok);
        const Tensor<double, Dim> expected = rotated<Dim>(s.stress, q);
        // Rounding may move an event or a step length of `accurate`, hence its tolerance.
        const double tolerance = 2e-7 * contact_factor(m, s);
        ASSERT_LE((sq.stress - expected).norm(),
                  tolerance * stress_scale(setup.parameters, s) + 1e-11 * expected.norm());
        ASSERT_NEAR(damage(sq), damage(s), 2e-7);
        ASSERT_NEAR(stored_energy(m, sq), stored_energy(m, s), 1e-6 * (std::abs(stored_energy(m, s)) + 1e3));
      }
    }
  });
}
TEST(RandomWalk, FrameInvariance2D) { frame_invariance<2>(false); }
TEST(RandomWalk, FrameInvariance3D) { frame_invariance<3>(false); }
TEST(RandomWalk, MirrorInvariance2D) { frame_invariance<2>(true); }
TEST(RandomWalk, MirrorInvariance3D) { frame_invariance<3>(true); }

/// rotate() of a state commutes with the update.
TEST(RandomWalk, RotatingTheStateCommutesWithTheUpdate) {
  Options o;
  each_walk<3>(10, 30, [&](const Scenario& setup, const Material<double>& m, const auto& walk) {
    Rng rng(9);
    const Mat<double, 3, 3> q = random_rotation<3>(rng, false);
    State3 s;
    for (const Tensor<double, 3>& d : walk) {
      State3 turned = s;
      rotate(turned, q);
      const bool was_cracked = s.cracked;
      ASSERT_EQ(update<3>(m, o, s, d, s).status, Status::ok);
      if (!was_cracked) continue;  // the choice of the plane is the subject of the tests above
      ASSERT_EQ(update<3>(m, o, turned, rotated<3>(d, q), turned).status, Status::ok);
      const Tensor<double, 3> expected = rotated<3>(s.stress, q);
      ASSERT_LE((turned.stress - expected).norm(), 2e-6 * setup.parameters.tensile_strength + 1e-11 * expected.norm());
      ASSERT_NEAR(damage(turned), damage(s), 2e-6);
    }
  });
}

/// implicit in tiny steps tends to accurate: first order.
template <int Dim>
void implicit_tends_to_accurate() {
  Options implicit, accurate;
  implicit.method = Method::implicit;
  accurate.tolerance = 1e-8;
  each_walk<Dim>(3, 20, [&](const Scenario& setup, const Material<double>& m, const auto& walk) {
    State<double, Dim> a;
    for (const Tensor<double, Dim>& d : walk) ASSERT_EQ(update<Dim>(m, accurate, a, d, a).status, Status::ok);
    double error[2];
    for (const int pass : {0, 1}) {
      const int parts = pass == 0 ? 400 : 6400;
      State<double, Dim> i;
      for (const Tensor<double, Dim>& step : walk) {
        const Tensor<double, Dim> d = step / parts;
        for (int k = 0; k < parts; ++k) ASSERT_EQ(update<Dim>(m, implicit, i, d, i).status, Status::ok);
      }
      error[pass] = distance(setup.parameters, a, i);
    }
    EXPECT_LE(error[0], 5e-3);
    EXPECT_LE(error[1], std::max(error[0] / 8.0, 1e-6));  // 16 times finer; the worst component may change
  });
}
TEST(RandomWalk, ImplicitTendsToAccurate2D) { implicit_tends_to_accurate<2>(); }
TEST(RandomWalk, ImplicitTendsToAccurate3D) { implicit_tends_to_accurate<3>(); }

}  // namespace
}  // namespace fpz::test
