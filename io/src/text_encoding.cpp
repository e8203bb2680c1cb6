#include "fpz/io/text_encoding.hpp"

#include <array>
#include <cstddef>

#include "fpz/io/input_error.hpp"

namespace fpz::io {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF"sv;
constexpr std::string_view utf16le_mark = "\xFF\xFE"sv;
constexpr std::string_view utf16be_mark = "\xFE\xFF"sv;
constexpr std::string_view utf32le_mark = "\xFF\xFE\0\0"sv;
constexpr std::string_view utf32be_mark = "\0\0\xFE\xFF"sv;

/// What windows-1252 has at 0x80 to 0x9f; the other bytes are the characters of the same number. 0: not used.
constexpr std::array<std::uint16_t, 32> windows1252_middle = {
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017D, 0,      0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

unsigned byte_at(std::string_view bytes, std::size_t k) { return static_cast<unsigned char>(bytes[k]); }

void append_utf8(std::string& out, char32_t c) {
  const auto put = [&out](char32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xC0 | (c >> 6));
  } else if (c < 0x10000) {
    put(0xE0 | (c >> 12));
    put(0x80 | ((c >> 6) & 0x3F));
  } else {
    put(0xF0 | (c >> 18));
    put(0x80 | ((c >> 12) & 0x3F));
    put(0x80 | ((c >> 6) & 0x3F));
  }
  put(0x80 | (c & 0x3F));
}

/// Bytes of the UTF-8 character at k; 0 when there is none (RFC 3629).
std::size_t utf8_length(std::string_view bytes, std::size_t k) {
  const unsigned first = byte_at(bytes, k);
  const std::size_t n = first < 0x80   ? 1
                        : first < 0xC2 ? 0
                        : first < 0xE0 ? 2
                        : first < 0xF0 ? 3
                        : first < 0xF5 ? 4
                                       : 0;
  if (n == 0 || k + n > bytes.size()) return 0;
  for (std::size_t j = 1; j < n; ++j) {
    if ((byte_at(bytes, k + j) & 0xC0U) != 0x80U) return 0;
  }
  const unsigned second = n > 1 ? byte_at(bytes, k + 1) : 0;
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return overlong || beyond ? 0 : n;
}

/// Place of the first byte that is no UTF-8; the size when there is none.
std::size_t utf8_ends(std::string_view bytes) {
  for (std::size_t k = 0; k < bytes.size();) {
    const std::size_t n = utf8_length(bytes, k);
    if (n == 0) return k;
    k += n;
  }
  return bytes.size();
}

/// Zero bytes at even and at odd places.
std::array<std::size_t, 2> count_zeros(std::string_view bytes) {
  std::array<std::size_t, 2> zeros{};
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    if (bytes[k] == '\0') ++zeros[k % 2];
  }
  return zeros;
}

TextEncoding find_encoding(std::string_view bytes, const std::string& origin) {
  if (bytes.starts_with(utf32le_mark) || bytes.starts_with(utf32be_mark)) {
    throw InputError(origin + ": is UTF-32; save it as UTF-8");
  }
  if (bytes.starts_with(utf16le_mark)) return TextEncoding::utf16le;
  if (bytes.starts_with(utf16be_mark)) return TextEncoding::utf16be;
  const auto [even, odd] = count_zeros(bytes);
  if (even + odd == 0) {
    return utf8_ends(bytes) == bytes.size() ? TextEncoding::utf8 : TextEncoding::windows1252;
  }
  // Latin letters and digits of UTF-16 have a zero in every second byte, and nowhere else.
  const std::size_t most = bytes.size() / 2;
  if (even == 0 && odd > most / 2) return TextEncoding::utf16le;
  if (odd == 0 && even > most / 2) return TextEncoding::utf16be;
  throw InputError(origin + ": has " + std::to_string(even + odd) +
                   " zero bytes, so it is no text that is known here (a workbook, a binary file?); export it as text, "
                   "or say \"encoding\": \"utf-16le\" or \"utf-16be\"");
}

std::string from_utf16(std::string_view bytes, bool big, const std::string& origin) {
  if (bytes.size() % 2 != 0) {
    throw InputError(origin + ": is UTF-16 but has an odd number of bytes (" + std::to_string(bytes.size()) +
                     "); it is not whole, or its \"encoding\" is another one");
  }
  const auto unit = [&](std::size_t k) -> char32_t {
    const unsigned a = byte_at(bytes, k), b = byte_at(bytes, k + 1);
    return big ? a << 8 | b : b << 8 | a;
  };
  std::string out;
  out.reserve(bytes.size() / 2);
  for (std::size_t k = 0; k < bytes.size(); k += 2) {
    char32_t c = unit(k);
    if (c >= 0xD800 && c < 0xE000) {  // half of a character beyond the first 65536
      const char32_t low = k + 2 < bytes.size() ? unit(k + 2) : 0;
      if (c >= 0xDC00 || low < 0xDC00 || low >= 0xE000) {
        throw InputError(origin + ": is no UTF-16 at byte " + std::to_string(k + 1));
      }
      c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
      k += 2;
    }
    append_utf8(out, c);
  }
  return out;
}

std::string from_windows1252(std::string_view bytes) {
  std::string out;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const unsigned b = byte_at(bytes, k);
    const bool middle = b >= 0x80 && b < 0xA0;
    append_utf8(out, middle && windows1252_middle[b - 0x80] != 0 ? windows1252_middle[b - 0x80] : b);
  }
  return out;
}

void drop_mark(std::string_view& bytes, std::string_view mark) {
  if (bytes.starts_with(mark)) bytes.remove_prefix(mark.size());
}

}  // namespace

DecodedText decode_text(std::string_view bytes, const std::string& origin, std::optional<TextEncoding> encoding) {
  const TextEncoding which = encoding ? *encoding : find_encoding(bytes, origin);
  switch (which) {
    case TextEncoding::utf16le:
      drop_mark(bytes, utf16le_mark);
      return {from_utf16(bytes, false, origin), which};
    case TextEncoding::utf16be:
      drop_mark(bytes, utf16be_mark);
      return {from_utf16(bytes, true, origin), which};
    case TextEncoding::windows1252:
      return {from_windows1252(bytes), which};
    case TextEncoding::utf8:
      break;
  }
  drop_mark(bytes, utf8_mark);
  if (const std::size_t end = utf8_ends(bytes); end != bytes.size()) {
    throw InputError(origin + ": is no UTF-8 at byte " + std::to_string(end + 1) +
                     "; leave \"encoding\" out or say \"windows-1252\"");
  }
  return {std::string(bytes), which};
}

}  // namespace fpz::io
