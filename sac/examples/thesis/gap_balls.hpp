// The gap balls on a vertex [Def 4.2.1], in any dimension, in doubles.
//
// The centres of gap balls on v are the points of the domain that no other vertex is nearer to: v's
// Voronoi cell. Its part within a cube around v is kept as the list of its corners, each with the D
// planes that it lies on, and cut by one vertex after the other: corners nearer to the new vertex
// than to v go, and where one that goes and one that stays have all planes but one in common, an
// edge is cut. Corners equally far from both but for rounding stay: where more than D planes meet
// in a point, several corners are in one place. A corner that is made lies between two, so all stay
// in the cell but for rounding.
//
// The figures leave open which gap ball is filled: here the largest, shrunk to gamma NN(v), of
// equal ones the one with the greatest centre.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "cells.hpp"

namespace examples::thesis {

template <int D>
class GapBalls {
 public:
  /// Those with centres in [0, L]^D, and no coordinate of them farther than `reach` from v's.
  GapBalls(const Point<D>& v, double reach, double L);

  /// w is a vertex: balls that hold it are no gap balls. Requires: w != v.
  void cut(const Point<D>& w);

  /// Whether a gap ball reaches into the cell.
  [[nodiscard]] bool enter(const Cell<D>& c) const;

  struct Ball {
    Point<D> centre;
    double radius;
  };
  /// The largest of a radius above `least`, shrunk to `most`.
  [[nodiscard]] std::optional<Ball> largest(double least, double most) const;

 private:
  struct Corner {
    Point<D> at;                  // relative to v
    std::array<int, D> planes{};  // ascending
    double from_v2 = 0;
    double nearer = 0;  // to v than to the vertex that cuts: difference of squared distances
  };
  // Up to here a corner is equally near, in |v w|^2: some bits more than rounding takes.
  static constexpr double kTie = 0x1p-42;

  void cut_edge(const Corner& stays, const Corner& goes);
  [[nodiscard]] Ball ball_at(const Corner& q, double most) const;

  Point<D> v_;
  double L_;
  int planes_ = 2 * D;  // so far; the first are the cube's sides
  std::vector<Corner> corners_;
};

template <int D>
GapBalls<D>::GapBalls(const Point<D>& v, double reach, double L) : v_(v), L_(L) {
  for (unsigned which = 0; which < 1u << D; ++which) {
    Corner q;
    for (unsigned i = 0; i < D; ++i) {
      const bool high = (which >> i & 1) != 0;
      q.at.x[i] = high ? std::min(reach, L - v[i]) : std::max(-reach, -v[i]);
      q.planes[i] = static_cast<int>(2 * i + high);
    }
    q.from_v2 = squared_distance(q.at, Point<D>{});
    corners_.push_back(q);
  }
}

template <int D>
void GapBalls<D>::cut(const Point<D>& w) {
  Point<D> to_w;
  for (std::size_t i = 0; i < D; ++i) to_w.x[i] = w[i] - v_[i];
  const double apart2 = squared_distance(to_w, Point<D>{});
  for (Corner& q : corners_) {
    q.nearer = apart2;
    for (std::size_t i = 0; i < D; ++i) q.nearer -= 2 * to_w[i] * q.at[i];
  }
  const auto stays = [&](const Corner& q) { return q.nearer >= -kTie * apart2; };
  const auto first = std::stable_partition(corners_.begin(), corners_.end(), stays);
  const std::vector<Corner> gone(first, corners_.end());
  corners_.erase(first, corners_.end());
  if (gone.empty()) return;
  const std::size_t kept = corners_.size();
  for (std::size_t i = 0; i < kept; ++i) {
    for (const Corner& goes : gone) cut_edge(Corner(corners_[i]), goes);
  }
  ++planes_;
}

// If the corners are the ends of an edge, adds the place on it that is as near to the new vertex as
// to v.
template <int D>
void GapBalls<D>::cut_edge(const Corner& stays, const Corner& goes) {
  Corner q;
  const auto common =
      std::set_intersection(stays.planes.begin(), stays.planes.end(), goes.planes.begin(),
                            goes.planes.end(), q.planes.begin());
  if (common != q.planes.end() - 1) return;
  *common = planes_;
  const double inside = std::max(stays.nearer, 0.0);
  const double part = inside / (inside - goes.nearer);
  for (std::size_t i = 0; i < D; ++i) {
    q.at.x[i] = stays.at[i] + part * (goes.at[i] - stays.at[i]);
  }
  q.from_v2 = squared_distance(q.at, Point<D>{});
  corners_.push_back(q);
}

template <int D>
bool GapBalls<D>::enter(const Cell<D>& c) const {
  const double side = side_of(c, L_);
  Point<D> low;
  for (std::size_t i = 0; i < D; ++i) low.x[i] = static_cast<double>(c.at[i]) * side - v_[i];
  return std::any_of(corners_.begin(), corners_.end(), [&](const Corner& q) {
    double apart2 = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const double out = std::max({0.0, low[i] - q.at[i], q.at[i] - low[i] - side});
      apart2 += out * out;
    }
    return apart2 <= q.from_v2;
  });
}

template <int D>
auto GapBalls<D>::ball_at(const Corner& q, double most) const -> Ball {
  Ball ball{v_, std::sqrt(q.from_v2)};
  const double part = ball.radius > most ? most / ball.radius : 1;
  for (std::size_t i = 0; i < D; ++i) {
    ball.centre.x[i] = std::clamp(v_[i] + part * q.at[i], 0.0, L_);
  }
  ball.radius *= part;
  return ball;
}

template <int D>
auto GapBalls<D>::largest(double least, double most) const -> std::optional<Ball> {
  std::optional<Ball> best;
  for (const Corner& q : corners_) {
    const Ball ball = ball_at(q, most);
    if (!(ball.radius > least)) continue;
    const bool larger = !best || ball.radius > best->radius ||
                        (ball.radius == best->radius && best->centre < ball.centre);
    if (larger) best = ball;
  }
  return best;
}

}  // namespace examples::thesis
