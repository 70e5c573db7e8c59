// Texts with numbers as bytes in them: binary files for tests.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>

namespace support {

/// Words and the bytes of numbers, one after the other.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}

  Bytes& operator<<(const char* words) {
    text_ += words;
    return *this;
  }
  template <class T>
  requires std::is_arithmetic_v<T> Bytes& operator<<(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big_endian_) std::reverse(bytes, bytes + sizeof value);
    text_.append(bytes, sizeof value);
    return *this;
  }
  template <class T, class... Values>
  Bytes& all(Values... values) {
    ((*this << static_cast<T>(values)), ...);
    return *this;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

}  // namespace support
