// base64 (RFC 4648) and sizes of blocks.
#include "io/vtu_data.hpp"

#include <algorithm>

namespace mesher {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::string_view kSpace = " \t\r\n";

// Bytes of a text in base64, four characters at a time; '=' ends a run, and another may follow.
class Base64 {
 public:
  Base64(const text::Source& source, std::string_view text) : source_(source), rest_(text) {}

  // The next `count` bytes. Throws: Error (bad_syntax, truncated).
  std::string take(std::uint64_t count) {
    while (ready_.size() < count) decode();
    std::string taken = ready_.substr(0, count);
    ready_.erase(0, count);
    return taken;
  }

 private:
  void decode() {
    std::uint32_t bits = 0;
    int kept = 0;
    const std::string_view begin = rest_;
    for (int i = 0; i < 4; ++i) {
      const char c = next(begin);
      bits <<= 6;
      if (c == '=') continue;
      const auto value = kAlphabet.find(c);
      if (value == std::string_view::npos || kept < i) {
        throw source_.error(ErrorCode::bad_syntax, "no base64", begin);
      }
      bits |= static_cast<std::uint32_t>(value);
      ++kept;
    }
    for (int i = 0; i < kept - 1; ++i) ready_ += static_cast<char>(bits >> (16 - 8 * i) & 0xff);
  }

  char next(std::string_view begin) {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
    if (rest_.empty()) throw source_.error(ErrorCode::truncated, "the data end too early", begin);
    const char c = rest_.front();
    rest_.remove_prefix(1);
    return c;
  }

  const text::Source& source_;
  std::string_view rest_;
  std::string ready_;
};

std::string read_raw(const text::Source& source, std::string_view text, std::size_t header,
                     bool big_endian) {
  const auto fail = [&] {
    throw source.error(ErrorCode::truncated, "the data end too early", text);
  };
  if (text.size() < header) fail();
  const std::uint64_t size = read_bits(text.data(), header, big_endian);
  if (text.size() - header < size) fail();
  return std::string(text.substr(header, size));
}

}  // namespace

std::uint64_t read_bits(const char* bytes, std::size_t size, bool big_endian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t from = big_endian ? i : size - 1 - i;
    bits = bits << 8 | static_cast<unsigned char>(bytes[from]);
  }
  return bits;
}

std::string read_block(const text::Source& source, std::string_view text, bool raw,
                       const VtuEncoding& encoding) {
  const std::size_t header = encoding.wide_headers ? 8 : 4;
  if (raw) return read_raw(source, text, header, encoding.big_endian);
  Base64 bytes(source, text);
  const std::uint64_t size = read_bits(bytes.take(header).data(), header, encoding.big_endian);
  return bytes.take(size);
}

}  // namespace mesher
