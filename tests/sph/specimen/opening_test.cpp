// The opening of notches at their mouths, which lie beside all particles.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "fpz/io/csv.hpp"
#include "fpz/specimen/run.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace sph = fpz::sph;

const std::filesystem::path data = FPZ_DATA_DIR;

/// The particles on either side of a notch turn about its tip by opposite angles, as in a specimen that opens: after
/// one step the gauge shows the exact opening of the mouth, which is half a spacing away from the nearest particle.
double opening_of_turning_halves(const Scene& scene, double rate) {
  Specimen s = make_specimen(scene);
  const Notch& n = scene.body.notches.front();
  s.setup.parameters.young_modulus = 1.0;  // nothing but the motion counts
  for (const Point& x : s.setup.arrangement.position) {
    const Point arm = x - n.tip;
    const double side = across(n).dot(x - n.mouth) > 0.0 ? 1.0 : -1.0;
    s.setup.velocity.push_back(side * rate * Point(arm[1], -arm[0]));
  }
  for (sph::Group<2>& g : s.setup.groups) g.drive = {};
  sph::Simulation<2> run(s.setup);
  EXPECT_TRUE(run.step().ok());
  return s.gauges.at("cmod").value(run, scene.thickness) / run.time_step();
}

TEST(NotchOpening, IsThatOfTheMouth) {
  for (const char* width : {"0", "\"narrowest\"", "0.003"}) {
    for (const int angle : {0, 20, 45}) {
      const Scene scene =
          read_scene(data / "scenes/scb.json", {"notches[0].angle_deg=" + std::to_string(angle),
                                                std::string("notches[0].width=") + width, "spacing=0.0019"});
      const Notch& n = scene.body.notches.front();
      const double rate = 1e-3, exact = 2.0 * rate * (n.tip - n.mouth).norm();
      EXPECT_NEAR(opening_of_turning_halves(scene, rate), exact, 1e-6 * exact) << width << " " << angle;
    }
  }
}

/// Without the lines that say how it was made.
fpz::io::Table reference_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string rows;
  for (std::string line; std::getline(in, line);) rows += line.starts_with("#") ? "" : line + "\n";
  return fpz::io::parse_csv(rows, file.string());
}

/// Load over opening of the notched beam while nothing has cracked, against finite elements with the same rollers.
TEST(NotchOpening, OfTheElasticBeamIsThatOfFiniteElements) {
  const fpz::io::Table t = reference_table(data / "reference/beam_3pb_rollers_8mm.csv");
  std::size_t row = 0;
  while (t.at("load")[row] < 500.0) ++row;
  const double reference = t.at("load")[row] / t.at("cmod")[row];
  const Scene scene =
      read_scene(data / "scenes/beam_3pb.json", {"spacing=0.003", "notches[0].width=0", "stop.time=3.5e-3",
                                                 "output.frames=0", "output.pictures=false", "method.threads=1"});
  RunRequest request;
  request.folder = fpz::test::fresh_path("opening");
  const History h = run_scene(scene, request).history;
  std::size_t k = 0;
  while (h.at(k, "load") < 500.0) ++k;
  EXPECT_EQ(h.at(k, "damaged_particles"), 0.0);
  EXPECT_NEAR(h.at(k, "load") / h.at(k, "cmod"), reference, 0.025 * reference);
}

}  // namespace
