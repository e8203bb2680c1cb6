// The documentation against the code, and the checks of it against pages made up for the purpose.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "blocks.hpp"
#include "equations.hpp"
#include "fpz/io/markdown.hpp"

namespace fpz::docs {
namespace {

namespace fs = std::filesystem;

constexpr int first_equation = 17;
constexpr int last_equation = 69;

std::string read(const fs::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> pages() {
  const fs::path root = FPZ_SOURCE_DIR;
  std::vector<fs::path> found = {root / "README.md", root / "sph/README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs")) found.push_back(entry.path());
  for (const auto& entry : fs::recursive_directory_iterator(root / "data")) found.push_back(entry.path());
  std::erase_if(found, [](const fs::path& p) { return p.extension() != ".md"; });
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Documentation, ProseHasReadableLines) {
  ASSERT_GT(pages().size(), 10U);
  for (const fs::path& page : pages()) {
    for (const io::LongLine& line : io::long_lines(read(page))) {
      ADD_FAILURE() << page.string() << ":" << line.number << ": " << line.length << " characters";
    }
  }
}

TEST(Documentation, EveryTableOfTheCodeIsOnAPage) {
  std::vector<std::string> found;
  for (const fs::path& page : pages()) {
    const Rewritten now = rewrite_blocks(read(page), all_tables());
    found.insert(found.end(), now.found.begin(), now.found.end());
  }
  for (const NamedTable& table : all_tables())
    EXPECT_EQ(std::count(found.begin(), found.end(), table.name), 1) << table.name;
}

TEST(Documentation, EveryEquationIsFoundInTheCode) {
  const fs::path root = FPZ_SOURCE_DIR;
  std::set<int> missing;
  for (int k = first_equation; k <= last_equation; ++k) missing.insert(k);
  for (const IndexRow& row : read_equation_index(read(root / "docs/equation-index.md"))) {
    const std::string at = "docs/equation-index.md:" + std::to_string(row.line) + ": ";
    EXPECT_FALSE(row.places.empty()) << at << "names no place in the code";
    std::set<int> mentioned;
    for (const CodePlace& place : row.places) {
      const std::string text = read(root / place.file);
      EXPECT_TRUE(has_word(text, place.name)) << at << place.file << " has no " << place.name;
      mentioned.merge(mentioned_equations(text));
    }
    for (const int k : row.equations) {
      EXPECT_TRUE(mentioned.contains(k)) << at << "none of the files mentions eq " << k;
      missing.erase(k);
    }
  }
  for (const int k : missing) ADD_FAILURE() << "docs/equation-index.md has no row for eq " << k;
}

std::string greeting() { return "| hello |\n"; }
constexpr NamedTable made_up[] = {{"greeting", greeting}, {"elsewhere", nullptr}};

TEST(Blocks, AreReplacedByWhatTheCodeSays) {
  const Rewritten now = rewrite_blocks("a\n<!-- table: greeting -->\n| stale |\n<!-- end of table -->\nb\n", made_up);
  EXPECT_TRUE(now.problems.empty());
  EXPECT_EQ(now.text, "a\n<!-- table: greeting -->\n| hello |\n<!-- end of table -->\nb\n");
  EXPECT_EQ(rewrite_blocks(now.text, made_up).text, now.text);
}

TEST(Blocks, StayWhenTheirPartIsNotBuilt) {
  const std::string page = "<!-- table: elsewhere -->\n| kept |\n<!-- end of table -->\n";
  EXPECT_EQ(rewrite_blocks(page, made_up).text, page);
  EXPECT_TRUE(rewrite_blocks(page, made_up).problems.empty());
}

TEST(Blocks, UnknownNamesAndMissingEndsAreProblems) {
  const std::string unknown = "\n<!-- table: gretting -->\n| kept |\n<!-- end of table -->\n";
  ASSERT_EQ(rewrite_blocks(unknown, made_up).problems.size(), 1U);
  EXPECT_EQ(rewrite_blocks(unknown, made_up).problems[0], "line 2: there is no table \"gretting\" in the code");
  EXPECT_EQ(rewrite_blocks(unknown, made_up).text, unknown);
  const std::string open = "<!-- table: greeting -->\n| kept |\n";
  EXPECT_EQ(rewrite_blocks(open, made_up).problems.size(), 1U);
  EXPECT_EQ(rewrite_blocks(open, made_up).text, open);
}

TEST(EquationIndex, ReadsListsAndRanges) {
  EXPECT_EQ(leading_numbers("33 x"), (std::set<int>{33}));
  EXPECT_EQ(leading_numbers("17, 19-21 and 23"), (std::set<int>{17, 19, 20, 21, 23}));
  EXPECT_TRUE(leading_numbers("eq").empty());
  EXPECT_EQ(mentioned_equations("(eq 44-46), eqs 47 and 48; seq 50"), (std::set<int>{44, 45, 46, 47, 48}));
}

TEST(EquationIndex, ReadsRows) {
  const auto rows =
      read_equation_index("| eq | what | where |\n| --- | --- | --- |\n| 1, 2 | a | `f.hpp: g`, `h.cpp: k` |\n");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].line, 3);
  EXPECT_EQ(rows[0].equations, (std::set<int>{1, 2}));
  ASSERT_EQ(rows[0].places.size(), 2U);
  EXPECT_EQ(rows[0].places[1].file, "h.cpp");
  EXPECT_EQ(rows[0].places[1].name, "k");
}

TEST(EquationIndex, NamesAreWholeWords) {
  EXPECT_TRUE(has_word("double damage(x)", "damage"));
  EXPECT_FALSE(has_word("double damage_energy(x)", "damage"));
}

}  // namespace
}  // namespace fpz::docs
