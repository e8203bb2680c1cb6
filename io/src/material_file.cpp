#include "fpz/io/material_file.hpp"

#include <algorithm>
#include <array>

#include "fpz/io/plausibility.hpp"
#include "material_statements.hpp"

namespace fpz::io {
namespace {

using Kind = JsonValue::Kind;

constexpr std::size_t longest_name = 200;
constexpr std::size_t longest_file_name = 4000;
constexpr std::array<std::string_view, 4> text_keys = {"name", "source", "units", "notes"};
constexpr std::string_view file_key = "file";

std::vector<std::string_view> all_keys() {
  std::vector<std::string_view> keys;
  for (const ParameterInfo<double>& key : material_keys) keys.push_back(key.name);
  for (const MaterialAlternative& a : material_alternatives()) {
    keys.push_back(a.key);
    keys.push_back(a.symbol);
  }
  for (const std::string_view key : choice_keys()) keys.push_back(key);
  keys.insert(keys.end(), text_keys.begin(), text_keys.end());
  return keys;
}

/// Keys for other programs, which this one does not look into: where a calibrated material comes from, and "x_...".
bool is_foreign(const JsonValue& member) { return member.key == "provenance" || member.key.starts_with("x_"); }

void check_texts(const InputReader& reader, const Place& place) {
  for (const JsonValue& member : place.value().items) {
    const bool is_text = std::find(text_keys.begin(), text_keys.end(), member.key) != text_keys.end();
    const char* expected = nullptr;
    if (is_text && !member.is(Kind::string)) expected = "a string";
    if (member.key == "provenance" && !member.is(Kind::object)) expected = "an object";
    if (expected != nullptr) {
      reader.problem(Place(place, member), "expected " + std::string(expected) + ", found " + member.description());
    }
  }
}

void read_name(const InputReader& reader, const Place& place, std::string& name) {
  const JsonValue* given = place.value().find("name");
  if (given == nullptr || !given->is(Kind::string)) return;
  if (const auto text = reader.text(Place(place, *given), longest_name)) name = *text;
}

template <Worded E>
void read_choice(const InputReader& reader, const Place& at, E& choice) {
  const std::optional<std::string> word = reader.text(at, longest_name);
  if (!word) return;
  if (const std::optional<E> known = from_word<E>(*word)) {
    choice = *known;
  } else {
    reader.problem(at, in_quotes(*word) + " is not known; it must be " + all_words<E>());
  }
}

std::string line_of(const Location& at, const Violation& v) {
  return at.path + " = " + exact(v.value) + ": " + v.constraint;
}

}  // namespace

std::vector<std::string_view> choice_keys() {
  std::vector<std::string_view> keys;
  const MaterialChoices defaults;
  visit_choices(defaults, [&keys](const char* key, auto) { keys.emplace_back(key); });
  return keys;
}

void read_choices(const InputReader& reader, const Place& place, MaterialChoices& choices) {
  visit_choices(choices, [&](const char* key, auto& choice) {
    const JsonValue* word = place.value().find(key);
    if (word != nullptr) read_choice(reader, Place(place, *word), choice);
  });
}

std::optional<MaterialFile> read_material(const InputReader& reader, const Place& place, std::string name) {
  if (!reader.object(place, "the parameters of a material")) return std::nullopt;
  const std::size_t before = reader.problems().size();
  reader.known_keys(place, all_keys(), is_foreign);
  check_texts(reader, place);

  MaterialFile material;
  material.name = std::move(name);
  const bool numbers = detail::read_statements(reader, place, material);
  const bool complete = detail::require_statements(reader, place);
  if (numbers && complete) detail::resolve(material, reader.problems());
  read_choices(reader, place, material.parameters.choices);
  read_name(reader, place, material.name);
  if (reader.problems().size() != before) return std::nullopt;
  return material;
}

std::optional<MaterialFile> read_difference(const InputReader& reader, const Place& place, const MaterialFile& base) {
  const std::size_t before = reader.problems().size();
  std::vector<std::string_view> keys = all_keys();
  keys.push_back(file_key);
  reader.known_keys(place, keys, is_foreign);
  check_texts(reader, place);
  MaterialFile given;
  if (detail::read_statements(reader, place, given)) {
    MaterialFile whole = base;
    detail::replace_statements(given, whole);
    given = std::move(whole);
    detail::resolve(given, reader.problems());
  }
  read_choices(reader, place, given.parameters.choices);
  read_name(reader, place, given.name);
  if (reader.problems().size() != before) return std::nullopt;
  return given;
}

void state_parameters(const MaterialFile& material, JsonValue& tree) {
  std::erase_if(tree.items, [](const JsonValue& m) { return detail::is_statement(m.key); });
  for (std::size_t k = 0; k < material_keys.size(); ++k) {
    JsonValue& v = tree.items.emplace_back();
    v.kind = Kind::number;
    v.key = material_keys[k].name;
    v.number = material.parameters.*material_keys[k].member;
    v.text = exact(v.number);
    v.line = material.locations[k].line;
  }
}

std::optional<MaterialFile> material_at(const InputReader& reader, const Place& place, const MaterialLoader& load) {
  const JsonValue& value = place.value();
  if (value.is(Kind::string)) return load(place);
  if (!value.is(Kind::object)) {
    reader.problem(
        place, "expected an object with the parameters or the name of a material file, found " + value.description());
    return std::nullopt;
  }
  const JsonValue* file = value.find(file_key);
  if (file == nullptr) return read_material(reader, place, "inline");
  const Place name(place, *file);
  if (!file->is(Kind::string)) {
    reader.problem(name, "expected the name of a material file, found " + file->description());
    return std::nullopt;
  }
  const std::optional<MaterialFile> base = load(name);
  if (!base) return std::nullopt;
  return read_difference(reader, place, *base);
}

std::optional<MaterialFile> load_material(const std::filesystem::path& file, const std::string& shown_as,
                                          const ReadLimits& limits, Problems& problems, std::string& error) {
  std::string text;
  if (!load_text(file, FileKind::regular, limits, text, error)) return std::nullopt;
  JsonValue root;
  if (!parse_json(text, shown_as, limits, problems, root)) return std::nullopt;
  return read_material(InputReader(shown_as, limits, problems), Place(root), file.stem().string());
}

std::optional<MaterialFile> load_named_material(const InputReader& reader, const Place& place,
                                                const std::filesystem::path& folder) {
  const std::optional<std::string> name = reader.text(place, longest_file_name);
  if (!name) return std::nullopt;
  if (name->find('\0') != std::string::npos) {
    reader.problem(place, "a file name with a zero character");
    return std::nullopt;
  }
  const std::filesystem::path file = folder / *name;
  const std::string shown = file.lexically_normal().string();
  std::string error;
  auto material = load_material(file, shown, reader.limits(), reader.problems(), error);
  if (!error.empty()) reader.problem(place, "cannot read material file " + in_quotes(shown) + ": " + error);
  return material;
}

namespace {

/// `file:line: path` of a value, without what is not known.
std::string where(const Location& at) {
  return at.file + ':' + (at.line > 0 ? std::to_string(at.line) + ':' : "") + ' ' + at.path;
}

/// A value that is far off because it is in another unit is a problem; others are warnings: a material may be made too
/// strong to crack.
void judge_value(const Location& at, std::string_view name, double si, Problems& problems,
                 std::vector<std::string>& warnings) {
  const Judgement j = judge_parameter(name, si);
  const std::string text = at.path + j.text.substr(std::min(name.size(), j.text.size()));
  if (j.verdict == Verdict::plausible) return;
  if (j.verdict == Verdict::impossible && j.other_unit) return problems.add(at.file, at.line, text);
  warnings.push_back(where({at.file, at.line, ""}) + text);
}

}  // namespace

std::vector<std::string> check_material(const MaterialFile& material, const Parameters& parameters, Setting setting,
                                        const std::optional<Location>& rve_length, Problems& problems) {
  const auto location = [&](const std::string& field) -> const Location* {
    for (std::size_t k = 0; k < material_keys.size(); ++k) {
      if (material_keys[k].name == field) return &material.locations[k];
    }
    return rve_length ? &*rve_length : nullptr;
  };
  const Validation result = validate(parameters, setting);
  for (const Violation& v : result.errors) {
    if (const Location* at = location(v.field)) problems.add(at->file, at->line, line_of(*at, v));
  }
  std::vector<std::string> warnings = material.warnings;
  for (const Violation& v : result.warnings) {
    const Location* at = location(v.field);
    if (at == nullptr) continue;
    warnings.push_back(where({at->file, at->line, ""}) + line_of(*at, v));
  }
  for (const ParameterInfo<double>& key : parameter_table<double>) {
    const Location* at = location(std::string(key.name));
    const double x = parameters.*key.member;
    if (at != nullptr && key.bounds.hold(x)) judge_value(*at, key.name, x, problems, warnings);
  }
  return warnings;
}

Parameters read_material_file(const std::filesystem::path& file, std::string* name) {
  const ReadLimits limits;
  Problems problems(limits.problems);
  std::string error;
  const auto material = load_material(file, file.string(), limits, problems, error);
  if (!error.empty()) throw InputError(file.string() + ": cannot read material file: " + error);
  problems.throw_if_any();
  if (!material) throw InputError(file.string() + ": no material");
  // The setting only moves the bound of rve_length, which a material file does not have.
  (void)check_material(*material, material->parameters, Setting::plane_strain, std::nullopt, problems);
  problems.throw_if_any();
  if (name != nullptr) *name = material->name;
  return material->parameters;
}

}  // namespace fpz::io
