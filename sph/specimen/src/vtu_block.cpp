#include "vtu_block.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace fpz::specimen::detail {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 33U;

/// Value of a base64 character; -1 for '=', -2 for any other.
int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return c == '=' ? -1 : -2;
}

/// Takes bytes off the text, one piece after the other.
class Bytes {
 public:
  Bytes(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  std::string take(std::uint64_t count) {
    if (count > most_bytes) throw std::runtime_error("a block is said to be longer than 8 GiB");
    std::string bytes;
    if (!base64_) {
      if (count > text_.size() - at_) throw std::runtime_error("the file ends within its data");
      bytes = text_.substr(at_, count);
      at_ += count;
      return bytes;
    }
    while (bytes.size() < count) {
      if (ready_.empty()) decode_four();
      const std::size_t n = std::min<std::size_t>(ready_.size(), count - bytes.size());
      bytes += ready_.substr(0, n);
      ready_.erase(0, n);
    }
    return bytes;
  }

  std::uint64_t number(bool wide) {
    const std::string bytes = take(wide ? 8 : 4);
    std::uint64_t x = 0;
    std::memcpy(&x, bytes.data(), bytes.size());  // little-endian, as this machine
    return x;
  }

 private:
  /// Lengths and data are padded each by itself, so that padding may stand in the middle.
  void decode_four() {
    std::uint32_t bits = 0;
    int characters = 0, padding = 0;
    while (characters < 4) {
      if (at_ >= text_.size()) throw std::runtime_error("the file ends within its data");
      const int v = value_of(text_[at_]);
      const char c = text_[at_++];
      if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
      if (v == -2) throw std::runtime_error("a character among the data is not base64");
      bits = (bits << 6U) | static_cast<std::uint32_t>(v < 0 ? 0 : v);
      padding += v < 0 ? 1 : 0;
      ++characters;
    }
    for (int k = 0; k < 3 - padding; ++k)
      ready_ += static_cast<char>((bits >> (16U - 8U * static_cast<unsigned>(k))) & 255U);
  }

  std::string_view text_;
  bool base64_;
  std::size_t at_ = 0;
  std::string ready_;  ///< decoded, not yet taken
};

std::string inflated(const std::string& packed, std::uint64_t size) {
  std::string bytes(size, '\0');
  auto length = static_cast<uLongf>(size);
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                                reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
  if (status != Z_OK || length != size) throw std::runtime_error("a compressed block is damaged");
  return bytes;
}

/// Number of parts, bytes of each, bytes of the last one (0: whole), packed bytes of each; then the parts.
std::string read_compressed(Bytes& bytes, bool wide) {
  const std::uint64_t parts = bytes.number(wide), size = bytes.number(wide), last = bytes.number(wide);
  if (parts > most_bytes / 16 || size > most_bytes || parts * size > most_bytes) {
    throw std::runtime_error("a compressed block is said to be longer than 8 GiB");
  }
  std::vector<std::uint64_t> packed;
  for (std::uint64_t k = 0; k < parts; ++k) packed.push_back(bytes.number(wide));
  std::string all;
  for (std::uint64_t k = 0; k < parts; ++k) {
    all += inflated(bytes.take(packed[k]), k + 1 == parts && last > 0 ? last : size);
  }
  return all;
}

}  // namespace

std::string read_block(std::string_view text, const BlockFormat& format) {
  Bytes bytes(text, format.base64);
  if (format.compressed) return read_compressed(bytes, format.wide);
  return bytes.take(bytes.number(format.wide));
}

}  // namespace fpz::specimen::detail
