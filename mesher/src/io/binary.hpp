// Numbers as bytes between the fields of a text: the binary variants of `.vtk` and `.msh`.
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "io/vtu_data.hpp"
#include "text/text.hpp"

namespace mesher {

/// Reads bytes where `fields` is, which goes on behind them.
class BinaryCursor {
 public:
  BinaryCursor(const text::Source& source, text::Fields& fields)
      : source_(source), fields_(fields) {}

  void set_big_endian(bool big) noexcept { big_endian_ = big; }

  /// Skips the rest of a line of text. Throws: Error (truncated; bad_syntax if it is not blank).
  void begin() {
    const std::string_view rest = fields_.rest();
    const auto end = rest.find('\n');
    if (end == std::string_view::npos) fail_truncated();
    for (const char c : rest.substr(0, end)) {
      if (c == ' ' || c == '\t' || c == '\r') continue;
      throw error(ErrorCode::bad_syntax, "binary data must begin on a line of its own");
    }
    fields_ = text::Fields(rest.substr(end + 1));
  }
  /// Throws: Error(truncated) unless so many numbers of `size` bytes are left.
  void require(std::size_t count, std::size_t size) const {
    if (count > fields_.rest().size() / size) fail_truncated();
  }
  /// The next `size` bytes as an unsigned number. Throws: Error(truncated).
  [[nodiscard]] std::uint64_t bits(std::size_t size) {
    require(1, size);
    const std::uint64_t value = read_bits(fields_.rest().data(), size, big_endian_);
    fields_ = text::Fields(fields_.rest().substr(size));
    return value;
  }
  /// As a signed number. Throws: likewise.
  [[nodiscard]] std::int64_t integer(std::size_t size) {
    const auto shift = 64 - 8 * size;
    return static_cast<std::int64_t>(bits(size) << shift) >> shift;
  }
  /// As an unsigned number below 2^63. Throws: also Error(bad_number).
  [[nodiscard]] std::int64_t natural(std::size_t size) {
    const std::uint64_t value = bits(size);
    if (value >> 63 == 0) return static_cast<std::int64_t>(value);
    throw error(ErrorCode::bad_number, "the number " + std::to_string(value) + " is too large");
  }
  /// As a float or double. Throws: also Error(not_finite).
  [[nodiscard]] double real(std::size_t size) {
    const std::uint64_t read = bits(size);
    const double value = size == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(read))
                                   : std::bit_cast<double>(read);
    if (value - value == 0) return value;
    throw error(ErrorCode::not_finite, "a number is not finite");
  }
  /// An error here: lines and columns say nothing of binary data.
  [[nodiscard]] Error error(ErrorCode code, const std::string& what) const {
    const auto at = static_cast<std::size_t>(fields_.rest().data() - source_.content().data());
    return {code, what + ", before byte " + std::to_string(at), {source_.file()}};
  }

 private:
  [[noreturn]] void fail_truncated() const {
    throw error(ErrorCode::truncated, "the file ends within binary data");
  }

  const text::Source& source_;
  text::Fields& fields_;
  bool big_endian_ = false;
};

}  // namespace mesher
