// Tetrahedra that are not poor, but have a small dihedral angle, and where they are split
// [Li, Teng 2001; rules E].
//
// A sliver has four corners about on a circle, so its radius-edge ratio is good. It gets a vertex
// not at its centre, where the next sliver would be likely, but at a place beside it that leaves no
// small angle among the new tetrahedra, of those on a lattice: that is a choice of places that do
// not depend on what was there before, and none comes close to another.
//
// Each vertex has a floor: a new vertex is at least half the least floor of the sliver's corners
// from all vertices, and takes it over; one for another reason takes over what it finds, or its
// distance, if that is larger. So distances have a bound that does not fall, and the process ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/kernel.hpp"
#include "geometry/grid.hpp"
#include "refinement/bucketed_queue.hpp"

namespace mesher::detail {

class Slivers {
 public:
  using Kernel = DelaunayKernel<3, BallLayout<3>>;

  /// `min_dihedral`: in degrees; 0: there are no slivers. `rho2`: above it a tetrahedron is poor.
  Slivers(const MeshBox<3>& box, double rho2, double min_dihedral);

  /// Whether there may be any.
  [[nodiscard]] bool any() const noexcept { return worst_ < 1; }
  [[nodiscard]] bool started() const noexcept { return started_; }
  /// Finds all that there are. Cost: O(n) for n simplices.
  void start(Kernel& kernel, const std::vector<VertexKind>& kinds);
  /// Of a simplex that is new. Requires: started().
  void look_at(const Kernel& kernel, const std::vector<VertexKind>& kinds, std::uint32_t s,
               const Shape& shape);
  /// Of a vertex that is dug. Requires: started().
  void before_fill(const Kernel& kernel, std::uint32_t v);

  /// The next sliver, or kNone: of short edges first.
  [[nodiscard]] std::uint32_t take();
  /// Digs v, which is no vertex yet, where it splits s best; false, and nothing dug: no place is
  /// better than none. `fits()`: whether v may be where it is dug.
  template <class Fits>
  [[nodiscard]] bool dig(Kernel& kernel, std::uint32_t s, std::uint32_t v, Fits&& fits);

  /// Vertices for slivers so far, and slivers that have found no place for one.
  [[nodiscard]] std::size_t split() const noexcept { return split_; }
  [[nodiscard]] std::size_t left() const noexcept;

 private:
  enum class Wait : std::uint8_t { none, queued, left };
  struct Place {
    int takes;        // of the slivers around a vertex
    double nearest2;  // to the corners of the sliver
    Point<3> at;
  };

  void add(std::uint32_t s, double shortest2);
  void find_places(Kernel& kernel, std::uint32_t s);
  void find_beside(Kernel& kernel, std::uint32_t s);
  [[nodiscard]] double least_floor2(const Kernel& kernel, std::uint32_t s) const;
  [[nodiscard]] static double score_of(const Kernel& kernel, std::uint32_t s);
  [[nodiscard]] double score(const Kernel& kernel, std::uint32_t v, double enough) const;
  [[nodiscard]] static double nearest2(const Kernel& kernel, std::uint32_t v);

  MeshBox<3> box_;
  double rho2_;
  double worst_;      // the largest cosine of a dihedral angle, squared with its sign
  std::size_t most_;  // places that are tried
  bool started_ = false;
  std::vector<Wait> wait_;      // by simplex
  std::vector<double> floor2_;  // by vertex
  ComputedBuckets<std::uint32_t> queue_;
  std::vector<std::uint32_t> left_;
  std::size_t split_ = 0, split_before_ = 0;  // now; when those left were tried again
  int rounds_ = 0;
  bool fills_ = false;  // before_fill() is of what dig() has dug
  double new_floor2_ = 0;
  // Scratch.
  std::vector<Place> places_;
  std::vector<std::uint32_t> star_, beside_;
};

template <class Fits>
bool Slivers::dig(Kernel& kernel, std::uint32_t s, std::uint32_t v, Fits&& fits) {
  const double floor2 = least_floor2(kernel, s);
  find_places(kernel, s);
  const auto try_at = [&](const Point<3>& p, double enough) {
    kernel.set_place(v, p);
    kernel.dig(v, s);
    const bool is_apart = nearest2(kernel, v) >= floor2 / 4;
    return is_apart && fits() ? score(kernel, v, enough) : 1;
  };
  double best = score_of(kernel, s);
  const Point<3>* best_at = nullptr;
  const auto dug = [&] {
    fills_ = true, new_floor2_ = floor2;
    ++split_;
    return true;
  };
  for (const Place& place : places_) {
    if (!kernel.conflicts(s, place.at)) continue;
    const double its = try_at(place.at, best);
    if (its <= worst_) return dug();
    kernel.undo_dig();
    if (its < best) best = its, best_at = &place.at;
  }
  if (best_at != nullptr) {
    kernel.set_place(v, *best_at);
    kernel.dig(v, s);
    return dug();
  }
  wait_[s] = Wait::left;
  left_.push_back(s);
  return false;
}

}  // namespace mesher::detail
