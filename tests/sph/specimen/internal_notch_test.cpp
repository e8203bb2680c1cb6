// Slots and cuts whose both ends are in the body.
#include <gtest/gtest.h>

#include "fpz/specimen/specimen.hpp"

namespace {

using namespace fpz::specimen;

const std::filesystem::path scenes = std::filesystem::path(FPZ_DATA_DIR) / "scenes";

Scene plate_with(const std::string& notch, const Overrides& more = {}) {
  Overrides set = {"notches=[" + notch + "]"};
  set.insert(set.end(), more.begin(), more.end());
  return read_scene(scenes / "uniaxial_compression.json", set);
}

TEST(InternalNotch, SlotsHaveBothEndsWhereTheSceneSays) {
  const Scene scene = plate_with(R"({"mouth": [0, -0.008], "length": 0.016, "width": 0.004})");
  const Notch& n = scene.body.notches.front();
  EXPECT_TRUE(n.internal);
  EXPECT_NEAR(area(scene.body), 0.05 * 0.1 - 0.016 * 0.004, 1e-9);
  EXPECT_TRUE(contains(scene.body, Point(0.0, -0.0081)));
  EXPECT_FALSE(contains(scene.body, Point(0.0, -0.0079)));
  EXPECT_FALSE(contains(scene.body, Point(0.0, 0.0079)));
  EXPECT_TRUE(contains(scene.body, Point(0.0, 0.0081)));
  const Specimen s = make_specimen(scene);
  EXPECT_NEAR(s.slots.front().length, 0.016, 0.05 * scene.spacing);
  EXPECT_NEAR(s.slots.front().width, 0.004, 0.05 * scene.spacing);
}

/// Mouth and tip change places: the same particles, the same volumes, the same bonds.
TEST(InternalNotch, NeitherEndIsTheMouth) {
  for (const char* width : {"0.004", "0"}) {
    const auto with = [&](const char* mouth, const char* angle) {
      return make_specimen(plate_with(std::string(R"({"mouth": )") + mouth + R"(, "length": 0.016, "angle_deg": )" +
                                      angle + R"(, "width": )" + width + "}"));
    };
    const Specimen up = with("[0, -0.008]", "0"), down = with("[0, 0.008]", "180");
    ASSERT_EQ(up.setup.arrangement.size(), down.setup.arrangement.size());
    for (std::size_t i = 0; i < up.setup.arrangement.size(); ++i) {
      EXPECT_LT((up.setup.arrangement.position[i] - down.setup.arrangement.position[i]).norm(), 1e-12);
      EXPECT_NEAR(up.setup.arrangement.volume[i], down.setup.arrangement.volume[i],
                  1e-6 * up.setup.arrangement.volume[i]);
    }
    const bool cut = std::string(width) == "0";
    EXPECT_EQ(up.setup.arrangement.cuts[0].is_tip[0], cut);
    EXPECT_EQ(up.setup.arrangement.cuts[0].is_tip[1], cut);
  }
}

TEST(InternalNotch, MouthsOnSurfacesStayMouths) {
  EXPECT_FALSE(plate_with(R"({"mouth": [-0.025, 0], "length": 0.01, "angle_deg": -90, "width": 0.004})")
                   .body.notches[0]
                   .internal);
  EXPECT_FALSE(plate_with(R"({"mouth": [-0.0247, 0], "length": 0.01, "angle_deg": -90})").body.notches[0].internal);
  // On the surface of a hole.
  EXPECT_FALSE(plate_with(R"({"mouth": [0.005, 0], "length": 0.01, "angle_deg": -90})",
                          {R"(holes=[{"type": "disc", "radius": 0.005}])"})
                   .body.notches[0]
                   .internal);
}

}  // namespace
