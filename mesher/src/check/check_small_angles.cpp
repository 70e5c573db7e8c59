// Which poor tetrahedra small angles of a complex excuse.
#include <algorithm>
#include <cmath>
#include <utility>

#include "check/check_complex.hpp"
#include "geometry/space_distances.hpp"

namespace mesher::detail {

namespace {

constexpr double kEqualDistances = 1e-9;  // distances that differ by no more of them are equal

template <class Items>
bool intersects(const Items& a, const Items& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](const auto& x) { return std::find(b.begin(), b.end(), x) != b.end(); });
}

}  // namespace

void ComplexCheck::name_vertices() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    for (const auto& run : lines_[i].runs) {
      for (const std::uint32_t vertex : run) {
        Featured& v = featured_[vertex];
        v.lines.push_back(i);
        v.is_point = v.is_point || at(vertex) == lines_[i].from || at(vertex) == lines_[i].to;
      }
    }
  }
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    for (const std::uint32_t v : surfaces_[i].on) featured_[v].surfaces.push_back(i);
  }
}

bool ComplexCheck::excuses(const Mesh<3>::Simplex& s) const {
  std::vector<std::pair<double, Ends>> edges;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = i + 1; k < 4; ++k) {
      edges.push_back({squared_distance(at(s[i]), at(s[k])), {s[i], s[k]}});
    }
  }
  const double least = std::min_element(edges.begin(), edges.end())->first;
  return std::any_of(edges.begin(), edges.end(), [&](const auto& e) {
    return e.first <= least * (1 + kEqualDistances) && is_short(e.second[0], e.second[1]);
  });
}

bool ComplexCheck::is_short(std::uint32_t a, std::uint32_t b) const {
  const auto p = featured_.find(a), q = featured_.find(b);
  if (p == featured_.end() || q == featured_.end()) return false;
  if (p->second.is_point || q->second.is_point) return false;
  return share_shell(a, b) || share_shell(b, a) || is_wide(a, b);
}

// Whether b, on a polygon with a point and on no edge, is as far from that as a, which is on
// something with it.
bool ComplexCheck::share_shell(std::uint32_t a, std::uint32_t b) const {
  const Featured &p = featured_.at(a), &q = featured_.at(b);
  if (!q.lines.empty()) return false;
  const auto has = [&](PointId point) {
    return std::any_of(p.lines.begin(), p.lines.end(),
                       [&](std::size_t l) {
                         return lines_[l].ends[0] == point || lines_[l].ends[1] == point;
                       }) ||
           std::any_of(p.surfaces.begin(), p.surfaces.end(),
                       [&](std::size_t f) { return surfaces_[f].points.count(point) != 0; });
  };
  for (const std::size_t f : q.surfaces) {
    for (const PointId point : surfaces_[f].points) {
      const Point<3>& o = places_.at(point);
      const double x = std::sqrt(squared_distance(at(a), o)),
                   y = std::sqrt(squared_distance(at(b), o));
      if (std::abs(x - y) <= kEqualDistances * (x + y) + 4 * rounding_ && has(point)) return true;
    }
  }
  return false;
}

// Whether the edge is shorter than both ends' distances from what two features share that they are
// on, and not on both.
bool ComplexCheck::is_wide(std::uint32_t a, std::uint32_t b) const {
  const Featured &p = featured_.at(a), &q = featured_.at(b);
  const double length2 = squared_distance(at(a), at(b));
  const auto is_far = [&](const Point<3>& from, const Point<3>& to) {
    return length2 < std::min(distance2(at(a), from, to), distance2(at(b), from, to));
  };
  const auto points_of = [&](std::size_t l) {
    return std::set<PointId>(lines_[l].ends.begin(), lines_[l].ends.end());
  };
  // Of two features by their points and lines.
  const auto look_at = [&](const std::set<PointId>& f, const std::vector<std::size_t>& of_f,
                           const std::set<PointId>& g, const std::vector<std::size_t>& of_g) {
    for (const std::size_t l : of_f) {
      const bool both = std::find(of_g.begin(), of_g.end(), l) != of_g.end();
      if (both && is_far(lines_[l].from, lines_[l].to)) return true;
    }
    if (intersects(of_f, of_g)) return false;
    return std::any_of(f.begin(), f.end(), [&](PointId point) {
      return g.count(point) != 0 && is_far(places_.at(point), places_.at(point));
    });
  };
  const auto for_each = [&](const Featured& x, const Featured& other, auto&& visit) {
    for (const std::size_t l : x.lines) {
      const bool is_others =
          std::find(other.lines.begin(), other.lines.end(), l) != other.lines.end();
      if (!is_others && visit(points_of(l), std::vector{l})) return true;
    }
    for (const std::size_t i : x.surfaces) {
      const auto& all = other.surfaces;
      const bool is_others = std::find(all.begin(), all.end(), i) != all.end();
      if (!is_others && visit(surfaces_[i].points, surfaces_[i].lines)) return true;
    }
    return false;
  };
  return for_each(p, q, [&](const std::set<PointId>& f, const std::vector<std::size_t>& of_f) {
    return for_each(q, p, [&](const std::set<PointId>& g, const std::vector<std::size_t>& of_g) {
      return look_at(f, of_f, g, of_g);
    });
  });
}

}  // namespace mesher::detail
