#include "quantity_reader.hpp"

#include <algorithm>

namespace fpz::calibration::detail {
namespace {

using Kind = JsonValue::Kind;
constexpr std::size_t longest_name = 200;

}  // namespace

void Context::judge(const Place& at, std::string_view what, const Written& value, const Typical& typical) const {
  const Judgement j = io::judge(what, value, typical);
  if (j.verdict == Verdict::impossible) problem(at, j.text);
  if (j.verdict == Verdict::doubtful) warn(at, j.text);
}

std::optional<Unit> read_unit(const Context& c, const Place& object, Quantity quantity) {
  return io::read_unit(c.reader, object, quantity);
}

std::optional<Written> read_written(const Context& c, const Place& at, Quantity quantity,
                                    const std::vector<std::string_view>& also) {
  return io::read_written(c.reader, at, quantity, also);
}

std::optional<double> read_judged(const Context& c, const Place& at, const Typical& typical) {
  const auto x = read_written(c, at, typical.quantity);
  if (!x) return std::nullopt;
  if (x->si <= 0.0) {
    c.problem(at, io::exact(x->number) + ": must be > 0");
    return std::nullopt;
  }
  c.judge(at, at.value().key, *x, typical);
  return x->si;
}

std::optional<double> read_member(const Context& c, const Place& object, std::string_view key, const Unit& unit,
                                  const Typical& typical, bool required, bool zero_allowed) {
  const JsonValue* value = required ? c.reader.required(object, key) : object.value().find(key);
  if (value == nullptr) return std::nullopt;
  const Place at(object, *value);
  const auto x = c.reader.number(at);
  if (!x) return std::nullopt;
  if (zero_allowed && *x == 0.0) return 0.0;
  if (*x <= 0.0) {
    c.problem(at, io::exact(*x) + (zero_allowed ? ": must be >= 0" : ": must be > 0"));
    return std::nullopt;
  }
  c.judge(at, key, {*x * unit.factor, *x, unit.name}, typical);
  return *x * unit.factor;
}

std::optional<std::size_t> read_choice(const Context& c, const Place& at, const char* what,
                                       std::span<const std::string_view> names) {
  const auto text = c.reader.text(at, longest_name);
  if (!text) return std::nullopt;
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  c.problem(at, "unknown " + std::string(what) + ' ' + io::in_quotes(*text) + io::suggestion(*text, names));
  return std::nullopt;
}

std::optional<bool> read_boolean(const Context& c, const Place& at) {
  if (at.value().is(Kind::boolean)) return at.value().boolean;
  c.problem(at, "expected true or false, found " + at.value().description());
  return std::nullopt;
}

}  // namespace fpz::calibration::detail
