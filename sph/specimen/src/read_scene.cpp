#include "check_scene.hpp"
#include "fpz/specimen/scene.hpp"
#include "read_materials.hpp"
#include "scene_reader.hpp"

namespace fpz::specimen {
namespace {

using namespace detail;
namespace fs = std::filesystem;

constexpr std::array<std::string_view, 24> root_keys = {
    "name",       "description", "source",  "material",   "setting",        "thickness",   "spacing", "shape",
    "holes",      "notches",     "regions", "interfaces", "strength_field", "arrangement", "method",  "initial_stress",
    "boundaries", "loads",       "gauges",  "toughness",  "stages",         "stop",        "output",  "solver"};

/// Kernel gradients keep constant stress in equilibrium where all neighbourhoods are alike: on lattices.
void judge_operator(Scene& scene) {
  const sph::Options<2>& o = scene.options;
  const bool particles_differ = scene.particles || scene.pattern.move > 0.0 ||
                                scene.pattern.kind == Pattern::Kind::rings ||
                                scene.pattern.kind == Pattern::Kind::scattered;
  std::string setting, way_out;
  if (o.configuration == sph::Configuration::updated) {
    setting = "method.configuration = updated", way_out = R"("configuration": "reference")";
  } else if (o.momentum == sph::MomentumForm::paper) {
    setting = "method.momentum = paper", way_out = R"("momentum": "adjoint")";
  } else if (o.gradient == sph::Gradient::kernel) {
    setting = "method.gradient = kernel", way_out = R"("gradient": "consistent")";
  }
  if (!particles_differ || setting.empty()) return;
  scene.warnings.push_back(
      scene.file + ": " + setting +
      ": on particles that are no lattice constant stress is not in equilibrium, and stresses are "
      "wrong by some tens of per cent; use " +
      way_out + (scene.particles ? ", unless those of the file are a lattice" : ", or a lattice that is not moved"));
}

void read_header(const InputReader& r, const Place& root, Scene& scene) {
  const auto text = [&](std::string_view key, std::string& member) {
    with(root, key, [&](const Place& p) { member = r.text(p, 10'000).value_or(""); });
  };
  scene.file = r.file();
  scene.has_shape = root.value().find("shape") != nullptr;
  scene.name = fs::path(r.file()).stem().string();
  text("name", scene.name);
  text("description", scene.description);
  std::string source;
  text("source", source);
  with_required(r, root, "setting", [&](const Place& p) {
    scene.setting = choice(r, p, {Setting::plane_strain, Setting::plane_stress}).value_or(scene.setting);
  });
  with_required(r, root, "thickness", [&](const Place& p) { scene.thickness = r.positive(p).value_or(1.0); });
  with_required(r, root, "spacing", [&](const Place& p) { scene.spacing = r.positive(p).value_or(1.0); });
}

/// Components of a stress that is the same everywhere, Pa.
Tensor<double, 2> read_stress(const InputReader& r, const Place& place) {
  Tensor<double, 2> stress = Tensor<double, 2>::Zero();
  std::vector<std::string_view> keys;
  for (const auto& word : Words<PlaneComponent>::list) keys.emplace_back(word.text);
  if (!r.object(place, "\"xx\", \"yy\" and \"xy\" (Pa, tension positive)")) return stress;
  r.known_keys(place, keys);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    with(place, keys[k], [&](const Place& p) { stress[static_cast<int>(k)] = r.number(p).value_or(0.0); });
  }
  return stress;
}

/// Names only: servos of the boundaries follow gauges, which look at boundaries.
std::vector<std::string> gauge_names(const JsonValue& root) {
  std::vector<std::string> names;
  if (const JsonValue* gauges = root.find("gauges")) {
    for (const JsonValue& g : gauges->items) names.push_back(g.key);
  }
  return names;
}

/// Paths of other files as they are valid from anywhere: the scene's copy in the output folder reads the same.
void make_paths_absolute(JsonValue& value, const fs::path& folder) {
  for (JsonValue& member : value.items) make_paths_absolute(member, folder);
  JsonValue* file = detail::member(value, "file");
  const JsonValue* type = value.find("type");
  if (file == nullptr || type == nullptr || (type->text != "file" && type->text != "outline")) return;
  file->text = fs::absolute(folder / file->text).lexically_normal().string();
}

Scene read_tree(JsonValue& root, const std::string& origin, const io::ReadLimits& limits, io::Problems& problems) {
  Scene scene;
  const InputReader r(origin, limits, problems);
  if (!r.object(Place(root), "the keys of a scene")) return scene;
  {
    const Place top(root);
    r.known_keys(top, root_keys);
    read_header(r, top, scene);
  }
  const auto material = read_material_of_scene(r, root);
  const JsonValue* first = material ? root.find("material") : nullptr;
  const std::vector<std::size_t> of_regions =
      add_materials(r, root, "regions", first, true, scene, scene.further_materials);
  const std::vector<std::size_t> of_boundaries =
      add_materials(r, root, "boundaries", first, false, scene, scene.further_materials);
  const std::vector<std::size_t> of_interfaces =
      add_materials(r, root, "interfaces", first, true, scene, scene.interface_materials);
  const Place top(root);
  const std::vector<std::string> gauges = gauge_names(root);
  with(top, "method", [&](const Place& p) { read_method(r, p, scene.options); });
  read_body(r, top, scene);
  read_arrangement(r, top, scene);
  with(top, "regions", [&](const Place& p) { read_regions(r, p, of_regions, scene); });
  with(top, "interfaces", [&](const Place& p) { read_interfaces(r, p, of_interfaces, scene); });
  with(top, "strength_field", [&](const Place& p) { read_strength_field(r, p, scene); });
  with(top, "initial_stress", [&](const Place& p) { scene.initial_stress = read_stress(r, p); });
  with_required(r, top, "boundaries", [&](const Place& p) { read_boundaries(r, p, gauges, of_boundaries, scene); });
  with(top, "loads", [&](const Place& p) { read_loads(r, p, scene); });
  with_required(r, top, "gauges", [&](const Place& p) { read_gauges(r, p, scene); });
  read_toughness(r, root, scene);
  read_stages(r, top, gauges, scene);
  with(top, "solver", [&](const Place& p) { read_solver(r, p, scene); });
  with(top, "output", [&](const Place& p) { read_output(r, p, scene.output); });
  if (material) {
    scene.parameters = material->parameters;
    scene.material_name = material->name;
    note_conversions(*material, scene);
    for (const std::string& w :
         io::check_material(*material, scene.parameters, scene.setting, std::nullopt, problems)) {
      if (std::find(scene.warnings.begin(), scene.warnings.end(), w) == scene.warnings.end()) {
        scene.warnings.push_back(w);
      }
    }
    const std::string why = why_unfit(scene.options.method, scene.parameters.choices);
    if (!why.empty()) r.problem(top, why);
  }
  judge_operator(scene);
  if (problems.empty()) check_scene(r, top, scene);
  make_paths_absolute(root, fs::path(r.file()).parent_path());
  scene.text = to_text(root);
  return scene;
}

}  // namespace

Scene parse_scene(std::string_view text, const fs::path& origin, const Overrides& overrides) {
  const io::ReadLimits limits;
  io::Problems problems(limits.problems);
  io::JsonValue root;
  Scene scene;
  if (io::parse_json(text, origin.string(), limits, problems, root)) {
    for (const std::string& o : overrides) apply_override(root, o, origin.string(), problems);
    scene = read_tree(root, origin.string(), limits, problems);
  }
  problems.throw_if_any();
  return scene;
}

Scene read_scene(const fs::path& file, const Overrides& overrides) {
  std::string text, error;
  if (!io::load_text(file, io::FileKind::any, io::ReadLimits(), text, error)) {
    throw io::InputError(file.string() + ": cannot be read: " + error);
  }
  return parse_scene(text, file, overrides);
}

}  // namespace fpz::specimen
