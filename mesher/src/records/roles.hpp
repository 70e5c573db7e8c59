// Roles of vertices on segments: the segment, and the position on it [rules, identity of vertices].
//
// Few vertices have a role, so roles are stored apart from the vertices' records, and only if there
// are any.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "records/segment.hpp"

namespace mesher::detail {

/// The place on a segment that a vertex stands for; none (on == 0) for other vertices.
struct Role {
  Label label;
  SegmentHandle on = 0;
  friend auto operator<=>(const Role&, const Role&) = default;
};

/// Roles by the handles of vertices.
class Roles {
 public:
  /// Requires: set() for this handle before.
  [[nodiscard]] const Role& operator[](VertexHandle h) const noexcept {
    return (*chunks_[h / kChunk])[h % kChunk];
  }
  /// Makes room for the role of `h`. Throws: std::bad_alloc, and then changes nothing.
  void reserve(VertexHandle h) {
    const std::size_t chunk = h / kChunk;
    if (chunk >= chunks_.size()) chunks_.resize(chunk + 1);
    if (chunks_[chunk] == nullptr) chunks_[chunk] = std::make_unique<Chunk>();
  }
  /// Requires: reserve(h).
  void set(VertexHandle h, const Role& role) noexcept { (*chunks_[h / kChunk])[h % kChunk] = role; }
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  static constexpr VertexHandle kChunk = 1024;
  using Chunk = std::array<Role, kChunk>;

  std::vector<std::unique_ptr<Chunk>> chunks_;  // null where no vertex has had a role
};

inline std::size_t Roles::bytes() const noexcept {
  std::size_t bytes = chunks_.capacity() * sizeof(chunks_[0]);
  for (const auto& chunk : chunks_) bytes += chunk == nullptr ? 0 : sizeof(Chunk);
  return bytes;
}

}  // namespace mesher::detail
