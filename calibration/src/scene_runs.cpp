#include "fpz/calibration/scene_runs.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "fpz/io/csv.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/json_locator.hpp"
#include "fpz/io/material_file.hpp"
#include "fpz/io/output.hpp"
#include "fpz/specimen/estimate.hpp"
#include "fpz/specimen/sweep.hpp"
#include "fpz/sph/archive.hpp"
#include "scene_program.hpp"

namespace fpz::calibration {
namespace {

namespace fs = std::filesystem;

// ---- Names of runs: what they are of and what made them

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Of any bytes, in hexadecimal digits.
std::string fingerprint(std::string_view bytes) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sph::fnv1a(sph::bytes_of(bytes))));
  return text;
}

/// This program: another one may give other results for the same scene.
const std::string& program() {
  static const std::string name = fingerprint(FPZ_VERSION + content_of("/proc/self/exe"));
  return name;
}

// ---- Scenes with the material of the calibration

specimen::Scene scene_of(const SceneRun& run) {
  nlohmann::ordered_json material;
  material["name"] = "of the calibration";
  for (const auto& key : io::material_keys) material[std::string(key.name)] = run.parameters.*key.member;
  io::put_choices(material, run.parameters.choices);
  specimen::Overrides changes = run.source.changes;
  changes.push_back("material=" + material.dump());
  // Nothing looks at them.
  changes.insert(changes.end(), {"output.frames=0", "output.picture_loads=[1.0]", "output.pictures=false"});
  return specimen::read_scene(run.source.file, changes);
}

// ---- Runs in their folders

fs::path seal_of(const fs::path& folder) { return folder / "seal.txt"; }

/// A seal tells that the history is whole and as it was written.
std::string seal_text(const fs::path& folder) {
  return "history.csv " + fingerprint(content_of(specimen::RunFiles(folder).history)) + "\n";
}

bool is_sealed(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(seal_of(folder), ignored) && content_of(seal_of(folder)) == seal_text(folder);
}

/// A run that is finished without a good seal is damaged: it is removed, to be made again.
void remove_if_damaged(const fs::path& folder) {
  const specimen::RunFiles files(folder);
  std::error_code ignored;
  const bool ended = fs::exists(files.summary, ignored);
  const bool goes_on = fs::exists(files.checkpoint, ignored);
  if (ended ? !is_sealed(folder) : fs::exists(folder, ignored) && !goes_on) fs::remove_all(folder, ignored);
}

SceneOutcome outcome_in(const fs::path& folder) {
  const specimen::RunFiles files(folder);
  SceneOutcome out;
  io::Table table = io::read_csv(files.history);
  out.columns = std::move(table.names);
  out.readings = std::move(table.columns);
  const nlohmann::json summary = nlohmann::json::parse(content_of(files.summary), nullptr, false);
  if (!summary.is_object()) return out;
  out.ending = summary.value("reason", "");
  for (const auto& w : summary.value("warnings", nlohmann::json::array())) {
    if (w.is_string()) out.warnings.push_back(w.get<std::string>());
  }
  return out;
}

/// Makes the runs that a list asks for, each once.
class Runner {
 public:
  explicit Runner(const SceneRunOptions& options) : options_(options) {}

  std::vector<SceneOutcome> operator()(const std::vector<SceneRun>& runs, const SceneProgress& progress) const {
    std::vector<SceneOutcome> out(runs.size());
    specimen::Sweep sweep;
    sweep.name = "runs of a calibration";
    sweep.series = {"runs"};
    std::vector<std::size_t> row_of(runs.size());
    std::map<std::string, std::size_t> rows;  // by folder
    for (std::size_t k = 0; k < runs.size(); ++k) {
      specimen::Scene scene;
      try {
        scene = scene_of(runs[k]);
      } catch (const io::InputError& e) {
        out[k].failure = e.what();
        continue;
      }
      const std::string folder = fingerprint(scene.text + program());
      const auto [at, is_new] = rows.emplace(folder, sweep.runs.size());
      row_of[k] = at->second;
      if (!is_new) continue;
      remove_if_damaged(options_.folder / folder);
      sweep.runs.push_back({0, folder, 0.0, folder, std::move(scene)});
    }
    if (sweep.runs.empty()) return out;
    specimen::SweepRequest request;
    request.folder = options_.folder;
    request.jobs = options_.jobs;
    request.pictures = false;
    request.progress = [&](const specimen::SweepProgress& p) {
      if (progress) progress(p.done, p.all, p.remaining);
    };
    const specimen::SweepResult result = specimen::run_sweep(sweep, request);
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (out[k].failure.empty()) out[k] = outcome_of(result.rows[row_of[k]], sweep.runs[row_of[k]].folder);
    }
    return out;
  }

 private:
  [[nodiscard]] SceneOutcome outcome_of(const specimen::SweepRow& row, const fs::path& name) const {
    const fs::path folder = options_.folder / name;
    SceneOutcome out;
    if (row.status != specimen::RunStatus::finished) {
      out.failure = "the run " + std::string(fpz::to_string(row.status)) + ": " + row.reason;
    } else {
      if (!row.kept) io::write_text(seal_of(folder), seal_text(folder), true);
      out = outcome_in(folder);
    }
    return out;
  }

  SceneRunOptions options_;
};

io::Quantity quantity_of(const specimen::Gauge& gauge) {
  using io::Quantity;
  if (std::holds_alternative<specimen::ForceGauge>(gauge)) return Quantity::force;
  if (std::holds_alternative<specimen::DisplacementGauge>(gauge)) return Quantity::length;
  if (std::holds_alternative<specimen::OpeningGauge>(gauge)) return Quantity::length;
  if (std::holds_alternative<specimen::StressGauge>(gauge)) return Quantity::stress;
  return Quantity::number;
}

}  // namespace

namespace detail {

SceneFacts facts_of(const SceneSource& source) {
  const specimen::Scene scene = specimen::read_scene(source.file, source.changes);
  SceneFacts facts{scene.setting, {{"time", io::Quantity::number}}, scene.warnings};
  for (const auto& [name, gauge] : scene.gauges) facts.columns.push_back({name, quantity_of(gauge)});
  return facts;
}

double seconds_of(const SceneRun& run) {
  const specimen::Scene scene = scene_of(run);
  const specimen::Estimate e = specimen::estimate(scene, specimen::make_specimen(scene), 1);
  return e.step_processor_seconds * static_cast<double>(e.likely_steps);
}

}  // namespace detail

RunScenes scene_runner(const SceneRunOptions& options) { return Runner(options); }

}  // namespace fpz::calibration
