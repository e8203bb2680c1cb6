// Words for the values of enumerations: each enumeration lists its own once, next to its declaration, and everything
// that reads or writes words goes through here. A word belongs to its value by name, never by position.
#pragma once

#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace fpz {

template <class E>
struct Word {
  E value;
  const char* text;
};

/// Specialised for every enumeration that files or messages name: `static constexpr Word<E> list[]`, all its values.
template <class E>
struct Words;

template <class E>
concept Worded = requires {
  Words<E>::list;
};

/// The word for a value; "unknown" for a number that is not one of the enumeration's.
template <Worded E>
[[nodiscard]] constexpr const char* to_string(E value) {
  for (const Word<E>& w : Words<E>::list) {
    if (w.value == value) return w.text;
  }
  return "unknown";
}

/// The value of a word, or nothing.
template <Worded E>
[[nodiscard]] constexpr std::optional<E> from_word(std::string_view text) {
  for (const Word<E>& w : Words<E>::list) {
    if (text == w.text) return w.value;
  }
  return std::nullopt;
}

/// All words in their order.
template <Worded E>
inline constexpr auto word_list = [] {
  std::array<std::string_view, std::size(Words<E>::list)> words;
  for (std::size_t k = 0; k < words.size(); ++k) words[k] = Words<E>::list[k].text;
  return words;
}();

/// The same for messages: "a, b or c".
template <Worded E>
[[nodiscard]] std::string all_words() {
  std::string text;
  const std::size_t size = std::size(Words<E>::list);
  for (std::size_t k = 0; k < size; ++k) {
    if (k > 0) text += k + 1 == size ? " or " : ", ";
    text += Words<E>::list[k].text;
  }
  return text;
}

}  // namespace fpz
