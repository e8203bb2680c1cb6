// Inputs that break constitutive updates, each with what is right.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "fpz/cohesive_update.hpp"
#include "fpz/energy.hpp"
#include "fpz/tangent.hpp"
#include "fpz/update.hpp"
#include "support/paths.hpp"

namespace fpz::test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Method robust[] = {Method::implicit, Method::accurate};

Options with(Method method, double tolerance = 1e-8) {
  Options o;
  o.method = method;
  o.tolerance = tolerance;
  return o;
}

template <int Dim>
bool finite(const State<double, Dim>& s) {
  return s.stress.allFinite() && s.strain.allFinite() && s.frame.allFinite() && s.crack.traction.allFinite() &&
         s.crack.jump.allFinite() && s.crack.plastic_jump.allFinite() && s.crack.offset.allFinite() &&
         std::isfinite(s.crack.slip) && std::isfinite(s.crack.integrity) && std::isfinite(s.crack.dissipated);
}

/// Equality of every number in two states, bit for bit (a NaN equals itself).
template <int Dim>
bool same(const State<double, Dim>& a, const State<double, Dim>& b) {
  const auto bits = [](const auto& x, const auto& y) {
    return std::memcmp(x.data(), y.data(), sizeof(double) * std::size_t(x.size())) == 0;
  };
  const auto bit = [](double x, double y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return bits(a.strain, b.strain) && bits(a.stress, b.stress) && a.cracked == b.cracked && bits(a.frame, b.frame) &&
         bits(a.crack.traction, b.crack.traction) && bits(a.crack.jump, b.crack.jump) &&
         bits(a.crack.plastic_jump, b.crack.plastic_jump) && bits(a.crack.offset, b.crack.offset) &&
         bit(a.crack.slip, b.crack.slip) && bit(a.crack.integrity, b.crack.integrity) &&
         bit(a.crack.dissipated, b.crack.dissipated);
}

/// What holds after every update that says ok.
template <int Dim>
void expect_sound(const Material<double>& m, const State<double, Dim>& s) {
  ASSERT_TRUE(finite(s));
  if (!s.cracked) return;
  const double c0 = m.law.surface.cohesion;
  const double w = s.crack.integrity;
  EXPECT_GE(w, 0.0);
  EXPECT_LE(w, 1.0);
  const double ts2 = s.crack.traction.template tail<Dim - 1>().squaredNorm();
  const double size = c0 + s.crack.traction.norm();
  EXPECT_LE(m.law.surface.value_at(s.crack.traction[0], ts2, w), 1e-9 * size);
  const Vec<double, Dim> t = local_traction<double, Dim>(s.frame, s.stress);
  // Continuity to rounding of the bulk stress that cancels against the jump's.
  const double cancel = (m.bulk.lambda + 2.0 * m.bulk.mu) * (s.strain.norm() + s.crack.jump.norm() / m.rve_length);
  EXPECT_LE((t - s.crack.traction).norm(), 1e-9 * size + 1e-14 * cancel);
}

/// A cracked state with damage: mode I first, a little shear.
State2 damaged(const Material<double>& m, double opening = 4e-3) {
  State2 s;
  const double scale = m.law.surface.tensile_strength / m.bulk.mu / (0.6 / 160.0);
  for (int k = 0; k < 20; ++k) {
    const Tensor<double, 2> d = strain2(opening * scale / 20, 0, 0.1 * opening * scale / 20);
    EXPECT_TRUE(update<2>(m, with(Method::accurate), s, d, s).ok());
  }
  EXPECT_TRUE(s.cracked);
  return s;
}

TEST(HardCases, AnyIncrementSizeFromTinyToHuge) {
  const Tensor<double, 2> directions[] = {strain2(1, 0, 0),     strain2(1, 0, 1),      strain2(0, 0, 1),
                                          strain2(0.1, 0.1, 1), strain2(-1, 0.3, 0.5), strain2(1, 1, 0),
                                          strain2(-1, -1, 1),   strain2(1, -1, 0.3)};
  for (const Parameters& p : {table1(1e-3), table3(0.1e-3)}) {
    const Material<double> m = make_material(p, Setting::plane_strain);
    for (const Method method : robust) {
      for (const bool fresh : {true, false}) {
        const State2 begin = fresh ? State2{} : damaged(m);
        for (const Tensor<double, 2>& direction : directions) {
          for (double size = 1e-12; size < 0.2; size *= 10.0) {
            SCOPED_TRACE(std::string(to_string(method)) + " size " + std::to_string(std::log10(size)) + " direction " +
                         std::to_string(direction[0]) + " " + std::to_string(direction[1]) + " " +
                         std::to_string(direction[2]) + (fresh ? " fresh" : " damaged"));
            State2 s;
            const Report r = update<2>(m, with(method), begin, Tensor<double, 2>(size * direction), s);
            EXPECT_EQ(r.status, Status::ok) << to_string(r.status);
            expect_sound<2>(m, s);
          }
        }
      }
    }
  }
}

/// One huge step and many small ones agree where the answer does not depend on the path within the step.
TEST(HardCases, HugeModeOneStepHasTheClosedForm) {
  const Parameters p = table1(1e-3);
  const Material<double> m = make_material(p, Setting::plane_strain);
  for (const Method method : robust) {
    for (const double strain : {2e-3, 1e-2, 5e-2, 0.3, 1.0, 10.0}) {
      State2 s;
      ASSERT_TRUE(update<2>(m, with(method), s, strain2(strain, 0, 0), s).ok());
      expect_sound<2>(m, s);
      const double t = p.tensile_strength * std::exp(-s.crack.jump[0] / p.delta0);
      EXPECT_NEAR(s.crack.traction[0], t, 1e-7 * p.tensile_strength);
      EXPECT_NEAR(s.crack.jump[0] + m.series.normal * t, strain * p.rve_length, 1e-7 * p.delta0);
    }
  }
}

TEST(HardCases, FullyDamaged) {
  const Parameters p = table1(1e-3);
  const Material<double> m = make_material(p, Setting::plane_strain);
  for (const Method method : robust) {
    for (const double w : {1e-8, 1e-16, 1e-100, 1e-300, 1e-308, 5e-324, 0.0}) {
      for (const Tensor<double, 2>& d :
           {strain2(1e-3, 0, 0), strain2(1e-3, 0, 1e-3), strain2(0, 0, 1e-3), strain2(-1e-1, 0, 0),
            strain2(-2e-1, 0, 3e-2), strain2(-2e-1, 0, 3e-1), strain2(0, 0, 0), strain2(0, 0, -1e-7)}) {
        SCOPED_TRACE(std::string(to_string(method)) + " w " + std::to_string(std::log10(w)) + " d " +
                     std::to_string(d[0]) + " " + std::to_string(d[2]));
        State2 s = damaged(m);
        ASSERT_TRUE(update<2>(m, with(method), s, strain2(5e-2, 0, 1e-2), s).ok());
        const Vec<double, 2> scaled = s.crack.traction / s.crack.integrity;
        s.crack.traction = w * scaled;
        s.crack.integrity = w;
        s.crack.jump = detail::drive<double, 2>(m, s.frame, s.strain);
        s.crack.jump[0] -= m.series.normal * s.crack.traction[0];
        s.crack.jump[1] -= m.series.shear * s.crack.traction[1];
        // The same scaled traction on the surface, so that the state is one that a path can reach.
        s.crack.plastic_jump[0] = s.crack.jump[0] + s.crack.offset[0] - scaled[0] / m.law.kn;
        s.crack.plastic_jump[1] = s.crack.jump[1] + s.crack.offset[1] - scaled[1] / m.law.ks;
        State2 end;
        Tangent<2> tangent;
        const Report r = update_with_tangent<2>(m, with(method), s, d, end, tangent);
        EXPECT_EQ(r.status, Status::ok) << to_string(r.status);
        expect_sound<2>(m, end);
        EXPECT_TRUE(tangent.allFinite());
        EXPECT_LE(end.crack.integrity, w);
        // Afterwards it still works.
        ASSERT_TRUE(update<2>(m, with(method), end, strain2(1e-3, 1e-4, -1e-3), end).ok());
        expect_sound<2>(m, end);
      }
    }
  }
}

TEST(HardCases, PureModesAreExact) {
  const Parameters p = table1(1e-3);
  for (const Method method : robust) {
    const Material<double> m2 = make_material(p, Setting::plane_strain);
    State2 s;
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(update<2>(m2, with(method), s, strain2(2e-4, 0, 0), s).ok());
    EXPECT_EQ(s.stress[2], 0.0);
    EXPECT_LE(s.crack.slip, 1e-12 * p.delta0);  // a difference of larger numbers in `accurate`
    const Material<double> m3 = make_material(p, Setting::three_d);
    State3 t;
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(update<3>(m3, with(method), t, strain3(0, 0, 2e-4, 0, 0, 0), t).ok());
    EXPECT_NEAR(t.stress[2], s.stress[0], 1e-9 * p.tensile_strength);
    EXPECT_NEAR(damage(t), damage(s), 1e-9);
    EXPECT_LE(t.crack.slip, 1e-12 * p.delta0);
    // Pure shear of a fresh point: principal stresses +-tau, a crack, sound states all along.
    State2 shear;
    for (int k = 0; k < 200; ++k) {
      ASSERT_TRUE(update<2>(m2, with(method), shear, strain2(0, 0, 1e-4), shear).ok());
      expect_sound<2>(m2, shear);
    }
    EXPECT_GT(damage(shear), 0.3);
  }
}

/// A zero increment leaves damage alone bit for bit and stress to rounding, and a second one changes nothing at all.
/// (`paper` takes a last Taylor step whenever f >= 0, so its second call may still move by rounding.)
TEST(HardCases, ZeroIncrementChangesNothing) {
  for (const Method method : {Method::paper, Method::implicit, Method::accurate}) {
    for (const Path<2>& path : {four_stage(), compressive_shear(), closing()}) {
      const Material<double> m = make_material(path.parameters, path.setting);
      State2 s;
      for (const Tensor<double, 2>& leg : path.legs) {
        for (int k = 0; k < 30; ++k) {
          State2 end;
          const Report r = update<2>(m, with(method == Method::paper ? Method::accurate : method), s,
                                     Tensor<double, 2>(leg / 30.0), s);
          ASSERT_TRUE(r.ok());
          ASSERT_TRUE(update<2>(m, with(method, 1e-4), s, strain2(0, 0, 0), end).ok());
          EXPECT_LE((end.stress - s.stress).norm(), 1e-13 * m.bulk.mu * (1e-3 + s.strain.norm()));
          EXPECT_EQ(end.crack.integrity, s.crack.integrity) << to_string(method) << path.name << k;
          State2 twice;
          ASSERT_TRUE(update<2>(m, with(method, 1e-4), end, strain2(0, 0, 0), twice).ok());
          EXPECT_TRUE(method == Method::paper || same(end, twice)) << to_string(method) << path.name << k;
        }
      }
    }
  }
}

TEST(HardCases, EqualPrincipalStressesAtOnset) {
  for (const Method method : robust) {
    const Parameters p = table1(1e-3);
    const Material<double> m2 = make_material(p, Setting::plane_strain);
    State2 a, b;
    ASSERT_TRUE(update<2>(m2, with(method), a, strain2(4e-3, 4e-3, 0), a).ok());
    expect_sound<2>(m2, a);
    EXPECT_EQ(a.frame(0, 0), 1.0);  // the rule: x
    Options o = with(method);
    o.preferred_normal << 0.6, 0.8, 0.0;
    ASSERT_TRUE(update<2>(m2, o, b, strain2(4e-3, 4e-3, 0), b).ok());
    EXPECT_NEAR(std::abs(b.frame(0, 0)), 0.6, 1e-12);
    EXPECT_NEAR(damage(a), damage(b), 1e-9);
    const Material<double> m3 = make_material(p, Setting::three_d);
    for (const Tensor<double, 3>& e : {strain3(4e-3, 4e-3, 4e-3, 0, 0, 0), strain3(4e-3, 4e-3, 0, 0, 0, 0),
                                       strain3(0, 4e-3, 4e-3, 0, 0, 0), strain3(4e-3, 0, 0, 0, 0, 0)}) {
      State3 s, t;
      ASSERT_TRUE(update<3>(m3, with(method), s, e, s).ok());
      ASSERT_TRUE(s.cracked);
      expect_sound<3>(m3, s);
      ASSERT_TRUE(update<3>(m3, with(method), t, e, t).ok());
      EXPECT_TRUE(same(s, t));
      ASSERT_TRUE(update<3>(m3, with(method), s, strain3(1e-3, 2e-3, -1e-3, 2e-3, 1e-3, 3e-3), s).ok());
      expect_sound<3>(m3, s);
    }
  }
}

/// Of two conjugate planes the preferred normal decides; without one the answer is always the same.
TEST(HardCases, ConjugatePlanesAreSteered) {
  const Parameters p = table2(0.25e-3);
  const Material<double> m = make_material(p, Setting::plane_strain);
  for (const double angle : {0.0, 0.3, 1.2, 2.5}) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const Tensor<double, 2> e = 1e-3 * strain2(c * c - 0.3 * s * s, s * s - 0.3 * c * c, 1.3 * c * s);
    State2 first, second, rule, again;
    Options o = with(Method::accurate);
    ASSERT_TRUE(update<2>(m, o, rule, e, rule).ok());
    ASSERT_TRUE(update<2>(m, o, again, e, again).ok());
    EXPECT_TRUE(same(rule, again));
    o.preferred_normal << std::cos(angle + 0.4), std::sin(angle + 0.4), 0.0;
    ASSERT_TRUE(update<2>(m, o, first, e, first).ok());
    o.preferred_normal << std::cos(angle - 0.4), std::sin(angle - 0.4), 0.0;
    ASSERT_TRUE(update<2>(m, o, second, e, second).ok());
    const auto turned = [&](const State2& z) {
      return std::remainder(std::atan2(z.frame(0, 1), z.frame(0, 0)) - angle, 3.14159265358979323846);
    };
    EXPECT_GT(turned(first), 0.05);
    EXPECT_NEAR(turned(first), -turned(second), 1e-9);
    EXPECT_NEAR(turned(rule), turned(first), 1e-9);  // the rule: counter-clockwise
    EXPECT_NEAR(damage(first), damage(second), 1e-9);
  }
}

TEST(HardCases, NormalStiffnessOverSixDecades) {
  for (const Method method : robust) {
    for (double ratio = 1e3; ratio < 2e8; ratio *= 10.0) {
      SCOPED_TRACE(std::string(to_string(method)) + " Kn/E " + std::to_string(ratio));
      Path<2> path = closing();
      path.parameters.normal_stiffness = ratio * path.parameters.young_modulus;
      const Material<double> m = make_material(path.parameters, path.setting);
      State2 s;
      for (const Tensor<double, 2>& leg : path.legs) {
        for (int k = 0; k < 40; ++k) {
          const Report r = update<2>(m, with(method), s, Tensor<double, 2>(leg / 40.0), s);
          ASSERT_EQ(r.status, Status::ok) << to_string(r.status) << " " << k;
          expect_sound<2>(m, s);
        }
      }
      if (method == Method::accurate) {
        const PathError e = compare<2>(path, with(method, 1e-6), 1e-4);
        EXPECT_EQ(e.status, Status::ok);
        EXPECT_LE(e.stress, 1e-6);
        EXPECT_LE(e.damage, 1e-6);
      }
    }
  }
}

/// psi = 0: eq 50 has no direction that relaxes a normal traction. Never a wrong number.
TEST(HardCases, ZeroDilation) {
  Parameters p = table1(1e-3);
  p.dilation_angle_deg = 0.0;
  const Material<double> m = make_material(p, Setting::plane_strain);
  for (const Method method : robust) {
    State2 s;
    ASSERT_TRUE(update<2>(m, with(method), s, strain2(1e-3, 0, 0), s).ok());
    const State2 before = s;
    State2 end;
    const Report r = update<2>(m, with(method), before, strain2(2e-3, 0, 0), end);
    EXPECT_TRUE(r.status == Status::no_plastic_flow || r.status == Status::snap_back) << to_string(r.status);
    EXPECT_TRUE(same(end, before));
    // Shear under compression flows in shear: no opening, sound, and as the reference says.
    Path<2> path = compressive_shear();
    path.legs = {strain2(-8e-3, -8e-3, 0), strain2(0, 0, 3e-2), strain2(0, 0, -2e-2)};
    path.parameters.dilation_angle_deg = 0.0;
    const PathError e = compare<2>(path, with(method, 1e-6), method == Method::accurate ? 1e-4 : 1e-6);
    EXPECT_EQ(e.status, Status::ok) << to_string(e.status);
    EXPECT_LE(e.stress, method == Method::accurate ? 1e-6 : 1e-4);
  }
}

TEST(HardCases, DilationEqualToFriction) {
  for (const Method method : robust) {
    for (Path<2> path : {mixed_mode(), compressive_shear(), closing()}) {
      path.parameters.dilation_angle_deg = path.parameters.friction_angle_deg;
      const PathError e = compare<2>(path, with(method, 1e-6), method == Method::accurate ? 1e-4 : 2e-6);
      EXPECT_EQ(e.status, Status::ok) << to_string(method) << " " << path.name << " " << to_string(e.status);
      EXPECT_LE(e.stress, method == Method::accurate ? 1e-6 : 1e-3);
    }
  }
}

TEST(HardCases, NearlyIncompressible) {
  for (const Method method : robust) {
    for (Path<2> path : {mixed_mode(), closing()}) {
      path.parameters.poisson_ratio = 0.4999;
      for (Tensor<double, 2>& leg : path.legs) leg[1] = -0.999 * leg[0];  // nearly isochoric
      const PathError e = compare<2>(path, with(method, 1e-6), method == Method::accurate ? 1e-4 : 2e-6);
      EXPECT_EQ(e.status, Status::ok) << to_string(method) << " " << path.name << " " << to_string(e.status);
      EXPECT_LE(e.stress, method == Method::accurate ? 1e-6 : 1e-3) << path.name;
    }
  }
}

/// Mode I just below and above the snap-back length, from onset to 99.9 % damage.
TEST(HardCases, ModeOneSnapBackLimit) {
  for (const Method method : robust) {
    for (const double factor : {0.9, 0.999, 1.001, 1.1}) {
      for (const int steps : {3, 30, 3000}) {
        SCOPED_TRACE(std::string(to_string(method)) + " factor " + std::to_string(factor) + " steps " +
                     std::to_string(steps));
        Parameters p = table1();
        p.rve_length = factor * snap_back_length(p, Setting::plane_strain);
        const Material<double> m = make_material(p, Setting::plane_strain);
        State2 s;
        Status status = Status::ok;
        for (int k = 0; k < steps && status == Status::ok; ++k) {
          const State2 before = s;
          status = update<2>(m, with(method), before, strain2(1.5e-2 / steps, 0, 0), s).status;
          if (status != Status::ok) {
            EXPECT_TRUE(same(s, before));
            break;
          }
          expect_sound<2>(m, s);
          const double t = p.tensile_strength * std::exp(-s.crack.jump[0] / p.delta0);
          if (s.cracked) {
            EXPECT_NEAR(s.stress[0], t, 1e-6 * p.tensile_strength);
          }
        }
        EXPECT_EQ(status, factor < 1.0 ? Status::ok : Status::snap_back) << to_string(status);
      }
    }
  }
}

/// Fresh material sheared hard snaps back in shear although mode I would not (docs/equations.md); a long RVE must say
/// so.
TEST(HardCases, ShearSnapBackIsDetected) {
  for (const Method method : robust) {
    for (const int steps : {2, 20, 2000}) {
      const Parameters p = table1(13e-3);
      ASSERT_LT(p.rve_length, snap_back_length(p, Setting::plane_strain));
      const Material<double> m = make_material(p, Setting::plane_strain);
      State2 s;
      Status status = Status::ok;
      for (int k = 0; k < steps && status == Status::ok; ++k) {
        const State2 before = s;
        status = update<2>(m, with(method), before, strain2(-1e-4 / steps, -1e-4 / steps, 1e-2 / steps), s).status;
        if (status != Status::ok) {
          EXPECT_TRUE(same(s, before));
        }
      }
      EXPECT_EQ(status, Status::snap_back) << to_string(method) << " " << steps << " " << to_string(status);
    }
  }
}

TEST(HardCases, NonFiniteInputIsRefused) {
  const Material<double> m = make_material(table1(1e-3), Setting::plane_strain);
  const Material<double> m3 = make_material(table1(1e-3), Setting::three_d);
  for (const Method method : {Method::paper, Method::implicit, Method::accurate}) {
    for (const double bad : {nan, inf, -inf}) {
      for (const State2& begin : {State2{}, damaged(m)}) {
        for (int k = 0; k < 3; ++k) {
          Tensor<double, 2> d = strain2(1e-5, 0, 0);
          d[k] = bad;
          State2 end;
          EXPECT_EQ(update<2>(m, with(method), begin, d, end).status, Status::invalid_input);
          EXPECT_TRUE(same(end, begin));
          Tangent<2> tangent;
          EXPECT_EQ(update_with_tangent<2>(m, with(method), begin, d, end, tangent).status, Status::invalid_input);
          State2 broken = begin;
          broken.strain[k] = bad;
          EXPECT_EQ(update<2>(m, with(method), broken, strain2(1e-5, 0, 0), end).status, Status::invalid_input);
          EXPECT_TRUE(same(end, broken));
        }
      }
      Tensor<double, 3> d = strain3(0, 0, 0, 0, 0, bad);
      State3 end;
      EXPECT_EQ(update<3>(m3, with(method), State3{}, d, end).status, Status::invalid_input);
      // A broken crack state is refused too.
      double CohesiveState<double, 2>::*const scalars[] = {
          &CohesiveState<double, 2>::integrity, &CohesiveState<double, 2>::slip, &CohesiveState<double, 2>::dissipated};
      for (const auto member : scalars) {
        State2 broken = damaged(m);
        broken.crack.*member = bad;
        State2 out;
        EXPECT_EQ(update<2>(m, with(method), broken, strain2(1e-5, 0, 1e-5), out).status, Status::invalid_input);
        EXPECT_TRUE(same(out, broken));
      }
      for (int k = 0; k < 2; ++k) {
        State2 broken = damaged(m);
        broken.crack.plastic_jump[k] = bad;
        State2 out;
        EXPECT_EQ(update<2>(m, with(method), broken, strain2(1e-5, 0, 1e-5), out).status, Status::invalid_input);
      }
    }
  }
}

/// A limit on sub-steps is a failure that leaves the begin state.
TEST(HardCases, TooFewSubstepsIsNonConvergence) {
  const Material<double> m = make_material(table1(1e-3), Setting::plane_strain);
  Options o = with(Method::accurate);
  o.max_substeps = 3;
  const State2 begin = damaged(m);
  State2 end;
  EXPECT_EQ(update<2>(m, o, begin, strain2(1e-2, 0, 1e-2), end).status, Status::non_convergence);
  EXPECT_TRUE(same(end, begin));
}

/// The begin state may be the end state.
TEST(HardCases, UpdateInPlace) {
  const Material<double> m = make_material(table1(1e-3), Setting::plane_strain);
  for (const Method method : robust) {
    State2 a = damaged(m);
    State2 b;
    const Tensor<double, 2> d = strain2(1e-4, 2e-5, 1e-4);
    ASSERT_TRUE(update<2>(m, with(method), a, d, b).ok());
    ASSERT_TRUE(update<2>(m, with(method), a, d, a).ok());
    EXPECT_TRUE(same(a, b));
  }
}

}  // namespace
}  // namespace fpz::test
