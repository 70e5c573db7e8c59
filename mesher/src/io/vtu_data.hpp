// Blocks of binary data as `.vtu` files hold them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "text/text.hpp"

namespace mesher {

/// How a file encodes blocks.
struct VtuEncoding {
  bool big_endian = false;
  bool wide_headers = false;  ///< sizes have 8 bytes, else 4
  bool compressed = false;    ///< by zlib, in pieces
};

/// The bytes of the block that begins `text`: its size, then as many bytes; or, compressed, the
/// number of pieces, the sizes of each piece and of the last (0: as the others), the compressed
/// size of each, then the pieces. Sizes and bytes are encoded by base64, together or one after the
/// other, or neither is (`raw`).
/// Throws: Error (bad_syntax, truncated).
[[nodiscard]] std::string read_block(const text::Source& source, std::string_view text, bool raw,
                                     const VtuEncoding& encoding);

/// The `size` bytes at `bytes` as an unsigned integer. Requires: size <= 8.
[[nodiscard]] std::uint64_t read_bits(const char* bytes, std::size_t size, bool big_endian);

}  // namespace mesher
