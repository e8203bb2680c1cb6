// A specimen in uniform tension parts along one crack.
#include <gtest/gtest.h>

#include "fpz/specimen/crack.hpp"
#include "fpz/specimen/specimen.hpp"

namespace {

using namespace fpz::specimen;

/// The waist of the dog-bone is 40 mm wide and 40 mm long, with equal stress everywhere. A gradient that does not see
/// alternating rows lets its two sub-lattices part separately, in two cracks of 40 mm.
TEST(OneCrack, TheDogBonePartsOnce) {
  const Scene scene = read_scene(std::filesystem::path(FPZ_DATA_DIR) / "scenes/dogbone.json",
                                 {"spacing=0.004", "method.courant=0.9", "method.release_integrity=0.02",
                                  "method.threads=1", "boundaries[0].velocity.y.speed=0.01"});
  const Specimen specimen = make_specimen(scene);
  fpz::sph::Simulation<2> run(specimen.setup);
  while (run.time() < 0.01) {
    const fpz::sph::Outcome o = run.step();
    ASSERT_TRUE(o.ok()) << o.message();
  }
  EXPECT_NEAR(opened_length(spots(run, specimen), scene.spacing), 0.04, 0.05 * 0.04);
}

}  // namespace
