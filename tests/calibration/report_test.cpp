#include "fpz/calibration/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "fpz/io/csv.hpp"
#include "fpz/io/material_file.hpp"
#include "fpz/io/output.hpp"
#include "fpz/law/softening.hpp"
#include "support/temporary_folder.hpp"

namespace fpz::calibration {
namespace {

using Json = nlohmann::json;

Specification example(const char* name) {
  return read_specification(std::string(FPZ_DATA_DIR "/calibration/") + name + ".json");
}

/// Strength and delta0 from two energies of the same test: only their product is determined.
Specification undetermined() {
  return parse_specification(
      R"({"material": "../materials/johnstone.json", "fit": ["delta0", "tensile_strength"], "options": {"starts": 2},
          "data": [{"name": "G1", "kind": "fracture_energy", "mode": "I", "energy": 10.8, "deviation": 0.5},
                   {"name": "G2", "kind": "fracture_energy", "mode": "I", "energy": 11.1, "deviation": 0.5}]})",
      FPZ_DATA_DIR "/calibration/undetermined.json");
}

TEST(Report, MaterialIsReadByTheDriversReader) {
  const test::TemporaryFolder folder;
  const Calibration c = calibrate(example("strength"));
  ASSERT_TRUE(c.result.usable()) << c.result.message;
  write_report(c, {folder.path(), false, false, {}});
  std::string name;
  const Parameters p = io::read_material_file(folder.path() / "material.json", &name);
  EXPECT_EQ(name, c.specification.name);
  for (const auto& key : io::material_keys) EXPECT_EQ(p.*key.member, c.parameters.*key.member) << key.name;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "material_unusable.json"));

  const Json provenance = Json::parse(test::text_of(folder.path() / "material.json")).at("provenance");
  EXPECT_EQ(provenance.at("status"), "ok");
  EXPECT_EQ(provenance.at("specification"), "strength.json");
  EXPECT_GT(provenance.at("fitted").at("cohesion").at("standard_error").get<double>(), 0.0);
  EXPECT_DOUBLE_EQ(provenance.at("fixed").at("delta0").at("value").get<double>(), 15e-6);
  EXPECT_EQ(provenance.at("data").at(0).at("name"), "strengths");
  EXPECT_EQ(test::text_of(folder.path() / "material.json").find(FPZ_DATA_DIR), std::string::npos);
}

/// The softening law of the base material is that of the models and of the result.
TEST(Report, SofteningIsThatOfTheMaterial) {
  const test::TemporaryFolder folder;
  std::string material = test::text_of(FPZ_DATA_DIR "/materials/johnstone.json");
  material.insert(material.find('{') + 1, "\"softening\": \"bilinear\", ");
  const Calibration c =
      calibrate(parse_specification(R"({"material": )" + material + R"(, "fit": ["delta0"], "options": {"starts": 1},
          "data": [{"name": "G1", "kind": "fracture_energy", "mode": "I", "energy": 12.0, "deviation": 0.5}]})",
                                    FPZ_DATA_DIR "/calibration/bilinear.json"));
  ASSERT_TRUE(c.result.usable()) << c.result.message;
  // One meaning of delta0 for all laws.
  EXPECT_NEAR(c.parameters.delta0, 12.0 / c.parameters.tensile_strength, 1e-4 * c.parameters.delta0);
  write_report(c, {folder.path(), false, false, {}});
  EXPECT_EQ(io::read_material_file(folder.path() / "material.json").choices.softening,
            softening_kind<BilinearSoftening>);
  // Or stated with the parameters of the specification itself.
  const Specification own = parse_specification(
      R"({"material": "../materials/johnstone.json", "fit": ["delta0"], "parameters": {"softening": "bilinear"},
          "data": [{"name": "G1", "kind": "fracture_energy", "mode": "I", "energy": 12.0, "deviation": 0.5}]})",
      FPZ_DATA_DIR "/calibration/bilinear.json");
  EXPECT_EQ(own.start().choices.softening, softening_kind<BilinearSoftening>);
}

TEST(Report, JsonIsComplete) {
  const Calibration c = calibrate(example("table1"));
  const Json j = Json::parse(report_json(c));
  for (const char* key : {"name",
                          "description",
                          "program",
                          "version",
                          "specification",
                          "units",
                          "status",
                          "usable",
                          "message",
                          "setting",
                          "confidence",
                          "seed",
                          "parameters",
                          "fixed",
                          "derived",
                          "reference_values",
                          "cost",
                          "degrees_of_freedom",
                          "covariance",
                          "correlation",
                          "singular_values",
                          "undetermined",
                          "data",
                          "starts",
                          "distinct_minima",
                          "profiles",
                          "fracture_energies",
                          "warnings"}) {
    EXPECT_TRUE(j.contains(key)) << key;
  }
  const Json& p = j.at("parameters").at(0);
  EXPECT_EQ(p.at("name"), "delta0");
  // K^2 (1 - nu^2)/(E sigma_t0) with the numbers of Table 1: 18.06 um, as printed 18.
  const double expected = 2.15e6 * 2.15e6 * 1e-3 * (1 - 0.25 * 0.25) / 0.4e9 / 0.6e6;
  EXPECT_NEAR(p.at("value").get<double>(), expected, 1e-9 * expected);
  EXPECT_NEAR(p.at("standard_error").get<double>(), 2 * 0.05 * expected, 1e-3 * expected);
  EXPECT_NEAR(j.at("reference_values").at(0).at("relative_difference").get<double>(), expected / 18e-6 - 1, 1e-9);
  EXPECT_EQ(j.at("data").at(0).at("predicted").size(), 1u);
  EXPECT_EQ(j.at("profiles").at(0).at("parameter"), "delta0");
  EXPECT_TRUE(j.at("fracture_energies").is_null());
}

TEST(Report, TwoEnergiesAreConfronted) {
  const Calibration c = calibrate(example("two_energies"));
  ASSERT_TRUE(c.energies);
  EXPECT_TRUE(c.energies->ok()) << c.energies->failure;
  EXPECT_FALSE(c.energies->consistent);
  EXPECT_NE(report_markdown(c, false).find("## Two fracture energies, one delta0"), std::string::npos);
  const auto conflict = [](const std::string& w) { return w.find("one delta0 cannot") != std::string::npos; };
  EXPECT_TRUE(std::any_of(c.warnings.begin(), c.warnings.end(), conflict));
}

TEST(Report, CurvesHaveABandAroundTheFit) {
  const Calibration c = calibrate(example("strength"));
  const io::Table t = io::parse_csv(curve_csv(c, c.comparisons[0]), "curve");
  ASSERT_EQ(t.rows(), 7u);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    EXPECT_LT(t.at("band_low")[k], t.at("fitted")[k]);
    EXPECT_GT(t.at("band_high")[k], t.at("fitted")[k]);
    EXPECT_DOUBLE_EQ(t.at("residual")[k], t.at("fitted")[k] - t.at("measured")[k]);
  }
}

TEST(Report, AnUnusableFitLeavesNoMaterial) {
  const test::TemporaryFolder folder;
  folder.write("material.json", "{}");  // of an earlier fit
  const Calibration c = calibrate(undetermined());
  EXPECT_EQ(c.result.status, FitStatus::undetermined);
  EXPECT_THROW(write_report(c, {folder.path(), false, false, {}}), io::OutputError);
  write_report(c, {folder.path(), true, false, {}});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "material.json"));
  const std::string material = test::text_of(folder.path() / "material_unusable.json");
  EXPECT_NE(material.find("NOT USABLE"), std::string::npos);
  EXPECT_NE(test::text_of(folder.path() / "report.md").find("NOT usable"), std::string::npos);
  EXPECT_NE(short_table(c).find("undetermined"), std::string::npos);
}

TEST(Report, PredictedSetsAreComparedAndNotFitted) {
  Specification spec = example("strength");
  DataSet other = spec.data[0];
  other.name = "other";
  other.role = Role::predict;
  other.measured *= 1.1;
  spec.data.push_back(other);
  spec.options.starts = 1;
  const Calibration c = calibrate(spec);
  ASSERT_EQ(c.comparisons.size(), 2u);
  EXPECT_EQ(c.result.data.size(), 1u);
  ASSERT_TRUE(c.comparisons[1].ok());
  EXPECT_LT((c.comparisons[1].predicted - c.comparisons[0].predicted).norm(), 1e-9 * c.comparisons[0].predicted.norm());
  EXPECT_LT((c.comparisons[1].band - c.comparisons[0].band).norm(), 1e-6 * c.comparisons[0].band.norm());
  EXPECT_LT(c.comparisons[1].peak_error, -0.05);
}

TEST(Report, Reproducible) {
  Specification spec = example("strength");
  spec.options.starts = 3;
  EXPECT_EQ(report_json(calibrate(spec)), report_json(calibrate(spec)));
}

}  // namespace
}  // namespace fpz::calibration
