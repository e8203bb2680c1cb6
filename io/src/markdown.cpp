#include "fpz/io/markdown.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace fpz::io {
namespace {

/// Characters of UTF-8, without what stands between "](" and ")".
std::size_t visible_length(std::string_view line) {
  std::size_t length = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const bool continues = (static_cast<unsigned char>(line[k]) & 0xC0U) == 0x80U;
    if (!continues) ++length;
    if (!line.substr(k).starts_with("](")) continue;
    const std::size_t end = line.find(')', k);
    if (end == std::string_view::npos) continue;
    length += 2;
    k = end;
  }
  return length;
}

std::size_t indentation(std::string_view line) { return std::min(line.find_first_not_of(' '), line.size()); }

/// Is the line prose? `fenced` says whether it stands in a fenced code block, and is kept up to date.
bool is_prose(std::string_view line, bool& fenced) {
  const std::string_view text = line.substr(indentation(line));
  const bool fence = text.starts_with("```");
  if (fence) fenced = !fenced;
  return !fenced && !fence && !line.starts_with("    ") && !text.starts_with('|') && !text.starts_with("![");
}

bool is_number_with_dot(std::string_view word) {
  return word.size() > 1 && word.back() == '.' && word.find_first_not_of("0123456789") == word.size() - 1;
}

/// Would the word mean something else at the begin of a line: an entry of a list, a heading, a quotation, a table?
bool is_marker(std::string_view word) {
  return word == "-" || word == "*" || word == "+" || word.starts_with('#') || word.starts_with('>') ||
         word.starts_with('|') || is_number_with_dot(word);
}

/// Width of the marker of a list's entry with the space behind it; 0 for other text.
std::size_t entry_marker(std::string_view text) {
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return 0;
  const std::string_view word = text.substr(0, space);
  return word == "-" || word == "*" || word == "+" || is_number_with_dot(word) ? space + 1 : 0;
}

/// Lines that are one paragraph or one entry of a list.
using Paragraph = std::vector<std::string>;

/// The words of a paragraph; short code in backticks is one word.
std::vector<std::string> words_of(const Paragraph& paragraph, std::size_t longest_code) {
  std::vector<std::string> words;
  std::size_t code = 0;  // words that the code has so far; 0: outside
  for (const std::string& line : paragraph) {
    std::istringstream in(line);
    for (std::string word; in >> word;) {
      const bool odd = std::count(word.begin(), word.end(), '`') % 2 != 0;
      words.push_back(word);
      if (odd || code > 0) ++code;
      if (!odd || code < 2) continue;
      std::string whole;
      for (std::size_t k = words.size() - code; k < words.size(); ++k) whole += (whole.empty() ? "" : " ") + words[k];
      if (whole.size() <= longest_code) {
        words.resize(words.size() - code);
        words.push_back(whole);
      }
      code = 0;
    }
  }
  return words;
}

void fill(const Paragraph& paragraph, std::size_t most, std::string& page) {
  const std::string& first = paragraph.front();
  const std::size_t marker = entry_marker(std::string_view(first).substr(indentation(first)));
  const std::string hanging(indentation(first) + marker, ' ');
  std::vector<std::string> words = words_of(paragraph, most / 2);
  if (marker > 0) {  // the marker and the first word stay together
    words[1].insert(0, first.substr(indentation(first), marker));
    words.erase(words.begin());
  }
  std::string indent(indentation(first), ' ');
  for (std::size_t begin = 0; begin < words.size();) {
    std::string line = indent + words[begin];
    std::size_t end = begin + 1;
    while (end < words.size() && visible_length(line + " " + words[end]) <= most) line += " " + words[end++];
    while (end < words.size() && end > begin + 1 && is_marker(words[end])) {
      --end;
      line.resize(line.size() - words[end].size() - 1);
    }
    page += line + "\n";
    indent = hanging;
    begin = end;
  }
}

void write(const Paragraph& paragraph, std::size_t most, std::string& page) {
  const bool fits = std::all_of(paragraph.begin(), paragraph.end(),
                                [most](const std::string& line) { return visible_length(line) <= most; });
  if (!fits) return fill(paragraph, most, page);
  for (const std::string& line : paragraph) page += line + "\n";
}

}  // namespace

std::vector<LongLine> long_lines(const std::string& page, std::size_t most) {
  std::vector<LongLine> found;
  std::istringstream lines(page);
  std::string line;
  bool fenced = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!is_prose(line, fenced)) continue;
    if (const std::size_t length = visible_length(line); length > most) found.push_back({number, length});
  }
  return found;
}

std::string wrap_prose(const std::string& page, std::size_t most) {
  std::string out;
  Paragraph paragraph;
  const auto close = [&] {
    if (!paragraph.empty()) write(paragraph, most, out);
    paragraph.clear();
  };
  std::istringstream lines(page);
  std::string line;
  bool fenced = false;
  while (std::getline(lines, line)) {
    const std::string_view text = std::string_view(line).substr(indentation(line));
    const bool prose = is_prose(line, fenced) && !text.empty() && !text.starts_with('#') && !text.starts_with('<');
    if (!prose || entry_marker(text) > 0) close();
    if (prose) {
      paragraph.push_back(line);
    } else {
      out += line + "\n";
    }
    if (line.ends_with("  ") || line.ends_with('\\')) close();  // the line break is meant
  }
  close();
  return out;
}

}  // namespace fpz::io
