#include "blocks.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

namespace fpz::docs {
namespace {

constexpr std::string_view opening = "<!-- table: ";
constexpr std::string_view closing = "<!-- end of table -->";

/// The name in an opening line.
std::optional<std::string> opened(std::string_view line) {
  constexpr std::string_view end = " -->";
  if (!line.starts_with(opening) || !line.ends_with(end)) return std::nullopt;
  return std::string(line.substr(opening.size(), line.size() - opening.size() - end.size()));
}

}  // namespace

Rewritten rewrite_blocks(const std::string& page, std::span<const NamedTable> tables) {
  Rewritten out;
  std::istringstream lines(page);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    out.text += line + "\n";
    const std::optional<std::string> name = opened(line);
    if (!name) continue;
    out.found.push_back(*name);
    const auto at = "line " + std::to_string(number) + ": ";
    std::string old;
    bool ended = false;
    while (!ended && std::getline(lines, line)) {
      ++number;
      ended = line == closing;
      if (!ended) old += line + "\n";
    }
    if (!ended) {
      out.problems.push_back(at + "the table \"" + *name + "\" has no line " + std::string(closing));
      out.text += old;
      break;
    }
    const auto table = std::find_if(tables.begin(), tables.end(), [&](const NamedTable& t) { return t.name == *name; });
    if (table == tables.end()) out.problems.push_back(at + "there is no table \"" + *name + "\" in the code");
    const bool known = table != tables.end() && table->markdown != nullptr;
    out.text += (known ? table->markdown() : old) + std::string(closing) + "\n";
  }
  return out;
}

}  // namespace fpz::docs
