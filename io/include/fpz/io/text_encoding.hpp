// Text files as programs and laboratories write them: bytes in one of a few encodings, turned into UTF-8.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "fpz/words.hpp"

namespace fpz::io {

enum class TextEncoding : std::uint8_t { utf8, utf16le, utf16be, windows1252 };

struct DecodedText {
  std::string text;  ///< UTF-8 without a byte order mark
  TextEncoding encoding = TextEncoding::utf8;
};

/// The text in `bytes`. Without `encoding` it is found: by the byte order mark, by the zero bytes that UTF-16 gives to
/// Latin letters, and as windows-1252 (of which latin-1 is a part) where the bytes are no UTF-8. Throws InputError with
/// the cause, beginning with `origin`, for bytes that are no text of the encoding.
[[nodiscard]] DecodedText decode_text(std::string_view bytes, const std::string& origin,
                                      std::optional<TextEncoding> encoding = std::nullopt);

}  // namespace fpz::io

template <>
struct fpz::Words<fpz::io::TextEncoding> {
  using K = io::TextEncoding;
  static constexpr Word<K> list[] = {
      {K::utf8, "utf-8"}, {K::utf16le, "utf-16le"}, {K::utf16be, "utf-16be"}, {K::windows1252, "windows-1252"}};
};
