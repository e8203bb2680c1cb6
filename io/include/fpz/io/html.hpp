// A Markdown page as one HTML file with its pictures inside.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace fpz::io {

/// The bytes in base64 (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

/// A page of headings, paragraphs, lists, tables, fenced code, pictures, `code`, **bold** and [links](target) as a
/// complete HTML document that needs no other file: pictures that the page names, relative to `folder`, are inside, as
/// SVG where such a file stands beside a PNG. A picture that cannot be read is named in its place.
[[nodiscard]] std::string html_page(const std::string& title, const std::string& markdown,
                                    const std::filesystem::path& folder);

}  // namespace fpz::io
