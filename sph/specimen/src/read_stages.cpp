// Stages: what changes at the begin of each, and when it ends.
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 5> stage_keys = {"name", "boundaries", "loads", "damping", "stop"};

std::vector<std::string_view> names_of(const auto& list) {
  std::vector<std::string_view> names;
  for (const auto& item : list) names.push_back(item.name);
  return names;
}

/// Calls f(index, place) for each member, by the name of one of the list.
template <class List, class F>
void for_named(const InputReader& r, const Place& place, const char* what, const List& list, F&& f) {
  const std::string content = std::string("the ") + what + " that change, by their names";
  if (!r.object(place, content.c_str())) return;
  for (const JsonValue& item : place.value().items) {
    const std::vector<std::string_view> names = names_of(list);
    const auto at = std::find(names.begin(), names.end(), item.key);
    if (at == names.end()) {
      r.problem(Place(place, item),
                std::string("there is none of the ") + what + " with this name" + io::suggestion(item.key, names));
    } else {
      f(static_cast<std::size_t>(at - names.begin()), Place(place, item));
    }
  }
}

/// Drives of a boundary that differ from those of the stage before.
Actuations read_change(const InputReader& r, const Place& p, const ActuationRules& rules, const Actuations& before) {
  constexpr std::array<std::string_view, 4> keys = {"velocity", "displacement", "force", "machine_stiffness"};
  Actuations now = before, changed;
  if (!r.object(p, "\"velocity\", \"displacement\" or \"force\"")) return changed;
  r.known_keys(p, keys);
  std::array<bool, 2> stated = {};
  read_actuations(r, p, rules, now, &stated);
  for (std::size_t c = 0; c < 2; ++c) {
    if (!stated[c]) continue;
    if (!before[c]) {
      const std::string axis = c == 0 ? "x" : "y";
      r.problem(p, "component " + axis +
                       " is free in \"boundaries\" and stays so: drive it there, for instance with "
                       "\"force\": {\"" +
                       axis + "\": 0}, which leaves it free to move as one");
      continue;
    }
    changed[c] = now[c];
  }
  return changed;
}

Stage read_stage(const InputReader& r, const Place& place, const ActuationRules& rules, std::size_t index,
                 std::vector<Actuations>& drive, const Scene& scene) {
  Stage stage;
  stage.name = std::to_string(index + 1);
  if (!r.object(place, "\"stop\", and what changes")) return stage;
  r.known_keys(place, stage_keys);
  with(place, "name", [&](const Place& p) { stage.name = r.text(p, longest_name).value_or(stage.name); });
  with(place, "boundaries", [&](const Place& list) {
    for_named(r, list, "boundaries", scene.boundaries, [&](std::size_t g, const Place& p) {
      const Actuations changed = read_change(r, p, rules, drive[g]);
      for (std::size_t c = 0; c < 2; ++c) {
        if (changed[c]) drive[g][c] = changed[c];
      }
      stage.boundaries.emplace_back(g, changed);
    });
  });
  with(place, "loads", [&](const Place& list) {
    for_named(r, list, "loads", scene.loads, [&](std::size_t k, const Place& p) {
      stage.loads.emplace_back(k, read_time_course(r, p, {"value", true, rules.first_stage}));
    });
  });
  with(place, "damping", [&](const Place& p) { stage.damping = r.number_between(p, 0.0, 1.0, true); });
  with_required(r, place, "stop", [&](const Place& p) { read_stop(r, p, scene, stage.stop); });
  return stage;
}

/// What the first stage changes is how the run begins.
void begin_with(const Stage& first, Scene& scene) {
  for (const auto& [g, drive] : first.boundaries) {
    for (std::size_t c = 0; c < 2; ++c) {
      if (drive[c]) scene.boundaries[g].drive[c] = drive[c];
    }
  }
  for (const auto& [k, course] : first.loads) scene.loads[k].course = course;
  if (first.damping) scene.options.damping = *first.damping;
}

}  // namespace

void read_stages(const InputReader& r, const Place& root, std::span<const std::string> gauges, Scene& scene) {
  const JsonValue* stages = root.value().find("stages");
  if (stages == nullptr) {
    with_required(r, root, "stop", [&](const Place& p) { read_stop(r, p, scene, scene.stop); });
    scene.stages.push_back({"", {}, {}, std::nullopt, scene.stop});
    return;
  }
  with(root, "stop", [&](const Place& p) { r.problem(p, "every one of the \"stages\" has its own \"stop\""); });
  const Place list(root, *stages);
  if (!r.array(list, "stages")) return;
  std::vector<Actuations> drive;
  for (const Boundary& b : scene.boundaries) drive.push_back(b.drive);
  for (std::size_t n = 0; n < stages->items.size(); ++n) {
    scene.stages.push_back(read_stage(r, Place(list, stages->items[n]), {n == 0, gauges}, n, drive, scene));
  }
  begin_with(scene.stages.front(), scene);
  scene.stop = scene.stages.back().stop;
  scene.stop.time = 0.0;
  for (const Stage& s : scene.stages) scene.stop.time += s.stop.time;
}

}  // namespace fpz::specimen::detail
