#include "fpz/io/json_locator.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

namespace fpz::io {
namespace {

using Json = nlohmann::json;
using Kind = JsonValue::Kind;

constexpr std::string_view number_characters = "0123456789+-.eE";

/// Hands the text to the parser and tells how much of it has been taken.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* position, const char* begin, std::size_t* taken)
      : position_(position), begin_(begin), taken_(taken) {}

  reference operator*() const { return *position_; }
  CountingIterator& operator++() {
    ++position_;
    *taken_ = static_cast<std::size_t>(position_ - begin_);
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return position_ == other.position_; }

 private:
  const char* position_;
  const char* begin_;
  std::size_t* taken_;
};

struct Word {
  std::size_t begin = 0;
  std::string_view text;
};

/// The run of characters around `offset` that a person would call one word.
Word word_at(std::string_view text, std::size_t offset) {
  const auto in_word = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' || c == '-' ||
           c == '.' || c == '_';
  };
  if (offset >= text.size() || !in_word(text[offset])) return {offset, {}};
  std::size_t begin = offset;
  std::size_t end = offset + 1;
  while (begin > 0 && in_word(text[begin - 1])) --begin;
  while (end < text.size() && in_word(text[end])) ++end;
  return {begin, text.substr(begin, end - begin)};
}

bool is_not_finite(std::string_view word) {
  std::string lower;
  for (const char c : word.substr(0, 16)) {
    if (c != '+' && c != '-') lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

/// The character before `offset` that is no white space, or 0.
char last_visible(std::string_view text, std::size_t offset) {
  while (offset > 0) {
    const char c = text[--offset];
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return c;
  }
  return '\0';
}

/// The word at which a parse ended: scanning stops at the first character that does not fit, often one past the word.
Word offending_word(std::string_view text, std::size_t offset) {
  const Word word = word_at(text, offset);
  return word.text.empty() && offset > 0 ? word_at(text, offset - 1) : word;
}

std::string hint_on_word(std::string_view word) {
  if (is_not_finite(word)) return in_quotes(word) + " is not a JSON number; NaN and infinity are not allowed";
  const std::string_view digits = word.front() == '-' ? word.substr(1) : word;
  if (digits.size() > 1 && digits[0] == '0' && digits[1] >= '0' && digits[1] <= '9') {
    return "the number " + shown(word) + " has a leading zero";
  }
  if (word.front() == '+') return "the number " + shown(word) + " has a leading '+'";
  if (word.front() == '.') return "the number " + shown(word) + " has no digit before its decimal point";
  return {};
}

/// What is meant by some frequent mistakes; empty for others. `message` is the parser's.
std::string syntax_hint(std::string_view text, std::size_t offset, const Word& word, std::string_view message) {
  const char c = text[offset];
  if (c == '/' || c == '#') return "comments are not allowed; use the key \"description\"";
  if (c == '\'') return "strings and keys are written in double quotes";
  if ((c == '}' || c == ']') && last_visible(text, offset) == ',') return "a comma before the closing bracket";
  if (word.text.empty()) return {};
  std::string hint = hint_on_word(word.text);
  if (!hint.empty()) return hint;
  if (message.find("invalid number") != std::string_view::npos) {
    return in_quotes(word.text) + " is not a JSON number (such as 12, -0.5 or 1e-3)";
  }
  if (message.find("invalid literal") != std::string_view::npos) {
    return in_quotes(word.text) + " is not a JSON value; strings and keys are written in double quotes";
  }
  return {};
}

/// The parser's message without its position (it gives the end of the token) and without the token, which may be long.
std::string plain_message(std::string_view message) {
  message.remove_prefix(std::min(message.find("syntax error"), message.size()));
  std::string text(message.substr(0, message.find("; last read: ")));
  const std::size_t expected = message.rfind("; expected ");
  if (text.size() < message.size() && expected != std::string_view::npos && expected > text.size()) {
    text += message.substr(expected);
  }
  return text;
}

/// Builds the tree. Returning false from a callback ends the parse; the reason is a problem by then.
class Handler {
 public:
  Handler(std::string_view text, const std::size_t& taken, const std::string& file, const ReadLimits& limits,
          Problems& problems)
      : text_(text), taken_(taken), file_(file), limits_(limits), problems_(problems) {}

  bool null() { return leaf(make(Kind::null)); }
  bool boolean(bool b) {
    JsonValue v = make(Kind::boolean);
    v.boolean = b;
    return leaf(std::move(v));
  }
  // The parser calls this one for negative integers only: a zero is "-0", whose sign strtod keeps.
  bool number_integer(Json::number_integer_t n) { return add_number(n == 0 ? -0.0 : static_cast<double>(n)); }
  bool number_unsigned(Json::number_unsigned_t n) { return add_number(static_cast<double>(n)); }
  bool number_float(Json::number_float_t x, const std::string& /*spelling*/) { return add_number(x); }
  bool string(std::string& s) {
    JsonValue v = make(Kind::string);
    v.text = std::move(s);
    return leaf(std::move(v));
  }
  bool binary(Json::binary_t& /*unused*/) { return false; }  // not in JSON text
  bool start_object(std::size_t /*unknown*/) { return open(Kind::object); }
  bool start_array(std::size_t /*unknown*/) { return open(Kind::array); }
  bool key(std::string& k) {
    key_ = std::move(k);
    return true;
  }
  bool end_object() {
    refuse_duplicate_keys(open_.back());
    return close();
  }
  bool end_array() { return close(); }

  bool parse_error(std::size_t position, const std::string& /*token*/, const nlohmann::detail::exception& e) {
    // The parser counts the characters it has read, the end of the text among them.
    const std::size_t offset = std::min(position > 0 ? position - 1 : 0, text_.size());
    std::string_view message = e.what();
    if (message.find("number overflow") != std::string_view::npos) {
      const std::size_t last = number_end() > 0 ? number_end() - 1 : 0;
      const Word word = word_at(text_, last);
      return refuse(word.begin, "the number " + shown(word.text) + " is too large for a double");
    }
    if (offset >= text_.size()) return refuse(offset, "the text ends too early; a bracket or quote is not closed");
    const Word word = offending_word(text_, offset);
    const std::string hint = syntax_hint(text_, offset, word, message);
    if (!hint.empty()) return refuse(word.text.empty() ? offset : word.begin, hint);
    return refuse(offset, plain_message(message));
  }

  std::optional<JsonValue> root;

 private:
  JsonValue make(Kind kind) {
    JsonValue v;
    v.kind = kind;
    v.line = line_at(taken_);
    v.key = std::move(key_);
    key_.clear();
    return v;
  }

  /// The end of the number just read. Only for numbers does the parser take one character too many.
  [[nodiscard]] std::size_t number_end() const {
    const bool all_taken_belongs = taken_ == 0 || number_characters.find(text_[taken_ - 1]) != std::string_view::npos;
    return all_taken_belongs ? taken_ : taken_ - 1;
  }

  bool add_number(double x) {
    const std::size_t end = number_end();
    std::size_t begin = end;
    while (begin > 0 && number_characters.find(text_[begin - 1]) != std::string_view::npos) --begin;
    JsonValue v;
    v.kind = Kind::number;
    v.line = line_at(end);
    v.key = std::move(key_);
    key_.clear();
    v.number = x;
    v.text = text_.substr(begin, end - begin);
    return leaf(std::move(v));
  }

  /// Offsets come in increasing order, so the lines are counted once.
  std::size_t line_at(std::size_t offset) {
    const auto at = [this](std::size_t k) { return text_.begin() + static_cast<std::ptrdiff_t>(k); };
    line_ += static_cast<std::size_t>(std::count(at(counted_), at(offset), '\n'));
    counted_ = offset;
    return line_;
  }

  bool leaf(JsonValue v) {
    if (++values_ > limits_.values) {
      return refuse(taken_, "more than " + std::to_string(limits_.values) + " values in one file");
    }
    if (open_.empty()) {
      root = std::move(v);
    } else {
      open_.back().items.push_back(std::move(v));
    }
    return true;
  }

  bool open(Kind kind) {
    if (open_.size() >= limits_.depth) {
      return refuse(taken_, "brackets are nested deeper than " + std::to_string(limits_.depth));
    }
    open_.push_back(make(kind));
    return true;
  }

  bool close() {
    JsonValue v = std::move(open_.back());
    open_.pop_back();
    return leaf(std::move(v));
  }

  void refuse_duplicate_keys(const JsonValue& object) {
    std::vector<const JsonValue*> members;
    members.reserve(object.items.size());
    for (const JsonValue& m : object.items) members.push_back(&m);
    std::stable_sort(members.begin(), members.end(),
                     [](const JsonValue* a, const JsonValue* b) { return a->key < b->key; });
    for (std::size_t k = 1; k < members.size(); ++k) {
      const JsonValue& first = *members[k - 1];
      if (members[k]->key != first.key) continue;
      problems_.add(file_, members[k]->line,
                    "key " + in_quotes(first.key) + " given twice, first in line " + std::to_string(first.line));
    }
  }

  bool refuse(std::size_t offset, const std::string& message) {
    const std::string_view before = text_.substr(0, std::min(offset, text_.size()));
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t newline = before.rfind('\n');
    const std::size_t column = before.size() - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
    problems_.add(file_, line, "column " + std::to_string(column) + ": " + message);
    return false;
  }

  std::string_view text_;
  const std::size_t& taken_;
  const std::string& file_;
  const ReadLimits& limits_;
  Problems& problems_;
  std::vector<JsonValue> open_;
  std::string key_;
  std::size_t values_ = 0;
  std::size_t counted_ = 0;
  std::size_t line_ = 1;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  for (const JsonValue& m : items) {
    if (m.key == name) return &m;
  }
  return nullptr;
}

std::string JsonValue::description() const {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return boolean ? "true" : "false";
    case Kind::number:
      return "the number " + shown(text);
    case Kind::string:
      return "the string " + in_quotes(text);
    case Kind::array:
      return "an array";
    case Kind::object:
      return "an object";
  }
  return {};
}

std::string Place::path() const {
  if (parent_ == nullptr) return {};
  std::string path = parent_->path();
  const JsonValue& parent = parent_->value();
  if (parent.is(Kind::array)) return path + '[' + std::to_string(value_ - parent.items.data()) + ']';
  if (!path.empty()) path += '.';
  return path + shown(value_->key);
}

bool parse_json(std::string_view text, const std::string& file, const ReadLimits& limits, Problems& problems,
                JsonValue& root) {
  if (text.size() > limits.bytes) {
    problems.add(file, 0, "larger than " + std::to_string(limits.bytes) + " bytes");
    return false;
  }
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    problems.add(file, 1, "the file is empty");
    return false;
  }
  std::size_t taken = 0;
  Handler handler(text, taken, file, limits, problems);
  const char* end = text.data() + text.size();
  const bool parsed = Json::sax_parse(CountingIterator(text.data(), text.data(), &taken),
                                      CountingIterator(end, text.data(), &taken), &handler);
  if (!parsed || !handler.root) return false;
  root = std::move(*handler.root);
  return true;
}

bool load_text(const std::filesystem::path& path, FileKind kind, const ReadLimits& limits, std::string& text,
               std::string& error) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  if (status.type() == std::filesystem::file_type::not_found || status.type() == std::filesystem::file_type::none) {
    error = code ? code.message() : "No such file or directory";
    return false;
  }
  if (std::filesystem::is_directory(status)) {
    error = "is a directory";
    return false;
  }
  if (kind == FileKind::regular && !std::filesystem::is_regular_file(status)) {
    error = "is not a regular file";
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    error = std::strerror(errno);
    return false;
  }
  text.clear();
  std::vector<char> block(std::size_t{1} << 16);
  while (stream && text.size() <= limits.bytes) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) {
    error = "cannot be read";
    return false;
  }
  if (text.size() > limits.bytes) {
    error = "larger than " + std::to_string(limits.bytes) + " bytes";
    return false;
  }
  return true;
}

}  // namespace fpz::io
