// Decompresses zlib's format (RFC 1950, 1951) in `.vtu` files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mesher {

/// The `size` bytes that `compressed` stands for; nothing if it is not zlib's format, or stands for
/// another number of bytes, or its checksum is wrong. Cost: O(size + |compressed|).
[[nodiscard]] std::optional<std::string> inflate(std::string_view compressed, std::size_t size);

}  // namespace mesher
