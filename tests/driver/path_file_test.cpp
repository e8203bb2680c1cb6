// Path and material files: what is read, and what is said about bad ones.
#include "fpz/driver/path_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "fpz/driver/history.hpp"
#include "fpz/io/material_file.hpp"

namespace fpz::driver {
namespace {

using PathTest = fpz::driver::Test;  // inside a test body, Test is GoogleTest's

const std::filesystem::path origin = FPZ_DATA_DIR "/paths/x.json";

/// One test; `rest` replaces or adds to the keys below, which stand in one line.
std::string with_stages(const std::string& stages, const std::string& setting = "plane_strain") {
  return R"({"material": "../materials/johnstone.json", "rve_length": 0.004, "setting": ")" + setting +
         R"(", "integrator": {"name": "accurate", "tolerance": 1e-6}, "stages": )" + stages + '}';
}

std::string with_stage(const std::string& stage, const std::string& setting = "plane_strain") {
  return with_stages('[' + stage + ']', setting);
}

std::string with_integrator(const std::string& integrator, const std::string& setting = "plane_strain") {
  return R"({"material": {"file": "../materials/johnstone.json", "cohesive_zone": "published"}, "rve_length": 0.004, "setting": ")" +
         setting + R"(", "integrator": )" + integrator + R"(, "stages": [{"increments": 1, "strain": {"xx": 1e-3}}]})";
}

/// A material in line 2, with `replaced` in place of the value of `key`.
std::string with_material_value(const std::string& key, const std::string& replaced) {
  std::string text = "{\"material\": {\n";
  const std::vector<std::pair<std::string, std::string>> values = {
      {"young_modulus", "0.4e9"},    {"poisson_ratio", "0.25"}, {"density", "1540"},
      {"tensile_strength", "0.6e6"}, {"cohesion", "1e6"},       {"friction_angle_deg", "33"},
      {"dilation_angle_deg", "4"},   {"delta0", "18e-6"},       {"normal_stiffness", "1e13"},
      {"shear_stiffness", "1e11"}};
  const char* comma = "";
  for (const auto& [name, value] : values) {
    const std::string& given = name == key ? replaced : value;
    if (given.empty()) continue;
    text += comma + ('"' + name + "\": ") + given;
    comma = ", ";
  }
  return text + R"(},
"rve_length": 0.004, "setting": "plane_strain", "integrator": {"name": "accurate", "tolerance": 1e-6},
"stages": [{"increments": 1, "strain": {"xx": 1e-3}}]})";
}

std::string message_of(const std::string& text) {
  try {
    (void)parse_path_file(text, origin);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
}

// ---- what is read ----

TEST(PathFile, SmallestFileOfTheFormat) {
  const PathFile file = parse_path_file(R"({"material": "../materials/johnstone.json",
 "rve_length": 0.004,
 "setting": "plane_strain",
 "integrator": {"name": "accurate", "tolerance": 1e-6},
 "stages": [
  {"increments": 12000, "strain_increment": {"xx": 3e-7}},
  {"increments": 2000, "strain_increment": {"xx": 3e-7, "xy": 15e-7}}
 ]})",
                                        origin);
  ASSERT_EQ(file.tests.size(), 1u);
  const PathTest& t = file.tests[0];
  EXPECT_EQ(t.name, "x");
  EXPECT_EQ(t.material_name, "Johnstone (soft rock)");
  EXPECT_EQ(t.parameters.young_modulus, 0.4e9);
  EXPECT_EQ(t.parameters.shear_stiffness, 1.0e11);
  EXPECT_EQ(t.parameters.rve_length, 0.004);
  EXPECT_EQ(t.setting, Setting::plane_strain);
  EXPECT_EQ(t.options.method, Method::accurate);
  EXPECT_EQ(t.options.tolerance, 1e-6);
  EXPECT_EQ(t.options.scan_resolution_deg, 0.0);
  EXPECT_TRUE(t.warnings.empty());
  ASSERT_EQ(t.stages.size(), 2u);
  EXPECT_EQ(t.stages[0].increments, 12000);
  ASSERT_EQ(t.stages[1].controls.size(), 2u);
  EXPECT_EQ(t.stages[1].controls[1].component, 3);
  EXPECT_EQ(t.stages[1].controls[1].prescribed, Prescribed::strain_increment);
  EXPECT_EQ(t.stages[1].controls[1].value, 15e-7);
  EXPECT_FALSE(t.stages[1].automatic);
  EXPECT_FALSE(t.stages[1].jump.has_value());
}

TEST(PathFile, MaterialFileWithOtherValuesBesideIt) {
  const auto with = [](const std::string& material) {
    return R"({"material": )" + material + R"(, "rve_length": 0.004, "setting": "plane_strain",
 "integrator": {"name": "accurate", "tolerance": 1e-6}, "stages": [{"increments": 1, "strain": {"xx": 1e-3}}]})";
  };
  const std::string file = R"({"file": "../materials/johnstone.json")";
  const PathFile read = parse_path_file(with(file + R"(, "cohesion": 2e6, "softening": "bilinear"})"), origin);
  const PathTest& t = read.tests.at(0);
  EXPECT_EQ(t.parameters.cohesion, 2e6);
  EXPECT_EQ(t.parameters.tensile_strength, 0.6e6);
  EXPECT_EQ(to_string(t.parameters.choices.softening), "bilinear");
  EXPECT_EQ(t.material_name, "Johnstone (soft rock)");

  EXPECT_EQ(message_of(with(file + ", \"cohesion\": 3e5}")),
            origin.string() +
                ":1: material.cohesion = 3e+05: must be > tensile_strength * tan(friction_angle_deg) = "
                "389644.6");
  EXPECT_NE(message_of(with(file + ", \"cohesionn\": 2e6}")).find("did you mean \"cohesion\"?"), std::string::npos);
  EXPECT_NE(message_of(with(R"({"file": 3})")).find("material.file: expected the name of a material file"),
            std::string::npos);
  EXPECT_NE(message_of(with(R"({"file": "none.json"})")).find("cannot read material file"), std::string::npos);
}

TEST(PathFile, ThePaperAlgorithmIsForThePublishedZone) {
  const std::string message = message_of(R"({"material": "../materials/johnstone.json", "rve_length": 0.004,
 "setting": "plane_strain", "integrator": {"name": "paper", "tolerance": 1e-4},
 "stages": [{"increments": 1, "strain": {"xx": 1e-3}}]})");
  EXPECT_NE(message.find("x.json:2: integrator: paper integrates the published zone only"), std::string::npos)
      << message;
}

TEST(PathFile, EveryKeyOfAStage) {
  const PathFile file = parse_path_file(with_stages(R"([
    {"name": "a", "automatic": {"tolerance": 1e-3, "increments": 10}, "strain": {"xx": 1e-3}, "stress": {"yy": -1e5},
     "stop": {"D": 0.9, "sig_xx": 0.0}},
    {"increments": 5, "strain_increment": {"xx": 1e-6}, "jump_control": {"increment": 2e-8}},
    {"increments": 5, "strain": {"xx": 1e-3},
     "constraints": [{"strain": {"xx": 1, "yy": 2}, "stress": {"yy": 1e-9}, "value": 4e-3}]}])"),
                                        origin);
  const std::vector<Stage>& s = file.tests.at(0).stages;
  ASSERT_EQ(s.size(), 3u);
  EXPECT_EQ(s[0].name, "a");
  EXPECT_TRUE(s[0].automatic);
  EXPECT_EQ(s[0].step_tolerance, 1e-3);
  EXPECT_EQ(s[0].increments, 10);
  ASSERT_EQ(s[0].controls.size(), 2u);
  EXPECT_EQ(s[0].controls[1].prescribed, Prescribed::stress);
  EXPECT_EQ(s[0].controls[1].component, 1);
  ASSERT_EQ(s[0].stop.size(), 2u);
  EXPECT_EQ(s[0].stop[1].quantity, "sig_xx");
  ASSERT_TRUE(s[1].jump.has_value());
  EXPECT_EQ(s[1].jump->increment, 2e-8);
  ASSERT_EQ(s[2].constraints.size(), 1u);
  EXPECT_EQ(s[2].constraints[0].strain[1], 2.0);
  EXPECT_EQ(s[2].constraints[0].stress[1], 1e-9);
  EXPECT_EQ(s[2].constraints[0].value, 4e-3);
}

TEST(PathFile, EveryKeyOfAnIntegrator) {
  const Options a = parse_path_file(with_integrator(R"({"name": "paper", "tolerance": 1e-4, "max_iterations": 7,
      "max_substeps": 8, "onset": {"scan_degrees": 0.5}, "preferred_normal": [3, -4]})"),
                                    origin)
                        .tests.at(0)
                        .options;
  EXPECT_EQ(a.method, Method::paper);
  EXPECT_EQ(a.max_iterations, 7);
  EXPECT_EQ(a.max_substeps, 8);
  EXPECT_EQ(a.scan_resolution_deg, 0.5);
  EXPECT_DOUBLE_EQ(a.preferred_normal[0], 0.6);
  EXPECT_DOUBLE_EQ(a.preferred_normal[1], -0.8);
  EXPECT_EQ(a.preferred_normal[2], 0.0);
  const std::string implicit = R"({"name": "implicit", "onset": "closed_form"})";
  const Options b = parse_path_file(with_integrator(implicit, "plane_stress"), origin).tests.at(0).options;
  EXPECT_EQ(b.method, Method::implicit);
  EXPECT_EQ(b.scan_resolution_deg, 0.0);
}

TEST(PathFile, AllComponentsIn3d) {
  const std::string stage =
      R"({"increments": 1, "strain": {"xx": 1, "yy": 2, "zz": 3}, "stress": {"xy": 4, "xz": 5, "yz": 6}})";
  const PathTest t = parse_path_file(with_stage(stage, "3d"), origin).tests.at(0);
  ASSERT_EQ(t.stages.at(0).controls.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    const ComponentControl& c = t.stages[0].controls[static_cast<std::size_t>(k)];
    EXPECT_EQ(c.component, k);
    EXPECT_EQ(c.value, k + 1.0);
  }
}

TEST(PathFile, TestsInheritTheKeysTheyDoNotGive) {
  const PathFile file = parse_path_file(R"({"name": "base", "material": "../materials/johnstone.json",
    "rve_length": 0.004, "setting": "plane_strain", "integrator": {"name": "accurate", "tolerance": 1e-6},
    "description": "for all", "stages": [{"increments": 3, "strain": {"xx": 1e-3}}],
    "tests": [{"description": "first"}, {"name": "other", "rve_length": 0.002, "setting": "plane_stress"},
              {"stages": [{"increments": 4, "strain": {"yy": 1e-3}}], "integrator": {"name": "implicit"}}]})",
                                        origin);
  ASSERT_EQ(file.tests.size(), 3u);
  EXPECT_EQ(file.tests[0].name, "base_1");
  EXPECT_EQ(file.tests[0].description, "first");
  EXPECT_EQ(file.tests[1].description, "for all");
  EXPECT_EQ(file.tests[1].name, "other");
  EXPECT_EQ(file.tests[1].parameters.rve_length, 0.002);
  EXPECT_EQ(file.tests[1].setting, Setting::plane_stress);
  EXPECT_EQ(file.tests[1].stages.at(0).increments, 3);
  EXPECT_EQ(file.tests[2].name, "base_3");
  EXPECT_EQ(file.tests[2].stages.at(0).increments, 4);
  EXPECT_EQ(file.tests[2].options.method, Method::implicit);
  EXPECT_EQ(file.tests[2].parameters.rve_length, 0.004);
}

TEST(PathFile, RepetitionsAreExpandedInOrder) {
  const PathTest t = parse_path_file(with_stages(R"([{"increments": 1, "strain": {"xx": 0}},
    {"repeat": 2, "name": "cycles", "stages": [
      {"increments": 2, "strain": {"xx": 0}},
      {"repeat": 3, "stages": [{"increments": 3, "strain": {"xx": 0}}]}]}])"),
                                     origin)
                         .tests.at(0);
  std::vector<int> increments;
  for (const Stage& s : t.stages) increments.push_back(s.increments);
  EXPECT_EQ(increments, (std::vector<int>{1, 2, 3, 3, 3, 2, 3, 3, 3}));
}

TEST(PathFile, NumbersAreReadAsStrtodReadsThem) {
  for (const char* text :
       {"1.0e-3", "1e-3", "3e-7", "15e-7", "0.1", "-0", "-0.0", "0", "9007199254740993", "18446744073709551616",
        "-9223372036854775809", "1.7976931348623157e308", "4.9406564584124654e-324", "2.2250738585072011e-308", "1E+2",
        "0.1000000000000000055511151231257827021181583404541015625", "123456789012345678901234567890e-30"}) {
    const PathTest t =
        parse_path_file(with_stage(R"({"increments": 1, "strain": {"xx": )" + std::string(text) + "}}"), origin)
            .tests.at(0);
    const double expected = std::strtod(text, nullptr);
    const double x = t.stages.at(0).controls.at(0).value;
    EXPECT_EQ(x, expected) << text;
    EXPECT_EQ(std::signbit(x), std::signbit(expected)) << text;
  }
}

TEST(PathFile, DoubtfulValuesWarnWithTheirPlace) {
  const std::string text =
      "{\"material\": \"../materials/johnstone.json\",\n\"rve_length\": 0.02,\n" +
      with_stage(R"({"increments": 1, "strain": {"xx": 1e-3}})")
          .substr(std::string(R"({"material": "../materials/johnstone.json", "rve_length": 0.004, )").size());
  const PathTest t = parse_path_file(text, origin).tests.at(0);
  ASSERT_EQ(t.warnings.size(), 1u);
  EXPECT_NE(t.warnings[0].find("x.json:2: rve_length = 0.02: should be < "), std::string::npos) << t.warnings[0];
}

/// A number that is far off and would be usual in another unit is refused; others are doubtful only.
TEST(PathFile, ValuesInOtherUnitsAreNamed) {
  const auto said = [](const std::string& key, const std::string& value) {
    try {
      const PathTest t = parse_path_file(with_material_value(key, value), origin).tests.at(0);
      std::string all;
      for (const std::string& w : t.warnings) all += "warning: " + w + "\n";
      return all;
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  const std::array<std::array<const char*, 3>, 5> slips = {
      {{"young_modulus", "45", "material.young_modulus = 45 Pa is far below any"},
       {"tensile_strength", "0.6", "0.6 MPa was probably meant: write 6e+05"},
       {"delta0", "18", "18 um was probably meant: write 1.8e-05"},
       {"density", "1.54", "1.54 g/cm3 was probably meant: write 1540"},
       {"friction_angle_deg", "0.576", "0.576 rad was probably meant: write 33"}}};
  for (const auto& [key, value, expected] : slips) {
    const std::string text = said(key, value);
    EXPECT_NE(text.find("x.json:"), std::string::npos) << text;
    EXPECT_NE(text.find(std::string("material.") + key + " = " + value), std::string::npos) << text;
    EXPECT_NE(text.find(expected), std::string::npos) << text;
    EXPECT_NE(text.find("warning: "), 0u) << text;
  }
  EXPECT_NE(said("young_modulus", "2e11").find("warning: "), std::string::npos);
}

TEST(PathFile, MaterialMayCarryKeysForOtherPrograms) {
  const std::string text = with_material_value(
      "shear_stiffness",
      R"(1e11, "name": "rock", "source": "s", "units": "SI", "notes": "n", "x_mine": [1], "provenance": {"cost": 1})");
  EXPECT_EQ(parse_path_file(text, origin).tests.at(0).material_name, "rock");
}

TEST(PathFile, AStopMayNameEveryNumericColumnOfTheHistory) {
  for (const Column& c : columns()) {
    const std::string stage =
        R"({"increments": 1, "strain": {"xx": 1}, "stop": {")" + std::string(c.name) + R"(": 0.5}})";
    if (c.get != nullptr) {
      EXPECT_EQ(parse_path_file(with_stage(stage), origin).tests.at(0).stages.at(0).stop.at(0).quantity, c.name);
    } else {
      EXPECT_THROW((void)parse_path_file(with_stage(stage), origin), InputError) << c.name;
    }
  }
}

TEST(PathFile, FilesOfTheRepositoryAreValid) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FPZ_DATA_DIR "/paths")) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    EXPECT_NO_THROW((void)read_path_file(entry.path())) << entry.path();
  }
  EXPECT_GE(count, 9u);
  const PathTest t = read_path_file(FPZ_DATA_DIR "/paths/four_stage.json").tests.at(0);
  int total = 0;
  for (const Stage& s : t.stages) total += s.increments;
  EXPECT_EQ(total, 12000 + 2000 + 300 + 1300);
}

TEST(MaterialFile, IsReadByItself) {
  std::string name;
  const Parameters p = io::read_material_file(FPZ_DATA_DIR "/materials/marble.json", &name);
  EXPECT_EQ(name, "Marble of the Brazilian ring tests");
  EXPECT_EQ(p.delta0, 8.5e-6);
  EXPECT_EQ(p.rve_length, 0.0);
  EXPECT_THROW((void)io::read_material_file(FPZ_DATA_DIR "/materials/none.json"), InputError);
  EXPECT_THROW((void)io::read_material_file(FPZ_DATA_DIR "/paths/four_stage.json"), InputError);
}

// ---- what is refused ----

struct Bad {
  const char* what;  ///< name of the case
  std::string text;
  std::vector<std::string> fragments;  ///< all must be in the message
};

void PrintTo(const Bad& bad, std::ostream* stream) { *stream << bad.what; }

class BadPathFile : public ::testing::TestWithParam<Bad> {};

TEST_P(BadPathFile, IsRefusedWithPlaceAndReason) {
  const std::string message = message_of(GetParam().text);
  ASSERT_FALSE(message.empty()) << "accepted: " << GetParam().text;
  EXPECT_EQ(message.rfind(origin.string() + ':', 0), 0u) << message;
  for (const std::string& f : GetParam().fragments) {
    EXPECT_NE(message.find(f), std::string::npos) << "missing: " << f << "\nin: " << message;
  }
}

std::string nested(std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); }

std::vector<Bad> bad_syntax() {
  const auto value = [](const std::string& v) { return "{\"rve_length\":\n  " + v + "}"; };
  return {
      {"Empty", "", {"x.json:1: the file is empty"}},
      {"Blank", " \n ", {"the file is empty"}},
      {"NotAnObject", "[1]", {"x.json:1: expected an object", "found an array"}},
      {"EmptyObject", "{}", {"the object is empty"}},
      {"Truncated", "{\"name\": \"a\",\n\"stages\": [", {"x.json:2: column 12: the text ends too early"}},
      {"NaN", value("NaN"), {"x.json:2: column 3: \"NaN\" is not a JSON number; NaN and infinity"}},
      {"LowerNan", value("nan"), {"NaN and infinity are not allowed"}},
      {"Infinity", value("-Infinity"), {"x.json:2: column 3: \"-Infinity\"", "NaN and infinity are not allowed"}},
      {"Overflow", value("1e999"), {"x.json:2: column 3: the number 1e999 is too large for a double"}},
      {"OverflowLast", "1e999", {"x.json:1: column 1: the number 1e999 is too large"}},
      {"Comment", "{\n// a remark\n}", {"x.json:2: column 1: comments are not allowed"}},
      {"BlockComment", "{/* a */}", {"x.json:1: column 2: comments are not allowed"}},
      {"HashComment", "{\n# a\n}", {"x.json:2: column 1: comments are not allowed"}},
      {"TrailingComma", value("1,"), {"x.json:2: ", "a comma before the closing bracket"}},
      {"SingleQuotes", "{'name': 1}", {"double quotes"}},
      {"BareKey", "{name: 1}", {"\"name\" is not a JSON value; strings and keys are written in double quotes"}},
      {"Plus", value("+1"), {"leading '+'"}},
      {"PointFirst", value(".5"), {"no digit before its decimal point"}},
      {"PointLast", value("1."), {"\"1.\" is not a JSON number"}},
      {"LeadingZero", value("01"), {"leading zero"}},
      {"Hexadecimal", value("0x1p3"), {"0x1p3"}},
      {"DecimalComma", value("0,004"), {"x.json:2: column "}},
      {"SecondValue", "{} {}", {"expected end of input"}},
      {"RawNewline", "{\"name\": \"a\nb\"}", {"control character"}},
      {"NotUtf8", "{\"name\": \"\xff\"}", {"UTF-8"}},
      {"DepthBomb", nested(100000), {"nested deeper than 64"}},
      {"DuplicateKey", "{\"name\": \"a\",\n\"name\": \"b\"}", {"x.json:2: key \"name\" given twice, first in line 1"}},
  };
}

std::vector<Bad> bad_tests() {
  const std::string good = with_stage(R"({"increments": 1, "strain": {"xx": 1}})");
  const auto extra = [&](const std::string& keys) { return good.substr(0, good.size() - 1) + ",\n" + keys + '}'; };
  return {
      {"MissingAll",
       R"({"name": "a"})",
       {"missing key \"material\"", "missing key \"rve_length\"", "missing key \"setting\"",
        "missing key \"integrator\"", "missing key \"stages\""}},
      {"UnknownKey",
       extra(R"("intergrator": 1)"),
       {"x.json:2: intergrator: unknown key \"intergrator\"; did you mean \"integrator\"? (valid: name, "}},
      {"UnknownFarKey", extra(R"("qqqqqq": 1)"), {"unknown key \"qqqqqq\" (valid: name"}},
      {"EmptyName", extra(R"("name": "")"), {"x.json:2: name: the string is empty"}},
      {"NumberName", extra(R"("name": 3)"), {"name: expected a string, found the number 3"}},
      {"Setting",
       with_stage(R"({"increments": 1, "strain": {"xx": 1}})", "plane strain"),
       {"setting: unknown setting \"plane strain\"; did you mean \"plane_strain\"? (valid: plane_strain, plane_stress, "
        "3d)"}},
      {"RveLengthString",
       R"({"rve_length": "4e-3"})",
       {"rve_length: expected a number, found the string \"4e-3\": write it without quotes"}},
      {"RveLengthNaNString", R"({"rve_length": "NaN"})", {"NaN and infinity are not allowed"}},
      {"RveLengthNegative", R"({"rve_length": -4e-3})", {"rve_length: -4e-3: must be > 0"}},
      {"RveLengthNull", R"({"rve_length": null})", {"rve_length: expected a number, found null"}},
      {"RveLengthBool", R"({"rve_length": true})", {"rve_length: expected a number, found true"}},
      {"EmptyTests", extra(R"("tests": [])"), {"tests: the array is empty"}},
      {"TestNotObject", extra(R"("tests": [1])"), {"tests[0]: expected an object"}},
      {"NestedTests", extra(R"("tests": [{"name": "a", "tests": []}])"), {"tests[0].tests: unknown key \"tests\""}},
      {"SameName", extra(R"("tests": [{"name": "a"}, {"name": "A"}])"), {"tests[1]: two tests with the name \"A\""}},
      {"UnusedKey",
       extra(R"("tests": [{"name": "a", "rve_length": 1e-3}])"),
       {"x.json:1: rve_length: is not used: every test has its own"}},
      {"InTest",
       extra(R"("tests": [{"stages": [{"increments": 1, "strain": {"q": 1}}]}])"),
       {"x.json:2: tests[0].stages[0].strain.q: unknown component \"q\""}},
  };
}

std::vector<Bad> bad_materials() {
  return {
      {"MaterialFileMissing",
       R"({"material": "../materials/jonstone.json"})",
       {"material: cannot read material file", "materials/jonstone.json\": No such file or directory"}},
      {"MaterialFolder", R"({"material": "../materials"})", {"material: cannot read material file", "is a directory"}},
      {"MaterialDevice", R"({"material": "/dev/zero"})", {"is not a regular file"}},
      {"MaterialZeroCharacter", R"({"material": "a\u0000b"})", {"zero character"}},
      {"MaterialNumber", R"({"material": 3})", {"material: expected an object", "found the number 3"}},
      {"MaterialMissingKey", with_material_value("cohesion", ""), {"x.json:1: material: missing key \"cohesion\""}},
      {"MaterialUnknownKey",
       with_material_value("delta0", "18e-6, \"fricton_angle\": 3"),
       {"x.json:2: material.fricton_angle: unknown key", "did you mean \"friction_angle_deg\"?"}},
      {"MaterialUnitInKey", with_material_value("delta0", "18e-6, \"delta0_um\": 3"), {"did you mean \"delta0\"?"}},
      {"MaterialString",
       with_material_value("delta0", "\"18e-6\""),
       {"x.json:2: material.delta0: expected a number, found the string \"18e-6\": write it without quotes"}},
      {"MaterialNotes", with_material_value("delta0", "18e-6, \"notes\": 3"), {"material.notes: expected a string"}},
      {"MaterialProvenance", with_material_value("delta0", "18e-6, \"provenance\": 3"), {"expected an object"}},
      {"MaterialConstraint",
       with_material_value("cohesion", "0.3e6"),
       {"x.json:2: material.cohesion = 3e+05: must be > tensile_strength * tan(friction_angle_deg) = 3896"}},
      {"MaterialPoisson", with_material_value("poisson_ratio", "0.5"), {"material.poisson_ratio = 0.5: must be > -1"}},
  };
}

std::vector<Bad> bad_integrators() {
  return {
      {"IntegratorString", with_integrator("\"accurate\""), {"integrator: expected an object"}},
      {"IntegratorName",
       with_integrator(R"({"name": "acurate", "tolerance": 1e-6})"),
       {"integrator.name: unknown integrator \"acurate\"; did you mean \"accurate\"?"}},
      {"IntegratorNoName", with_integrator(R"({"tolerance": 1e-6})"), {"integrator: missing key \"name\""}},
      {"IntegratorNoTolerance", with_integrator(R"({"name": "paper"})"), {"integrator: missing key \"tolerance\""}},
      {"IntegratorKey",
       with_integrator(R"({"name": "implicit", "max_iteration": 3})"),
       {"integrator.max_iteration: unknown key", "did you mean \"max_iterations\"?"}},
      {"Tolerance", with_integrator(R"({"name": "paper", "tolerance": 0})"), {"tolerance: 0: must be > 0 and < 1"}},
      {"Iterations", with_integrator(R"({"name": "implicit", "max_iterations": 1.5})"), {"must be a whole number"}},
      {"Onset",
       with_integrator(R"({"name": "implicit", "onset": "closedform"})"),
       {"unknown onset", "did you mean \"closed_form\"?", "scan_degrees"}},
      {"OnsetNumber", with_integrator(R"({"name": "implicit", "onset": 1})"), {"onset: expected \"closed_form\" or"}},
      {"OnsetKey",
       with_integrator(R"({"name": "implicit", "onset": {"scan_degree": 1}})"),
       {"did you mean \"scan_degrees\"?", "onset: missing key \"scan_degrees\""}},
      {"OnsetRange", with_integrator(R"({"name": "implicit", "onset": {"scan_degrees": 90}})"), {"must be >= 0.01"}},
      {"Normal3In2d",
       with_integrator(R"({"name": "implicit", "preferred_normal": [1, 0, 0]})"),
       {"preferred_normal: has 3 components; needs 2 in plane_strain"}},
      {"Normal2In3d", with_integrator(R"({"name": "implicit", "preferred_normal": [1, 0]})", "3d"), {"needs 3 in 3d"}},
      {"NormalZero", with_integrator(R"({"name": "implicit", "preferred_normal": [0, 0]})"), {"is zero"}},
      {"NormalString",
       with_integrator(R"({"name": "implicit", "preferred_normal": ["1", 0]})"),
       {"preferred_normal[0]: expected a number"}},
  };
}

std::vector<Bad> bad_stages() {
  const std::string nested_repeat =
      R"({"repeat": 1000000, "stages": [{"repeat": 1000000, "stages": [{"increments": 1, "strain": {"xx": 1}}]}]})";
  return {
      {"NoStages", with_stages("[]"), {"stages: the array is empty"}},
      {"StagesObject", with_stages("{}"), {"stages: expected an array of stages, found an object"}},
      {"EmptyStage", with_stage("{}"), {"stages[0]: the object is empty"}},
      {"StageKey",
       with_stage(R"({"incremnts": 1, "strain": {"xx": 1}})"),
       {"stages[0].incremnts: unknown key \"incremnts\"; did you mean \"increments\"?", "missing key \"increments\""}},
      {"StressKey", with_stage(R"({"increments": 1, "stres": {"xx": 1}})"), {"did you mean \"stress\"?"}},
      {"ZeroIncrements", with_stage(R"({"increments": 0, "strain": {"xx": 1}})"), {"increments: 0: must be >= 1"}},
      {"NegativeIncrements", with_stage(R"({"increments": -5, "strain": {"xx": 1}})"), {"-5: must be >= 1"}},
      {"HalfIncrement", with_stage(R"({"increments": 1.5, "strain": {"xx": 1}})"), {"must be a whole number"}},
      {"HugeIncrements", with_stage(R"({"increments": 1e300, "strain": {"xx": 1}})"), {"1e300: must be >= 1 and <="}},
      {"StringIncrements", with_stage(R"({"increments": "12", "strain": {"xx": 1}})"), {"write it without quotes"}},
      {"BothSteppings",
       with_stage(R"({"increments": 1, "automatic": {"tolerance": 0.1}, "strain": {"xx": 1}})"),
       {"exclude each other"}},
      {"AutomaticEmpty", with_stage(R"({"automatic": {}, "strain": {"xx": 1}})"), {"automatic: the object is empty"}},
      {"AutomaticTrue", with_stage(R"({"automatic": true, "strain": {"xx": 1}})"), {"automatic: expected an object"}},
      {"AutomaticTolerance", with_stage(R"({"automatic": {"tolerance": 2}, "strain": {"xx": 1}})"), {"< 1"}},
      {"NothingControlled", with_stage(R"({"increments": 1})"), {"stages[0]: nothing is controlled"}},
      {"EmptyControl", with_stage(R"({"increments": 1, "strain": {}})"), {"strain: the object is empty"}},
      {"ControlNumber", with_stage(R"({"increments": 1, "strain": 1e-3})"), {"strain: expected an object"}},
      {"Component",
       with_stage(R"({"increments": 1, "strain_increment": {"xq": 1}})"),
       {"stages[0].strain_increment.xq: unknown component \"xq\"; did you mean \"xx\"? (valid: xx, yy, xy)"}},
      {"SwappedComponent", with_stage(R"({"increments": 1, "strain": {"yx": 1}})"), {"did you mean \"xy\"?"}},
      {"UpperComponent", with_stage(R"({"increments": 1, "strain": {"YY": 1}})"), {"did you mean \"yy\"?"}},
      {"ZzPlaneStrain",
       with_stage(R"({"increments": 1, "strain": {"zz": 1}})"),
       {"\"zz\" cannot be controlled in plane_strain, where eps_zz"}},
      {"ZzPlaneStress", with_stage(R"({"increments": 1, "stress": {"zz": 1}})", "plane_stress"), {"sig_zz"}},
      {"XzPlane", with_stage(R"({"increments": 1, "strain": {"xz": 1}})"), {"cannot be controlled in plane_strain"}},
      {"ControlledTwice",
       with_stage(R"({"increments": 1, "strain": {"xx": 1}, "stress": {"xx": 1}})"),
       {"stages[0].stress.xx: component \"xx\" is already controlled by \"strain\""}},
      {"ControlString",
       with_stage(R"({"increments": 1, "strain": {"xx": "1e-3"}})"),
       {"stages[0].strain.xx: expected a number, found the string \"1e-3\": write it without quotes"}},
      {"StopKey",
       with_stage(R"({"increments": 1, "strain": {"xx": 1}, "stop": {"sigxx": 1}})"),
       {"stop.sigxx: unknown quantity \"sigxx\"; did you mean \"sig_xx\"?"}},
      {"StopDamage",
       with_stage(R"({"increments": 1, "strain": {"xx": 1}, "stop": {"D": 1}})"),
       {"must be > 0 and < 1"}},
      {"StopEmpty", with_stage(R"({"increments": 1, "strain": {"xx": 1}, "stop": {}})"), {"stop: the object is empty"}},
      {"JumpStill",
       with_stage(R"({"increments": 1, "strain_increment": {"xx": 0}, "jump_control": {"increment": 1}})"),
       {"stages[0].jump_control: needs a direction"}},
      {"JumpStress",
       with_stage(R"({"increments": 1, "stress": {"xx": 1}, "jump_control": {"increment": 1}})"),
       {"needs a direction", "excludes \"stress\""}},
      {"JumpNegative",
       with_stage(R"({"increments": 1, "strain": {"xx": 1}, "jump_control": {"increment": -1}})"),
       {"jump_control.increment: -1: must be > 0"}},
      {"JumpAutomatic",
       with_stage(R"({"automatic": {"tolerance": 0.1}, "strain": {"xx": 1}, "jump_control": {"increment": 1}})"),
       {"jump control prescribes the step"}},
      {"RepeatZero",
       with_stage(R"({"repeat": 0, "stages": [{"increments": 1, "strain": {"xx": 1}}]})"),
       {"stages[0].repeat: 0: must be >= 1"}},
      {"RepeatMissing",
       with_stage(R"({"stages": [{"increments": 1, "strain": {"xx": 1}}]})"),
       {"stages[0]: missing key \"repeat\""}},
      {"RepeatNothing", with_stage(R"({"repeat": 2, "stages": []})"), {"stages[0].stages: the array is empty"}},
      {"RepeatKey",
       with_stage(R"({"repeat": 2, "increments": 1, "stages": [{"increments": 1, "strain": {"xx": 1}}]})"),
       {"stages[0].increments: unknown key \"increments\""}},
      {"RepeatInside",
       with_stage(R"({"repeat": 2, "stages": [{"increments": 1, "strain": {"zx": 1}}]})"),
       {"stages[0].stages[0].strain.zx: unknown component"}},
      {"TooManyStages", with_stage(nested_repeat), {"stages: with repetitions the file has more than 1e+06 stages"}},
      {"TooManyIncrements",
       with_stage(R"({"repeat": 1000, "stages": [{"increments": 10000000, "strain": {"xx": 1}}]})"),
       {"more than 1e+09 increments"}},
  };
}

std::vector<Bad> bad_constraints() {
  const auto with = [](const std::string& constraints) {
    return with_stage(R"({"increments": 1, "strain": {"xx": 1}, "constraints": )" + constraints + '}');
  };
  return {
      {"ConstraintsEmpty", with("[]"), {"constraints: the array is empty"}},
      {"ConstraintNoValue", with(R"([{"strain": {"yy": 1}}])"), {"constraints[0]: missing key \"value\""}},
      {"ConstraintNoTerms", with(R"([{"value": 1}])"), {"missing key \"strain\" or \"stress\""}},
      {"ConstraintZero", with(R"([{"strain": {"yy": 0}, "value": 1}])"), {"all coefficients are zero"}},
      {"ConstraintKey", with(R"([{"strains": {"yy": 1}, "value": 1}])"), {"did you mean \"strain\"?"}},
      {"ConstraintComponent", with(R"([{"strain": {"zz": 1}, "value": 1}])"), {"constraints[0].strain.zz"}},
      {"Overdetermined", with(R"([{"strain": {"xx": 1}, "value": 1}])"), {"1 constraint for 0 free components"}},
      {"Underdetermined",
       with(R"([{"strain": {"yy": 1, "xy": 1}, "value": 1}])"),
       {"1 constraint for 2 free components (yy, xy)"}},
  };
}

std::string case_name(const ::testing::TestParamInfo<Bad>& bad) { return bad.param.what; }

INSTANTIATE_TEST_SUITE_P(Syntax, BadPathFile, ::testing::ValuesIn(bad_syntax()), case_name);
INSTANTIATE_TEST_SUITE_P(Tests, BadPathFile, ::testing::ValuesIn(bad_tests()), case_name);
INSTANTIATE_TEST_SUITE_P(Materials, BadPathFile, ::testing::ValuesIn(bad_materials()), case_name);
INSTANTIATE_TEST_SUITE_P(Integrators, BadPathFile, ::testing::ValuesIn(bad_integrators()), case_name);
INSTANTIATE_TEST_SUITE_P(Stages, BadPathFile, ::testing::ValuesIn(bad_stages()), case_name);
INSTANTIATE_TEST_SUITE_P(Constraints, BadPathFile, ::testing::ValuesIn(bad_constraints()), case_name);

TEST(PathFileProblems, AllProblemsAreReportedOncePerPlace) {
  const std::string message = message_of(R"({"material": "../materials/johnstone.json",
    "rve_length": "4e-3",
    "setting": "plane_strain", "integrator": {"name": "accurate", "tolerance": 1e-6, "order": 4},
    "stages": [{"increments": 1, "strain": {"xq": 1}},
               {"increments": 0, "strain": {"xx": 1}}],
    "tests": [{}, {"name": "b"}, {"nam": "c"}]})");
  // One in each line from 2 to 6, though three tests inherit the first four.
  EXPECT_EQ(lines(message), 5u) << message;
  EXPECT_LT(message.find(":2: "), message.find(":3: ")) << "ordered by line";
  EXPECT_LT(message.find(":4: "), message.find(":5: ")) << "ordered by line";
}

TEST(PathFileProblems, ProblemsAreBounded) {
  std::string stages = "[1";
  for (int k = 0; k < 1000; ++k) stages += ",\n1";
  const std::string message = message_of(with_stages(stages + ']'));
  EXPECT_NE(message.find("reading stopped after 100 problems"), std::string::npos) << message;
}

TEST(PathFileProblems, LongAndStrangeTextIsShortenedAndEscapedInMessages) {
  const std::string message = message_of("{\"" + std::string(100000, 'k') + "\": 1, \"a\\u001b[31m\\n\": 2}");
  EXPECT_LT(message.size(), 3000u);
  EXPECT_NE(message.find("\\x1b[31m\\x0a"), std::string::npos) << message;
}

TEST(PathFileProblems, LimitsAreKept) {
  const std::string good = with_stage(R"({"increments": 1, "strain": {"xx": 1}})");
  Limits limits;
  limits.bytes = 10;
  EXPECT_THROW((void)parse_path_file(good, origin, limits), InputError);
  limits = {};
  limits.values = 10;
  EXPECT_THROW((void)parse_path_file(good, origin, limits), InputError);
  limits = {};
  limits.tests = 1;
  const std::string two = good.substr(0, good.size() - 1) + R"(, "tests": [{"name": "a"}, {"name": "b"}]})";
  EXPECT_THROW((void)parse_path_file(two, origin, limits), InputError);
  limits = {};
  limits.stages = 1;
  EXPECT_NO_THROW((void)parse_path_file(good, origin, limits));
  EXPECT_THROW((void)parse_path_file(two, origin, limits), InputError) << "the bound is for all tests together";
}

TEST(PathFileProblems, ProblemsOfAMaterialFileNameThatFile) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "fpz_path_file_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "m.json") << "{\n\"cohesion\": \"1e6\",\n\"chesion\": 1}";
  try {
    (void)parse_path_file(R"({"material": "m.json"})", folder / "p.json");
    FAIL() << "accepted";
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_NE(message.find("m.json:2: cohesion: expected a number"), std::string::npos) << message;
    EXPECT_NE(message.find("m.json:3: chesion: unknown key \"chesion\"; did you mean \"cohesion\"?"), std::string::npos)
        << message;
    EXPECT_NE(message.find("m.json:1: missing key \"density\""), std::string::npos) << message;
  }
  std::filesystem::remove_all(folder);
}

TEST(PathFileProblems, UnreadableFilesAreNamed) {
  for (const char* name : {"/none/such.json", "/tmp"}) {
    try {
      (void)read_path_file(name);
      FAIL() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).rfind(name, 0), 0u) << e.what();
    }
  }
}

}  // namespace
}  // namespace fpz::driver
