// The parts of features in a mesh, kept from update to update, so that an update finds the added
// and removed parts by visiting only the vertices that it has touched.
//
// A part is found from each end of an edge, and from the first corner of a face. The changes of an
// update are prepared before it is final; completing them needs no memory.
#pragma once

#include <set>
#include <vector>

#include "mesh/canonical.hpp"

namespace mesher::detail {

class KnownParts {
 public:
  /// What comes and goes, each part once.
  struct News {
    std::vector<LineEdge> edges_in, edges_out;
    std::vector<PolygonFace> faces_in, faces_out;

   private:
    friend class KnownParts;
    std::set<LineEdge> edges_;
    std::set<PolygonFace> faces_;
  };

  KnownParts() = default;
  /// Corners ascend.
  explicit KnownParts(const OnFeatures& parts);

  [[nodiscard]] bool empty() const noexcept { return edges_.empty(); }
  /// Adds the ends of the parts of an edge to `all`, from `start`, one of them, on.
  /// Cost: O(log) for each.
  void list_ends(std::uint32_t edge, VertexHandle start, std::vector<VertexHandle>& all) const;
  /// The difference at these vertices (ascending): `now` has all parts at them, and may have
  /// others. Cost: O(parts log parts).
  [[nodiscard]] News news(const std::vector<VertexHandle>& at, const OnFeatures& now) const;
  /// Requires: `news` is of this.
  void apply(News& news) noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept;
  friend bool operator==(const KnownParts&, const KnownParts&) = default;

 private:
  template <class Visit>
  void visit_edges_at(VertexHandle v, Visit&& visit) const;

  std::set<LineEdge> edges_;  // from both ends
  std::set<PolygonFace> faces_;
};

}  // namespace mesher::detail
