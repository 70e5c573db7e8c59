// A value of the client whose every operation may throw.
#pragma once

#include <compare>
#include <cstdint>
#include <ostream>
#include <string>

#include "failing_new.hpp"
#include "sac/label.hpp"

namespace support {

/// A number of 0 or more, kept as a text so that most of them own memory: copying, comparing,
/// ordering, hashing it and making it may throw.
class Fragile {
 public:
  static inline Fuse fuse;

  Fragile() { burn(); }
  explicit Fragile(int value) : text_(static_cast<std::size_t>(value) * kWidth, 'x') { burn(); }
  Fragile(const Fragile& other) : text_(other.text_) { burn(); }
  Fragile(Fragile&& other) noexcept = default;
  Fragile& operator=(const Fragile& other) {
    burn();
    text_ = other.text_;
    return *this;
  }
  Fragile& operator=(Fragile&&) noexcept = default;

  explicit operator int() const { return static_cast<int>(text_.size() / kWidth); }
  friend bool operator==(const Fragile& a, const Fragile& b) {
    burn();
    return a.text_ == b.text_;
  }
  friend std::strong_ordering operator<=>(const Fragile& a, const Fragile& b) {
    burn();
    return int(a) <=> int(b);
  }
  friend std::uint64_t hash_value(const Fragile& f) {
    burn();
    return f.text_.size();
  }
  friend std::ostream& operator<<(std::ostream& out, const Fragile& f) { return out << int(f); }

 private:
  static constexpr std::size_t kWidth = 12;  // 2 and more do not fit into the string itself
  static void burn() {
    if (fuse.burns()) throw ClientFailure();
  }
  std::string text_;
};

}  // namespace support
