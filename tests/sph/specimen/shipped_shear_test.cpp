// Shipped scenes of shear and compression, coarse, each on its number.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "fpz/specimen/run.hpp"
#include "support/temporary_folder.hpp"

namespace {

using fpz::degree;
using fpz::Parameters;
namespace sph = fpz::sph;
using namespace fpz::specimen;

RunResult run(const char* name, Overrides set, const std::string& folder) {
  set.insert(set.end(), {"output.pictures=false", "output.history_rows=500"});
  RunRequest request;
  request.folder = fpz::test::fresh_path(folder);
  request.threads = 1;
  RunResult r = run_scene(read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes" / name, set), request);
  EXPECT_EQ(r.ending, Ending::finished) << r.reason;
  for (const std::string& w : r.warnings) EXPECT_EQ(w.find("not quasi-static"), std::string::npos) << w;
  return r;
}

std::size_t first_row(const History& h, const char* gauge, double above) {
  std::size_t row = 0;
  while (row + 1 < h.rows() && h.at(row, gauge) < above) ++row;
  return row;
}

double mean(const History& h, const char* gauge, std::size_t from) {
  double sum = 0.0;
  for (std::size_t row = from; row < h.rows(); ++row) sum += h.at(row, gauge);
  return sum / static_cast<double>(h.rows() - from);
}

double largest(const History& h, const char* gauge) {
  double most = -1e300;
  for (std::size_t row = 0; row < h.rows(); ++row) most = std::max(most, h.at(row, gauge));
  return most;
}

/// Shear force over displacement while it rises from one value to another.
double shear_stiffness(const History& h, double from, double to) {
  const std::size_t a = first_row(h, "load", from), b = first_row(h, "load", to);
  return (h.at(b, "load") - h.at(a, "load")) / (h.at(b, "deflection") - h.at(a, "deflection"));
}

/// Coulomb: the joint sticks, as stiff as no joint, up to N tan(phi), which is peak and residual in one.
TEST(ShippedShear, AFlatJointSlidesAtTheFrictionOfTheNormalForce) {
  const History whole =
      run("shear_box_stress.json", {"spacing=0.004", "notches=[]", "stages[1].stop.gauges.deflection.above=4e-6"},
          "shear_whole")
          .history;
  for (const auto& [force, friction_deg] : {std::pair{10e3, 30.0}, std::pair{5e3, 40.0}}) {
    const History h = run("shear_box_stress.json",
                          {"spacing=0.004", "boundaries[0].force.y.value=" + std::to_string(-force),
                           "notches[0].friction_angle_deg=" + std::to_string(friction_deg)},
                          "shear_stress")
                          .history;
    const double right = force * std::tan(friction_deg * degree);
    EXPECT_NEAR(shear_stiffness(h, 0.2 * right, 0.6 * right), shear_stiffness(whole, 1e3, 3e3),
                0.02 * shear_stiffness(whole, 1e3, 3e3));
    EXPECT_NEAR(largest(h, "load"), right, 0.01 * right);
    const std::size_t sliding = first_row(h, "deflection", 1.5e-5);
    EXPECT_NEAR(mean(h, "load", sliding), right, 2e-3 * right);
    EXPECT_NEAR(mean(h, "support", sliding), right, 2e-3 * right);
    EXPECT_NEAR(mean(h, "normal", sliding), force, 1e-3 * force);
    EXPECT_NEAR(h.last("rise"), h.at(sliding, "rise"), 1e-3 * (h.last("deflection") - h.at(sliding, "deflection")));
    EXPECT_EQ(h.last("damaged_particles"), 0.0);
  }
}

/// A joint that rises by the angle i: the block climbs, the spring presses harder, T = N tan(phi + i). The spring of
/// the machine is in series with the block, whose stiffnesses are those of pressing and sticking.
TEST(ShippedShear, AnInclinedJointClimbsAgainstTheMachine) {
  const double machine = 5e7, rise = std::tan(15.0 * degree);
  const RunResult r = run("shear_box_stiffness.json", {"spacing=0.004"}, "shear_stiffness");
  const History& h = r.history;
  ASSERT_EQ(r.stages.size(), 2u);
  const std::size_t pressed = first_row(h, "time", r.stages[0].end);
  const double n0 = h.at(pressed, "normal"), normal_stiffness = n0 / -h.at(pressed, "rise");
  EXPECT_NEAR(n0, machine * (102e-6 + h.at(pressed, "rise")), 2e-3 * n0);
  const double sticking = shear_stiffness(h, 0.2 * n0, 0.6 * n0), steep = std::tan(45.0 * degree);
  const std::size_t begin = first_row(h, "deflection", 5e-5), end = h.rows() - 1;
  for (const std::size_t row : {begin, (begin + end) / 2, end}) {
    const double n = h.at(row, "normal"), slip = h.at(row, "deflection") - h.at(row, "load") / sticking;
    EXPECT_NEAR(h.at(row, "load"), n * steep, 5e-3 * n);
    EXPECT_NEAR(h.at(row, "rise") - h.at(pressed, "rise"), slip * rise - (n - n0) / normal_stiffness,
                0.01 * slip * rise);
  }
  const double k = machine * rise, wanted = k / (1.0 + k * steep / sticking + machine / normal_stiffness);
  const double slope =
      (h.at(end, "normal") - h.at(begin, "normal")) / (h.last("deflection") - h.at(begin, "deflection"));
  EXPECT_NEAR(slope, wanted, 0.02 * wanted);
  EXPECT_GT(h.at(end, "normal"), 1.4 * n0);
}

/// The same machine on a flat joint: nothing climbs, the normal force stays.
TEST(ShippedShear, AFlatJointLeavesTheMachineAlone) {
  const RunResult r = run("shear_box_stiffness.json",
                          {"spacing=0.004", "notches[0].mouth=[-0.05, 0]", "notches[0].angle_deg=-90",
                           "stages[1].stop.gauges.deflection.above=8e-5"},
                          "shear_flat");
  const History& h = r.history;
  const double n0 = h.at(first_row(h, "time", r.stages[0].end), "normal"), right = n0 * std::tan(30.0 * degree);
  const std::size_t sliding = first_row(h, "deflection", 3e-5);
  EXPECT_NEAR(mean(h, "normal", sliding), n0, 2e-3 * n0);
  EXPECT_NEAR(mean(h, "load", sliding), right, 2e-3 * right);
}

/// A closed flaw in uniaxial compression: half length a (m), angle to the load, friction of its faces.
struct Flaw {
  double a = 0.02, to_load_deg = 45.0, friction_deg = 20.0;
  [[nodiscard]] double normal() const { return std::pow(std::sin(to_load_deg * degree), 2); }  ///< over the pressure
  [[nodiscard]] double along() const { return 1.0 - normal(); }
  [[nodiscard]] double friction() const { return std::tan(friction_deg * degree) * normal(); }
  /// Shear that the faces do not bear, over the pressure; K_II = driving sqrt(pi a).
  [[nodiscard]] double driving() const {
    return std::sin(to_load_deg * degree) * std::cos(to_load_deg * degree) - friction();
  }
};

struct FirstCrack {
  double angle_deg = 0.0;  ///< from the flaw's continuation, towards the load
  double pressure = 0.0;   ///< Pa
};

/// Generalised maximum tangential stress (Smith, Ayatollahi and Pavier 2001): the tangential stress of K_II and of the
/// even stresses at the distance (K_Ic/sigma_t)^2/(2 pi) from the tip reaches sigma_t.
FirstCrack first_crack(const Flaw& flaw, double toughness, double strength) {
  const double r = std::pow(toughness / strength, 2) / (2.0 * std::numbers::pi);
  FirstCrack c;
  double most = 0.0;
  for (double angle = 1.0; angle < 180.0; angle += 0.1) {
    const double t = angle * degree, sine = std::sin(t), cosine = std::cos(t);
    const double tangential = 1.5 * flaw.driving() * std::sqrt(flaw.a / (2.0 * r)) * sine * std::cos(0.5 * t) -
                              flaw.along() * sine * sine - flaw.normal() * cosine * cosine +
                              2.0 * flaw.friction() * sine * cosine;
    if (tangential > most) most = tangential, c = {angle, strength / tangential};
  }
  return c;
}

/// What the particles around the tips of a flaw say.
class Wings {
 public:
  Wings(const Notch& flaw, double spacing) : flaw_(flaw), spacing_(spacing) {}

  /// The shorter wing: how far from its tip a particle has lost half of its strength.
  [[nodiscard]] double length(const std::vector<Spot>& spots) const {
    double reach[2] = {0.0, 0.0};
    for (const Spot& s : spots) {
      if (s.damage > 0.5) reach[end(s)] = std::max(reach[end(s)], (s.at - tip(end(s))).norm());
    }
    return std::min(reach[0], reach[1]);
  }
  /// Where the particles lie: the angle of their mean place, seen from the tip, degrees.
  [[nodiscard]] double place_deg(const std::vector<Spot>& spots) const {
    Point sum = Point::Zero();
    for (const Spot& s : spots) {
      const double far = (s.at - tip(end(s))).norm() / spacing_;
      if (s.damage > 0.3 && far > 1.0 && far < 4.5) sum += s.damage * turned(s.at - tip(end(s)), s);
    }
    return -std::atan2(sum.y(), sum.x()) / degree;
  }
  /// Mean direction of the crack planes beside the tip, degrees.
  [[nodiscard]] double planes_deg(const std::vector<Spot>& spots) const {
    double sum = 0.0, weight = 0.0;
    for (const Spot& s : spots) {
      if (s.damage <= 0.3 || (s.at - tip(end(s))).norm() > 2.5 * spacing_) continue;
      const Point n = turned(s.normal, s);
      sum += s.damage * std::atan(n.x() / n.y()) / degree;
      weight += s.damage;
    }
    return sum / weight;
  }

 private:
  [[nodiscard]] Point tip(int end) const { return end == 0 ? flaw_.mouth : flaw_.tip; }
  [[nodiscard]] int end(const Spot& s) const { return (s.at - flaw_.tip).norm() < (s.at - flaw_.mouth).norm() ? 1 : 0; }
  /// In axes along the flaw, outward at the particle's tip, and across it.
  [[nodiscard]] Point turned(const Point& v, const Spot& s) const {
    const Point x = (tip(end(s)) - tip(1 - end(s))).normalized();
    return {x.dot(v), x.x() * v.y() - x.y() * v.x()};
  }
  Notch flaw_;
  double spacing_;
};

/// The plate of wing_crack.json at 2 mm with another flaw.
Scene cracked_plate(const Flaw& flaw) {
  const double t = flaw.to_load_deg * degree, e = 3e-3;
  const auto point = [](double x, double y) { return "[" + std::to_string(x) + ", " + std::to_string(y) + "]"; };
  const auto beside = [&](double side) {
    return R"({"point": )" + point(-side * e * std::cos(t), -side * e * std::sin(t)) + R"(, "radius": 0.0022})";
  };
  return read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes" / "wing_crack.json",
                    {"spacing=0.002", "notches[0].mouth=" + point(flaw.a * std::sin(t), -flaw.a * std::cos(t)),
                     "notches[0].angle_deg=" + std::to_string(flaw.to_load_deg),
                     "notches[0].friction_angle_deg=" + std::to_string(flaw.friction_deg),
                     R"(gauges.slip={"displacement_of": )" + beside(1.0) + R"(, "relative_to": )" + beside(-1.0) +
                         R"(, "direction": )" + point(-std::sin(t), std::cos(t)) + "}"});
}

/// A sliding flaw slips in its middle by 4 driving a/E', and its wings begin as the stresses around its tips say.
TEST(ShippedShear, WingCracksBeginAtTheTipsOfASlidingFlaw) {
  for (const Flaw& flaw : {Flaw{0.02, 45.0, 20.0}, Flaw{0.02, 30.0, 20.0}, Flaw{0.02, 55.0, 10.0}}) {
    const Scene scene = cracked_plate(flaw);
    Specimen specimen = make_specimen(scene);
    specimen.setup.options.threads = 1;
    sph::Simulation<2> run(specimen.setup);
    const Parameters& p = specimen.setup.parameters;
    const double plane_modulus = p.young_modulus / (1.0 - p.poisson_ratio * p.poisson_ratio), area = 0.12 * 0.05;
    const FirstCrack right =
        first_crack(flaw, std::sqrt(plane_modulus * p.tensile_strength * p.delta0), p.tensile_strength);
    const Wings wings(scene.body.notches[0], scene.spacing);
    double load = 0.0, slip = 0.0, slip_over_right = 0.0, length = 0.0;
    bool begun = false;
    for (int step = 1; length < 8e-3 && run.time() < 4e-3; ++step) {
      ASSERT_TRUE(run.step().ok());
      load += specimen.gauges.at("load").value(run, scene.thickness) / 50.0;
      slip += specimen.gauges.at("slip").value(run, scene.thickness) / 50.0;
      if (step % 50 != 0) continue;
      const std::vector<Spot> now = spots(run, specimen);
      length = wings.length(now);
      if (run.cracked() == 0) slip_over_right = slip / (4.0 * flaw.driving() * load / area * flaw.a / plane_modulus);
      if (!begun && length > 4e-3) {
        begun = true;
        std::printf("flaw at %g degrees: slip %.3f, planes %.1f (%.1f) degrees, load of the wing %.3f\n",
                    flaw.to_load_deg, slip_over_right, wings.planes_deg(now), right.angle_deg,
                    load / area / right.pressure);
        EXPECT_NEAR(load / area, right.pressure, 0.1 * right.pressure) << flaw.to_load_deg;
        EXPECT_NEAR(wings.planes_deg(now), right.angle_deg, 5.0) << flaw.to_load_deg;
      }
      if (length > 8e-3) {
        std::printf("places %.1f degrees\n", wings.place_deg(now));
        EXPECT_NEAR(wings.place_deg(now), right.angle_deg, 10.0) << flaw.to_load_deg;
      }
      load = slip = 0.0;
    }
    EXPECT_NEAR(slip_over_right, 1.0, 0.05) << flaw.to_load_deg;
    EXPECT_GT(length, 8e-3) << flaw.to_load_deg;
  }
}

/// Farthest particle above a notch that has lost half of its strength, from the tip of the notch.
Point crack_tip(const std::vector<Spot>& spots, const Notch& notch) {
  Point tip = Point::Zero();
  for (const Spot& s : spots) {
    const Point to = s.at - notch.tip;
    if (s.damage > 0.5 && to.y() > -5e-3 && to.norm() > tip.norm()) tip = to;
  }
  return tip;
}

/// A blow on the plate between two notches: the force of the plane wave first; then a crack in the direction that
/// experiments have, slower than Rayleigh's wave.
TEST(ShippedShear, KalthoffsPlateCracksAtSeventyDegrees) {
  const Scene scene = read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes" / "kalthoff.json", {"spacing=0.001"});
  Specimen specimen = make_specimen(scene);
  specimen.setup.options.threads = 1;
  sph::Simulation<2> run(specimen.setup);
  const Parameters& p = specimen.setup.parameters;
  const double shear = p.young_modulus / (2.0 * (1.0 + p.poisson_ratio));
  const double squeezed = 2.0 * shear * (1.0 - p.poisson_ratio) / (1.0 - 2.0 * p.poisson_ratio);
  const double rayleigh = (0.862 + 1.14 * p.poisson_ratio) / (1.0 + p.poisson_ratio) * std::sqrt(shear / p.density);
  double force = 0.0, fastest = 0.0;
  int steps = 0;
  std::vector<double> length;  // every 10 us
  Point tip = Point::Zero();
  while (tip.norm() < 0.05 && run.time() < 85e-6) {
    ASSERT_TRUE(run.step().ok());
    if (run.time() > 2e-6 && run.time() < 3e-6) {
      force += specimen.gauges.at("load").value(run, scene.thickness);
      ++steps;
    }
    if (run.time() < 1e-5 * static_cast<double>(length.size() + 1)) continue;
    tip = crack_tip(spots(run, specimen), scene.body.notches[0]);
    length.push_back(tip.norm());
    std::printf("%2.0f us: %4.1f mm at %.1f degrees\n", 1e6 * run.time(), 1e3 * tip.norm(),
                std::atan2(tip.y(), tip.x()) / degree);
  }
  // Even strain between two fronts: impedance times velocity.
  const double wave = std::sqrt(squeezed * p.density) * 13.0 * 0.048 * scene.thickness;
  EXPECT_NEAR(force / steps, wave, 0.04 * wave);
  EXPECT_GT(tip.norm(), 0.05);
  const double angle = std::atan2(tip.y(), tip.x()) / degree;
  EXPECT_GT(angle, 65.0);
  EXPECT_LT(angle, 72.0);
  for (std::size_t k = 1; k < length.size(); ++k) fastest = std::max(fastest, (length[k] - length[k - 1]) / 1e-5);
  EXPECT_LT(fastest, rayleigh);
  EXPECT_GT(fastest, 0.4 * rayleigh);
  EXPECT_LT(length[0], 1e-3);
}

/// Steepness of the longest axis of a cloud of particles, degrees from the horizontal, 0 to 90.
double steepness_deg(const std::vector<Point>& cloud) {
  Point middle = Point::Zero();
  for (const Point& q : cloud) middle += q / static_cast<double>(cloud.size());
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const Point& q : cloud) {
    const Point d = q - middle;
    xx += d.x() * d.x(), yy += d.y() * d.y(), xy += d.x() * d.y();
  }
  return std::abs(0.5 * std::atan2(2.0 * xy, xx - yy)) / degree;
}

/// Bands of shear in a plate under compression are between Roscoe's direction, 45 + dilation/2, and Coulomb's, 45 +
/// friction/2 (Arthur et al. 1977, Geotechnique 27, 53-74), on a lattice and among particles without directions.
TEST(ShippedShear, ShearBandsAreBetweenRoscoeAndCoulomb) {
  for (const char* arrangement : {"lattice", "scattered"}) {
    const Scene scene = read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes" / "uniaxial_compression.json",
                                   {"spacing=0.002", std::string("arrangement.type=") + arrangement});
    Specimen specimen = make_specimen(scene);
    specimen.setup.options.threads = 1;
    sph::Simulation<2> run(specimen.setup);
    double load = 0.0, peak = 0.0;
    for (int step = 1; load >= 0.97 * peak && run.time() < 8e-3; ++step) {
      ASSERT_TRUE(run.step().ok());
      if (step % 50 != 0) continue;
      load = specimen.gauges.at("load").value(run, scene.thickness);
      peak = std::max(peak, load);
    }
    std::vector<Point> cracked;
    for (const Spot& s : spots(run, specimen)) {
      if (s.damage > 0.7) cracked.push_back(s.at);
    }
    // Two bands, each other's image in the middle of the plate.
    double product = 0.0;
    for (const Point& q : cracked) product += q.x() * q.y();
    std::vector<Point> upper, lower;
    for (const Point& q : cracked) (q.y() > (product > 0.0 ? q.x() : -q.x()) ? upper : lower).push_back(q);
    for (const std::vector<Point>& band : {upper, lower}) {
      ASSERT_GT(band.size(), 10u) << arrangement;
      const double angle = steepness_deg(band);
      std::printf("band among %s particles: %.1f degrees\n", arrangement, angle);
      EXPECT_GT(angle, 45.0 + 0.5 * scene.parameters.dilation_angle_deg - 2.0) << arrangement;
      EXPECT_LT(angle, 45.0 + 0.5 * scene.parameters.friction_angle_deg) << arrangement;
    }
  }
}

/// Compliance that a closed cut without friction adds to a disc, m/N: K_II of Atkinson, Smelser and Sanchez (1982, Int.
/// J. Fracture 18, 279-291; their coefficients S fitted by parabolas) in the energy that the cut releases.
double compliance_of_sliding_cut(double half_length, double radius, double thickness, double modulus,
                                 double angle_deg) {
  const double c = std::pow(std::cos(angle_deg * degree), 2);
  double sum = 0.0;
  constexpr int parts = 100;
  for (int k = 0; k < parts; ++k) {
    const double x = (k + 0.5) / parts * half_length / radius, x2 = x * x;
    const double s1 = 1.0 + 0.986 * x2 + 0.118 * x2 * x2, s2 = 0.5 + 0.248 * x2, s3 = 0.375 + 0.1236 * x2;
    const double factor = 2.0 * std::sin(2.0 * angle_deg * degree) *
                          (s1 + s2 * x2 * (8.0 * c - 5.0) + s3 * x2 * x2 * (3.0 - 16.0 * c + 16.0 * c * c));
    // Two tips; K_II = P/(pi R t) sqrt(pi a) factor, and half of P^2 dC is t times the integral of K^2/E' over both.
    const double k2 = x * radius * std::numbers::pi * std::pow(factor / (std::numbers::pi * radius * thickness), 2);
    sum += 4.0 * thickness * k2 / modulus * half_length / parts;
  }
  return sum;
}

/// The disc as it is shipped is as stiff as one without the cut, and breaks no earlier; without friction the cut slides
/// and makes it softer as its K_II says.
TEST(ShippedShear, ACutDiscIsAsStiffAsItsFrictionLetsIt) {
  const auto stiffness = [](double angle_deg, const std::string& cut) {
    Scene scene =
        read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes" / "cracked_disc_closed.json",
                   {"arrangement={\"type\": \"lattice\", \"angle_deg\": " + std::to_string(angle_deg) + "}", cut});
    scene.parameters.tensile_strength = 1e9, scene.parameters.cohesion = 1e10;
    Specimen specimen = make_specimen(scene);
    specimen.setup.options.threads = 1;
    sph::Simulation<2> run(specimen.setup);
    double load = 0.0, deflection = 0.0;
    while (run.time() < 1.2e-3) {
      if (!run.step().ok()) return 0.0;
      if (run.time() < 1e-3) continue;
      load += specimen.gauges.at("load").value(run, scene.thickness);
      deflection += specimen.gauges.at("deflection").value(run, scene.thickness);
    }
    EXPECT_FALSE(run.overlap() > 0.01 * scene.spacing);
    return load / deflection;
  };
  const auto cut = [](double angle_deg, double friction_deg) {
    const double t = angle_deg * degree;
    return "notches=[{\"mouth\": [" + std::to_string(0.01 * std::sin(t)) + ", " + std::to_string(-0.01 * std::cos(t)) +
           "], \"length\": 0.02, \"angle_deg\": " + std::to_string(angle_deg) +
           ", \"friction_angle_deg\": " + std::to_string(friction_deg) + "}]";
  };
  for (const double angle : {75.0, 45.0}) {
    const double whole = stiffness(angle, "notches=[]");
    if (angle == 75.0) {
      EXPECT_NEAR(stiffness(angle, cut(angle, 35.0)), whole, 0.01 * whole);
    }
    const double more = compliance_of_sliding_cut(0.01, 0.025, 0.025, 20e9 / 0.96, angle);
    const double right = 1.0 / (1.0 / whole + more), slid = stiffness(angle, cut(angle, 0.0));
    std::printf("cut at %g degrees: %.4g N/m without friction, closed form %.4g, whole disc %.4g\n", angle, slid, right,
                whole);
    EXPECT_NEAR(slid, right, 0.015 * right) << angle;
  }
}

}  // namespace
