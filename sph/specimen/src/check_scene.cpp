#include "check_scene.hpp"

#include <cmath>
#include <sstream>

#include "fpz/io/plausibility.hpp"

namespace fpz::specimen::detail {
namespace {

/// A number, a string, or an array of numbers as it stands in the file; nothing for other values.
std::string value_of(const JsonValue& v) {
  if (v.is(JsonValue::Kind::number)) return io::shown(v.text);
  if (v.is(JsonValue::Kind::string)) return io::in_quotes(v.text);
  if (!v.is(JsonValue::Kind::array) || v.items.empty()) return "";
  std::string text;
  for (const JsonValue& item : v.items) {
    if (!item.is(JsonValue::Kind::number)) return "";
    text += text.empty() ? '[' : ',';
    text += text.size() > 1 ? " " : "";
    text += io::shown(item.text);
  }
  text += ']';
  return text;
}

std::string with_value(const Place& at, const std::string& text) {
  const std::string value = value_of(at.value());
  return value.empty() ? text : value + ": " + text;
}

}  // namespace

void SceneCheck::problem(const Place& at, const std::string& constraint) const {
  reader.problem(at, with_value(at, constraint));
}

void SceneCheck::warn(const Place& at, const std::string& text) const {
  warnings.push_back(reader.where(at) + ": " + with_value(at, text));
}

std::string brief(double x) {
  std::ostringstream s;
  s.precision(4);
  s << x;
  return s.str();
}

std::string brief(const Point& x) {
  std::ostringstream s;
  s.precision(4);
  const auto clean = [](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; };  // no -0, no rounding errors
  s << '[' << clean(x[0]) << ", " << clean(x[1]) << ']';
  return s.str();
}

std::string likely_length(double metres, double low, double high) {
  constexpr double far = 20.0;
  if (metres < far * high) return "";
  for (const char* unit : {"mm", "cm", "um"}) {
    const double meant = metres * io::unit_factor(io::Quantity::length, unit).value();
    if (meant < low || meant > high) continue;
    return "; " + brief(metres) + " " + unit + " was probably meant: write " + brief(meant);
  }
  return "";
}

std::string likely_place(const Point& x, const Shape& body) {
  const auto [low, high] = extent(body);
  const double size = (high - low).maxCoeff();
  for (const double coordinate : {x[0], x[1]}) {
    if (coordinate != 0.0 && std::abs(coordinate) < 3.0 * size) return "";
  }
  return likely_length(x.cwiseAbs().maxCoeff(), 1e-3 * size, size);
}

void check_scene(const InputReader& r, const Place& root, Scene& scene) {
  const SceneCheck c{r, root, scene, scene.warnings};
  const std::size_t before = r.problems().size();
  check_loading(c);
  check_end(c);
  if (!scene.has_shape) return;
  // A body in millimetres fits nothing else, and a wrong hole or notch is under every boundary: one thing at a time.
  for (const auto check : {check_sizes, check_holes, check_notches, check_regions, check_interfaces,
                           check_strength_field, check_rows, check_boundaries, check_gauges, check_loads}) {
    if (r.problems().size() > before) return;
    check(c);
  }
}

}  // namespace fpz::specimen::detail
