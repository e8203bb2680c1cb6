#include "read_materials.hpp"

#include <algorithm>

namespace fpz::specimen::detail {
namespace {

/// Puts what an object says in place of the same keys of another.
void replace_members(JsonValue& whole, const JsonValue& given) {
  for (const JsonValue& own : given.items) {
    if (own.key == "file") continue;
    JsonValue* old = member(whole, own.key);
    (old != nullptr ? *old : whole.items.emplace_back()) = own;
  }
}

/// The material at a place, whose value is `given`.
std::optional<io::MaterialFile> read_and_complete(const InputReader& r, const Place& place, JsonValue& given) {
  std::optional<NamedTree> file;
  auto material = io::material_at(r, place, [&](const Place& name) -> std::optional<io::MaterialFile> {
    file = load_tree(r, name, "material file");
    if (!file) return std::nullopt;
    return io::read_material(InputReader(file->shown_as, r.limits(), r.problems()), Place(file->root), file->stem);
  });
  if (file) {
    if (given.is(JsonValue::Kind::object)) replace_members(file->root, given);
    file->root.key = given.key;
    given = std::move(file->root);
  }
  if (material) io::state_parameters(*material, given);
  return material;
}

std::string name_of(const JsonValue& entry) {
  const JsonValue* name = entry.find("name");
  return name != nullptr && name->is(JsonValue::Kind::string) ? name->text : "inline";
}

bool is_complete(const JsonValue& material) {
  return std::all_of(io::material_keys.begin(), io::material_keys.end(),
                     [&](const auto& key) { return material.find(key.name) != nullptr; });
}

/// The parameters of a material, without what is said about it.
JsonValue parameters_alone(JsonValue material) {
  std::erase_if(material.items, [](const JsonValue& m) {
    return m.key == "name" || m.key == "source" || m.key == "notes" || m.key == "provenance" || m.key.starts_with("x_");
  });
  return material;
}

/// That of an entry of a list of the root.
std::optional<io::MaterialFile> read_further(const InputReader& r, const JsonValue& root, const JsonValue& first,
                                             const JsonValue& list, JsonValue& entry) {
  JsonValue& given = *member(entry, "material");
  const Place top(root), array(top, list), owner(array, entry), place(owner, given);
  if (!given.is(JsonValue::Kind::object) || given.find("file") != nullptr) return read_and_complete(r, place, given);
  if (is_complete(given)) {
    const auto own = io::read_material(r, place, name_of(entry));
    if (own) io::state_parameters(*own, given);
    return own;
  }
  auto base = io::read_material(r, Place(top, first), name_of(entry));
  if (!base) return std::nullopt;
  base->name = name_of(entry);
  base->warnings.clear();  // said of the first already
  auto material = io::read_difference(r, place, *base);
  JsonValue whole = parameters_alone(first);
  replace_members(whole, given);
  whole.key = given.key;
  given = std::move(whole);
  if (material) io::state_parameters(*material, given);
  return material;
}

}  // namespace

std::optional<io::MaterialFile> read_material_of_scene(const InputReader& r, JsonValue& root) {
  const Place top(root);
  if (r.required(top, "material") == nullptr) return std::nullopt;
  JsonValue& given = *member(root, "material");
  return read_and_complete(r, Place(top, given), given);
}

void note_conversions(const io::MaterialFile& material, Scene& scene) {
  for (const std::string& c : material.conversions) {
    const auto& known = scene.conversions;
    if (std::find(known.begin(), known.end(), c) == known.end()) scene.conversions.push_back(c);
  }
}

std::vector<std::size_t> add_materials(const InputReader& r, JsonValue& root, std::string_view array,
                                       const JsonValue* first, bool may_crack, Scene& scene,
                                       std::vector<SceneMaterial>& all) {
  std::vector<std::size_t> numbers;
  JsonValue* list = member(root, array);
  if (list == nullptr || !list->is(JsonValue::Kind::array)) return numbers;
  for (JsonValue& entry : list->items) {
    numbers.push_back(0);
    if (first == nullptr || !entry.is(JsonValue::Kind::object) || entry.find("material") == nullptr) continue;
    const auto material = read_further(r, root, *first, *list, entry);
    if (!material) continue;
    note_conversions(*material, scene);
    const std::vector<std::string> doubts =
        io::check_material(*material, material->parameters, scene.setting, std::nullopt, r.problems());
    if (may_crack) scene.warnings.insert(scene.warnings.end(), doubts.begin(), doubts.end());
    all.push_back({material->name, material->parameters});
    numbers.back() = all.size();
  }
  return numbers;
}

}  // namespace fpz::specimen::detail
