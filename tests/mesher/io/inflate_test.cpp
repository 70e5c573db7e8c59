// Decompression of data of zlib: stored, in fixed and in given codes; damage is noticed.
#include "io/inflate.hpp"

#include <zlib.h>

#include <catch2/catch.hpp>

#include "mesher/extra/generate.hpp"

namespace {

std::string from_hex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

struct Compressed {
  std::string hex;  // of zlib.compress (Python's, 1.2.13)
  std::string bytes;
};

// "I*I%97 I" for I from 0 to 59, each on its line.
std::string squares() {
  std::string text;
  for (int i = 0; i < 60; ++i) {
    text += std::to_string(i * i % 97) + " " + std::to_string(i) + "\n";
  }
  return text;
}

std::vector<Compressed> samples() {
  return {
      {"789c030000000001", ""},
      {"789c4b040000620062", "a"},
      {"7801010f00f0ff73746f7265642061732069742069732ded057f", "stored as it is"},
      {"78014b4c4a4ec4860072e00931", "abcabcabcabcabcabcabcabc"},
      {"78da1d4fc911044108fa130521b4071ef927b6ce7e280a05f4f1c168483a96012b265c14a258c865"
       "a39283312e82f6e0493b43d31cedb4c041222e46a8e38515ad11b73ee8475b98d31f1474c316dd91"
       "571958a327f274614f29e8d11b431f94e80b6fc6c30cc3a06438dc1981b97b13658c3b568c821d3f"
       "6b31ce7bb8c8613e84330d76dc71ff5d6b301323a6d0cb2cf4f1469f3e7fdc4fd1fba6b26f53feb9"
       "1417a0fcb2a42f57f575a8bf3ecdd7adc50f4bc2370a",
       squares()},
      {"78daabaa1a05c4020012e48ef9", std::string(300, 'z')},
  };
}

}  // namespace

TEST_CASE("what zlib has compressed comes back") {
  for (const Compressed& sample : samples()) {
    INFO(sample.hex);
    CHECK(mesher::inflate(from_hex(sample.hex), sample.bytes.size()) == sample.bytes);
  }
}

TEST_CASE("long data comes back, and what is announced too long or too short is refused") {
  mesher::SplitMix64 random(2);
  for (const uLong size : {32767, 32768, 32769, 65536, 1000000}) {
    std::string bytes(size, '\0');
    for (char& c : bytes) c = static_cast<char>('a' + random.below(3));
    uLongf length = compressBound(size);
    std::string compressed(length, '\0');
    REQUIRE(compress(reinterpret_cast<Bytef*>(compressed.data()), &length,
                     reinterpret_cast<const Bytef*>(bytes.data()), size) == Z_OK);
    compressed.resize(length);
    INFO(size);
    CHECK(mesher::inflate(compressed, size) == bytes);
    CHECK(mesher::inflate(compressed + "behind", size) == bytes);
    CHECK_FALSE(mesher::inflate(compressed, size - 1));
    CHECK_FALSE(mesher::inflate(compressed, size + 1));
    compressed.pop_back();
    CHECK_FALSE(mesher::inflate(compressed, size));
  }
}

TEST_CASE("no memory is taken for a size that is announced alone") {
  const Compressed sample = samples()[4];
  CHECK_FALSE(mesher::inflate(from_hex(sample.hex), std::size_t{1} << 62));
}

TEST_CASE("another size than was announced is noticed") {
  for (const Compressed& sample : samples()) {
    const std::string bytes = from_hex(sample.hex);
    CHECK_FALSE(mesher::inflate(bytes, sample.bytes.size() + 1));
    if (!sample.bytes.empty()) CHECK_FALSE(mesher::inflate(bytes, sample.bytes.size() - 1));
  }
}

TEST_CASE("any change of a byte, and any loss at the end, is noticed") {
  mesher::SplitMix64 random(1);
  for (const Compressed& sample : samples()) {
    const std::string good = from_hex(sample.hex);
    for (std::size_t i = 0; i < good.size(); ++i) {
      CHECK_FALSE(mesher::inflate(good.substr(0, i), sample.bytes.size()));
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ static_cast<char>(1 + random.below(255)));
      INFO(sample.hex << ", byte " << i);
      const auto read = mesher::inflate(bad, sample.bytes.size());
      CHECK((!read || *read == sample.bytes));  // unused bits may change
    }
  }
}
