// Inflate by zlib, into memory that grows as bytes come: no announced size is trusted.
#include "io/inflate.hpp"

#include <zlib.h>

#include <array>
#include <new>

namespace mesher {
namespace {

class Inflater {
 public:
  explicit Inflater(std::string_view compressed) : rest_(compressed) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  // The next bytes; none at the end, or behind it.
  std::string_view next() {
    stream_.next_out = buffer_.data();
    stream_.avail_out = static_cast<uInt>(buffer_.size());
    while (state_ == Z_OK && stream_.avail_out > 0 && feed()) {
      state_ = ::inflate(&stream_, Z_NO_FLUSH);
    }
    return {reinterpret_cast<const char*>(buffer_.data()), buffer_.size() - stream_.avail_out};
  }
  // Whether all is there, and the checksum right.
  [[nodiscard]] bool complete() const { return state_ == Z_STREAM_END; }

 private:
  // zlib counts in 32 bits. Whether there is input.
  bool feed() {
    if (stream_.avail_in > 0) return true;
    const std::string_view some = rest_.substr(0, kMostInput);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(some.data()));  // it only reads
    stream_.avail_in = static_cast<uInt>(some.size());
    rest_.remove_prefix(some.size());
    return !some.empty();
  }

  static constexpr std::size_t kMostInput = std::size_t{1} << 30;
  std::string_view rest_;
  z_stream stream_{};
  int state_ = Z_OK;
  std::array<Bytef, 1 << 15> buffer_;
};

}  // namespace

std::optional<std::string> inflate(std::string_view compressed, std::size_t size) {
  Inflater inflater(compressed);
  std::string bytes;
  for (auto some = inflater.next(); !some.empty(); some = inflater.next()) {
    if (some.size() > size - bytes.size()) return std::nullopt;
    bytes += some;
  }
  if (!inflater.complete() || bytes.size() != size) return std::nullopt;
  return bytes;
}

}  // namespace mesher
