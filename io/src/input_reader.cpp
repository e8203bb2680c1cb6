#include "fpz/io/input_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace fpz::io {
namespace {

using Kind = JsonValue::Kind;

/// What to do about a string where a number belongs; empty when nothing can be guessed.
std::string advice_on_string(std::string_view text) {
  std::string lower = lower_case(std::string(text.substr(0, 16)));
  std::erase_if(lower, [](char c) { return c == '+' || c == '-'; });
  if (lower == "nan" || lower == "inf" || lower == "infinity") return ": NaN and infinity are not allowed";
  const bool numeric = !text.empty() && text.find_first_not_of("0123456789+-.eE") == std::string_view::npos;
  return numeric ? ": write it without quotes" : "";
}

}  // namespace

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

void InputReader::problem(const Place& place, const std::string& text) const {
  const std::string path = place.path();
  problems_.add(file_, place.line(), path.empty() ? text : path + ": " + text);
}

std::string InputReader::where(const Place& place) const {
  const std::string path = place.path();
  const std::string line = place.line() > 0 ? std::to_string(place.line()) + ':' : "";  // none: from the command line
  return file_ + ':' + line + (path.empty() ? "" : " " + path);
}

bool InputReader::object(const Place& place, const char* content) const {
  if (!place.value().is(Kind::object)) {
    problem(place, "expected an object with " + std::string(content) + ", found " + place.value().description());
    return false;
  }
  if (place.value().items.empty()) {
    problem(place, "the object is empty; expected " + std::string(content));
    return false;
  }
  return true;
}

bool InputReader::array(const Place& place, const char* content) const {
  if (!place.value().is(Kind::array)) {
    problem(place, "expected an array of " + std::string(content) + ", found " + place.value().description());
    return false;
  }
  if (place.value().items.empty()) {
    problem(place, "the array is empty; expected " + std::string(content));
    return false;
  }
  return true;
}

void InputReader::known_keys(const Place& object, std::span<const std::string_view> valid,
                             const std::function<bool(const JsonValue&)>& also) const {
  for (const JsonValue& member : object.value().items) {
    if (std::find(valid.begin(), valid.end(), member.key) != valid.end()) continue;
    if (also && also(member)) continue;
    problem(Place(object, member), "unknown key " + in_quotes(member.key) + suggestion(member.key, valid));
  }
}

const JsonValue* InputReader::required(const Place& object, std::string_view key) const {
  const JsonValue* value = object.value().find(key);
  if (value == nullptr) problem(object, "missing key " + in_quotes(key));
  return value;
}

std::optional<double> InputReader::number(const Place& place) const {
  const JsonValue& v = place.value();
  if (v.is(Kind::number)) return v.number;
  problem(place, "expected a number, found " + v.description() + (v.is(Kind::string) ? advice_on_string(v.text) : ""));
  return std::nullopt;
}

std::optional<double> InputReader::number_between(const Place& place, double lower, double upper, bool included) const {
  const std::optional<double> x = number(place);
  if (!x) return std::nullopt;
  if (included ? (*x >= lower && *x <= upper) : (*x > lower && *x < upper)) return x;
  const std::string sign = included ? "= " : " ";
  problem(place, shown(place.value().text) + ": must be >" + sign + exact(lower) + " and <" + sign + exact(upper));
  return std::nullopt;
}

std::optional<double> InputReader::positive(const Place& place) const {
  const std::optional<double> x = number(place);
  if (!x || *x > 0.0) return x;
  problem(place, shown(place.value().text) + ": must be > 0");
  return std::nullopt;
}

std::optional<int> InputReader::integer(const Place& place, int lower, int upper) const {
  const std::optional<double> x = number(place);
  if (!x) return std::nullopt;
  if (*x != std::floor(*x)) {
    problem(place, shown(place.value().text) + ": must be a whole number");
    return std::nullopt;
  }
  if (*x >= lower && *x <= upper) return static_cast<int>(*x);
  problem(place,
          shown(place.value().text) + ": must be >= " + std::to_string(lower) + " and <= " + std::to_string(upper));
  return std::nullopt;
}

std::optional<std::string> InputReader::text(const Place& place, std::size_t longest) const {
  const JsonValue& v = place.value();
  if (!v.is(Kind::string)) {
    problem(place, "expected a string, found " + v.description());
  } else if (v.text.empty()) {
    problem(place, "the string is empty");
  } else if (v.text.size() > longest) {
    problem(place, "the string is longer than " + std::to_string(longest) + " bytes");
  } else {
    return v.text;
  }
  return std::nullopt;
}

}  // namespace fpz::io
