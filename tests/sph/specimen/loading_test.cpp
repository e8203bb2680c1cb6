// How a scene says over time what drives its boundaries.
#include "fpz/specimen/loading.hpp"

#include <gtest/gtest.h>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/specimen.hpp"

namespace {

using namespace fpz::specimen;
using DriveKind = fpz::sph::Drive::Kind;

const std::filesystem::path scenes = std::filesystem::path(FPZ_DATA_DIR) / "scenes";

/// The beam with its top driven in another way: members of the boundary as JSON.
std::string top(const std::string& drive) {
  return R"(boundaries[0]={"name": "top", "at": [0.0, 0.08], "direction": [0, 1], "width": 0.008)" +
         (drive.empty() ? "" : ", " + drive) + "}";
}

std::string complaint(const std::string& drive) {
  try {
    (void)read_scene(scenes / "beam_3pb.json", {top(drive)});
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
  return "";
}

TEST(LoadingOfScenes, QuantitiesOverTimeAreReadInEveryForm) {
  const Scene s =
      read_scene(scenes / "beam_3pb.json",
                 {top(R"("velocity": {"x": 0}, "force": {"y": {"table": [[0, 0], [1, -8], [2, 0]], "cycles": 3}})")});
  const Actuations& drive = s.boundaries[0].drive;
  ASSERT_TRUE(drive[0] && drive[1]);
  EXPECT_EQ(drive[0]->kind, DriveKind::velocity);
  EXPECT_EQ(drive[1]->kind, DriveKind::force);
  const fpz::sph::TimeTable& t = drive[1]->course.table;
  EXPECT_EQ(t.time, (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(t.value, (std::vector<double>{0, -8, 0, -8, 0, -8, 0}));
  // Forces are for the whole thickness here, per metre in the engine; so is the machine.
  const Specimen specimen = make_specimen(s);
  EXPECT_DOUBLE_EQ(specimen.setup.groups[0].drive[1]->table.at(0.5), -4.0 / 0.04);
  const Scene machine = read_scene(scenes / "beam_3pb.json", {top(R"("displacement": {"y": {"value": -1e-4, "ramp": 2}},
      "machine_stiffness": {"y": 4e6})")});
  const fpz::sph::Drive d = *make_specimen(machine).setup.groups[0].drive[1];
  EXPECT_EQ(d.kind, DriveKind::displacement);
  EXPECT_DOUBLE_EQ(d.machine_stiffness, 1e8);
  EXPECT_DOUBLE_EQ(d.table.at(1.0), -0.5e-4);
}

TEST(LoadingOfScenes, TheyGoOnFromWhatIsThere) {
  TimeCourse c;
  c.value = 5.0, c.ramp = 2.0;
  EXPECT_DOUBLE_EQ(c.starting(10.0, 3.0).at(11.0), 4.0);
  EXPECT_DOUBLE_EQ(c.starting(10.0, 3.0).at(12.0), 5.0);
  c.form = TimeCourse::Form::hold;
  EXPECT_DOUBLE_EQ(c.starting(10.0, 3.0).at(20.0), 3.0);
  const Actuation force{DriveKind::force, c, 0.0};
  EXPECT_DOUBLE_EQ(force.starting(0.0, 1.0, 8.0, 0.5).table.at(0.0), 16.0);
}

TEST(LoadingOfScenes, WhatIsWrongIsNamed) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "boundaries[0]: needs \"velocity\", \"displacement\" or \"force\""},
      {R"("force": {"y": -100})", "boundaries[0].force.y: would act at once and shake the specimen"},
      {R"("force": {"y": {"value": -100}})", "boundaries[0].force.y: needs a \"ramp\" (s) above 0"},
      {R"("force": {"y": {"speed": -100, "ramp": 1}})", "unknown key \"speed\""},
      {R"("velocity": {"y": {"value": -100, "ramp": 1}})", "unknown key \"value\""},
      {R"("force": {"y": {"table": [[0, -1], [1, -2]]}})", "the table begins with [0, 0]"},
      {R"("displacement": {"y": {"table": [[0, 1e-6], [1, 0]]}})", "its table begins with [0, 0]"},
      {R"("force": {"y": {"table": [[0, 0], [2, -1], [1, -2]]}})", "boundaries[0].force.y.table[2]: times must ascend"},
      {R"("force": {"y": {"table": [[0.5, 0], [2, -1]]}})", "the first time of a table is 0"},
      {R"("force": {"y": {"table": [[0, 0]]}})", "at least two rows"},
      {R"("force": {"y": {"table": [[0, 0], [1, -5]], "cycles": 2}})", "must end with the value with which it begins"},
      {R"("force": {"y": "keep"})", "or \"hold\", found the string \"keep\""},
      {R"("force": {"y": true})", "a number, {\"value\", \"ramp\"}, {\"table\": [[time, value], ...]} or \"hold\""},
      {R"("force": {"y": 0}, "velocity": {"y": 0})", "this component is driven twice"},
      {R"("force": {"y": 0}, "machine_stiffness": {"y": 1e8})", "has no velocity or displacement that a machine"},
      {R"("velocity": {"y": 0}, "machine_stiffness": {"y": 0})", "boundaries[0].machine_stiffness.y: 0: must be > 0"},
      {R"("forces": {"y": 0})", "unknown key \"forces\"; did you mean \"force\"?"}};
  for (const auto& [drive, expected] : cases) {
    EXPECT_NE(complaint(drive).find(expected), std::string::npos) << drive << "\n" << complaint(drive);
  }
}

}  // namespace
