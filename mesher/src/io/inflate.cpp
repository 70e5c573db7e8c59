// Inflate after RFC 1951: blocks that are stored, or in Huffman codes that are fixed or given.
//
// A canonical Huffman code is kept as the number of codes of each length and the symbols in the
// order of their codes; a code is read bit by bit [Adler's puff].
#include "io/inflate.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace mesher {
namespace {

// Thrown and caught within this file.
struct Malformed {};

constexpr int kLongestCode = 15;

// Bits of bytes, the lowest first.
class Bits {
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t take(int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value |= take_one() << i;
    return value;
  }
  std::uint32_t take_one() {
    if (at_ / 8 >= bytes_.size()) throw Malformed();
    const std::uint32_t bit = static_cast<unsigned char>(bytes_[at_ / 8]) >> (at_ % 8) & 1U;
    ++at_;
    return bit;
  }
  // The next whole bytes; what is left of the current one is skipped.
  std::string_view take_bytes(std::size_t count) {
    at_ = (at_ + 7) / 8 * 8;
    if (bytes_.size() - at_ / 8 < count) throw Malformed();
    const std::string_view taken = bytes_.substr(at_ / 8, count);
    at_ += 8 * count;
    return taken;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;  // in bits
};

class HuffmanCode {
 public:
  explicit HuffmanCode(const std::vector<int>& lengths) {
    for (const int length : lengths) ++count_[static_cast<std::size_t>(length)];
    count_[0] = 0;
    std::array<int, kLongestCode + 2> first{};
    for (std::size_t length = 1; length <= kLongestCode; ++length) {
      first[length + 1] = first[length] + count_[length];
    }
    symbols_.resize(static_cast<std::size_t>(first[kLongestCode + 1]));
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      const auto length = static_cast<std::size_t>(lengths[symbol]);
      if (length > 0)
        symbols_[static_cast<std::size_t>(first[length]++)] = static_cast<int>(symbol);
    }
    require_not_too_many();
  }

  int read(Bits& bits) const {
    int code = 0, first = 0, index = 0;
    for (std::size_t length = 1; length <= kLongestCode; ++length) {
      code |= static_cast<int>(bits.take_one());
      if (code - count_[length] < first) {
        return symbols_[static_cast<std::size_t>(index + code - first)];
      }
      index += count_[length];
      first = (first + count_[length]) << 1;
      code <<= 1;
    }
    throw Malformed();
  }

 private:
  // More codes of a length than there is room for.
  void require_not_too_many() const {
    int left = 1;
    for (std::size_t length = 1; length <= kLongestCode; ++length) {
      left = 2 * left - count_[length];
      if (left < 0) throw Malformed();
    }
  }

  std::array<int, kLongestCode + 1> count_{};
  std::vector<int> symbols_;
};

// Lengths and distances of copies [RFC 1951, 3.2.5]: each code has a base and extra bits.
struct Extra {
  int base, bits;
};
constexpr Extra kLengths[] = {
    {3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
    {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
    {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}};
constexpr Extra kDistances[] = {{1, 0},     {2, 0},     {3, 0},      {4, 0},      {5, 1},
                                {7, 1},     {9, 2},     {13, 2},     {17, 3},     {25, 3},
                                {33, 4},    {49, 4},    {65, 5},     {97, 5},     {129, 6},
                                {193, 6},   {257, 7},   {385, 7},    {513, 8},    {769, 8},
                                {1025, 9},  {1537, 9},  {2049, 10},  {3073, 10},  {4097, 11},
                                {6145, 11}, {8193, 12}, {12289, 12}, {16385, 13}, {24577, 13}};

class Inflater {
 public:
  Inflater(std::string_view deflated, std::size_t size) : bits_(deflated), size_(size) {}

  std::string run() {
    for (bool last = false; !last;) {
      last = bits_.take_one() == 1;
      read_block(bits_.take(2));
    }
    if (out_.size() != size_) throw Malformed();
    return std::move(out_);
  }
  // What follows, at the next whole byte.
  std::string_view rest(std::size_t count) { return bits_.take_bytes(count); }

 private:
  void read_block(std::uint32_t type) {
    if (type == 0) return read_stored();
    if (type == 1) return read_codes(fixed_literals(), HuffmanCode(std::vector<int>(30, 5)));
    if (type != 2) throw Malformed();
    read_given();
  }

  void read_stored() {
    const std::string_view head = bits_.take_bytes(4);
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
    const unsigned length = byte(0) | byte(1) << 8, complement = byte(2) | byte(3) << 8;
    if ((length ^ complement) != 0xffff) throw Malformed();
    require_room(length);
    out_ += bits_.take_bytes(length);
  }

  static HuffmanCode fixed_literals() {
    std::vector<int> lengths(288, 8);
    for (std::size_t i = 144; i < 256; ++i) lengths[i] = 9;
    for (std::size_t i = 256; i < 280; ++i) lengths[i] = 7;
    return HuffmanCode(lengths);
  }

  // The codes of this block are given, in a code that is given first.
  void read_given() {
    constexpr std::size_t kOrder[] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                      11, 4,  12, 3, 13, 2, 14, 1, 15};
    const std::size_t literals = bits_.take(5) + 257, distances = bits_.take(5) + 1;
    const std::size_t given = bits_.take(4) + 4;
    std::vector<int> lengths(19, 0);
    for (std::size_t i = 0; i < given; ++i) lengths[kOrder[i]] = static_cast<int>(bits_.take(3));
    const HuffmanCode code(lengths);
    std::vector<int> all;
    while (all.size() < literals + distances) add_lengths(code.read(bits_), all);
    if (all.size() != literals + distances) throw Malformed();
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(literals);
    read_codes(HuffmanCode(std::vector<int>(all.begin(), middle)),
               HuffmanCode(std::vector<int>(middle, all.end())));
  }

  // 16 repeats the last length, 17 and 18 are runs of 0.
  void add_lengths(int symbol, std::vector<int>& all) {
    if (symbol < 16) return all.push_back(symbol);
    if (symbol == 16 && all.empty()) throw Malformed();
    const int length = symbol == 16 ? all.back() : 0;
    const std::uint32_t times = symbol == 16   ? 3 + bits_.take(2)
                                : symbol == 17 ? 3 + bits_.take(3)
                                               : 11 + bits_.take(7);
    all.insert(all.end(), times, length);
  }

  void read_codes(const HuffmanCode& literals, const HuffmanCode& distances) {
    constexpr int kEnd = 256;
    for (int symbol = literals.read(bits_); symbol != kEnd; symbol = literals.read(bits_)) {
      if (symbol < kEnd) {
        require_room(1);
        out_ += static_cast<char>(symbol);
      } else {
        const std::size_t length = read_extra(kLengths, symbol - kEnd - 1);
        copy(read_extra(kDistances, distances.read(bits_)), length);
      }
    }
  }

  template <std::size_t N>
  std::size_t read_extra(const Extra (&table)[N], int symbol) {
    if (symbol >= static_cast<int>(N)) throw Malformed();
    const Extra& extra = table[symbol];
    return static_cast<std::size_t>(extra.base) + bits_.take(extra.bits);
  }

  // The copy may overlap what it makes.
  void copy(std::size_t distance, std::size_t length) {
    if (distance > out_.size()) throw Malformed();
    require_room(length);
    for (; length > 0; --length) out_ += out_[out_.size() - distance];
  }

  void require_room(std::size_t more) const {
    if (size_ - out_.size() < more) throw Malformed();
  }

  Bits bits_;
  std::size_t size_;
  std::string out_;
};

// [RFC 1950, 9]
std::uint32_t adler32(std::string_view bytes) {
  constexpr std::uint32_t kModulus = 65521;  // the largest prime below 2^16
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % kModulus;
    b = (b + a) % kModulus;
  }
  return b << 16 | a;
}

}  // namespace

std::optional<std::string> inflate(std::string_view compressed, std::size_t size) {
  try {
    if (compressed.size() < 6) throw Malformed();
    const auto byte = [](std::string_view of, std::size_t i) {
      return std::uint32_t{static_cast<unsigned char>(of[i])};
    };
    const std::uint32_t method = byte(compressed, 0), flags = byte(compressed, 1);
    constexpr std::uint32_t kDictionary = 32;
    if ((method & 15) != 8 || (method << 8 | flags) % 31 != 0 || (flags & kDictionary) != 0) {
      throw Malformed();
    }
    Inflater inflater(compressed.substr(2), size);
    std::string bytes = inflater.run();
    const std::string_view sum = inflater.rest(4);
    const std::uint32_t said =
        byte(sum, 0) << 24 | byte(sum, 1) << 16 | byte(sum, 2) << 8 | byte(sum, 3);
    if (said != adler32(bytes)) throw Malformed();
    return bytes;
  } catch (const Malformed&) {
    return std::nullopt;
  }
}

}  // namespace mesher
