// Tetrahedra with a small dihedral angle, and where they are split [Li, Teng 2001; rules E].
//
// A sliver has four corners about on a circle, so its radius-edge ratio is good. It gets a vertex
// not at its centre, where the next sliver would be likely, but beside that where no new
// tetrahedron has a small angle, or where the smallest is as large as may be. The choice is among
// points of a lattice, so that vertices that are inserted for different slivers do not come close.
//
// Each vertex has a floor, at first its distance from the nearest one. A vertex that splits a
// sliver is at least half the least floor of the sliver's corners from all others, and takes that
// floor over; one that comes for another reason takes over the least floor around it, or its
// distance, if that is larger. So no floor is less than the least at the beginning, and only as
// many slivers are split as there is room for. Vertices on features may come nearer, where a
// sliver's vertex is between features at a small angle; a poor tetrahedron whose shortest edge is
// below an eighth of its floors stays, so that these do not ask for each other on and on.
//
// Where features meet at small angles poor tetrahedra stay (ConformingMesh::is_split); these are
// split, too, beside their off-centre. So what is left is what a wall or a floor protects.
//   (To leave poor ones: half of the angles under 5 degrees on scanned surfaces stay. To keep new
//   vertices away from walls, by the balls of tiles or by their height: more slivers stay, and no
//   fewer vertices. Not to look at angles of new tetrahedra that are poor, since they will be
//   split: more vertices.)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

#include "delaunay/kernel.hpp"
#include "geometry/grid.hpp"
#include "rules/sliver_rule.hpp"

namespace mesher::detail {

class Slivers {
 public:
  using Kernel = DelaunayKernel<3, BallLayout<3>>;

  /// `min_dihedral`: in degrees; 0: there are no slivers. `rho`: above it tetrahedra are poor.
  /// `is_thorough`: any gain counts, and what is left is tried at all places: not beside features.
  Slivers(const MeshBox<3>& box, double rho, double min_dihedral, bool is_thorough);

  /// Whether there may be any.
  [[nodiscard]] bool any() const noexcept { return rule_.any(); }
  [[nodiscard]] bool started() const noexcept { return started_; }
  /// Finds all that there are. Cost: O(n) for n simplices.
  void start(const Kernel& kernel, const std::vector<VertexKind>& kinds);
  /// Of a simplex that is new. Requires: started().
  void look_at(const Kernel& kernel, const std::vector<VertexKind>& kinds, std::uint32_t s);
  /// Of a vertex that is dug. Requires: started().
  void before_fill(const Kernel& kernel, std::uint32_t v);

  /// The next sliver, or kNone: of short edges first.
  [[nodiscard]] std::uint32_t take(const Kernel& kernel);
  /// Digs v, which is no vertex yet, where it splits s best; false, and nothing dug: no place is
  /// better than none. `fits()`: whether v may be where it is dug.
  template <class Fits>
  [[nodiscard]] bool dig(Kernel& kernel, std::uint32_t s, std::uint32_t v, Fits&& fits);

  /// Whether a poor simplex stays, by its shortest edge: features have made it, where they meet at
  /// a small angle, and would go on and on. Requires: started().
  [[nodiscard]] bool is_below_floor(const Kernel& kernel, std::uint32_t s, double shortest2) const;
  /// The least floor of its corners, squared.
  [[nodiscard]] double least_floor2(const Kernel& kernel, std::uint32_t s) const;
  /// Vertices for slivers so far, and slivers that have no place for one, or have not been tried.
  [[nodiscard]] std::size_t split() const noexcept { return split_; }
  [[nodiscard]] std::size_t left() const noexcept;

 private:
  enum class Wait : std::uint8_t { none, queued, left };
  struct Place {
    int takes;        // of the slivers around the first corner of this one
    double nearest2;  // to its corners
    Point<3> at;
  };
  struct Ball {
    Point<3> centre;
    double radius2;
  };
  static constexpr double kRefused = 2;      // a score, as SliverRule's
  static constexpr double kLeast = 0x1p-30;  // that a score is better by
  // Where features are, a place that leaves a small angle is better if its sine is twice as large.
  // (With any that is larger: of scans up to a third more vertices, for as many small angles.)
  static constexpr double kBetter2 = 4;

  // Numbers of simplices, and the order of their corners, are accidental: slivers go by places. An
  // entry may be of a simplex that is gone.
  struct Entry {
    double shortest2;
    Point<3> sum;  // of its corners
    std::uint32_t simplex;
    friend bool operator<(const Entry& a, const Entry& b) {  // the last goes first
      return a.shortest2 != b.shortest2 ? a.shortest2 > b.shortest2 : b.sum < a.sum;
    }
    friend bool operator==(const Entry&, const Entry&) = default;
  };

  // By their places.
  [[nodiscard]] static std::array<std::uint32_t, 4> sorted_corners(const Kernel& kernel,
                                                                   std::uint32_t s);
  [[nodiscard]] static Entry entry_of(const Kernel& kernel, std::uint32_t s);
  void add(const Kernel& kernel, std::uint32_t s);
  [[nodiscard]] Ball ball_to_split(const Kernel& kernel, std::uint32_t s) const;
  void find_places(Kernel& kernel, std::uint32_t s);
  void find_beside(Kernel& kernel, std::uint32_t s);
  [[nodiscard]] static double score_of(const Kernel& kernel, std::uint32_t s);
  [[nodiscard]] static double score_of_dug(const Kernel& kernel, std::uint32_t v, double enough);
  [[nodiscard]] static double nearest2(const Kernel& kernel, std::uint32_t v);

  SliverRule rule_;
  double rho_;
  bool is_thorough_;
  bool started_ = false;
  std::vector<Wait> wait_;      // by simplex
  std::vector<double> floor2_;  // by vertex
  std::priority_queue<Entry> queue_;
  std::size_t split_ = 0, split_before_ = 0;  // now; when those left were tried again
  int rounds_ = 0;
  double dug_floor2_ = 0;  // of the vertex that dig() has dug; 0: none
  // Scratch.
  std::vector<Place> places_;
  std::vector<std::uint32_t> star_, beside_;
};

template <class Fits>
bool Slivers::dig(Kernel& kernel, std::uint32_t s, std::uint32_t v, Fits&& fits) {
  const double floor2 = least_floor2(kernel, s);
  find_places(kernel, s);
  const double before = score_of(kernel, s);
  double best =
      std::max(is_thorough_ ? before - kLeast : 1 - kBetter2 * (1 - before), rule_.worst());
  const Point<3>* best_at = nullptr;
  const auto dig_at = [&](const Point<3>& p) {
    kernel.set_place(v, p);
    kernel.dig(v, s);
  };
  for (const Place& place : places_) {
    if (!kernel.conflicts(s, place.at)) continue;
    dig_at(place.at);
    const bool may_be = nearest2(kernel, v) >= floor2 / 4 && fits();
    const double score = may_be ? score_of_dug(kernel, v, best) : kRefused;
    if (score <= best) best = score, best_at = &place.at;
    if (best_at != nullptr && best <= rule_.worst()) break;
    kernel.undo_dig();
  }
  if (best_at == nullptr) {
    wait_[s] = Wait::left;
    return false;
  }
  if (best > rule_.worst()) dig_at(*best_at);
  dug_floor2_ = floor2;
  ++split_;
  return true;
}

}  // namespace mesher::detail
