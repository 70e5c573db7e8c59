// What processes tell each other, as bytes: values one after the other, in the order and the form
// of the machine, which is that of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "mesher/error.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

using Bytes = std::vector<std::byte>;

/// Writes values.
class Packer {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof value);
  }
  /// Their number, and they.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put_all(std::span<const T> values) {
    put(std::uint64_t{values.size()});
    const auto* from = reinterpret_cast<const std::byte*>(values.data());
    bytes_.insert(bytes_.end(), from, from + values.size_bytes());
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    put_all(std::span<const T>(values));
  }
  void put_all(std::string_view text) { put_all(std::span<const char>(text.data(), text.size())); }

  [[nodiscard]] const Bytes& bytes() const noexcept { return bytes_; }
  void clear() noexcept { bytes_.clear(); }

 private:
  Bytes bytes_;
};

/// Reads them in the same order.
class Unpacker {
 public:
  explicit Unpacker(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  [[nodiscard]] T take() {
    T value;
    copy(&value, sizeof value);
    return value;
  }
  template <class T>
  [[nodiscard]] std::vector<T> take_all() {
    const auto count = take<std::uint64_t>();
    SAC_ENSURES(count <= rest_.size() / sizeof(T));
    std::vector<T> values(static_cast<std::size_t>(count));
    if (!values.empty()) copy(values.data(), values.size() * sizeof(T));
    return values;
  }
  [[nodiscard]] std::string take_text() {
    const std::vector<char> text = take_all<char>();
    return {text.begin(), text.end()};
  }
  [[nodiscard]] bool is_empty() const noexcept { return rest_.empty(); }

 private:
  void copy(void* to, std::size_t count) {
    SAC_ENSURES(count <= rest_.size());
    std::memcpy(to, rest_.data(), count);
    rest_ = rest_.subspan(count);
  }

  std::span<const std::byte> rest_;
};

void pack(const FileLocation& location, Packer& to);
[[nodiscard]] FileLocation unpack_location(Unpacker& from);
void pack(const Error& error, Packer& to);
[[nodiscard]] Error unpack_error(Unpacker& from);

}  // namespace mesher::detail
