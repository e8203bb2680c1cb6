// Specifications: what is read, and what is said about bad ones.
#include "fpz/calibration/specification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace fpz::calibration {
namespace {

const std::filesystem::path origin = FPZ_DATA_DIR "/calibration/x.json";

/// Table 1 with delta0 fitted to one mode I energy; `data` and `rest` may be replaced.
std::string with(const std::string& data, const std::string& rest = R"("fit": ["delta0"])") {
  return R"({"material": "../materials/johnstone.json", )" + rest + R"(, "data": [)" + data + "]}";
}

const std::string energy_set =
    R"({"name": "G", "kind": "fracture_energy", "mode": "I", "energy": 10.8, "deviation": {"relative": 0.05}})";

std::string beam(const std::string& columns, const std::string& rest = "") {
  return R"({"name": "b", "kind": "notched_beam",
"geometry": {"unit": "mm", "depth": 50, "thickness": 50, "span": 125, "notch": 25},
)" + columns +
         rest + '}';
}

std::string beam_values(const std::string& cmod, const std::string& load, const std::string& rest = "") {
  return beam(R"("values": {"cmod": )" + cmod + R"(, "load": )" + load + '}', rest);
}

std::string message_of(const std::string& text, const std::filesystem::path& file = origin) {
  try {
    (void)parse_specification(text, file);
  } catch (const io::InputError& e) {
    return e.what();
  }
  return "";
}

void expect_message(const std::string& text, const std::string& part) {
  const std::string message = message_of(text);
  EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in\n" << message << "\nof\n" << text;
}

TEST(Specification, Smallest) {
  const Specification s = parse_specification(with(energy_set), origin);
  EXPECT_EQ(s.name, "x");
  ASSERT_EQ(s.data.size(), 1u);
  EXPECT_EQ(s.data[0].measured[0], 10.8);
  EXPECT_DOUBLE_EQ(s.data[0].deviation[0], 0.54);
  EXPECT_TRUE(s.data[0].deviation_known);
  const ParameterSetting& delta0 = s[Parameter::delta0];
  EXPECT_TRUE(delta0.fitted);
  EXPECT_EQ(delta0.value, 18e-6);
  EXPECT_DOUBLE_EQ(delta0.lower, 18e-6 / 20);
  EXPECT_DOUBLE_EQ(delta0.upper, 18e-6 * 20);
  EXPECT_FALSE(s[Parameter::cohesion].fitted);
  EXPECT_EQ(s.density, 1540.0);
  EXPECT_EQ(s.profiles, std::vector<std::string>{"delta0"});
}

TEST(Specification, UnitsBoundsAndPriors) {
  const Specification s = parse_specification(
      with(energy_set, R"("parameters": {"tensile_strength": {"start": 0.7, "unit": "MPa", "lower": 0.2, "upper": 2,
           "prior": {"mean": 0.6, "deviation": 0.05}}, "delta0": {"value": 20, "unit": "um"}})"),
      origin);
  const ParameterSetting& t = s[Parameter::tensile_strength];
  EXPECT_TRUE(t.fitted);
  EXPECT_DOUBLE_EQ(t.value, 0.7e6);
  EXPECT_DOUBLE_EQ(t.lower, 0.2e6);
  EXPECT_DOUBLE_EQ(t.upper, 2e6);
  EXPECT_DOUBLE_EQ(t.prior->mean, 0.6e6);
  EXPECT_DOUBLE_EQ(t.prior->deviation, 0.05e6);
  EXPECT_FALSE(s[Parameter::delta0].fitted);
  EXPECT_DOUBLE_EQ(s.start().delta0, 20e-6);
  EXPECT_TRUE(s.profiles.empty());
}

TEST(Specification, EveryProblemAtOnceWithItsPlace) {
  const std::string message = message_of(
      "{\"material\": \"../materials/johnstone.json\",\n"
      "\"fit\": [\"delta\"],\n"
      "\"setting\": \"plain_strain\",\n"
      "\"options\": {\"starts\": 0},\n"
      "\"data\": [{\"name\": \"G\", \"kind\": \"fracture\"}]}");
  for (const char* part : {"x.json:2: fit[0]: unknown parameter \"delta\"; did you mean \"delta0\"?",
                           "x.json:3: setting: unknown setting \"plain_strain\"; did you mean \"plane_strain\"?",
                           "x.json:4: options.starts: 0: must be >= 1",
                           "x.json:5: data[0].kind: unknown kind \"fracture\"; did you mean \"fracture_energy\"?"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << "\nnot in\n" << message;
  }
}

TEST(Specification, Parameters) {
  const auto p = [](const std::string& entry) { return with(energy_set, "\"parameters\": {" + entry + "}"); };
  expect_message(p(R"("tensile_strength": 3.9)"),
                 "parameters.tensile_strength: tensile_strength = 3.9 Pa is far below");
  expect_message(p(R"("tensile_strength": 3.9)"), "3.9 MPa was probably meant");
  expect_message(p(R"("delta0": {"start": 18})"), "18 um was probably meant");
  expect_message(p(R"("delta0": {"start": 0.018})"), "0.018 mm was probably meant");
  expect_message(p(R"("young_modulus": {"value": 37, "unit": "GP"})"), "unknown unit \"GP\"; did you mean \"GPa\"?");
  expect_message(p(R"("delta0": {"value": 18e-6, "lower": 1e-6})"), "has no effect on a fixed parameter");
  expect_message(p(R"("delta0": {"value": 18e-6, "start": 18e-6})"), "give one of \"value\", \"start\"");
  expect_message(p(R"("delta0": {"start": 18e-6, "lower": 20e-6})"), "must lie between");
  expect_message(p(R"("delta0": {"start": 18e-6, "lower": 2e-5, "upper": 1e-5})"), "\"lower\" must be below \"upper\"");
  expect_message(p(R"("delta0": {"start": 18e-6, "prior": {"mean": 18e-6, "deviation": 0}})"), "must be > 0");
  expect_message(p(R"("density": {"start": 2000})"), "the density cannot be fitted");
  expect_message(p(R"("hardness": 3)"), "unknown key \"hardness\"");
  expect_message(p(R"("cohesion": {"from_initial_slope": "G"})"), "only young_modulus follows");
  expect_message(with(energy_set, R"("fit": ["delta0", "delta0"])"), "is named twice");
  expect_message(with(energy_set, R"("fit": ["density"])"), "no test that is evaluated here depends on the density");
  expect_message(with(energy_set, R"("name": "n")"), "nothing is to be fitted");
  // Constraints of the model among the start values.
  expect_message(p(R"("cohesion": 0.3e6, "delta0": {"start": 18e-6})"), "must be > tensile_strength * tan");
}

TEST(Specification, WithoutAMaterialEveryParameterIsNeeded) {
  expect_message(R"({"parameters": {"delta0": {"start": 18e-6}}, "data": [)" + energy_set + "]}",
                 "missing parameter \"young_modulus\", and no \"material\" to take it from");
  expect_message(R"({"material": "none.json", "fit": ["delta0"], "data": [)" + energy_set + "]}",
                 "cannot read material file");
}

TEST(Specification, DataSets) {
  expect_message(with(""), "the array is empty");
  expect_message(with(energy_set + ',' + energy_set), "two data sets would share the file name \"G\"");
  const auto set = [](const std::string& rest) {
    return with(R"({"name": "G", "kind": "fracture_energy", )" + rest + "}");
  };
  expect_message(set(R"("mode": "I", "energy": 10)"), "from a single value no scatter can be estimated");
  expect_message(set(R"("mode": "I", "energy": 10, "deviation": 0)"), "deviation: 0: must be > 0");
  expect_message(set(R"("mode": "I", "energy": 10, "deviation": {"relative": -0.1})"), "must be > 0");
  expect_message(set(R"("mode": "I", "energy": 10, "deviation": 1, "weight": 0)"),
                 "0: must be > 0; to leave a data set out of the fit use \"role\": \"predict\"");
  expect_message(set(R"("mode": "I", "energy": 10, "deviation": 1, "role": "predict")"), "at least one must be fitted");
  expect_message(set(R"("mode": "I", "energy": 10, "deviation": 1, "loss": {"kind": "hubert"})"),
                 "did you mean \"huber\"?");
  expect_message(set(R"("mode": "I", "energy": 1e-3, "deviation": 1)"), "1000 J/m2");
  expect_message(set(R"("mode": "I", "deviation": 1)"), "give either \"energy\" (J/m2) or \"toughness\"");
  expect_message(set(R"("mode": "direction", "energy": 10, "deviation": 1)"), "missing key \"angle_deg\"");
  expect_message(set(R"("mode": "I", "toughness": 2.15, "deviation": 1)"), "far below any value");
  const auto strength = [](const std::string& point) {
    return with(R"({"name": "s", "kind": "strength", "points": [)" + point + "]}");
  };
  expect_message(strength(R"({"test": "brazilian", "strength": 4e6, "deviation": 1e5})"), "unknown test \"brazilian\"");
  expect_message(strength(R"({"test": "uniaxial_compression", "strength": 60, "deviation": 1})"),
                 "60 MPa was probably meant");
  expect_message(strength(R"({"test": "brazilian_load", "strength": 8.2, "deviation": 1,
                             "diameter": 0.05, "thickness": 0.025})"),
                 "8.2 kN was probably meant");
  expect_message(strength(R"({"test": "triaxial_axial", "strength": 6e7, "deviation": 1e6})"),
                 "missing key \"pressure\"");
  expect_message(strength(R"({"test": "uniaxial_tension", "strength": 4e6})"), "missing key \"deviation\"");
}

TEST(Specification, CurvesInTheSpecification) {
  const std::string load = R"({"unit": "N", "list": [100, 300, 500, 700, 900]})";
  const std::string cmod = R"({"unit": "um", "list": [1, 2, 3, 4, 5]})";
  const Specification s = parse_specification(with(beam_values(cmod, load)), origin);
  EXPECT_EQ(s.data[0].measured.size(), 5);
  EXPECT_DOUBLE_EQ(s.data[0].abscissa[4], 5e-6);
  EXPECT_FALSE(s.data[0].deviation_known);
  expect_message(with(beam_values("[1e-6, 2e-6, 3e-6]", load)), "\"load\" has 5 values, \"cmod\" has 3");
  expect_message(with(beam_values("[1e-6]", "[100]")), "has 1 point; a curve needs at least 4");
  expect_message(with(beam_values("[1e-6, 2e-6, 2e-6, 1e-6, 5e-6]", load)),
                 "values.cmod[3]: is below the value of the row before; the rows must be sorted by cmod");
  expect_message(with(beam_values("[1, 2, 3, 4, 5]", load)), "5 um was probably meant");
  expect_message(with(beam_values(cmod, "[0.1, 0.3, 0.5, 0.7, 0.9]")), "0.9 kN was probably meant");
  expect_message(with(beam_values(cmod, "[0, 0, 0, 0, 0]")), "all measured values are zero");
  expect_message(with(beam_values(cmod, load, R"(, "range": {"from": 4, "to": 5, "unit": "um"})")),
                 "leaves 2 points of 5");
  expect_message(with(beam_values(cmod, load, R"(, "deviation": {"relative": 0.02, "value": 3})")), "give one of");
  expect_message(with(beam_values(cmod, load, R"(, "nuisance": {"offset": {}})")), "unknown key \"offset\"");
  const Specification part =
      parse_specification(with(beam_values(cmod, load, R"(, "range": {"from": 2, "unit": "um"})")), origin);
  EXPECT_EQ(part.data[0].measured.size(), 4);
  const Specification thin = parse_specification(with(beam_values(cmod, load, R"(, "thin": 4)")), origin);
  EXPECT_EQ(thin.data[0].measured.size(), 4);
  EXPECT_DOUBLE_EQ(thin.data[0].abscissa[3], 5e-6);
}

TEST(Specification, GeometryInMetresWhereMillimetresCameIn) {
  expect_message(with(R"({"name": "b", "kind": "notched_beam", "values": {"cmod": [1e-6, 2e-6, 3e-6, 4e-6],
    "load": [1, 2, 3, 4]}, "geometry": {"depth": 50, "thickness": 0.05, "span": 0.125, "notch": 0.025}})"),
                 "geometry.depth: depth = 50 m is far above any value");
  expect_message(with(R"({"name": "b", "kind": "notched_beam", "values": {"cmod": [1e-6, 2e-6, 3e-6, 4e-6],
    "load": [1, 2, 3, 4]}, "geometry": {"unit": "mm", "depth": 50, "thickness": 50, "span": 125, "notch": 60}})"),
                 "notch");
}

class SpecificationFiles : public ::testing::Test {
 protected:
  std::string message(const std::string& csv, const std::string& rest = "") {
    folder_.write("data.csv", csv);
    folder_.write("material.json", test::text_of(FPZ_DATA_DIR "/materials/johnstone.json"));
    return message_of(
        R"({"material": "material.json", "fit": ["delta0"], "data": [)" +
            beam(
                R"("file": "data.csv", "columns": {"cmod": {"column": "CMOD", "unit": "mm"}, "load": {"column": "P"}})",
                rest) +
            "]}",
        folder_.path() / "spec.json");
  }

  void expect(const std::string& csv, const std::string& part, const std::string& rest = "") {
    const std::string text = message(csv, rest);
    EXPECT_NE(text.find(part), std::string::npos) << "no \"" << part << "\" in\n" << text;
  }

  test::TemporaryFolder folder_;
};

TEST_F(SpecificationFiles, Good) { EXPECT_EQ(message("CMOD,P\n0.001,100\n0.002,200\n0.003,300\n0.004,400\n"), ""); }

TEST_F(SpecificationFiles, BadTables) {
  const std::string rows = "0.001,100\n0.002,200\n0.003,300\n0.004,400\n";
  expect("cmod,P\n" + rows, "data.csv has no column \"CMOD\"; did you mean \"cmod\"? (valid: cmod, P)");
  expect("CMOD,P\n0.001,100\n0.002,\n0.003,300\n0.004,400\n",
         "data.csv:3: column \"P\": the cell is not a finite number");
  expect("CMOD,P\n0.001,100\n\n0.002,nan\n0.003,300\n0.004,400\n",
         "data.csv:4: column \"P\": the cell is not a finite number");
  expect("CMOD,P\n0.001,100\n0.003,200\n0.002,300\n0.004,400\n",
         "data.csv:4: column \"cmod\": is below the value of the row before");
  expect("CMOD,P\n0.001,100\n", "has 1 point; a curve needs at least 4");
  expect("CMOD,P\n", "no rows");
  expect("", "no rows");
  expect("CMOD,P\n0.001,100,3\n", "data.csv:2: 3 cells, the header (line 1) has 2");
  expect("CMOD,P\n" + rows, "has no column \"s\"", R"(, "deviation": {"column": "s"})");
  expect("CMOD,P,s\n0.001,100,1\n0.002,200,0\n0.003,300,1\n0.004,400,1\n",
         "data.csv:3: column \"s\": a standard deviation must be > 0", R"(, "deviation": {"column": "s"})");
}

/// A file as a testing machine writes it, with two load cells and compression negative.
class MachineExport : public ::testing::Test {
 protected:
  MachineExport() {
    folder_.write(
        "data.csv",
        "DEU|1|2|,|.\r\nDatenerfassung:\t\tZeit: 12,5\ts\r\nWeg\tKanal 1 CMOD\tKraft\tKraft\r\nmm\tmm\tkN\tN\r\n"
        "0,1\t0,001\t-0,1\t-100\r\n0,2\t0,002\t-0,2\t-200\r\n0,3\t0,003\t-0,3\t-300\r\n0,4\t0,004\t-0,25\t-250\r\n");
    folder_.write("material.json", test::text_of(FPZ_DATA_DIR "/materials/johnstone.json"));
  }

  [[nodiscard]] static std::string text(const std::string& cmod, const std::string& load,
                                        const std::string& rest = "") {
    return R"({"material": "material.json", "fit": ["delta0"], "data": [)" +
           beam(R"("file": "data.csv", "columns": {"cmod": )" + cmod + R"(, "load": )" + load + "}", rest) + "]}";
  }
  [[nodiscard]] Specification read(const std::string& cmod, const std::string& load,
                                   const std::string& rest = "") const {
    return parse_specification(text(cmod, load, rest), folder_.path() / "spec.json");
  }
  void expect(const std::string& part, const std::string& cmod, const std::string& load,
              const std::string& rest = "") const {
    const std::string message = message_of(text(cmod, load, rest), folder_.path() / "spec.json");
    EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in\n" << message;
  }

  test::TemporaryFolder folder_;
};

TEST_F(MachineExport, IsReadWithItsOwnUnitsAndATurnedSign) {
  for (const char* cmod : {R"("Kanal 1 CMOD")", "2", R"({"column": "Kanal 1 CMOD", "unit": "mm"})"}) {
    for (const char* load : {R"({"column": 3, "scale": -1})", R"({"column": 4, "scale": -1})"}) {
      const DataSet set = read(cmod, load).data[0];
      ASSERT_EQ(set.measured.size(), 4);
      EXPECT_DOUBLE_EQ(set.abscissa[3], 4e-6);
      EXPECT_DOUBLE_EQ(set.measured[3], 250.0);
      EXPECT_EQ(set.notation.find("utf-8, 4 columns at each tab, decimal comma, names in line 3"), 0U) << set.notation;
    }
  }
}

TEST_F(MachineExport, IsRefusedWhereItIsOpenWhatIsMeant) {
  const std::string cmod = R"("Kanal 1 CMOD")";
  expect("columns 3 and 4 are both called \"Kraft\"", cmod, R"({"column": "Kraft", "scale": -1})");
  expect("give the column \"scale\": -1", cmod, "3");
  expect("did you mean \"Kanal 1 CMOD\"?", R"("CMOD")", "3");
  expect("columns.cmod", "5", "3");
  expect("must not be zero", cmod, R"({"column": 3, "scale": 0})");
  expect("\"tabs\" is not known; it must be comma, semicolon, tab, bar or space", cmod, "3",
         R"(, "separator": "tabs")");
  expect("which is not known for this quantity", cmod, "1");  // a length in place of a load
}

TEST_F(MachineExport, AStatedUnitGoesBeforeTheFilesAndIsSaid) {
  const Specification s = read("2", R"({"column": 3, "unit": "N", "scale": -1000})");
  EXPECT_DOUBLE_EQ(s.data[0].measured[0], 100.0);
  const auto said = [](const std::string& w) { return w.find("is in kN according to the file") != std::string::npos; };
  EXPECT_TRUE(std::any_of(s.warnings.begin(), s.warnings.end(), said));
}

TEST_F(SpecificationFiles, OptionsOfAFileGoWithAFile) {
  EXPECT_NE(message_of(with(beam_values("[1e-6, 2e-6, 3e-6, 4e-6]", "[1, 2, 3, 4]", R"(, "decimal": "comma")")))
                .find("\"decimal\" goes with \"file\""),
            std::string::npos);
  EXPECT_EQ(message("CMOD;P\n0,001;1.100,5\n0,002;1.200,5\n0,003;1.300,5\n0,004;1.400,5\n"), "");
  expect("CMOD;P\n1,001;1,100\n1,002;1,200\n1,003;1,300\n1,004;1,400\n", "data.csv:2: 1,001 can be 1001");
}

TEST_F(SpecificationFiles, BandsBecomeDeviations) {
  folder_.write("data.csv", "CMOD,low,high\n1,100,140\n2,200,240\n3,300,360\n4,380,420\n");
  folder_.write("material.json", test::text_of(FPZ_DATA_DIR "/materials/johnstone.json"));
  const auto spec = [&](const std::string& load) {
    return R"({"material": "material.json", "fit": ["delta0"], "data": [)" +
           beam(R"("file": "data.csv", "columns": {"cmod": {"column": "CMOD", "unit": "um"}, "load": )" + load + "}") +
           "]}";
  };
  const Specification s =
      parse_specification(spec(R"({"low": "low", "high": "high", "edges_at": 2})"), folder_.path() / "spec.json");
  EXPECT_DOUBLE_EQ(s.data[0].measured[2], 330.0);
  EXPECT_DOUBLE_EQ(s.data[0].deviation[2], 15.0);
  EXPECT_NE(message_of(spec(R"({"low": "high", "high": "low"})"), folder_.path() / "spec.json")
                .find("the upper edge of the band must be above the lower one"),
            std::string::npos);
}

/// Shipped specifications and curves in place, damaged in many ways: every one is read or refused with a message.
TEST(Specification, DamagedOnesEndInAMessage) {
  std::vector<std::string> texts;
  for (const char* name : {"table1", "two_energies", "strength"}) {
    texts.push_back(test::text_of(std::string(FPZ_DATA_DIR "/calibration/") + name + ".json"));
  }
  texts.push_back(
      with(beam_values("[1e-6, 2e-6, 3e-6, 4e-6, 5e-6]", "[100, 300, 500, 700, 900]",
                       R"(, "range": {"from": 1e-6}, "thin": 4, "nuisance": {"cmod_offset": {"unit": "um"}})")));
  const std::vector<std::string> tokens = {"{",         "}",
                                           "[",         "]",
                                           ",",         "\"",
                                           "null",      "-1",
                                           "0",         "1e308",
                                           "{}",        "[]",
                                           "\"value\"", "\"start\"",
                                           "1e-320",    "true",
                                           ":",         "\xff",
                                           "NaN",       "\"data\"",
                                           "\"fit\"",   "\"unit\": \"mm\","};
  std::mt19937 random(20261122);  // its sequence is fixed by the standard
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int refused = 0;
  for (std::size_t k = 0; k < 3000; ++k) {
    std::string text = texts[k % texts.size()];
    for (std::size_t change = 0; change <= below(3); ++change) {
      const std::size_t at = below(text.size());
      const std::size_t length = std::min(below(20), text.size() - at);
      text.replace(at, length, below(3) == 0 ? std::string() : tokens[below(tokens.size())]);
    }
    SCOPED_TRACE(text);
    try {
      (void)parse_specification(text, origin);
    } catch (const io::InputError& e) {
      ++refused;
      EXPECT_GT(std::string(e.what()).size(), 10u);
    }
  }
  EXPECT_GT(refused, 1000);
}

/// A specimen that is pulled open, one data set.
std::string pulled(const std::string& kind, const std::string& geometry, const std::string& load = "load") {
  return R"({"name": "b", "kind": ")" + kind + R"(", "geometry": {"unit": "mm", )" + geometry +
         R"(}, "values": {"cmod": {"unit": "um", "list": [2, 4, 6, 8]}, ")" + load +
         R"(": {"unit": "N", "list": [100, 200, 300, 400]}}})";
}

const NotchedSpecimen& specimen_of(const Specification& s) {
  return std::get<NotchedData>(s.data[0].test).test.specimen;
}

TEST(Specification, CompactTensionHasTheProportionsOfTheStandardWhereNothingElseIsStated) {
  const std::string lengths = R"("width": 100, "notch": 40, "thickness": 50)";
  const Specification s = parse_specification(with(pulled("compact_tension", lengths)), origin);
  NotchedSpecimen standard = compact_tension(0.1, 0.04, 0.05);
  EXPECT_EQ(specimen_of(s), standard);
  standard.hole = 0.0;
  EXPECT_EQ(specimen_of(parse_specification(with(pulled("compact_tension", lengths + R"(, "hole": 0)")), origin)),
            standard);
  expect_message(with(pulled("compact_tension", R"("width": 100, "notch": 99, "thickness": 50)")), "notch = ");
  expect_message(with(pulled("compact_tension", lengths + R"(, "depth": 3)")), "unknown key \"depth\"");
}

TEST(Specification, WedgesTurnTheLoadOfTheMachineIntoWhatSplits) {
  const std::string lengths =
      R"("length": 200, "depth": 200, "ligament": 90, "thickness": 100, "span": 60, "load_depth": 15)";
  const std::string wedge = lengths + R"(, "wedge_half_angle_deg": 15)";
  const Specification plain = parse_specification(with(pulled("wedge_splitting", lengths)), origin);
  EXPECT_DOUBLE_EQ(specimen_of(plain).notch, 0.11);
  EXPECT_EQ(specimen_of(plain).wedge_slope, 0.0);
  const Specification turned = parse_specification(with(pulled("wedge_splitting", wedge, "vertical_load")), origin);
  const double slope = 2.0 - std::sqrt(3.0);  // tan 15 degrees
  EXPECT_NEAR(specimen_of(turned).wedge_slope, slope, 1e-12);
  EXPECT_NEAR(turned.data[0].measured[3], 400.0 / (2.0 * slope), 1e-9);
  EXPECT_NEAR(turned.data[0].deviation[3] / plain.data[0].deviation[3], 1.0 / (2.0 * slope), 1e-9);
  expect_message(with(pulled("wedge_splitting", lengths, "vertical_load")), "needs \"wedge_half_angle_deg\"");
  expect_message(with(pulled("compact_tension", R"("width": 100, "notch": 40, "thickness": 50)", "vertical_load")),
                 "has none of the quantities load");
}

TEST(Specification, EccentricNotchIsRefusedWithTheWayOut) {
  const std::string set = R"({"name": "b", "kind": "notched_beam", "values": {"cmod": [1e-6, 2e-6, 3e-6, 4e-6],
    "load": [1000, 2000, 3000, 4000]}, "geometry": {"unit": "mm", "depth": 50, "thickness": 50, "span": 125,
    "notch": 25, "notch_offset": )";
  expect_message(with(set + "20}}"), "use a data set of the kind \"scene\"");
  EXPECT_EQ(message_of(with(set + "0}}")), "");
}

TEST(Specification, QuantitiesStandForParametersAsInMaterialFiles) {
  const auto p = [](const std::string& entries, const std::string& fit) {
    return R"({"material": "../materials/johnstone.json", "fit": [)" + fit + R"(], "parameters": {)" + entries +
           R"(}, "data": [)" + energy_set + "]}";
  };
  const Specification s =
      parse_specification(p(R"-("compressive_strength": {"value": 4, "unit": "MPa"}, "friction_angle_deg": 30,
             "K_Ic": {"value": 2.5, "unit": "MPa.sqrt(mm)"})-",
                            "\"dilation_angle_deg\""),
                          origin);
  const double phi = 30.0 * std::numbers::pi / 180.0;
  EXPECT_EQ(s[Parameter::friction_angle_deg].value, 30.0);
  // The Mohr circle of uniaxial compression touches the yield surface.
  const double c0 = s[Parameter::cohesion].value;
  const double a = c0 - s[Parameter::tensile_strength].value * std::tan(phi);
  EXPECT_NEAR(std::sqrt(4e12 + a * a), c0 * std::cos(phi) + 2e6 * std::sin(phi), 1e-3);
  const double energy = s[Parameter::tensile_strength].value * s[Parameter::delta0].value;
  EXPECT_NEAR(energy, 2.5e6 * 2.5e6 * 1e-3 * (1.0 - 0.25 * 0.25) / 0.4e9, 1e-9);
  EXPECT_EQ(s.conversions.size(), 2u);

  // What a fitted parameter moves is refused; what it does not is taken.
  const std::string k = R"-("K_Ic": {"value": 2.5, "unit": "MPa.sqrt(mm)"})-";
  expect_message(p(k + R"(, "tensile_strength": {"start": 0.5, "unit": "MPa"})", "\"dilation_angle_deg\""),
                 "tensile_strength is fitted, and delta0 follows from it");
  expect_message(p(k, "\"young_modulus\""), "delta0 follows from it");
  expect_message(p(k + R"(, "delta0": 1e-5)", "\"dilation_angle_deg\""), "delta0");
  EXPECT_EQ(message_of(p(R"("UCS": {"value": 4, "unit": "MPa"})", "\"delta0\"")), "");
}

TEST(Specification, ShippedOnesAreGood) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FPZ_DATA_DIR "/calibration")) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    EXPECT_NO_THROW((void)read_specification(entry.path())) << entry.path();
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace fpz::calibration
