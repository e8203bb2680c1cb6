// Changes of single entries of a JSON tree, and the tree as text.
#include <nlohmann/json.hpp>

#include "fpz/specimen/scene.hpp"

namespace fpz::specimen {
namespace {

using io::JsonValue;
using Kind = JsonValue::Kind;

/// One step of a path: a name, or an index.
struct Step {
  std::string name;
  std::optional<std::size_t> index;
};

std::optional<std::vector<Step>> steps_of(std::string_view path) {
  std::vector<Step> steps;
  while (!path.empty()) {
    if (path.front() == '[') {
      const auto end = path.find(']');
      if (end == std::string_view::npos || end == 1 || end > 7) return std::nullopt;
      std::size_t index = 0;
      for (const char c : path.substr(1, end - 1)) {
        if (c < '0' || c > '9') return std::nullopt;
        index = 10 * index + static_cast<std::size_t>(c - '0');
      }
      steps.push_back({"", index});
      path.remove_prefix(end + 1);
      if (!path.empty() && path.front() == '.') path.remove_prefix(1);
      continue;
    }
    const auto end = path.find_first_of(".[");
    if (end == 0) return std::nullopt;
    steps.push_back({std::string(path.substr(0, end)), std::nullopt});
    if (end == std::string_view::npos) break;
    path.remove_prefix(end + (path[end] == '.' ? 1 : 0));
    if (path.empty()) return std::nullopt;
  }
  return steps;
}

void forget_lines(JsonValue& v) {
  v.line = 0;
  for (JsonValue& item : v.items) forget_lines(item);
}

JsonValue value_of(const std::string& text) {
  const io::ReadLimits limits;
  io::Problems ignored(2);
  JsonValue value;
  bool is_json = false;
  try {
    is_json = io::parse_json(text, "", limits, ignored, value) && ignored.empty();
  } catch (const io::InputError&) {
  }
  if (!is_json) {
    value = JsonValue();
    value.kind = Kind::string;
    value.text = text;
  }
  forget_lines(value);
  return value;
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The name of a material file as an object that names it, so that other keys can stand beside it.
void give_file_a_key(JsonValue& name) {
  JsonValue object;
  object.kind = Kind::object;
  object.line = name.line;
  object.key = std::move(name.key);
  name.key = "file";
  object.items.push_back(std::move(name));
  name = std::move(object);
}

bool is_leaf(const JsonValue& v) { return !v.is(Kind::object) && !v.is(Kind::array); }

void write(const JsonValue& v, const std::string& indent, std::string& out) {
  switch (v.kind) {
    case Kind::null:
      out += "null";
      return;
    case Kind::boolean:
      out += v.boolean ? "true" : "false";
      return;
    case Kind::number:
      out += v.text;
      return;
    case Kind::string:
      out += quoted(v.text);
      return;
    case Kind::array:
    case Kind::object:
      break;
  }
  const bool object = v.is(Kind::object);
  bool flat = !object;  // arrays of numbers stay on one line
  for (const JsonValue& item : v.items) flat = flat && is_leaf(item);
  const std::string inner = indent + "  ";
  out += object ? '{' : '[';
  for (std::size_t k = 0; k < v.items.size(); ++k) {
    if (k > 0) out += flat ? ", " : ",";
    if (!flat) out += "\n" + inner;
    if (object) out += quoted(v.items[k].key) + ": ";
    write(v.items[k], inner, out);
  }
  if (!flat && !v.items.empty()) out += "\n" + indent;
  out += object ? '}' : ']';
}

}  // namespace

void apply_override(JsonValue& root, const std::string& assignment, const std::string& file, io::Problems& problems) {
  const auto refuse = [&](const std::string& why) {
    problems.add(file, 0, "--set " + io::in_quotes(assignment) + ": " + why);
  };
  const auto equals = assignment.find('=');
  const auto steps = steps_of(std::string_view(assignment).substr(0, equals));
  if (equals == std::string::npos || !steps || steps->empty()) {
    return refuse("expected path=value, such as method.courant=0.3 or notches[0].angle_deg=30");
  }
  JsonValue* at = &root;
  for (const Step& step : *steps) {
    if (step.index) {
      if (!at->is(Kind::array)) return refuse("an index where the scene has " + at->description());
      if (*step.index > at->items.size()) {
        return refuse("index " + std::to_string(*step.index) + ", but there are " + std::to_string(at->items.size()) +
                      " entries");
      }
      if (*step.index == at->items.size()) at->items.emplace_back().kind = Kind::object;
      at = &at->items[*step.index];
      continue;
    }
    if (at == root.find("material") && at->is(Kind::string)) give_file_a_key(*at);
    if (!at->is(Kind::object)) return refuse(io::in_quotes(step.name) + " where the scene has " + at->description());
    JsonValue* member = nullptr;
    for (JsonValue& m : at->items) {
      if (m.key == step.name) member = &m;
    }
    if (member == nullptr) {
      member = &at->items.emplace_back();
      member->kind = Kind::object;
      member->key = step.name;
    }
    at = member;
  }
  std::string key = std::move(at->key);
  *at = value_of(assignment.substr(equals + 1));
  at->key = std::move(key);
}

std::string to_text(const JsonValue& root) {
  std::string out;
  write(root, "", out);
  return out + "\n";
}

}  // namespace fpz::specimen
