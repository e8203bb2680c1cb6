#include "fpz/io/quantity_reader.hpp"

#include <charconv>

#include "fpz/io/input_error.hpp"

namespace fpz::io {
namespace {

using Kind = JsonValue::Kind;
constexpr std::size_t longest_name = 200;

}  // namespace

std::optional<Unit> read_unit(const InputReader& reader, const Place& object, Quantity quantity) {
  const JsonValue* given = object.value().is(Kind::object) ? object.value().find("unit") : nullptr;
  if (given == nullptr) return units(quantity).front();
  const Place at(object, *given);
  const auto name = reader.text(at, longest_name);
  if (!name) return std::nullopt;
  if (const std::optional<Unit> known = find_unit(quantity, *name)) return known;
  std::vector<std::string_view> names;
  for (const Unit& unit : units(quantity)) names.push_back(unit.name);
  reader.problem(at, "unknown unit " + in_quotes(*name) + suggestion(*name, names));
  return std::nullopt;
}

std::optional<Written> read_written(const InputReader& reader, const Place& at, Quantity quantity,
                                    const std::vector<std::string_view>& also) {
  if (!at.value().is(Kind::object)) {
    const auto x = reader.number(at);
    if (!x) return std::nullopt;
    return Written{*x, *x, si_unit(quantity)};
  }
  std::vector<std::string_view> keys = {"value", "unit"};
  keys.insert(keys.end(), also.begin(), also.end());
  reader.known_keys(at, keys);
  const auto unit = read_unit(reader, at, quantity);
  const JsonValue* value = reader.required(at, "value");
  const auto x = value != nullptr ? reader.number(Place(at, *value)) : std::nullopt;
  if (!unit || !x) return std::nullopt;
  return Written{*x * unit->factor, *x, unit->name};
}

Written written_in(std::string_view text, Quantity quantity, const std::string& what) {
  const std::string given = what + " " + std::string(text) + ": ";
  double x = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc()) throw InputError(given + "must be a number with its unit, such as 100mm");
  std::string_view name = text.substr(static_cast<std::size_t>(end - text.data()));
  while (name.starts_with(' ')) name.remove_prefix(1);
  std::vector<std::string_view> names;
  for (const Unit& unit : units(quantity)) names.push_back(unit.name);
  if (name.starts_with(',')) throw InputError(given + "write the number with a decimal point");
  if (name.empty()) throw InputError(given + "say the unit" + suggestion("", names));
  const std::optional<Unit> unit = find_unit(quantity, name);
  if (!unit) throw InputError(given + "unknown unit " + in_quotes(name) + suggestion(name, names));
  return {x * unit->factor, x, unit->name};
}

}  // namespace fpz::io
