// The two mixers. They are part of the file format: changing one needs a new version of it.
#include "traces/label_hash.hpp"

#include <algorithm>

namespace traces {
namespace {

// The finaliser of splitmix64.
std::uint64_t mix_high(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// The finaliser of MurmurHash3.
std::uint64_t mix_low(std::uint64_t x) noexcept {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53u;
  return x ^ (x >> 33);
}

}  // namespace

void LabelHasher::word(std::uint64_t value) noexcept {
  high_ = mix_high(high_ + value + 0x9e3779b97f4a7c15u);
  low_ = mix_low((low_ ^ value) * 0xd6e8feb86659fd93u + 1);
}

void LabelHasher::text(std::string_view value) noexcept {
  word(value.size());
  while (!value.empty()) {
    std::uint64_t bytes = 0;
    const std::size_t count = std::min<std::size_t>(8, value.size());
    for (std::size_t i = 0; i < count; ++i) {
      bytes |= std::uint64_t{static_cast<unsigned char>(value[i])} << (8 * i);
    }
    word(bytes);
    value.remove_prefix(count);
  }
}

void LabelHasher::hash(const LabelHash& value) noexcept {
  word(value.high);
  word(value.low);
}

}  // namespace traces
