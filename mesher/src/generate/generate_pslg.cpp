// Families of points and lines. Each thing is drawn at random and taken if it is free of those that
// are there: by exact orientation, and by a distance that keeps what is not equal well apart.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "generate/on_circle.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/segment_tests.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"

namespace mesher {
namespace {

using detail::distance2;
using detail::segments_meet;
using detail::squared_distance;
using predicates::orient2d;

constexpr double kApart = 0x1p-20;  // least distance of a point to what it is not on
constexpr int kTriesPerThing = 50;  // before there is no room

// A number of a point; none for a point that is not there yet.
using Number = std::size_t;
constexpr Number kNew = static_cast<Number>(-1);

// A segment of numbers of points.
struct Piece {
  Number a, b;
};

// Points and segments of the unit square in a grid of cells, and what is free of them.
class Plane {
 public:
  // `reach`: the length of most segments.
  explicit Plane(double reach)
      : side_(std::clamp(static_cast<int>(1 / (2 * reach)), 1, 4096)),
        points_in_(squared_side()),
        pieces_in_(squared_side()) {}

  [[nodiscard]] const std::vector<Point<2>>& points() const { return points_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }

  [[nodiscard]] static bool inside(const Point<2>& p) {
    return p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1;
  }

  [[nodiscard]] bool is_free(const Point<2>& p) const {
    const Point<2> lo{p[0] - kApart, p[1] - kApart}, hi{p[0] + kApart, p[1] + kApart};
    return !any_point(lo, hi, [&](Number i) { return is_near(p, points_[i]); }) &&
           !any_piece(lo, hi, [&](const Piece& s) {
             return distance2(p, points_[s.a], points_[s.b]) < kApart * kApart;
           });
  }

  // Of the segment from p to q, ends that are points by their numbers.
  [[nodiscard]] bool is_free(const Point<2>& p, Number p_number, const Point<2>& q,
                             Number q_number) const {
    const auto is_end = [&](Number i) { return i == p_number || i == q_number; };
    const auto [lo, hi] = box(p, q);
    return !any_point(lo, hi, [&](Number i) {
      return !is_end(i) && distance2(points_[i], p, q) < kApart * kApart;
    }) && !any_piece(lo, hi, [&](const Piece& s) {
      return is_end(s.a) || is_end(s.b) ? overlaps(s, p, p_number, q)
                                        : segments_meet(points_[s.a], points_[s.b], p, q);
    });
  }

  Number add(const Point<2>& p) {
    points_.push_back(p);
    points_in_[cell(p)].push_back(points_.size() - 1);
    return points_.size() - 1;
  }

  void add(Number a, Number b) {
    pieces_.push_back({a, b});
    const auto [lo, hi] = box(points_[a], points_[b]);
    for_each_cell(lo, hi, [&](std::size_t c) {
      pieces_in_[c].push_back(pieces_.size() - 1);
      return false;
    });
  }

 private:
  [[nodiscard]] std::size_t squared_side() const {
    return static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  }
  [[nodiscard]] int row(double x) const {
    return std::clamp(static_cast<int>(std::floor(x * side_)), 0, side_ - 1);
  }
  [[nodiscard]] std::size_t cell(const Point<2>& p) const {
    return static_cast<std::size_t>(row(p[1])) * static_cast<std::size_t>(side_) +
           static_cast<std::size_t>(row(p[0]));
  }
  static Box<2> box(const Point<2>& p, const Point<2>& q) {
    return {{std::min(p[0], q[0]), std::min(p[1], q[1])},
            {std::max(p[0], q[0]), std::max(p[1], q[1])}};
  }

  // Whether `each(cell)` is true of a cell that the box meets.
  template <class Each>
  bool for_each_cell(const Point<2>& lo, const Point<2>& hi, Each each) const {
    for (int y = row(lo[1]); y <= row(hi[1]); ++y) {
      for (int x = row(lo[0]); x <= row(hi[0]); ++x) {
        if (each(static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                 static_cast<std::size_t>(x))) {
          return true;
        }
      }
    }
    return false;
  }
  template <class Test>
  bool any_point(const Point<2>& lo, const Point<2>& hi, Test test) const {
    return for_each_cell(lo, hi, [&](std::size_t c) {
      return std::any_of(points_in_[c].begin(), points_in_[c].end(), test);
    });
  }
  template <class Test>
  bool any_piece(const Point<2>& lo, const Point<2>& hi, Test test) const {
    return for_each_cell(lo, hi, [&](std::size_t c) {
      return std::any_of(pieces_in_[c].begin(), pieces_in_[c].end(),
                         [&](std::size_t i) { return test(pieces_[i]); });
    });
  }

  static bool is_near(const Point<2>& p, const Point<2>& q) {
    return squared_distance(p, q) < kApart * kApart;
  }

  // Whether s, which shares an end with pq, has more of it. The other end of s is tested as a
  // point.
  [[nodiscard]] bool overlaps(const Piece& s, const Point<2>& p, Number p_number,
                              const Point<2>& q) const {
    const bool at_p = s.a == p_number || s.b == p_number;
    const Point<2>&o = at_p ? p : q, &end = at_p ? q : p;
    const Point<2>& other = points_[s.a] == o ? points_[s.b] : points_[s.a];
    if (orient2d(o, end, other) != 0) return false;
    return (end[0] - o[0]) * (other[0] - o[0]) + (end[1] - o[1]) * (other[1] - o[1]) > 0;
  }

  int side_;
  std::vector<Point<2>> points_;
  std::vector<Piece> pieces_;
  std::vector<std::vector<Number>> points_in_;
  std::vector<std::vector<std::size_t>> pieces_in_;
};

Point<2> ahead(const Point<2>& from, double turns, double length) {
  const Point<2> direction = on_circle(turns);
  return {from[0] + length * direction[0], from[1] + length * direction[1]};
}

// Draws the things of a family; each returns whether there was room for it.
class Drawer {
 public:
  Drawer(const PslgFamily& family, double reach)
      : random_(family.seed), reach_(reach), plane_(reach) {}

  double unit() { return random_.unit(); }
  [[nodiscard]] const Plane& plane() const { return plane_; }

  // Until `n` have been drawn, or there is no room.
  template <class Draw>
  void draw(std::size_t n, Draw draw_one) {
    std::size_t tries = kTriesPerThing * n;
    for (std::size_t done = 0; done < n && tries > 0; --tries) {
      if (draw_one()) ++done;
    }
  }

  bool point() {
    const Point<2> p{unit(), unit()};
    if (!plane_.inside(p) || !plane_.is_free(p)) return false;
    plane_.add(p);
    return true;
  }

  bool segment(double length) {
    const double x = unit();
    const Point<2> p{x, unit()}, q = ahead(p, unit(), length);
    if (!plane_.inside(p) || !plane_.inside(q) || !plane_.is_free(p) || !plane_.is_free(q) ||
        !plane_.is_free(p, kNew, q, kNew)) {
      return false;
    }
    const Number a = plane_.add(p), b = plane_.add(q);
    plane_.add(a, b);
    return true;
  }

  bool short_segment() { return segment(reach_ * (0.2 + 0.8 * unit())); }

  // From a point that is there; its other end, or kNew.
  Number grow(Number from, double turns, double length) {
    const Point<2> p = plane_.points()[from], q = ahead(p, turns, length);
    if (!plane_.inside(q) || !plane_.is_free(q) || !plane_.is_free(p, from, q, kNew)) return kNew;
    const Number end = plane_.add(q);
    plane_.add(from, end);
    return end;
  }

  bool branch() {
    if (plane_.points().empty()) return false;
    const Number from = random_.below(plane_.points().size());
    const double turns = unit();
    return grow(from, turns, reach_ * (0.2 + 0.8 * unit())) != kNew;
  }

  // As many pieces as there is room for; its points.
  std::vector<Number> polyline(std::size_t pieces, double length) {
    const double x = unit();
    const Point<2> p{x, unit()};
    if (!plane_.inside(p) || !plane_.is_free(p)) return {};
    std::vector<Number> line{plane_.add(p)};
    double turns = unit();
    for (int tries = 10; line.size() <= pieces && tries > 0; --tries) {
      constexpr double kBend = 75.0 / 360;
      const double next = turns + kBend * (2 * unit() - 1) + 1;  // no turn is negative
      const Number end = grow(line.back(), next - std::floor(next), length);
      if (end == kNew) continue;
      line.push_back(end);
      turns = next - std::floor(next);
      tries = 10;
    }
    return line;
  }

  Number add(const Point<2>& p) { return plane_.add(p); }
  void add(Number a, Number b) { plane_.add(a, b); }

 private:
  SplitMix64 random_;
  double reach_;
  Plane plane_;
};

PointId id_of(std::size_t number) { return PointId{static_cast<std::int64_t>(number) + 1}; }

LineId line_of(std::size_t number) { return LineId{static_cast<std::int64_t>(number) + 1}; }

// All pieces are segments but those of `lines`, whose pieces come in their order.
Graph<2> pslg_of(const Plane& plane, const std::vector<std::vector<Number>>& lines = {}) {
  Graph<2> pslg;
  for (std::size_t i = 0; i < plane.points().size(); ++i) {
    pslg.points.push_back({id_of(i), plane.points()[i], 0});
  }
  std::size_t number = 0;
  if (lines.empty()) {
    for (const Piece& s : plane.pieces()) {
      pslg.segments.push_back({line_of(number++), id_of(s.a), id_of(s.b), 0});
    }
  }
  for (const auto& line : lines) {
    if (line.size() < 2) continue;
    std::vector<PointId> points;
    for (const Number i : line) points.push_back(id_of(i));
    pslg.polylines.push_back({line_of(number++), std::move(points), 0});
  }
  return pslg;
}

Graph<2> polylines(Drawer& draw, std::size_t n, double reach) {
  std::vector<std::vector<Number>> lines;
  std::size_t pieces = 0;
  for (std::size_t tries = kTriesPerThing * n; pieces < n && tries > 0; --tries) {
    const auto wanted = 3 + static_cast<std::size_t>(10 * draw.unit());
    lines.push_back(draw.polyline(wanted, reach * (0.2 + 0.5 * draw.unit())));
    pieces += std::max<std::size_t>(lines.back().size(), 1) - 1;
  }
  return pslg_of(draw.plane(), lines);
}

// Gaps between the lines are 0.1 to 1.1 times their mean, so no two lines meet.
Graph<2> corridors(Drawer& draw, std::size_t n) {
  const double gap = 0.8 / static_cast<double>(std::max<std::size_t>(n, 1));
  double y = 0.05;
  for (std::size_t i = 0; i < n; ++i) {
    const double left = 0.02 + 0.05 * draw.unit(), right = 0.98 - 0.05 * draw.unit();
    const double rise = 0.04 * gap * draw.unit();
    const Number a = draw.add({left, y}), b = draw.add({right, y + rise});
    draw.add(a, b);
    y += gap * (0.1 + draw.unit());
  }
  return pslg_of(draw.plane());
}

Graph<2> zigzag(Drawer& draw, std::size_t n) {
  std::vector<Number> line;
  for (std::size_t i = 0; n > 0 && i <= n; ++i) {
    const double x = 0.1 + 0.8 * static_cast<double>(i) / static_cast<double>(n);
    const double y = (i % 2 == 1 ? 0.8 : 0.2) + 0.01 * draw.unit();
    line.push_back(draw.add({x, y}));
  }
  return pslg_of(draw.plane(), {line});
}

Graph<2> fan(Drawer& draw, std::size_t n, double degrees) {
  constexpr double kFirst = 0.03;  // turns: no leg lies along an axis
  const Number centre = draw.add({0.5, 0.5});
  for (std::size_t i = 0; i < n; ++i) {
    const double turns = kFirst + static_cast<double>(i) * (degrees / 360);
    draw.add(centre, draw.add(ahead({0.5, 0.5}, turns, 0.4)));
  }
  return pslg_of(draw.plane());
}

Graph<2> bundle(Drawer& draw, std::size_t n, double degrees) {
  const Number centre = draw.add({0.1, 0.1});
  draw.draw(n, [&] {
    constexpr double kFirst = 0.08;  // turns
    const double turns = kFirst + draw.unit() * (degrees / 360);
    return draw.grow(centre, turns, 0.3 + 0.5 * draw.unit()) != kNew;
  });
  return pslg_of(draw.plane());
}

}  // namespace

const std::vector<std::string>& pslg_kind_names() {
  static const std::vector<std::string> names{"segments",  "lengths", "polylines", "trees",
                                              "corridors", "zigzag",  "fan",       "bundle"};
  return names;
}

std::optional<PslgKind> pslg_kind(std::string_view name) {
  const auto& names = pslg_kind_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<PslgKind>(found - names.begin());
}

Graph<2> generate_pslg(const PslgFamily& family) {
  const std::size_t n = family.n;
  const double count = static_cast<double>(std::max<std::size_t>(n, 1));
  const double reach = 1 / std::sqrt(2 * count);
  Drawer draw(family, reach);
  switch (family.kind) {
    case PslgKind::segments:
      draw.draw(n, [&] { return draw.short_segment(); });
      draw.draw(n, [&] { return draw.point(); });
      return pslg_of(draw.plane());
    case PslgKind::lengths:
      draw.draw(n, [&] {
        const double u = draw.unit() + 0x1p-13;
        return draw.segment(std::min(0.3 * reach / (std::sqrt(u) * std::sqrt(std::sqrt(u))), 0.7));
      });
      return pslg_of(draw.plane());
    case PslgKind::polylines:
      return polylines(draw, n, reach);
    case PslgKind::trees:
      draw.draw((n + 1) / 2, [&] { return draw.short_segment(); });
      draw.draw(n / 2, [&] { return draw.branch(); });
      return pslg_of(draw.plane());
    case PslgKind::corridors:
      return corridors(draw, n);
    case PslgKind::zigzag:
      return zigzag(draw, n);
    case PslgKind::fan:
      return fan(draw, n, family.angle.value_or(360 / count));
    case PslgKind::bundle:
      return bundle(draw, n, family.angle.value_or(0.05));
  }
  return {};
}

}  // namespace mesher
