// Buckets of lengths, with the search radius of Complete and the independent vertices for each
// bucket.
//
// Bucket i holds the lengths in [rho^i l_0, rho^(i+1) l_0). In bucket [l, rho l) Complete sees the
// part of a Voronoi cell within the clip, gamma rho l; the squares of the colouring [Fig 4.9] are
// so large that of two vertices in different squares of one colour neither sees what the other
// inserts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"

namespace mesher::detail {

/// What a rule promises, by which buckets, squares and the boundary grid are sized.
struct Promise {
  double gamma;    // gap balls up to gamma times a bucket's longest length are looked for
  double inserts;  // no new vertex is farther than this from the vertex completed, in clips
  double input;    // an input point is within this times NN(x) of each x that the input leads to
};

template <int D>
class Buckets {
 public:
  Buckets(double rho, const Promise& promise, const MeshBox<D>& box);

  /// The bucket of a length, given its square. Cost: O(log log L/s).
  [[nodiscard]] int bucket(double length2) const;
  [[nodiscard]] int count() const noexcept { return static_cast<int>(start2_.size()); }

  /// Of the lengths in bucket b the shortest.
  [[nodiscard]] double shortest(int b) const { return std::sqrt(start2_[index(b)]); }
  /// How far Complete looks in bucket b; from the last bucket on, everywhere. (A vertex that comes
  /// in bucket b is looked at in b + 1, however short the lengths beside it.)
  [[nodiscard]] double clip_radius(int b) const { return clip_[index(b)]; }

  /// Vertices of one colour in different squares are at least this far apart.
  [[nodiscard]] double independent(int b) const;
  /// The colour of v in bucket b: the parities of its square's coordinates.
  [[nodiscard]] unsigned colour(const Fixed<D>& f, int b) const;

 private:
  [[nodiscard]] std::size_t index(int b) const noexcept {
    return std::min(static_cast<std::size_t>(b), start2_.size() - 1);
  }
  double unit_;                 // of Fixed coordinates
  std::vector<double> start2_;  // squared start of each bucket
  std::vector<double> clip_;
  std::vector<std::uint64_t> square_;  // side of a square, in units
};

/// Complete reads no vertex farther away than this, in clips. A cell is cut from the clip, an
/// octagon around the circle of its radius, in space a cube around the sphere; a vertex concerns it
/// only if it is in the ball around a corner, through v: within two circumradii of the clip.
template <int D>
inline constexpr double kReads = 2 * 1.7320508075688773;  // 2 sqrt(3)
template <>
inline constexpr double kReads<2> = 2 * 1.0823922002923939687994464;  // 2 / cos(pi / 8)

template <>
inline constexpr double kReads<4> = 2 * 2.0;  // 2 sqrt(4)

}  // namespace mesher::detail
