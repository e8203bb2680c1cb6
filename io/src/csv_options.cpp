#include "fpz/io/csv_options.hpp"

namespace fpz::io {
namespace {

constexpr std::size_t longest_word = 40;
constexpr int most_rows = 10'000'000;

template <Worded E>
std::optional<E> read_word(const InputReader& reader, const Place& at,
                           std::optional<E> (*other_spelling)(std::string_view)) {
  const std::optional<std::string> word = reader.text(at, longest_word);
  if (!word) return std::nullopt;
  if (const auto known = from_word<E>(*word)) return known;
  if (const auto known = other_spelling(*word)) return known;
  reader.problem(at, in_quotes(*word) + " is not known; it must be " + all_words<E>());
  return std::nullopt;
}

std::optional<CsvSeparator> separator_of(std::string_view character) {
  if (character == ",") return CsvSeparator::comma;
  if (character == ";") return CsvSeparator::semicolon;
  if (character == "\t") return CsvSeparator::tab;
  if (character == "|") return CsvSeparator::bar;
  if (character == " ") return CsvSeparator::space;
  return std::nullopt;
}

std::optional<DecimalMark> mark_of(std::string_view character) {
  if (character == ".") return DecimalMark::point;
  if (character == ",") return DecimalMark::comma;
  return std::nullopt;
}

std::optional<TextEncoding> encoding_of(std::string_view name) {
  const std::string plain = lower_case(std::string(name));
  if (plain == "utf8" || plain == "utf-8") return TextEncoding::utf8;
  if (plain == "latin-1" || plain == "latin1" || plain == "iso-8859-1" || plain == "cp1252") {
    return TextEncoding::windows1252;
  }
  return from_word<TextEncoding>(plain);
}

}  // namespace

std::optional<CsvSeparator> csv_separator(std::string_view text) {
  const auto known = from_word<CsvSeparator>(text);
  return known ? known : separator_of(text);
}

std::optional<DecimalMark> csv_decimal(std::string_view text) {
  const auto known = from_word<DecimalMark>(text);
  return known ? known : mark_of(text);
}

CsvOptions read_csv_options(const InputReader& reader, const Place& place) {
  CsvOptions options;
  const auto member = [&](std::string_view key) { return place.value().find(key); };
  if (const JsonValue* v = member("separator")) {
    options.separator = read_word<CsvSeparator>(reader, Place(place, *v), separator_of);
  }
  if (const JsonValue* v = member("decimal")) {
    options.decimal = read_word<DecimalMark>(reader, Place(place, *v), mark_of);
  }
  if (const JsonValue* v = member("encoding")) {
    options.encoding = read_word<TextEncoding>(reader, Place(place, *v), encoding_of);
  }
  const auto count = [&](std::string_view key, int least) -> std::optional<std::size_t> {
    const JsonValue* v = member(key);
    const auto n = v != nullptr ? reader.integer(Place(place, *v), least, most_rows) : std::nullopt;
    if (!n) return std::nullopt;
    return static_cast<std::size_t>(*n);
  };
  options.skip_rows = count("skip_rows", 0);
  options.rows = count("rows", 1);
  return options;
}

}  // namespace fpz::io
