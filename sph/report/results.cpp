#include "results.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/run.hpp"

namespace fpz::report {
namespace {

namespace fs = std::filesystem;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

const io::JsonValue* find(const io::JsonValue& root, std::string_view path) {
  const io::JsonValue* at = &root;
  for (const std::string& name : split(std::string(path), '/')) {
    if (at->is(io::JsonValue::Kind::array)) {
      const auto k = static_cast<std::size_t>(std::stoul(name));
      at = k < at->items.size() ? &at->items[k] : nullptr;
    } else {
      at = at->find(name);
    }
    if (at == nullptr) return nullptr;
  }
  return at;
}

double number(const io::JsonValue& root, std::string_view path) {
  const io::JsonValue* at = find(root, path);
  return at != nullptr && at->is(io::JsonValue::Kind::number) ? at->number : nan;
}

io::JsonValue load_json(const fs::path& file) {
  const io::ReadLimits limits;
  io::Problems problems(limits.problems);
  std::string text, error;
  if (!io::load_text(file, io::FileKind::regular, limits, text, error)) {
    throw io::InputError(file.string() + ": cannot be read: " + error);
  }
  io::JsonValue root;
  (void)io::parse_json(text, file.string(), limits, problems, root);
  problems.throw_if_any();
  return root;
}

/// Place of a column in a header line.
std::size_t column(const std::vector<std::string>& header, const char* name, const fs::path& file) {
  const auto at = std::find(header.begin(), header.end(), name);
  if (at == header.end()) throw io::InputError(file.string() + ": has no column \"" + name + "\"");
  return static_cast<std::size_t>(at - header.begin());
}

}  // namespace

double Run::figure(std::string_view path) const { return number(summary, path); }
double Run::setting(std::string_view path) const { return number(scene, path); }

std::string Run::choice(std::string_view path, const std::string& otherwise) const {
  const io::JsonValue* at = find(scene, path);
  return at != nullptr ? at->text : otherwise;
}

bool Run::finished() const {
  const io::JsonValue* at = summary.find("status");
  return at != nullptr && at->text == "finished";
}

std::string Run::reason() const {
  const io::JsonValue* at = summary.find("reason");
  return at != nullptr ? at->text : std::string();
}

std::size_t Run::warnings() const {
  const io::JsonValue* at = summary.find("warnings");
  return at != nullptr ? at->items.size() : 0;
}

io::Table Run::history() const { return io::read_csv(specimen::RunFiles(folder).history); }
specimen::Scene Run::parsed_scene() const { return specimen::read_scene(specimen::RunFiles(folder).scene); }
std::vector<specimen::Frame> Run::frames() const { return specimen::read_pvd(specimen::RunFiles(folder).collection); }
specimen::PointCloud Run::cloud(const specimen::Frame& frame) const { return specimen::read_vtk(folder / frame.file); }

const Run* SweepRuns::find(std::string_view series, std::string_view label) const {
  for (const Run& r : runs) {
    if (r.series == series && r.label == label) return &r;
  }
  return nullptr;
}

std::vector<const Run*> SweepRuns::of(std::string_view series) const {
  std::vector<const Run*> list;
  for (const Run& r : runs) {
    if (r.series == series) list.push_back(&r);
  }
  return list;
}

SweepRuns load_sweep(const fs::path& folder, const std::string& name) {
  SweepRuns sweep;
  const fs::path file = folder / name / "sweep.csv";
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) return sweep;
  const std::vector<std::string> header = split(line, ',');
  const std::size_t series = column(header, "series", file), value = column(header, "value", file),
                    label = column(header, "label", file), status = column(header, "status", file),
                    place = column(header, "folder", file);
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line, ',');
    if (cells.size() != header.size()) throw io::InputError(file.string() + ": a line of another length: " + line);
    ++sweep.planned;
    if (cells[status] != "finished" && cells[status] != "failed") continue;
    const fs::path run = folder / name / cells[place];
    if (!fs::exists(specimen::RunFiles(run).summary)) continue;  // failed before it began
    sweep.runs.push_back({name, cells[series], cells[label], std::strtod(cells[value].c_str(), nullptr), run,
                          load_json(specimen::RunFiles(run).scene), load_json(specimen::RunFiles(run).summary)});
  }
  return sweep;
}

std::vector<const SweepRuns*> Results::all() const {
  return {&beam_spacing,      &beam_fine,      &beam_rollers,       &beam_rate,      &beam_methods,
          &beam_methods_fine, &scb_angles,     &scb_updated,        &ring_diameters, &solver_beam,
          &solver_scb,        &method_dogbone, &method_compression, &method_disc,    &method_beam};
}

Results load_results(const fs::path& folder) {
  const auto load = [&](const char* name) { return load_sweep(folder, name); };
  return {folder,
          load("beam_spacing"),
          load("beam_fine"),
          load("beam_rollers"),
          load("beam_rate"),
          load("beam_methods"),
          load("beam_methods_fine"),
          load("scb_angles"),
          load("scb_updated"),
          load("ring_diameters"),
          load("solver_beam"),
          load("solver_scb"),
          load("method_dogbone"),
          load("method_compression"),
          load("method_disc"),
          load("method_beam")};
}

std::optional<Onset> first_crack(const Run& run) {
  const io::Table t = run.history();
  const auto& count = t.at("damaged_particles");
  const auto first = std::find_if(count.begin(), count.end(), [](double n) { return n > 0.0; });
  if (first == count.end()) return std::nullopt;
  const auto row = static_cast<std::size_t>(first - count.begin());
  Onset onset{t.at("load")[row], t.at("deflection")[row]};
  for (const specimen::Frame& f : run.frames()) {
    const specimen::PointCloud cloud = run.cloud(f);
    const specimen::PointData* damage = cloud.find("damage");
    if (damage == nullptr) continue;
    const auto most = std::max_element(damage->values.begin(), damage->values.end());
    if (*most <= 0.0) continue;
    const auto i = static_cast<std::size_t>(most - damage->values.begin());
    onset.at = specimen::Point(cloud.points[3 * i], cloud.points[3 * i + 1]);
    return onset;
  }
  return onset;
}

std::size_t row_after_peak(const io::Table& history, double fraction) {
  const std::vector<double>& load = history.at("load");
  const auto peak = std::max_element(load.begin(), load.end());
  const auto at = std::find_if(peak, load.end(), [&](double p) { return p <= fraction * *peak; });
  return static_cast<std::size_t>((at == load.end() ? at - 1 : at) - load.begin());
}

const specimen::Frame& frame_at(const std::vector<specimen::Frame>& frames, double time) {
  return *std::min_element(frames.begin(), frames.end(), [&](const specimen::Frame& a, const specimen::Frame& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
}

}  // namespace fpz::report
