// Constants of the trace file's format, and its checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace traces::format {

// A byte above 127 and an end of line: a file mangled as text is recognised at once.
inline constexpr std::string_view kMagic = "\x89traces\n";
inline constexpr char kFunction = 'F';
inline constexpr char kCall = 'C';
inline constexpr char kEdge = 'X';
inline constexpr char kEnd = 'E';

// Flags of a call.
inline constexpr unsigned kUnnamed = 1;
inline constexpr unsigned kTail = 2;
inline constexpr unsigned kWeighs = 4;

// Files are read and written in blocks of so many bytes.
inline constexpr std::size_t kBlock = std::size_t{1} << 16;

class Checksum {
 public:
  void add(char byte) noexcept {
    value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  }
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace traces::format
