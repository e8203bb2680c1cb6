#include "fpz/io/html.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace fpz::io {
namespace {

TEST(Html, Base64OfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

std::string body(const std::string& markdown, const std::filesystem::path& folder = ".") {
  const std::string page = html_page("t", markdown, folder);
  const std::size_t begin = page.find("<body>\n") + 7;
  return page.substr(begin, page.find("</body>") - begin);
}

TEST(Html, Blocks) {
  EXPECT_EQ(body("## Two **words**\n\na < b,\n`c & d`\n"),
            "<h2>Two <strong>words</strong></h2>\n<p>a &lt; b, <code>c &amp; d</code></p>\n");
  EXPECT_EQ(body("- one\n- two\n  goes on\n"), "<ul>\n<li>one</li>\n<li>two goes on</li>\n</ul>\n");
  EXPECT_EQ(body("| a | b |\n| --- | --- |\n| 1 \\| 2 | **3** |\n"),
            "<table>\n<tr><th>a</th><th>b</th></tr>\n<tr><td>1 | 2</td><td><strong>3</strong></td></tr>\n</table>\n");
  EXPECT_EQ(body("see [x](y.md), 2 * 3\n"), "<p>see <a href=\"y.md\">x</a>, 2 * 3</p>\n");
}

TEST(Html, PicturesAreInside) {
  const test::TemporaryFolder folder;
  folder.write("a.png", "foobar");
  EXPECT_NE(body("![A](a.png)\n", folder.path()).find("src=\"data:image/png;base64,Zm9vYmFy\""), std::string::npos);
  folder.write("a.svg", "foo");
  EXPECT_NE(body("![A](a.png)\n", folder.path()).find("src=\"data:image/svg+xml;base64,Zm9v\""), std::string::npos);
  EXPECT_NE(body("![B](b.png)\n", folder.path()).find("(picture b.png:"), std::string::npos);
}

}  // namespace
}  // namespace fpz::io
