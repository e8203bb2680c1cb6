#include "fpz/specimen/scene.hpp"

#include <gtest/gtest.h>

#include "fpz/io/input_error.hpp"
#include "fpz/law/softening.hpp"
#include "fpz/specimen/specimen.hpp"

namespace {

using namespace fpz::specimen;
using fpz::io::InputError;

const std::filesystem::path scenes = std::filesystem::path(FPZ_DATA_DIR) / "scenes";

/// What reading complains about.
std::string complaint(const std::filesystem::path& file, const Overrides& set) {
  try {
    (void)read_scene(file, set);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::string beam_complaint(const Overrides& set) { return complaint(scenes / "beam_3pb.json", set); }

TEST(Scene, TheScenesOfThePaperAreValid) {
  for (const char* name : {"beam_3pb", "scb", "ring"}) {
    const Scene s = read_scene(scenes / (std::string(name) + ".json"), {"spacing=0.002"});
    EXPECT_EQ(s.name, name);
    const Specimen specimen = make_specimen(s);
    EXPECT_NEAR(specimen.area, area(s.body), 1e-9 * specimen.area);
    EXPECT_EQ(s.gauges.size(), specimen.gauges.size());
  }
}

TEST(Scene, OverridesChangeAnyEntry) {
  const Scene s =
      read_scene(scenes / "beam_3pb.json",
                 {"spacing=0.002", "method.configuration=updated", "notches[0].angle_deg=30", "method.rve_length=0.005",
                  "boundaries[0].velocity.y.speed=-0.5", "stop.deflection=1e-5", "material=../materials/bellego.json"});
  EXPECT_EQ(s.spacing, 0.002);
  EXPECT_EQ(s.options.configuration, fpz::sph::Configuration::updated);
  EXPECT_NEAR(s.body.notches[0].tip[0], -0.004, 1e-12);
  EXPECT_EQ(s.options.rve_length.rule, fpz::sph::RveLength::Rule::number);
  EXPECT_EQ(s.boundaries[0].drive[1]->course.value, -0.5);
  EXPECT_EQ(*s.stop.deflection, 1e-5);
  EXPECT_EQ(s.parameters.cohesion, 2.9e6);
}

TEST(Scene, OverridesReplacePartsOfAMaterialFile) {
  const Scene s = read_scene(scenes / "beam_3pb.json", {"material.cohesion=6e6", "material.softening=bilinear"});
  EXPECT_EQ(s.parameters.cohesion, 6e6);
  EXPECT_EQ(s.parameters.tensile_strength, 2.9e6);
  EXPECT_EQ(to_string(s.parameters.choices.softening), "bilinear");
  // The scene's copy is complete and reads as the same material from anywhere.
  const Scene again = parse_scene(s.text, "/elsewhere/x.json");
  EXPECT_EQ(again.parameters.cohesion, 6e6);
  EXPECT_EQ(to_string(again.parameters.choices.softening), "bilinear");
  EXPECT_EQ(again.material_name, s.material_name);
  EXPECT_NE(beam_complaint({"material.cohesion=1"}).find("material.cohesion = 1: must be >"), std::string::npos);
}

TEST(Scene, SpacingsTooCoarseForTheProcessZoneAreSaid) {
  const auto said = [](const Overrides& set) {
    std::string all;
    for (const std::string& w : read_scene(scenes / "beam_3pb.json", set).warnings) all += w + "\n";
    return all.find("too coarse for this material") != std::string::npos;
  };
  EXPECT_FALSE(said({}));                       // 269 mm
  EXPECT_TRUE(said({"material.delta0=1e-6"}));  // 16 mm
  EXPECT_FALSE(said({"material.delta0=1e-6", "spacing=0.002"}));
}

TEST(Scene, OperatorsThatFailOnAnArrangementAreSaid) {
  const auto said = [](const std::string& arrangement, const std::string& method) {
    std::string all;
    for (const std::string& w :
         read_scene(scenes / "disc.json", {"arrangement=" + arrangement, method.empty() ? "name=disc" : method})
             .warnings) {
      all += w + "\n";
    }
    return all.find("constant stress is not in equilibrium") != std::string::npos ? all : "";
  };
  const std::string updated = "method.configuration=updated";
  for (const char* fine : {R"({"type":"lattice"})", R"({"type":"lattice","angle_deg":20})", R"({"type":"sheared"})"}) {
    EXPECT_EQ(said(fine, updated), "");
  }
  for (const char* wrong : {R"({"type":"lattice","move":0.1})", R"({"type":"rings"})", R"({"type":"scattered"})"}) {
    EXPECT_NE(said(wrong, updated).find(R"(use "configuration": "reference")"), std::string::npos) << wrong;
    EXPECT_NE(said(wrong, "method.momentum=paper").find(R"(use "momentum": "adjoint")"), std::string::npos);
    EXPECT_NE(said(wrong, "method.gradient=kernel").find(R"(use "gradient": "consistent")"), std::string::npos);
    EXPECT_EQ(said(wrong, ""), "");
  }
}

TEST(Scene, OverridesAreCheckedLikeTheFile) {
  EXPECT_NE(beam_complaint({"method.courrant=0.3"}).find("did you mean \"courant\"?"), std::string::npos);
  EXPECT_NE(beam_complaint({"spacing=-1"}).find("spacing: -1: must be > 0"), std::string::npos);
  EXPECT_NE(beam_complaint({"notches[3].length=1"}).find("there are 1 entries"), std::string::npos);
  EXPECT_NE(beam_complaint({"spacing"}).find("expected path=value"), std::string::npos);
  EXPECT_NE(beam_complaint({"spacing.x=1"}).find("where the scene has the number"), std::string::npos);
  EXPECT_NE(beam_complaint({"method.kernel=cubic"}).find("did you mean \"cubic_spline\"?"), std::string::npos);
}

TEST(Scene, ArrangementsAtRandomHaveASeed) {
  const Pattern scattered =
      read_scene(scenes / "beam_3pb.json", {R"(arrangement={"type":"scattered","seed":0})"}).pattern;
  EXPECT_EQ(scattered.kind, Pattern::Kind::scattered);
  EXPECT_EQ(scattered.seed, 0u);
  const Pattern moved =
      read_scene(scenes / "beam_3pb.json", {R"(arrangement={"type":"lattice","move":0.2,"seed":3})"}).pattern;
  EXPECT_EQ(moved.move, 0.2);
  EXPECT_EQ(moved.seed, 3u);
  const auto said = [](const std::string& arrangement) { return beam_complaint({"arrangement=" + arrangement}); };
  EXPECT_NE(said(R"({"type":"scattered","seed":-1})").find("arrangement.seed: -1"), std::string::npos);
  EXPECT_NE(said(R"({"type":"scattered","seed":1.5})").find("arrangement.seed: 1.5"), std::string::npos);
  EXPECT_NE(said(R"({"type":"lattice","move":0.31})").find("arrangement.move: 0.31"), std::string::npos);
  EXPECT_NE(said(R"({"type":"lattice","seed":1})").find("has no effect without \"move\""), std::string::npos);
  EXPECT_NE(said(R"({"type":"scattered","move":0.1})").find("move"), std::string::npos);
}

TEST(Scene, AllProblemsAreReportedWithTheirLines) {
  const std::string text = R"({
  "material": "../materials/johnstone.json",
  "setting": "plain_strain",
  "thickness": 0.02,
  "spacing": "0.001",
  "shape": {"type": "half_disk", "radius": 0.05},
  "boundaries": [
    {"name": "top", "at": [0, 0.05], "direction": [0, 0], "width": 0.004, "velocity": {"z": 0}}
  ],
  "gauges": {"load": {"force_on": "topp", "direction": [0, -1]}},
  "stop": {"deflection": 1e-4}
})";
  std::string what;
  try {
    (void)parse_scene(text, scenes / "bad.json");
  } catch (const InputError& e) {
    what = e.what();
  }
  for (const char* expected :
       {"bad.json:3: setting: unknown choice \"plain_strain\"; did you mean \"plane_strain\"?",
        "bad.json:5: spacing: expected a number, found the string \"0.001\": write it without quotes",
        "bad.json:6: shape.type: unknown choice \"half_disk\"; did you mean \"half_disc\"?",
        "bad.json:8: boundaries[0].direction: is zero", "bad.json:8: boundaries[0].velocity.z: unknown key \"z\"",
        "bad.json:10: gauges.load.force_on: there is no boundary \"topp\"; did you mean \"top\"?",
        "bad.json:10: gauges: missing key \"deflection\"", "bad.json:11: stop: missing key \"time\""}) {
    EXPECT_NE(what.find(expected), std::string::npos) << expected << "\nin\n" << what;
  }
}

TEST(Scene, TheTextReadsBackAsTheSameScene) {
  const Scene s = read_scene(scenes / "scb.json", {"notches[0].angle_deg=30", "name=a \"quoted\" one"});
  const Scene again = parse_scene(s.text, "/elsewhere/scene.json");
  EXPECT_EQ(again.text, s.text);
  EXPECT_EQ(again.name, "a \"quoted\" one");
  EXPECT_EQ(again.parameters.delta0, s.parameters.delta0);
  const Specimen a = make_specimen(s), b = make_specimen(again);
  ASSERT_EQ(a.setup.arrangement.size(), b.setup.arrangement.size());
  for (std::size_t i = 0; i < a.setup.arrangement.size(); ++i) {
    EXPECT_EQ(a.setup.arrangement.position[i], b.setup.arrangement.position[i]);
  }
}

TEST(Scene, GaugesThatFindNothingAreRefused) {
  const Scene s = read_scene(scenes / "beam_3pb.json",
                             {R"(gauges.far={"stress": "xx", "of": {"low": [0.01, 0.01], "high": [0.011, 0.011]}})"});
  EXPECT_THROW((void)make_specimen(s), InputError);
  EXPECT_NE(beam_complaint({R"(gauges.load={"stress": "xx", "of": "top"})"}).find("must measure a force"),
            std::string::npos);
  EXPECT_NE(beam_complaint({R"(gauges.time={"force_on": "top", "direction": [0, 1]})"}).find("exists already"),
            std::string::npos);
}

/// Particles interact around the tip of a notch but never across its faces, whatever its width and angle.
TEST(Scene, SlotsAreMeasuredAtTheirParticles) {
  // 4 mm columns beside the slot of 9.6 mm: two are missing, and parts of the cells beside them.
  const Specimen coarse = make_specimen(read_scene(scenes / "beam_3pb.json", {}));
  ASSERT_EQ(coarse.slots.size(), 1u);
  EXPECT_NEAR(coarse.slots[0].width, 9.6e-3, 2e-5);
  EXPECT_NEAR(coarse.slots[0].length, 8e-3, 2e-5);
  const Specimen longer = make_specimen(read_scene(scenes / "beam_3pb.json", {"notches[0].length=0.011"}));
  EXPECT_NEAR(longer.slots[0].length, 11e-3, 0.05 * 4e-3);
}

TEST(Scene, SlotsNarrowerThanASpacingAreCuts) {
  const Scene scene = read_scene(scenes / "beam_3pb.json", {"notches[0].width=0.002"});
  EXPECT_EQ(scene.body.notches[0].width, 0.0);
  EXPECT_EQ(scene.body.notches[0].asked_width, 0.002);
  const Specimen s = make_specimen(scene);
  EXPECT_EQ(s.setup.arrangement.size(), 1600u + 18u);  // and three rollers
  EXPECT_FALSE(s.setup.arrangement.cuts[0].is_tip[0]);
  EXPECT_TRUE(s.setup.arrangement.cuts[0].is_tip[1]);
  const Scene wide = read_scene(scenes / "beam_3pb.json", {"notches[0].width=0.0041"});
  EXPECT_EQ(wide.body.notches[0].width, 0.0041);
  EXPECT_FALSE(make_specimen(wide).setup.arrangement.cuts[0].is_tip[1]);
}

TEST(Scene, NotchesOfAnyWidthSeparateTheirFaces) {
  for (const char* width : {"0", "0.0005", "\"narrowest\""}) {
    for (const int angle : {0, 15, 30, 45, 54, 60}) {
      const Scene scene = read_scene(scenes / "scb.json", {"notches[0].angle_deg=" + std::to_string(angle),
                                                           std::string("notches[0].width=") + width});
      const Specimen s = make_specimen(scene);
      ASSERT_EQ(s.setup.arrangement.cuts.size(), 1u);
      EXPECT_EQ(s.setup.arrangement.cuts[0].corner[0], scene.body.notches[0].mouth);
      EXPECT_EQ(s.setup.arrangement.cuts[0].corner[1], scene.body.notches[0].tip);
    }
  }
}

}  // namespace
