// base64 (RFC 4648), sizes of blocks, and compressed pieces.
#include "io/vtu_data.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "io/inflate.hpp"

namespace mesher {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::string_view kBlanks = " \t\r\n";

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
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size()));
    if (rest_.empty()) throw source_.error(ErrorCode::truncated, "the data end too early", begin);
    const char c = rest_.front();
    rest_.remove_prefix(1);
    return c;
  }

  const text::Source& source_;
  std::string_view rest_;
  std::string ready_;
};

// Bytes of a text as they are.
class RawBytes {
 public:
  RawBytes(const text::Source& source, std::string_view text) : source_(source), rest_(text) {}

  std::string take(std::uint64_t count) {
    if (rest_.size() < count) {
      throw source_.error(ErrorCode::truncated, "the data end too early", rest_);
    }
    std::string taken(rest_.substr(0, count));
    rest_.remove_prefix(count);
    return taken;
  }

 private:
  const text::Source& source_;
  std::string_view rest_;
};

// A block from where its bytes come from; `at` is its place.
template <class Bytes>
class Block {
 public:
  Block(Bytes bytes, const VtuEncoding& encoding, const text::Source& source, std::string_view at)
      : bytes_(std::move(bytes)), encoding_(encoding), source_(source), at_(at) {}

  std::string read() { return encoding_.compressed ? read_pieces() : bytes_.take(take_size()); }

 private:
  std::uint64_t take_size() {
    const std::size_t size = encoding_.wide_headers ? 8 : 4;
    return read_bits(bytes_.take(size).data(), size, encoding_.big_endian);
  }

  std::string read_pieces() {
    const std::uint64_t pieces = take_size(), size = take_size(), last = take_size();
    std::vector<std::uint64_t> compressed;
    for (std::uint64_t i = 0; i < pieces; ++i) compressed.push_back(take_size());
    std::string all;
    for (std::uint64_t i = 0; i < pieces; ++i) {
      const bool is_last = i + 1 == pieces && last > 0;
      const auto piece = inflate(bytes_.take(compressed[i]), is_last ? last : size);
      if (!piece) throw source_.error(ErrorCode::bad_syntax, "damaged compressed data", at_);
      all += *piece;
    }
    return all;
  }

  Bytes bytes_;
  VtuEncoding encoding_;
  const text::Source& source_;
  std::string_view at_;
};

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
  if (raw) return Block(RawBytes(source, text), encoding, source, text).read();
  return Block(Base64(source, text), encoding, source, text).read();
}

}  // namespace mesher
