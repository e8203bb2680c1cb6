#include "fpz/io/html.hpp"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <vector>

#include "fpz/io/json_locator.hpp"

namespace fpz::io {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view style =
    "body{font-family:sans-serif;line-height:1.45;max-width:60em;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0;display:block;overflow-x:auto}"
    "th,td{border:1px solid #ccc;padding:.25em .6em;text-align:left}th{background:#f2f2f2}"
    "img{max-width:100%}code,pre{background:#f5f5f5}pre{padding:.6em;overflow-x:auto}figure{margin:1em 0}"
    "figcaption{color:#555;font-size:.9em}";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string element(std::string_view name, const std::string& content) {
  std::string out = "<";
  out.append(name).append(">").append(content).append("</").append(name).append(">");
  return out;
}

/// Code, bold and links within a line.
std::string inline_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t at = text.find_first_of("`*[");
    out += escaped(text.substr(0, at));
    if (at == std::string_view::npos) break;
    text.remove_prefix(at);
    const auto enclosed = [&](std::string_view mark) -> std::string_view {
      const std::size_t end = text.starts_with(mark) ? text.find(mark, mark.size()) : std::string_view::npos;
      return end == std::string_view::npos ? std::string_view() : text.substr(mark.size(), end - mark.size());
    };
    if (const auto code = enclosed("`"); !code.empty()) {
      out += element("code", escaped(code));
      text.remove_prefix(code.size() + 2);
      continue;
    }
    if (const auto bold = enclosed("**"); !bold.empty()) {
      out += element("strong", inline_text(bold));
      text.remove_prefix(bold.size() + 4);
      continue;
    }
    const std::size_t middle = text.front() == '[' ? text.find("](") : std::string_view::npos;
    const std::size_t end = middle == std::string_view::npos ? middle : text.find(')', middle);
    if (end != std::string_view::npos) {
      out.append("<a href=\"").append(escaped(text.substr(middle + 2, end - middle - 2))).append("\">");
      out.append(inline_text(text.substr(1, middle - 1))).append("</a>");
      text.remove_prefix(end + 1);
      continue;
    }
    out += escaped(text.substr(0, 1));
    text.remove_prefix(1);
  }
  return out;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// Cells of a line "| a | b |"; a bar behind a backslash belongs to its cell.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  line = trimmed(line);
  line.remove_prefix(1);
  if (line.ends_with('|')) line.remove_suffix(1);
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '\\' && k + 1 < line.size() && line[k + 1] == '|') {
      cells.back() += '|';
      ++k;
    } else if (line[k] == '|') {
      cells.emplace_back();
    } else {
      cells.back() += line[k];
    }
  }
  return cells;
}

class PageWriter {
 public:
  PageWriter(const std::string& markdown, const fs::path& folder) : folder_(folder) {
    std::istringstream in(markdown);
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
  }

  std::string write() {
    while (at_ < lines_.size()) block();
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::string_view line() const { return lines_[at_]; }
  [[nodiscard]] bool begins_block() const {
    const std::string_view l = line();
    return trimmed(l).empty() || l.starts_with('#') || l.starts_with('|') || l.starts_with("- ") ||
           l.starts_with("```") || l.starts_with("![");
  }

  void block() {
    const std::string_view l = line();
    if (trimmed(l).empty()) {
      ++at_;
    } else if (l.starts_with('#')) {
      const std::size_t level = std::min(l.find_first_not_of('#'), std::size_t{6});
      const std::string tag{'h', static_cast<char>('0' + level)};
      out_ += element(tag, inline_text(trimmed(l.substr(std::min(level, l.size()))))) + "\n";
      ++at_;
    } else if (l.starts_with("```")) {
      fenced();
    } else if (l.starts_with('|')) {
      table();
    } else if (l.starts_with("- ")) {
      list();
    } else if (l.starts_with("![")) {
      picture(l);
      ++at_;
    } else {
      out_ += element("p", inline_text(paragraph())) + "\n";
    }
  }

  /// The line at hand and those that go on with it.
  std::string paragraph() {
    std::string text(trimmed(line()));
    for (++at_; at_ < lines_.size() && !begins_block(); ++at_) text.append(" ").append(trimmed(line()));
    return text;
  }

  void fenced() {
    std::string text;
    for (++at_; at_ < lines_.size() && !line().starts_with("```"); ++at_) text.append(line()).append("\n");
    ++at_;
    out_ += element("pre", escaped(text)) + "\n";
  }

  void list() {
    out_ += "<ul>\n";
    while (at_ < lines_.size() && line().starts_with("- ")) {
      lines_[at_].erase(0, 2);
      out_ += element("li", inline_text(paragraph())) + "\n";
    }
    out_ += "</ul>\n";
  }

  void table() {
    out_ += "<table>\n";
    for (std::size_t row = 0; at_ < lines_.size() && line().starts_with('|'); ++at_, ++row) {
      if (row == 1 && line().find_first_not_of("|-: ") == std::string_view::npos) continue;
      out_ += "<tr>";
      for (const std::string& cell : cells_of(line())) {
        out_ += element(row == 0 ? "th" : "td", inline_text(trimmed(cell)));
      }
      out_ += "</tr>\n";
    }
    out_ += "</table>\n";
  }

  void picture(std::string_view l) {
    const std::size_t middle = l.find("](");
    const std::size_t end = l.find(')', middle);
    if (middle == std::string_view::npos || end == std::string_view::npos) {
      out_ += element("p", escaped(l)) + "\n";
      return;
    }
    const std::string caption(l.substr(2, middle - 2)), name(l.substr(middle + 2, end - middle - 2));
    fs::path file = folder_ / name;
    const fs::path drawing = fs::path(file).replace_extension(".svg");
    std::error_code ignored;
    if (fs::exists(drawing, ignored)) file = drawing;
    std::string bytes, error;
    if (!load_text(file, FileKind::regular, ReadLimits(), bytes, error)) {
      out_.append("<p>(picture ").append(escaped(name)).append(": ").append(escaped(error)).append(")</p>\n");
      return;
    }
    const char* type = file.extension() == ".svg" ? "image/svg+xml" : "image/png";
    out_.append("<figure><img alt=\"").append(escaped(caption)).append("\" src=\"data:").append(type);
    out_.append(";base64,").append(base64(bytes)).append("\">").append(element("figcaption", inline_text(caption)));
    out_ += "</figure>\n";
  }

  const fs::path& folder_;
  std::vector<std::string> lines_;
  std::size_t at_ = 0;
  std::string out_;
};

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t three = 0;
    for (std::size_t j = 0; j < 3; ++j) three = three << 8 | (j < n ? static_cast<unsigned char>(bytes[k + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) out += j <= n ? letters[three >> (18 - 6 * j) & 63U] : '=';
  }
  return out;
}

std::string html_page(const std::string& title, const std::string& markdown, const fs::path& folder) {
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += element("title", escaped(title)) + "\n" + element("style", std::string(style)) + "\n</head>\n<body>\n";
  page += PageWriter(markdown, folder).write();
  return page + "</body>\n</html>\n";
}

}  // namespace fpz::io
