// Regions of other materials in scenes: who has which, and what is written about them.
#include <gtest/gtest.h>

#include <fstream>

#include "fpz/specimen/specimen.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

const fs::path plate = fs::path(FPZ_DATA_DIR) / "scenes" / "uniaxial_compression.json";
constexpr const char* coarse = "spacing=0.0025";
constexpr const char* layers =
    R"(regions=[{"name":"mortar","material":{"young_modulus":5e9,"tensile_strength":1e6},
                 "shape":[{"type":"rectangle","low":[-0.025,-0.005],"high":[0.025,0.005]},
                          {"type":"rectangle","low":[-0.025,0.02],"high":[0.025,0.03]}]},
                {"name":"stone","material":{"file":"../materials/bellego.json","density":2700},
                 "shape":{"type":"disc","radius":0.01}}])";

std::size_t material_of(const Scene& scene, const Point& x) {
  if (x.norm() < 0.01) return 2;
  const bool in_mortar = std::abs(x[1]) < 0.005 || (x[1] > 0.02 && x[1] < 0.03);
  return in_mortar && std::abs(x[1]) < 0.05 && !scene.regions.empty() ? 1 : 0;
}

TEST(Regions, LaterOnesCoverEarlierOnesAndBoundariesHaveTheFirstMaterial) {
  const Scene scene = read_scene(plate, {coarse, layers});
  ASSERT_EQ(scene.further_materials.size(), 2U);
  const fpz::Parameters& mortar = scene.further_materials[0].parameters;
  EXPECT_EQ(scene.further_materials[0].name, "mortar");
  EXPECT_EQ(mortar.young_modulus, 5e9);
  EXPECT_EQ(mortar.cohesion, scene.parameters.cohesion);
  EXPECT_NE(scene.further_materials[1].parameters.young_modulus, scene.parameters.young_modulus);
  EXPECT_EQ(scene.further_materials[1].parameters.density, 2700.0);
  const Specimen s = make_specimen(scene);
  const fpz::sph::Arrangement<2>& a = s.setup.arrangement;
  std::array<int, 3> count = {};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::size_t expected = a.group[i] < 0 ? material_of(scene, a.position[i]) : 0;
    ASSERT_EQ(s.setup.materials.of(i), expected) << a.position[i].transpose();
    ++count[expected];
  }
  for (const int n : count) EXPECT_GT(n, 20);
}

TEST(Regions, TheTextOfTheSceneIsCompleteAndReadsBackTheSame) {
  const Scene scene = read_scene(plate, {coarse, layers});
  const Scene again = parse_scene(scene.text, "/elsewhere/scene.json");
  ASSERT_EQ(again.further_materials.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(again.further_materials[k].name, scene.further_materials[k].name);
    EXPECT_EQ(again.further_materials[k].parameters.cohesion, scene.further_materials[k].parameters.cohesion);
  }
  EXPECT_EQ(again.text, scene.text);
}

TEST(Regions, FramesHaveTheNumbersWhereThereAreSeveral) {
  const Specimen several = make_specimen(read_scene(plate, {coarse, layers}));
  const PointCloud frame = frame_of(fpz::sph::Simulation<2>(several.setup), several);
  ASSERT_NE(frame.find("material"), nullptr);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    ASSERT_EQ(frame.find("material")->values[i], several.setup.materials.of_particle[i]);
  }
  const Specimen one = make_specimen(read_scene(plate, {coarse}));
  EXPECT_EQ(frame_of(fpz::sph::Simulation<2>(one.setup), one).find("material"), nullptr);
}

TEST(Regions, ParticlesOfAFileSayTheirs) {
  const fpz::test::TemporaryFolder folder;
  const fs::path file = folder.path() / "particles.csv";
  std::ofstream csv(file);
  csv << "x,y,material\n";
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 10; ++i) {
      csv << -0.0225 + 0.005 * i << "," << -0.0475 + 0.005 * j << "," << (i == j ? 2 : i > 5 ? 1 : 0) << "\n";
    }
  }
  csv.close();
  const std::string from_file = R"(arrangement={"type":"file","file":")" + file.string() + "\"}";
  const Overrides set = {
      "spacing=0.005", from_file,
      R"(regions=[{"name":"a","material":{"density":2000}},{"name":"b","material":{"density":2100}}])"};
  const Specimen s = make_specimen(read_scene(plate, set));
  for (std::size_t i = 0; i < 200; ++i) {
    const int column = static_cast<int>(i) % 10, row = static_cast<int>(i) / 10;
    ASSERT_EQ(s.setup.materials.of_particle[i], column == row ? 2 : column > 5 ? 1 : 0);
  }
}

/// A steel platen that is rigid moves sideways as a whole, and under no force.
TEST(Regions, PlatensHaveAMaterialAndMayBeRigid) {
  const Overrides set = {coarse, R"(boundaries[0].material={"young_modulus":1.4e11,"poisson_ratio":0.3})",
                         "boundaries[0].rigid=true", R"(boundaries[0].velocity={"y":{"speed":-0.02,"ramp":1e-4}})"};
  const Specimen s = make_specimen(read_scene(plate, set));
  fpz::sph::Simulation<2> run(s.setup);
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(run.step().ok());
  const fpz::sph::Particles<2>& p = run.particles();
  double stress = 0.0;
  for (std::size_t id = 0; id < s.setup.arrangement.size(); ++id) {
    if (s.setup.arrangement.group[id] != 0) continue;
    ASSERT_EQ(s.setup.materials.of(id), 1U);
    ASSERT_EQ(p.velocity[0][run.slot(id)], run.velocity(0)[0]);
    stress = std::max(stress, std::abs(p.stress[0][run.slot(id)]));
  }
  EXPECT_LT(std::abs(run.reaction(0)[0]), 1e-9 * std::abs(run.reaction(0)[1]));
}

}  // namespace
