// The input's segments as a mesh has them: paths of its edges between input points.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

struct MeshSegment {
  std::uint32_t a = 0, b = 0;  // its ends, input points
  LineId line{};
  double length = 0;
};

/// Segments, and which of them are at a vertex.
class MeshLines {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Requires: a mesh of a Mesher.
  explicit MeshLines(const Mesh<2>& mesh);

  [[nodiscard]] const std::vector<MeshSegment>& segments() const noexcept { return segments_; }
  /// That through a vertex between its ends; kNone.
  [[nodiscard]] std::uint32_t through(std::uint32_t v) const noexcept { return through_[v]; }
  /// Those that end at a vertex.
  [[nodiscard]] const std::vector<std::uint32_t>& ending_at(std::uint32_t v) const noexcept {
    return ending_at_[v];
  }
  /// Those that the edges of the mesh are on, one for each.
  [[nodiscard]] const std::vector<std::uint32_t>& of_edges() const noexcept { return of_edges_; }

  /// Calls visit(segment, apex, distance) for each segment that v is on and each end of it that v
  /// is not at.
  template <class Visit>
  void for_each_leg(std::uint32_t v, Visit&& visit) const {
    const auto leg = [&](std::uint32_t s, std::uint32_t apex) {
      if (apex != v) visit(s, apex, distance(apex, v));
    };
    const auto both = [&](std::uint32_t s) { leg(s, segments_[s].a), leg(s, segments_[s].b); };
    if (through_[v] != kNone) both(through_[v]);
    for (const std::uint32_t s : ending_at_[v]) both(s);
  }
  [[nodiscard]] double distance(std::uint32_t v, std::uint32_t w) const;
  /// The angle of two segments with the end `apex`, degrees.
  [[nodiscard]] double degrees(std::uint32_t s, std::uint32_t t, std::uint32_t apex) const;
  /// From an end of a segment to the other one.
  [[nodiscard]] Point<2> along(std::uint32_t s, std::uint32_t apex) const;

  /// Segments s and t, ends of an edge of which are at equal distances from their common end, where
  /// they meet at under 60 degrees.
  struct Wedge {
    std::uint32_t s, t, apex;
    double degrees;
  };
  /// The wedges that an edge pq lies across, those without vertices between segments only on the
  /// side of the apex: left of pq. `any_side`: on both sides.
  [[nodiscard]] std::vector<Wedge> wedges_across(std::uint32_t p, std::uint32_t q,
                                                 bool any_side) const;

 private:
  void follow(std::uint32_t from, std::uint32_t edge);

  const Mesh<2>& mesh_;
  std::vector<MeshSegment> segments_;
  std::vector<std::uint32_t> through_;
  std::vector<std::vector<std::uint32_t>> ending_at_;
  std::vector<std::uint32_t> of_edges_;
  std::vector<std::uint32_t> edges_, first_;  // edges at each vertex: edges_[first_[v]...]
};

}  // namespace mesher::detail
