// Reading of sweeps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "fpz/io/csv_options.hpp"
#include "fpz/specimen/specimen.hpp"
#include "fpz/specimen/sweep.hpp"
#include "scene_reader.hpp"

namespace fpz::specimen {
namespace {

using namespace detail;
namespace fs = std::filesystem;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<std::string_view, 9> sweep_keys = {"name",      "description", "source",     "scene",   "set",
                                                        "parameter", "series",      "references", "pictures"};
constexpr std::array<std::string_view, 4> parameter_keys = {"name", "unit", "path", "values"};
constexpr std::array<std::string_view, 3> value_keys = {"label", "value", "set"};
constexpr std::array<std::string_view, 2> series_keys = {"name", "set"};
constexpr std::array<std::string_view, 4> picture_keys = {"x", "y", "curves", "maps"};
constexpr std::array<std::string_view, 5> reference_keys = {"name", "file", "x", "y", "points"};

struct Change {
  std::string label;
  double value = nan;
  Overrides set;
};

std::string assignment(std::string_view path, const JsonValue& value) {
  std::string text = to_text(value);
  text.pop_back();  // the line's end
  return std::string(path) + "=" + text;
}

std::string_view path_of(std::string_view assignment) { return assignment.substr(0, assignment.find('=')); }

Overrides read_set(const InputReader& r, const Place& place) {
  Overrides set;
  if (!r.object(place, "paths and values, as in \"spacing\": 0.001")) return set;
  for (const JsonValue& m : place.value().items) set.push_back(assignment(m.key, m));
  return set;
}

/// A name that can stand in sweep.csv.
std::string read_label(const InputReader& r, const Place& place) {
  const std::string text = r.text(place, longest_name).value_or("");
  if (text.find_first_of(",\"\r\n") != std::string::npos) {
    r.problem(place, io::in_quotes(text) + ": must have no comma, quote or line break");
  }
  return text;
}

/// A name as a folder has it.
std::string folder_name(const std::string& label) {
  std::string name;
  for (const char c : label) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("._+-").find(c) != std::string_view::npos;
    name += plain && !(name.empty() && c == '.') ? c : '_';
  }
  return name;
}

Change read_value(const InputReader& r, const Place& place, const std::string& path) {
  const JsonValue& v = place.value();
  Change change;
  if (v.is(JsonValue::Kind::object)) {
    if (!r.object(place, "\"label\" and \"set\"")) return change;
    r.known_keys(place, value_keys);
    with_required(r, place, "label", [&](const Place& p) { change.label = read_label(r, p); });
    with(place, "value", [&](const Place& p) { change.value = r.number(p).value_or(nan); });
    with_required(r, place, "set", [&](const Place& p) { change.set = read_set(r, p); });
    return change;
  }
  if (v.is(JsonValue::Kind::array) || v.is(JsonValue::Kind::null)) {
    r.problem(place, "expected a number, a word, or an object with \"label\" and \"set\", found " + v.description());
    return change;
  }
  if (path.empty()) r.problem(place, "needs the \"path\" of the parameter, or \"label\" and \"set\"");
  change.set.push_back(assignment(path, v));
  change.label = v.is(JsonValue::Kind::string) ? read_label(r, place) : change.set.back().substr(path.size() + 1);
  if (v.is(JsonValue::Kind::number)) change.value = v.number;
  return change;
}

std::vector<Change> read_parameter(const InputReader& r, const Place& place, Sweep& sweep) {
  std::vector<Change> changes;
  if (!r.object(place, "\"name\" and \"values\"")) return changes;
  r.known_keys(place, parameter_keys);
  with_required(r, place, "name", [&](const Place& p) { sweep.parameter = read_label(r, p); });
  with(place, "unit", [&](const Place& p) { sweep.unit = read_label(r, p); });
  std::string path;
  with(place, "path", [&](const Place& p) { path = r.text(p, longest_name).value_or(""); });
  with_required(r, place, "values", [&](const Place& p) {
    if (!r.array(p, "values")) return;
    for (const JsonValue& item : p.value().items) changes.push_back(read_value(r, Place(p, item), path));
  });
  return changes;
}

std::vector<Change> read_series(const InputReader& r, const Place& top) {
  std::vector<Change> list;
  with(top, "series", [&](const Place& place) {
    if (!r.array(place, "series")) return;
    for (const JsonValue& item : place.value().items) {
      const Place p(place, item);
      Change& change = list.emplace_back();
      if (!r.object(p, "\"name\" and \"set\"")) continue;
      r.known_keys(p, series_keys);
      with_required(r, p, "name", [&](const Place& q) { change.label = read_label(r, q); });
      with(p, "set", [&](const Place& q) { change.set = read_set(r, q); });
    }
  });
  if (list.empty()) list.push_back({"runs", nan, {}});
  return list;
}

std::string read_column(const InputReader& r, const Place& place) {
  const std::vector<std::string_view> names(figure_names().begin(), figure_names().end());
  return std::string(word(r, place, names).value_or("value"));
}

SweepReference read_reference(const InputReader& r, const Place& place) {
  SweepReference reference;
  if (!r.object(place, "\"name\", \"file\", \"x\" and \"y\"")) return reference;
  std::vector<std::string_view> keys(reference_keys.begin(), reference_keys.end());
  keys.insert(keys.end(), io::csv_option_keys.begin(), io::csv_option_keys.end());
  r.known_keys(place, keys);
  with_required(r, place, "name", [&](const Place& p) { reference.name = read_label(r, p); });
  with(place, "points", [&](const Place& p) { reference.points = boolean(r, p).value_or(false); });
  std::string x;
  with_required(r, place, "x", [&](const Place& p) { x = r.text(p, longest_name).value_or(""); });
  with_required(r, place, "y", [&](const Place& p) { reference.y = read_column(r, p); });
  // A name that is no column of sweep.csv, such as angle_deg, is the parameter's.
  const auto& columns = figure_names();
  reference.x = std::find(columns.begin(), columns.end(), x) != columns.end() ? x : columns.front();
  with_required(r, place, "file", [&](const Place& p) {
    const auto name = r.text(p, 10'000);
    if (!name) return;
    try {
      const io::Table t =
          io::read_csv((fs::path(r.file()).parent_path() / *name).lexically_normal(), io::read_csv_options(r, place));
      const auto &xs = t.at(x), &ys = t.at(reference.y);
      for (std::size_t k = 0; k < t.rows(); ++k) reference.values.emplace_back(xs[k], ys[k]);
    } catch (const io::InputError& e) {
      r.problem(p, e.what());
    }
  });
  return reference;
}

SweepPicture read_picture(const InputReader& r, const Place& place) {
  SweepPicture picture;
  if (!r.object(place, "\"y\", \"curves\" or \"maps\"")) return picture;
  r.known_keys(place, picture_keys);
  const auto has = [&](std::string_view key) { return place.value().find(key) != nullptr; };
  if (has("y") + has("curves") + has("maps") != 1) {
    r.problem(place, "needs one of \"y\", \"curves\" and \"maps\"");
    return picture;
  }
  const auto flag = [&](std::string_view key, SweepPicture::Kind kind) {
    with(place, key, [&](const Place& p) {
      picture.kind = kind;
      if (boolean(r, p) == false) r.problem(p, "must be true, or left out");
    });
  };
  flag("curves", SweepPicture::Kind::curves);
  flag("maps", SweepPicture::Kind::maps);
  with(place, "y", [&](const Place& p) { picture.y = read_column(r, p); });
  with(place, "x", [&](const Place& p) {
    if (!has("y")) r.problem(p, "belongs to a picture with \"y\"");
    picture.x = read_column(r, p);
  });
  return picture;
}

/// What a person gave on the command line must not undo what distinguishes the runs.
void require_distinct(const InputReader& r, const Place& top, const Overrides& common,
                      const std::vector<Change>& series, const std::vector<Change>& values) {
  for (const auto* changes : {&series, &values}) {
    for (const Change& c : *changes) {
      for (const std::string& own : c.set) {
        for (const std::string& other : common) {
          if (path_of(own) != path_of(other)) continue;
          r.problem(top, "--set " + io::in_quotes(other) + ": this sweep varies that entry itself");
        }
      }
    }
  }
}

/// The scenes of all runs. The same complaint of several runs is made once.
void add_runs(const InputReader& r, const Place& top, const fs::path& scene, const Overrides& common,
              const std::vector<Change>& series, const std::vector<Change>& values, Sweep& sweep) {
  std::set<std::string> complaints;
  std::set<fs::path> folders;
  for (std::size_t s = 0; s < series.size(); ++s) {
    for (const Change& v : values) {
      SweepRun run{s, v.label, v.value, fs::path(folder_name(series[s].label)) / folder_name(v.label), {}};
      if (!folders.insert(run.folder).second) {
        r.problem(top, "two runs would have the folder " + io::in_quotes(run.folder.string()));
      }
      Overrides set = common;
      set.insert(set.end(), series[s].set.begin(), series[s].set.end());
      set.insert(set.end(), v.set.begin(), v.set.end());
      std::string title = sweep.name + " " + series[s].label + " " + v.label;
      if (v.value == v.value && !sweep.unit.empty()) title += " " + sweep.unit;
      set.push_back("name=" + title);
      try {
        run.scene = read_scene(scene, set);
        const Specimen specimen = make_specimen(run.scene);
        run.scene.warnings.insert(run.scene.warnings.end(), specimen.warnings.begin(), specimen.warnings.end());
      } catch (const io::InputError& e) {
        if (complaints.insert(e.what()).second) {
          r.problem(top, "run " + io::in_quotes(run.folder.string()) + ":\n" + e.what());
        }
      }
      sweep.runs.push_back(std::move(run));
    }
  }
}

std::vector<SweepPicture> default_pictures(const Sweep& sweep) {
  std::vector<SweepPicture> list(1);
  list[0].y = "peak_load";
  const bool toughness = std::any_of(sweep.runs.begin(), sweep.runs.end(),
                                     [](const SweepRun& run) { return run.scene.toughness.has_value(); });
  if (toughness) list.push_back({SweepPicture::Kind::columns, "K_I", "K_II"});
  list.push_back({SweepPicture::Kind::curves, "", ""});
  list.push_back({SweepPicture::Kind::maps, "", ""});
  return list;
}

Sweep read_tree(const InputReader& r, const Place& top, const Overrides& command_line) {
  Sweep sweep;
  if (!r.object(top, "the keys of a sweep")) return sweep;
  r.known_keys(top, sweep_keys);
  sweep.name = fs::path(r.file()).stem().string();
  with(top, "name", [&](const Place& p) { sweep.name = read_label(r, p); });
  std::string ignored;
  for (const char* key : {"description", "source"}) {
    with(top, key, [&](const Place& p) { ignored = r.text(p, 10'000).value_or(""); });
  }
  fs::path scene;
  with_required(r, top, "scene", [&](const Place& p) {
    scene = (fs::path(r.file()).parent_path() / r.text(p, 10'000).value_or("")).lexically_normal();
  });
  Overrides common;
  with(top, "set", [&](const Place& p) { common = read_set(r, p); });
  std::vector<Change> values;
  with_required(r, top, "parameter", [&](const Place& p) { values = read_parameter(r, p, sweep); });
  const std::vector<Change> series = read_series(r, top);
  for (const Change& s : series) sweep.series.push_back(s.label);
  with(top, "references", [&](const Place& p) {
    if (!r.array(p, "references")) return;
    for (const JsonValue& item : p.value().items) sweep.references.push_back(read_reference(r, Place(p, item)));
  });
  with(top, "pictures", [&](const Place& p) {
    if (!r.array(p, "pictures")) return;
    for (const JsonValue& item : p.value().items) sweep.pictures.push_back(read_picture(r, Place(p, item)));
  });
  require_distinct(r, top, command_line, series, values);
  common.insert(common.end(), command_line.begin(), command_line.end());
  if (!r.problems().empty()) return sweep;
  add_runs(r, top, scene, common, series, values, sweep);
  if (sweep.pictures.empty()) sweep.pictures = default_pictures(sweep);
  return sweep;
}

}  // namespace

Sweep read_sweep(const fs::path& file, const Overrides& common) {
  const io::ReadLimits limits;
  io::Problems problems(limits.problems);
  const InputReader r(file.string(), limits, problems);
  std::string text, error;
  if (!io::load_text(file, io::FileKind::any, limits, text, error)) {
    throw io::InputError(file.string() + ": cannot be read: " + error);
  }
  io::JsonValue root;
  Sweep sweep;
  if (io::parse_json(text, file.string(), limits, problems, root)) sweep = read_tree(r, Place(root), common);
  problems.throw_if_any();
  return sweep;
}

}  // namespace fpz::specimen
