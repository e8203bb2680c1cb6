// Slips that a person makes in a scene, one a row, and what must be said about them: file, key, value, constraint.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/specimen.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

const fs::path scenes = fs::path(FPZ_DATA_DIR) / "scenes";

/// All that is said about a scene before it runs: refusals as they are, warnings after "warning: ".
std::string said(const fs::path& file, const Overrides& set) {
  try {
    const Scene scene = read_scene(file, set);
    const Specimen specimen = make_specimen(scene);
    std::string all;
    for (const std::string& w : scene.warnings) all += "warning: " + w + "\n";
    for (const std::string& w : specimen.warnings) all += "warning: " + w + "\n";
    return all;
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
}

enum class Answer { refused, warned };

struct Slip {
  Answer answer;
  const char* scene;
  Overrides set;
  std::vector<const char*> parts;  ///< of the message
};

void expect_answers(const std::vector<Slip>& slips) {
  for (const Slip& slip : slips) {
    const std::string text = said(scenes / slip.scene, slip.set);
    const std::string& first = slip.set.front();
    EXPECT_NE(text.find(slip.scene), std::string::npos) << first << "\n" << text;
    EXPECT_EQ(text.find("warning: ") == 0, slip.answer == Answer::warned) << first << "\n" << text;
    for (const char* part : slip.parts)
      EXPECT_NE(text.find(part), std::string::npos) << first << ": " << part << "\nin\n" << text;
  }
}

constexpr const char* beam = "beam_3pb.json";
constexpr const char* plate = "uniaxial_compression.json";
constexpr Answer refused = Answer::refused, warned = Answer::warned;

/// Warnings about the shipped scenes themselves: only what the calibrated materials of the paper deserve, and that
/// steel is no rock.
TEST(Checks, ShippedScenesGiveNoFalseAlarm) {
  for (const fs::directory_entry& entry : fs::directory_iterator(scenes)) {
    const std::string file = entry.path().filename().string();
    std::istringstream text(said(scenes / file, {"name=x", "material.shear_stiffness=1e15"}));
    for (std::string line; std::getline(text, line);) {
      const bool steel = file == "kalthoff.json" && line.find("value for rock and concrete") != std::string::npos;
      EXPECT_TRUE(steel) << file << ": " << line;
    }
  }
}

TEST(Checks, InterfacesHaveNoElasticity) {
  expect_answers({{warned,
                   "uniaxial_compression.json",
                   {R"(interfaces=[{"name": "bed", "line": [[-0.1, 0.05], [0.1, 0.05]], "material": {"name": "clay",
                       "young_modulus": 1e9, "poisson_ratio": 0.3, "density": 2000, "tensile_strength": 1e5,
                       "cohesion": 2e5, "friction_angle_deg": 20, "dilation_angle_deg": 0, "delta0": 1e-4,
                       "normal_stiffness": 1e13, "shear_stiffness": 1e13}}])"},
                   {"interfaces[0].material: its young_modulus = 1e+09", "have no effect"}}});
}

TEST(Checks, Notches) {
  expect_answers({
      {refused,
       beam,
       {"method.configuration=updated", "notches[0].friction_angle_deg=30"},
       {"notches[0].friction_angle_deg: 30: faces press on each other and slide in the configuration reference only"}},
      {refused,
       beam,
       {"notches[0].mouth=[0.3,0]"},
       {"notches[0].mouth: [0.3, 0]: the notch is outside the body", "0.14 m", "from [-0.16, 0] to [0.16, 0.08]"}},
      {refused, beam, {"notches[0].mouth=[0,0.2]"}, {"notches[0].mouth: [0, 0.2]: the notch is outside the body"}},
      {refused,
       beam,
       {"notches[0].length=8"},
       {"notches[0].length: 8: the notch is longer than the body", "after 0.08 m",
        "8 mm was probably meant: write 0.008"}},
      {refused, beam, {"notches[0].length=0.2"}, {"notches[0].length: 0.2: the notch is longer than the body"}},
      {refused,
       beam,
       {"notches[0].angle_deg=180"},
       {"notches[0].angle_deg: 180: the notch points out of the body", "as 0 does"}},
      {refused, beam, {"notches[0].angle_deg=-120"}, {"notches[0].angle_deg: -120: the notch points out of the body"}},
      {refused,
       beam,
       {"notches[0].mouth=[0,-0.009]", "notches[0].length=0.02"},
       {"notches[0].mouth: [0, -0.009]: the mouth is outside the body", "0.009 m", "put it at [0, 0]"}},
      {warned,
       beam,
       {"notches[0].mouth=[0,-0.004]", "notches[0].length=0.02"},
       {"notches[0].mouth: [0, -0.004]: the mouth is outside the body", "put it at [0, 0]"}},
      {refused,
       beam,
       {"notches[0].width=9.6"},
       {"notches[0].width: 9.6: the slot is wider than the body; must be < 0.08"}},
      {warned, beam, {"notches[0].length=0.001"}, {"notches[0].length: 0.001: shorter than a spacing (0.004)"}},
      {refused, beam, {R"(notches[1]={"mouth":[0,0],"length":0.008})"}, {"notches[1]: the same as notches[0]"}},
      {warned,
       beam,
       {R"(holes=[{"type":"disc","centre":[0,0.012],"radius":0.006}])"},
       {"notches[0].length: 0.008: the notch ends in holes[0]"}},
      {warned,
       beam,
       {R"(holes=[{"type":"disc","centre":[0,0.03],"radius":0.01}])", "notches[0].length=0.045"},
       {"notches[0].length: 0.045: the notch runs through a hole", "from [0, 0.02] to [0, 0.04]"}},
      {warned,
       beam,
       {"notches[0].length=0.08", "notches[0].width=0", "notches[0].mouth=[0.05,0]"},
       {"notches[0].length: 0.08: the cut goes from surface to surface and divides the body", "friction_angle_deg"}},
      {warned,
       "dogbone.json",
       {R"(notches=[{"mouth":[-0.02,0],"length":0.041,"angle_deg":-90,"width":0.004}])"},
       {"notches[0].length: 0.041: the slot goes from surface to surface and divides the body"}},
      {refused,
       beam,
       {"notches[0].mouth=[0,0.02]"},
       {"gauges.cmod.notch_opening: 0: the mouth of notches[0] is 0.02 m inside the body", "nothing opens",
        R"("displacement_of": {"point": [-0.0068, 0.024]})"}},
  });
}

/// A cut with a friction angle of its own is a joint, and one into a hole divides nothing.
TEST(Checks, NotchesThatMayDivide) {
  const Overrides stiff = {"material.shear_stiffness=1e14", "notches[0].width=0", "notches[0].length=0.08",
                           "notches[0].mouth=[0.05,0]", "notches[0].friction_angle_deg=30"};
  EXPECT_EQ(said(scenes / beam, stiff), "");
  const std::string ring =
      said(scenes / "ring.json",
           {R"(notches=[{"mouth":[-0.025,0],"length":0.0175,"angle_deg":-90}])", "material.shear_stiffness=1e14"});
  EXPECT_EQ(ring.find("divides"), std::string::npos) << ring;
}

TEST(Checks, Holes) {
  const auto hole = [](const char* shape) { return Overrides{std::string("holes=[") + shape + "]"}; };
  expect_answers({
      {refused,
       beam,
       hole(R"({"type":"disc","centre":[1,1],"radius":0.01})"),
       {"holes[0]: the hole reaches from [0.99, 0.99] to [1.01, 1.01] and is outside the body", "removes nothing"}},
      {refused, beam, hole(R"({"type":"disc","centre":[0,0.04],"radius":10})"), {"holes[0]", "removes the whole body"}},
      {warned,
       beam,
       hole(R"({"type":"disc","centre":[0.05,0.075],"radius":0.01})"),
       {"holes[0]: the hole from [0.04, 0.065] to [0.06, 0.085] crosses the surface of the body"}},
      {warned,
       beam,
       hole(R"({"type":"disc","centre":[0.1,0.04],"radius":0.0005})"),
       {"holes[0]: the hole is 0.001 m wide, less than two spacings"}},
      {refused,
       beam,
       hole(R"({"type":"disc","centre":[0.1,0.04],"radius":0.02},{"type":"disc","centre":[0.1,0.04],"radius":0.01})"),
       {"holes[1]: the hole lies within holes[0]"}},
  });
}

/// What rounding has left just short of what it was meant to reach.
TEST(Checks, NearlyTouching) {
  constexpr const char* box = "shear_box_stress.json";
  const auto joint = [](const char* length) {
    return Overrides{std::string(R"(notches=[{"mouth":[-0.05,0],"angle_deg":-90,"friction_angle_deg":30,"length":)") +
                     length + "}]"};
  };
  for (const char* length : {"0.1", "0.099999998", "0.0999999", "0.099981", "0.1000000001", "0.100001"}) {
    const Scene scene = read_scene(scenes / box, joint(length));
    EXPECT_GE(scene.body.notches[0].tip.x(), 0.05) << length;
    EXPECT_EQ(said(scenes / box, joint(length)).find("notches"), std::string::npos) << length;
  }
  expect_answers({
      {refused,
       box,
       joint("0.0995"),
       {"notches[0].length: 0.0995: the notch ends 0.0005 m (0.25 spacings) before the surface", "[0.05, 0]",
        "must reach through it, 0.1, or leave it 3 rows", "<= 0.094"}},
      {refused,
       beam,
       {R"(holes=[{"type":"disc","centre":[0.05,0.07],"radius":0.009999999}])"},
       {"holes[0]: the hole from [0.04, 0.06] to [0.06, 0.08] leaves a wall of 1e-09 m", "to the surface of the body"}},
      {refused,
       beam,
       {R"(holes=[{"type":"disc","centre":[0.05,0.04],"radius":0.01},
                  {"type":"disc","centre":[0.07,0.04],"radius":0.00999}])"},
       {"holes[1]: the hole", "leaves a wall of 1e-05 m (0.0025 spacings) to holes[0]"}},
  });
  EXPECT_EQ(said(scenes / beam, {R"(holes=[{"type":"rectangle","low":[0.03,0.06],"high":[0.05,0.08]}])"}).find("holes"),
            std::string::npos);
}

TEST(Checks, SizesAndSpacings) {
  expect_answers({
      {refused,
       beam,
       {R"(shape={"type":"rectangle","low":[-160,0],"high":[160,80]})"},
       {"shape: the size of the body = 320 m is far above any", "320 mm was probably meant: write 0.32"}},
      {refused, "ring.json", {"shape.radius=25"}, {"shape: the size of the body = 50 m", "50 mm was probably meant"}},
      {refused, beam, {"thickness=40"}, {"thickness: thickness = 40 m is far above any", "40 mm was probably meant"}},
      {refused, beam, {"thickness=-0.04"}, {"thickness: -0.04: must be > 0"}},
      {refused,
       beam,
       {"spacing=4"},
       {"spacing: 4: only 0.018 rows of particles", "4 mm was probably meant: write 0.004"}},
      {refused, beam, {"spacing=0.05"}, {"spacing: 0.05: only 1.44 rows of particles", "0.072 m", "must be <= 0.024"}},
      {warned, beam, {"spacing=0.008"}, {"spacing: 0.008: only 9 rows of particles", "should be <= 0.0072 (10 rows)"}},
      {warned, beam, {"material.delta0=1e-6"}, {"spacing: 0.004: too coarse for this material", "at most 0.003293"}},
      {warned,
       beam,
       {"material.delta0=4e-7", "spacing=0.008"},
       {"spacing: 0.008: should be < 0.00", "without snap-back"}},
      {warned, beam, {"method.gravity=[0,-9810]"}, {"method.gravity: [0, -9810]: the weight of the body", "9.81"}},
      {refused,
       beam,
       {R"(shape={"type":"polygon","corners":[[-0.16,0],[0.16,0.08],[0.16,0],[-0.16,0.07]]})"},
       {"shape.corners: the polygon crosses itself: the sides that begin at corners 0 and 2"}},
      {refused,
       beam,
       {R"(shape={"type":"polygon","corners":[[0,0],[0.1,0],[0.1,0.1],[0,0.1],[0,0]]})"},
       {"shape.corners: the last corner repeats the first"}},
  });
}

TEST(Checks, Boundaries) {
  expect_answers({
      {refused,
       beam,
       {"boundaries[2].at=[-0.12,0]"},
       {"boundaries[2].at: [-0.12, 0]: the platen lies on the one of boundary", "\"left\""}},
      {refused, beam, {"boundaries[0].at=[0.3,0.08]"}, {"boundaries[0].at: [0.3, 0.08]: the platen is off the body"}},
      {refused,
       beam,
       {"boundaries[0].width=0.8"},
       {"boundaries[0].width: 0.8: the platen reaches beyond the body", "120 of its 200 columns",
        "about 0.32 at most"}},
      {refused,
       beam,
       {"boundaries[0].width=0.004", "boundaries[0].friction=0.3"},
       {"boundaries[0].width: 0.004: has 1 column of particles, too little for a face", "must be >= 0.008"}},
      {refused, beam, {"boundaries[0].width=8"}, {"boundaries[0].width: 8", "8 mm was probably meant: write 0.008"}},
      {refused,
       beam,
       {"boundaries[0].direction=[0,-1]"},
       {"boundaries[0].direction: [0, -1]: points into the body", "must point outwards"}},
      {refused, beam, {"boundaries[1].direction=[0,1]"}, {"boundaries[1].direction: [0, 1]: points into the body"}},
      {refused,
       beam,
       {"boundaries[1].at=[0,0]"},
       {"boundaries[1].at: [0, 0]: 2 of its 2 columns stand over a hole or a slot"}},
      {warned, beam, {"boundaries[0].at=[0,80]"}, {"boundaries[0].at: [0, 80]: lies 79.92 m above the surface"}},
      {warned,
       beam,
       {"boundaries[1].at=[0.03,0]", "notches[0].mouth=[0.03,0]", "notches[0].width=0"},
       {"boundaries[1].at: [0.03, 0]: notches[0] reaches the surface under the platen"}},
      {refused,
       beam,
       {"boundaries[0].velocity.y=\"fast\""},
       {"boundaries[0].velocity.y: expected a number, {\"speed\", \"ramp\"}", "found the string \"fast\""}},
  });
}

TEST(Checks, PlatensMayMeetAtACorner) {
  const std::string text = said(
      scenes / beam,
      {R"(boundaries=[{"name": "top", "at": [0.157, 0.08], "direction": [0, 1], "width": 0.006, "velocity": {"y": -0.01}},
                      {"name": "left", "at": [-0.12, 0], "direction": [0, -1], "width": 0.008, "velocity": {"y": 0}},
                      {"name": "right", "at": [0.16, 0.077], "direction": [1, 0], "width": 0.006,
                       "velocity": {"x": 0, "y": 0}}])"});
  EXPECT_TRUE(text.empty() || text.find("warning: ") == 0) << text;
}

TEST(Checks, Loading) {
  expect_answers({
      {refused,
       beam,
       {"boundaries[0].velocity.y=0"},
       {"boundaries: no boundary moves, and there is neither a load nor gravity"}},
      {refused, plate, {"boundaries[1].velocity.y.speed=-0.02"}, {"boundaries: all boundaries move alike"}},
      {warned,
       beam,
       {"boundaries[0].velocity.y.speed=-5"},
       {"boundaries[0].velocity.y.speed: -5: a start at 5 m/s sends a wave", "56.41 MPa",
        "5 mm/s was perhaps meant: write 0.005"}},
      {refused,
       beam,
       {"boundaries[0].velocity.y.speed=-1e5"},
       {"boundaries[0].velocity.y.speed: -1e5: moves at 1e+05 m/s; must be < 4701"}},
      {warned,
       beam,
       {"boundaries[0].velocity.y.ramp=1"},
       {"boundaries[0].velocity.y.ramp: 1: takes 1 s, longer than stop.time = 0.02 s"}},
      {warned,
       beam,
       {"stop.deflection=0.06"},
       {"stop.deflection: 0.06: is not reached before stop.time = 0.02 s", "9.75e-05 m",
        "0.06 mm was probably meant: write 6e-05"}},
      {warned, beam, {R"(stop={"time": 20})"}, {"stop.time: 20: until then a boundary moves by 0.09997 m"}},
      {warned, beam, {"output.frames_at=[1e-5,1]", "stop.deflection=5e-5"}, {"output.frames_at[1]: 1: never reached"}},
  });
}

TEST(Checks, Loads) {
  const char* confined = "confined_compression.json";
  expect_answers({
      {warned,
       confined,
       {"loads[0].pressure.value=5"},
       {"loads[0].pressure.value: pressure = 5 Pa is far below any", "5 MPa was probably meant: write 5e+06"}},
      {warned,
       beam,
       {R"(boundaries[0].force={"y": {"value": -3, "ramp": 0.01}})", R"(boundaries[0].velocity={"x": 0})"},
       {"boundaries[0].force.y.value: force = 3 N is far below any", "3 kN was probably meant"}},
      {refused,
       beam,
       {R"(boundaries[0].hinge=[0, 84])"},
       {"boundaries[0].hinge: [0, 84]: is 83.92 m from the platen", "84 mm was probably meant"}},
      {warned,
       beam,
       {"stop.time=1e-6", "boundaries[0].velocity.y.ramp=0"},
       {"stop.time: 1e-6: shorter than the 6.807e-05 s"}},
      {refused, beam, {"spacing=4e-6"}, {"spacing: 4e-6: makes about 1.6e+09 particles", "must be >="}},
  });
}

TEST(Checks, SignsOfGauges) {
  expect_answers({
      {refused,
       beam,
       {"gauges.load.direction=[0,1]"},
       {"gauges.load.direction: [0, 1]: points against the motion", "must be [0, -1]"}},
      {refused,
       beam,
       {"gauges.support.direction=[0,-1]"},
       {"gauges.support.direction: [0, -1]: points against the motion"}},
      {refused,
       beam,
       {"gauges.support.direction=[1,0]"},
       {"gauges.support.direction: [1, 0]", "nothing drives or holds", "in x", "always 0"}},
      {warned, beam, {"gauges.load.direction=[1,0]"}, {"gauges.load.direction: [1, 0]: nothing moves along it"}},
      {warned,
       beam,
       {"gauges.deflection.direction=[0,1]"},
       {"gauges.deflection.direction: [0, 1]: points against the motion"}},
      {refused,
       plate,
       {"gauges.deflection.direction=[0,1]"},
       {"gauges.deflection.direction: [0, 1]: points against the motion", "must be [0, -1]"}},
      {refused, plate, {"gauges.deflection.relative_to=top"}, {"gauges.deflection", "always 0"}},
      {refused,
       plate,
       {"boundaries[0].velocity.y.speed=0.02", "boundaries[1].velocity.y.speed=-0.02"},
       {"gauges.load.direction: [0, -1]", "gauges.support.direction: [0, 1]", "gauges.deflection.direction: [0, -1]"}},
  });
}

TEST(Checks, SitesOfGauges) {
  expect_answers({
      {refused,
       beam,
       {R"(gauges.deflection.displacement_of={"point":[5,0.04]})"},
       {"gauges.deflection.displacement_of.point: [5, 0.04]: is 4.84 m outside the body",
        "within two spacings (0.008 m)"}},
      {refused,
       beam,
       {R"(gauges.deflection.displacement_of={"point":[0,40]})"},
       {"gauges.deflection.displacement_of.point: [0, 40]", "40 mm was probably meant: write 0.04"}},
      {refused,
       beam,
       {R"(gauges.s={"stress":"xx","of":{"point":[0.17,0.04],"radius":0.001}})"},
       {"gauges.s.of.point: [0.17, 0.04]: is 0.01 m outside the body"}},
      {warned,
       beam,
       {R"(gauges.s={"stress":"xx","of":{"point":[0,0.04],"radius":5}})"},
       {"gauges.s.of.radius: 5: takes the mean over more than half", "5 mm was probably meant"}},
      {refused,
       beam,
       {R"(gauges.s={"stress":"xx","of":{"low":[0.01,0.05],"high":[0,0.06]}})"},
       {"gauges.s.of.low: [0.01, 0.05]: must be below and to the left of \"high\""}},
      {refused,
       beam,
       {R"(gauges.s={"stress":"xx","of":{"low":[5,5],"high":[6,6]}})"},
       {"gauges.s.of.low: [5, 5]: the box is outside the body"}},
      {refused,
       beam,
       {R"(gauges.d={"displacement_of":{"point":[0,0.04]},"relative_to":{"point":[0,0.04]},"direction":[0,1]})"},
       {"gauges.d.displacement_of: the same as \"relative_to\""}},
  });
}

TEST(Checks, Materials) {
  expect_answers({
      {refused,
       beam,
       {"material.young_modulus=45"},
       {"material.young_modulus = 45 Pa is far below any", "45 GPa was probably meant: write 4.5e+10"}},
      {refused,
       beam,
       {"material.tensile_strength=2.9"},
       {"material.tensile_strength = 2.9 Pa", "2.9 MPa was probably meant"}},
      {refused,
       beam,
       {"material.delta0=0.0164"},
       {"material.delta0 = 0.0164 m is far above any", "0.0164 mm was probably meant"}},
      {refused,
       beam,
       {"material.density=2.4"},
       {"material.density = 2.4 kg/m3", "2.4 g/cm3 was probably meant: write 2400"}},
      {refused,
       beam,
       {"material.friction_angle_deg=0.65", "material.dilation_angle_deg=0.1"},
       {"material.friction_angle_deg = 0.65 deg", "0.65 rad was probably meant: write 37.24"}},
      {warned,
       beam,
       {"material.tensile_strength=1e9", "material.cohesion=1e10"},
       {"material.tensile_strength = 1e+09 Pa is far above any value"}},
      {warned, beam, {"material.young_modulus=2e11"}, {"material.young_modulus = 2e+11 Pa is above the usual value"}},
  });
}

// ---- Particles from a file

struct ParticleFileScene {
  fs::path folder = fpz::test::fresh_path("particle_file");

  /// A bar of 40 x 20 particles 1 mm apart, the outer three columns at its ends being boundaries; f changes a row.
  fs::path write(const std::function<std::string(double x, double y, int group)>& row, double spacing = 1e-3) {
    fs::create_directories(folder);
    std::ofstream csv(folder / "particles.csv");
    csv << "x,y,volume,group\n";
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 20; ++j) csv << row(1e-3 * (i + 0.5), 1e-3 * (j + 0.5), i < 3 ? 0 : i >= 37 ? 1 : -1);
    }
    std::ofstream(folder / "scene.json")
        << R"({"material": ")" << (scenes / "../materials/bellego_mode1.json").string()
        << R"(", "setting": "plane_stress", "thickness": 0.01, "spacing": )" << spacing
        << R"(, "arrangement": {"type": "file", "file": "particles.csv"}, "boundaries": [
      {"name": "left", "velocity": {"x": 0}}, {"name": "right", "velocity": {"x": {"speed": 0.01, "ramp": 1e-4}}}],
      "gauges": {"load": {"force_on": "right", "direction": [1, 0]},
                 "deflection": {"displacement_of": "right", "direction": [1, 0]},
                 "s": {"stress": "xx", "of": {"point": [0.02, 0.01]}}}, "stop": {"time": 1e-3, "load_below": 0.5}})";
    return folder / "scene.json";
  }
};

std::string row(double x, double y, double volume, int group) {
  std::ostringstream s;
  s << x << ',' << y << ',' << volume << ',' << group << '\n';
  return s.str();
}

TEST(Checks, Regions) {
  const auto region = [](const std::string& shape, const std::string& material = R"({"density":2000})") {
    return R"(regions=[{"name":"r","material":)" + material + R"(,"shape":)" + shape + "}]";
  };
  const std::string disc = R"({"type":"disc","centre":[0,0.04],"radius":0.02})";
  expect_answers({
      {refused,
       beam,
       {region(R"({"type":"disc","centre":[1,1],"radius":0.01})")},
       {"regions[0].shape: it reaches from [0.99, 0.99] to [1.01, 1.01] and is outside the body"}},
      {refused,
       beam,
       {region(R"([{"type":"disc","centre":[0,0.04],"radius":0.01},{"type":"disc","centre":[0,40],"radius":0.01}])")},
       {"regions[0].shape[1]: it reaches from", "outside the body", "40 mm was probably meant: write 0.04"}},
      {warned,
       beam,
       {region(R"({"type":"rectangle","low":[-1,-1],"high":[1,1]})")},
       {"regions[0].shape: it covers the whole body, of which nothing has the \"material\" of the scene"}},
      {warned,
       beam,
       {region(R"({"type":"rectangle","low":[-0.1,0.04],"high":[0.1,0.046]})")},
       {"regions[0].shape: it is 0.006 m wide, less than two spacings"}},
      {refused,
       beam,
       {region(R"({"type":"disc","centre":[0,0.04],"radius":0.0005})")},
       {"regions[0] = \"r\": no particle is in it"}},
      {refused, beam, {region(disc, R"("nowhere.json")")}, {"regions[0].material: cannot read material file"}},
      {refused, beam, {region(disc, R"({"youngs":2e9})")}, {"regions[0].material", "unknown key \"youngs\""}},
      {refused, beam, {region(disc, R"({"young_modulus":30})")}, {"regions[0].material.young_modulus = 30", "GPa"}},
      {refused, beam, {region(disc, R"({"cohesion":1e4})")}, {"regions[0].material.cohesion", "must be >"}},
      {warned,
       beam,
       {region(disc, R"({"delta0":5e-7})")},
       {"regions[0].material: the spacing, 0.004, is too coarse for this material"}},
      {refused,
       beam,
       {R"(regions=[{"name":"r","shape":{"type":"disc","radius":0.01}}])"},
       {"regions[0]", "missing", "material"}},
      {refused,
       beam,
       {R"(boundaries[0].hinge=true)", "boundaries[0].rigid=true"},
       {"boundaries[0].rigid: one with a \"hinge\" is rigid already"}},
  });
}

TEST(Checks, Interfaces) {
  const auto interface = [](const std::string& where, const std::string& material = R"({"tensile_strength":1e6})") {
    return R"(interfaces=[{"name":"j","material":)" + material + "," + where + "}]";
  };
  const std::string line = R"("line":[[-0.1,0.05],[0.1,0.05]])";
  expect_answers({
      {refused,
       beam,
       {interface(R"("line":[[-0.1,0.2],[0.1,0.2]])")},
       {"interfaces[0].line: from [-0.1, 0.2] to [0.1, 0.2]: it is outside the body"}},
      {refused,
       beam,
       {interface(R"("line":[[-100,40],[100,40]])")},
       {"interfaces[0].line", "outside the body", "mm was probably meant"}},
      {refused, beam, {interface(R"("line":[[0,0.05]])")}, {"interfaces[0].line: has fewer than 2 points"}},
      {refused, beam, {interface(R"("line":[[0,0.05],[0,0.05]])")}, {"repeats the point before it"}},
      {refused,
       beam,
       {interface(line + R"(,"bedding":{"angle_deg":0,"spacing":0.02})")},
       {"interfaces[0]: needs either \"line\" or \"bedding\""}},
      {refused,
       beam,
       {interface(R"("bedding":{"angle_deg":10,"spacing":20,"origin":[0,1]})")},
       {"interfaces[0].bedding: no plane 20 m apart goes through the body", "20 mm was probably meant"}},
      {warned,
       beam,
       {interface(R"("bedding":{"angle_deg":0,"spacing":0.01})")},
       {"interfaces[0].bedding: planes are 0.01 m apart, less than three spacings"}},
      {warned,
       beam,
       {interface(line, R"({"tensile_strength":5e6})")},
       {"interfaces[0].material: the interface is as strong as the material beside it"}},
      {refused, beam, {interface(line, R"({"cohesion":1e3})")}, {"interfaces[0].material.cohesion", "must be >"}},
      {refused,
       beam,
       {interface(line), "method.configuration=updated"},
       {"weak planes: need the configuration reference"}},
  });
}

TEST(Checks, StrengthFields) {
  const auto field = [](const std::string& text) { return Overrides{"strength_field={" + text + "}"}; };
  expect_answers({
      {refused, beam, field(R"("weibull_modulus": 10)"), {"strength_field", "correlation_length"}},
      {refused, beam, field(R"("weibull_modulus": 0, "correlation_length": 0.01)"), {"strength_field.weibull_modulus"}},
      {refused, beam, field(R"("weibull_modulus": 10, "correlation_length": -1)"), {"correlation_length"}},
      {refused,
       beam,
       field(R"("weibull_modulus": 10, "correlation_length": 0.01, "sed": 3)"),
       {"strength_field.sed", "did you mean \"seed\""}},
      {warned,
       beam,
       field(R"("weibull_modulus": 10, "correlation_length": 0.001)"),
       {"strength_field.correlation_length: 0.001: less than two spacings"}},
      {warned,
       beam,
       field(R"("weibull_modulus": 10, "correlation_length": 10)"),
       {"strength_field.correlation_length: 10: longer than the body", "10 mm was probably meant"}},
      {warned,
       beam,
       field(R"("weibull_modulus": 1.5, "correlation_length": 0.01)"),
       {"strength_field.weibull_modulus: 1.5: scatters far more than rock"}},
  });
}

TEST(Checks, ParticlesFromAFile) {
  ParticleFileScene file;
  const Overrides stiff = {"material.shear_stiffness=1e14"};
  const fs::path good = file.write([](double x, double y, int g) { return row(x, y, 1e-6, g); });
  EXPECT_EQ(said(good, stiff), "");

  const auto expect = [&](const fs::path& scene, const Overrides& set, std::vector<std::string> parts) {
    Overrides all = stiff;
    all.insert(all.end(), set.begin(), set.end());
    const std::string text = said(scene, all);
    parts.emplace_back("scene.json: arrangement.file: \"" + (file.folder / "particles.csv").string());
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  };
  expect(good, {R"(shape={"type":"rectangle","low":[0,0],"high":[0.05,0.02]})"},
         {"volumes of the specimen sum to 0.00068"});
  expect(good, {R"(gauges.s={"stress":"xx","of":{"point":[0.02,0.05]}})"},
         {"gauges.s: its point [0.02, 0.05] is", "must be within two spacings (0.002 m)"});
  expect(file.write([](double x, double y, int g) { return row(1e3 * x, 1e3 * y, 1e-6, g); }), {},
         {"particles are 1 m from their nearest neighbours, \"spacing\" is 0.001", "1000 times the spacing", "in mm"});
  expect(file.write([](double x, double y, int g) { return row(x, y, 1e-6, g); }, 1.0), {},
         {"particles are 0.001 m from their nearest", "\"spacing\" is 1", "the spacing is about 1000 times"});
  expect(file.write([](double x, double y, int g) { return row(x, y, 1.0, g); }), {},
         {"volumes are 9.998e+05 times the area", "about spacing^2 = 1e-06", "in mm^2"});
  expect(file.write([](double x, double y, int g) { return row(x, y, 1e-8, g); }), {},
         {"volumes are 0.009998 times the area", "multiplied by the thickness"});
  expect(file.write([](double x, double y, int g) {
    return row(x, y, 1e-6, g) + (x < 4e-3 && y < 1e-3 ? row(x, y, 1e-6, g) : "");
  }),
         {}, {"8 particles lie on others: particle 0 at [0.0005, 0.0005] of boundary \"left\" is 0 m from particle 1"});
  expect(file.write(
             [](double x, double y, int g) { return row(x > 5e-3 || x < 4.5e-3 || y > 1e-3 ? x : -0.1, y, 1e-6, g); }),
         {}, {"1 particles have no neighbours: particle", "at [-0.1, 0.0005]"});
  expect(file.write([](double x, double y, int g) { return row(g == 1 ? x + 0.01 : x, y, 1e-6, g); }), {},
         {"boundaries[1] = \"right\" touches nothing"});
}

}  // namespace
