#include "reference_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "fpz/io/csv.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/io/json_locator.hpp"

namespace fpz::report {
namespace {

std::string command(const std::filesystem::path& file, const std::vector<Condition>& wanted) {
  std::string text = "fpz-notched-reference";
  for (const Condition& c : wanted) text += " --" + c.name + "=" + c.value;
  return text + " -o " + file.string();
}

/// Takes the lines "# name = value" (and other lines that begin with #) off the text.
std::map<std::string, std::string> take_header(std::string& text) {
  std::map<std::string, std::string> header;
  std::istringstream in(text);
  std::string rest;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#")) {
      rest += line + "\n";
      continue;
    }
    const auto equals = line.find(" = ");
    if (equals != std::string::npos) header[line.substr(2, equals - 2)] = line.substr(equals + 3);
  }
  text = rest;
  return header;
}

bool agree(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char *end_a = nullptr, *end_b = nullptr;
  const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
  const bool numbers = end_a != a.c_str() && *end_a == '\0' && end_b != b.c_str() && *end_b == '\0';
  return numbers && std::abs(x - y) <= 1e-9 * std::abs(y);
}

}  // namespace

ReferenceCurve read_reference_curve(const std::filesystem::path& file, const std::vector<Condition>& wanted) {
  const auto refuse = [&](const std::string& why) {
    throw io::InputError(file.string() + ": " + why + "; a matching file is made by\n  " + command(file, wanted));
  };
  std::string text, error;
  if (!io::load_text(file, io::FileKind::regular, io::ReadLimits(), text, error)) refuse("cannot be read: " + error);
  const auto header = take_header(text);
  for (const Condition& c : wanted) {
    if (!c.acts) continue;
    const auto at = header.find(c.name);
    if (at == header.end()) refuse("does not state \"" + c.name + "\"");
    if (!agree(at->second, c.value)) refuse(c.name + " is " + at->second + ", the run has " + c.value);
  }
  const io::Table t = io::parse_csv(text, file.string());
  return {t.at("load"), t.at("cmod"), t.at("deflection_mid_depth")};
}

}  // namespace fpz::report
