// Tables of the documentation that are made of tables in the code. In docs/*.md they stand between the lines
//   <!-- table: NAME -->
//   <!-- end of table -->
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fpz::docs {

/// A table under its name. `markdown` is null when the part of the code that holds it is not in this build.
struct NamedTable {
  std::string_view name;
  std::string (*markdown)();
};

/// All tables that a page may name.
[[nodiscard]] std::span<const NamedTable> all_tables();

struct Rewritten {
  std::string text;                   ///< with every block brought up to date
  std::vector<std::string> problems;  ///< unknown names and blocks without an end, with their lines
  std::vector<std::string> found;     ///< names of the blocks, in their order
};

/// Puts into every block of a page what its table gives; blocks of tables that are not in this build stay.
[[nodiscard]] Rewritten rewrite_blocks(const std::string& page, std::span<const NamedTable> tables);

}  // namespace fpz::docs
