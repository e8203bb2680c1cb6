#include "fpz/io/markdown.hpp"

#include <gtest/gtest.h>

namespace fpz::io {
namespace {

TEST(Markdown, CountsCharactersOfProseOnly) {
  EXPECT_EQ(long_lines("12345\n123456\n", 5).size(), 1U);
  EXPECT_EQ(long_lines("12345\n123456\n", 5).at(0).number, 2);
  EXPECT_TRUE(long_lines("µµµµµ\n", 5).empty());
  EXPECT_TRUE(long_lines("[a](https://example.org)\n", 5).empty());
  EXPECT_EQ(long_lines("[a](https://example.org)b\n", 5).at(0).length, 6U);
  EXPECT_TRUE(long_lines("| 123456 |\n![123456](x)\n    123456\n```\n123456\n```\n", 5).empty());
  EXPECT_EQ(long_lines("```\n123456\n```\n123456\n", 5).at(0).number, 4);
}

TEST(Markdown, FillsParagraphsWithALongLine) {
  EXPECT_EQ(wrap_prose("aa bb cc\ndd\n", 5), "aa bb\ncc dd\n");
  EXPECT_EQ(wrap_prose("aa\nbb\n", 5), "aa\nbb\n");
  EXPECT_EQ(wrap_prose("[aa](target) b cccc\n", 8), "[aa](target) b\ncccc\n");
}

TEST(Markdown, KeepsListsCodeTablesAndHeadings) {
  EXPECT_EQ(wrap_prose("- aa bb cc\n- dd\n", 7), "- aa bb\n  cc\n- dd\n");
  EXPECT_EQ(wrap_prose("12. aa bb\n", 6), "12. aa\n    bb\n");
  const std::string kept = "# aaaa bbbb\n\n    aaaa bbbb\n\n| aaaa | bbbb |\n\n```\naaaa bbbb\n```\n";
  EXPECT_EQ(wrap_prose(kept, 5), kept);
}

TEST(Markdown, KeepsShortCodeTogether) { EXPECT_EQ(wrap_prose("aaaaaa bb `c d` ee\n", 10), "aaaaaa bb\n`c d` ee\n"); }

TEST(Markdown, BeginsNoLineWithWhatWouldBeAMarker) { EXPECT_EQ(wrap_prose("aa bb - cc\n", 5), "aa\nbb -\ncc\n"); }

}  // namespace
}  // namespace fpz::io
