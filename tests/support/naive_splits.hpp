// How segments are split before refinement, from the words of the rules [A1, A2] and a look at all
// features for every question.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/segment_tests.hpp"
#include "random_pslg.hpp"

namespace support {

class NaiveSplits {
 public:
  using Place = mesher::Point<2>;

  explicit NaiveSplits(const Pslg& pslg) {
    for (const auto& [id, p] : pslg.points) points_.push_back(p);
    for (const auto& [ends, id] : pslg.segments) {
      const Place& a = pslg.points.at(ends.first);
      const Place& b = pslg.points.at(ends.second);
      segments_.push_back({std::min(a, b), std::max(a, b)});
    }
    for (std::size_t i = 0; i < segments_.size() && !too_many(); ++i) split_all(segments_[i]);
    std::sort(vertices_.begin(), vertices_.end());
  }
  /// The new vertices, sorted.
  [[nodiscard]] const std::vector<Place>& vertices() const { return vertices_; }
  [[nodiscard]] bool too_many() const { return vertices_.size() > 2000; }

 private:
  struct Line {
    Place a, b;
    [[nodiscard]] double length() const { return std::sqrt(squared(a, b)); }
    [[nodiscard]] bool ends_at(const Place& p) const { return a == p || b == p; }
    [[nodiscard]] bool touches(const Line& t) const { return ends_at(t.a) || ends_at(t.b); }
  };
  enum class Origin { none, a, b, a_then_b, b_then_a };
  // Distances of a place on a line from both its ends.
  struct Mark {
    double from_a, from_b;
  };
  struct Part {
    Mark lo, hi;
    Origin origin;
  };

  static double squared(const Place& p, const Place& q) {
    return (q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]);
  }
  static Place at(const Line& s, const Mark& m) {
    const bool near_a = m.from_a <= m.from_b;
    const Place& o = near_a ? s.a : s.b;
    const Place& e = near_a ? s.b : s.a;
    const double t = (near_a ? m.from_a : m.from_b) / s.length();
    return {o[0] + t * (e[0] - o[0]), o[1] + t * (e[1] - o[1])};
  }

  [[nodiscard]] bool crowded(const Line& s, const Place& a, const Place& b) const {
    const double length2 = squared(a, b);
    const Place middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    for (const Line& t : segments_) {
      if (t.touches(s)) continue;
      if (mesher::detail::distance2(middle, t.a, t.b) < length2 / 4) return true;
      if (mesher::detail::distance2(a, b, t.a, t.b) < length2 / 64) return true;
    }
    for (const Place& p : points_) {
      if (s.ends_at(p)) continue;
      const double cosine = (p[0] - a[0]) * (p[0] - b[0]) + (p[1] - a[1]) * (p[1] - b[1]);
      if (cosine <= 1e-12 * length2) return true;
      if (mesher::detail::distance2(p, a, b) < length2 / 64) return true;
    }
    return false;
  }

  static double degrees(const Place& o, const Line& s, const Line& t) {
    const Place& p = s.a == o ? s.b : s.a;
    const Place& q = t.a == o ? t.b : t.a;
    const double ux = p[0] - o[0], uy = p[1] - o[1], wx = q[0] - o[0], wy = q[1] - o[1];
    return std::abs(std::atan2(ux * wy - uy * wx, ux * wx + uy * wy)) * 180 / std::acos(-1.0);
  }
  [[nodiscard]] double reach(const Place& o) const {
    double r = std::numeric_limits<double>::infinity();
    for (const Line& t : segments_) {
      r = std::min(r,
                   t.ends_at(o) ? t.length() : std::sqrt(mesher::detail::distance2(o, t.a, t.b)));
    }
    for (const Place& p : points_) {
      if (p != o) r = std::min(r, std::sqrt(squared(o, p)));
    }
    return r;
  }
  [[nodiscard]] double zone(const Line& s, const Place& o) const {
    double z = 0;
    for (const Line& t : segments_) {
      if (!t.ends_at(o) || (t.a == s.a && t.b == s.b)) continue;
      const double angle = degrees(o, s, t);
      if (angle < 20) z = std::max(z, std::min(s.length(), t.length()));
      if (angle >= 20 && angle < 60) z = std::max(z, std::min(reach(o), t.length()));
    }
    return z;
  }

  static double roundest(double from, double to) {
    const double lo = from + (to - from) / 3, hi = to - (to - from) / 3;
    for (double unit = std::ldexp(1.0, 10);; unit /= 2) {
      if (const double m = std::ceil(lo / unit) * unit; m <= hi) return m;
    }
  }
  [[nodiscard]] Origin origin(const Line& s) const {
    const double za = zone(s, s.a), zb = zone(s, s.b), half = s.length() / 2;
    if (za >= half && zb >= half) return Origin::none;
    if (zb >= half) return za > 0 ? Origin::b_then_a : Origin::b;
    return zb > 0 ? Origin::a_then_b : Origin::a;
  }
  // The two halves: the first ends where the second begins.
  [[nodiscard]] std::pair<Part, Part> split(const Line& s, Part part, bool is_whole) const {
    const double length = s.length();
    if (is_whole) part.origin = origin(s);
    if (part.origin == Origin::none) {
      const Mark m{length / 2, length - length / 2};
      return {{part.lo, m, Origin::a}, {m, part.hi, Origin::b}};
    }
    const bool at_a = part.origin == Origin::a || part.origin == Origin::a_then_b;
    const double r =
        at_a ? roundest(part.lo.from_a, part.hi.from_a) : roundest(part.hi.from_b, part.lo.from_b);
    const Mark m = at_a ? Mark{r, length - r} : Mark{length - r, r};
    Part lo{part.lo, m, part.origin}, hi{m, part.hi, part.origin};
    if (part.origin == Origin::a_then_b) {
      lo.origin = Origin::a;
      if (m.from_b <= zone(s, s.b)) hi.origin = Origin::b;
    }
    if (part.origin == Origin::b_then_a) {
      hi.origin = Origin::b;
      if (m.from_a <= zone(s, s.a)) lo.origin = Origin::a;
    }
    return {lo, hi};
  }
  void split_all(const Line& s) {
    const double length = s.length();
    std::vector<Part> open{{{0, length}, {length, 0}, Origin::none}};
    bool is_whole = true;
    while (!open.empty() && !too_many()) {
      const Part part = open.back();
      open.pop_back();
      if (!crowded(s, at(s, part.lo), at(s, part.hi))) continue;
      const auto [lo, hi] = split(s, part, std::exchange(is_whole, false));
      vertices_.push_back(at(s, lo.hi));
      open.push_back(lo);
      open.push_back(hi);
    }
  }

  std::vector<Place> points_;
  std::vector<Line> segments_;
  std::vector<Place> vertices_;
};

}  // namespace support
