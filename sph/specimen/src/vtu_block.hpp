// Blocks of bytes in .vtu files: raw or base64, as they are or compressed by zlib.
#pragma once

#include <string>
#include <string_view>

namespace fpz::specimen::detail {

/// How the blocks of a file are written.
struct BlockFormat {
  bool base64 = false;
  bool compressed = false;  ///< vtkZLibDataCompressor
  bool wide = false;        ///< lengths have 64 bits, else 32
};

/// The bytes of the block at the begin of a text, which goes on behind it. Throws std::runtime_error with the reason
/// when the block is damaged or longer than the text.
[[nodiscard]] std::string read_block(std::string_view text, const BlockFormat& format);

}  // namespace fpz::specimen::detail
