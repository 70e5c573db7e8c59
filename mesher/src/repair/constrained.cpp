// Flips.
#include "repair/constrained.hpp"

#include <algorithm>
#include <deque>

#include "mesher/delaunay.hpp"
#include "mesher/predicates.hpp"
#include "repair/crossing_place.hpp"

namespace mesher::detail {

namespace {

using Triangle = Constrained::Triangle;

Triangle in_order(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

}  // namespace

Constrained::Constrained(std::vector<Point<2>> places) : places_(std::move(places)) {
  for (Point<2>& p : places_) p = {allowed(p[0]), allowed(p[1])};
  for (const auto& t : delaunay<2>(places_).simplices) put(t[0], t[1], t[2]);
}

int Constrained::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return predicates::orient2d(places_[a], places_[b], places_[c]);
}

void Constrained::put(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  apexes_[{a, b}] = c;
  apexes_[{b, c}] = a;
  apexes_[{c, a}] = b;
}

// The edges that cross ab, from a on, each with a's side of it on the left; nothing if a point is
// in the way.
std::optional<std::vector<Constrained::Directed>> Constrained::crossed(std::uint32_t a,
                                                                       std::uint32_t b) const {
  std::vector<Directed> edges;
  for (auto it = apexes_.lower_bound({a, 0}); it != apexes_.end() && it->first.first == a; ++it) {
    const std::uint32_t u = it->first.second, w = it->second;
    if (turn(a, b, u) < 0 && turn(a, b, w) > 0 && turn(u, w, b) < 0) edges.push_back({u, w});
  }
  if (edges.size() != 1) return std::nullopt;
  for (;;) {
    const auto [u, w] = edges.back();
    const auto x = apex(w, u);
    if (!x) return std::nullopt;
    if (*x == b) return edges;
    const int side = turn(a, b, *x);
    if (side == 0) return std::nullopt;
    edges.push_back(side > 0 ? Directed{u, *x} : Directed{*x, w});
  }
}

// Whether the quadrilateral around an edge can be cut the other way.
bool Constrained::is_convex(std::uint32_t u, std::uint32_t w) const {
  const std::uint32_t p = *apex(u, w), q = *apex(w, u);
  return turn(p, q, u) * turn(p, q, w) < 0;
}

// Returns the edge that comes.
Constrained::Directed Constrained::flip(std::uint32_t u, std::uint32_t w) {
  const std::uint32_t p = *apex(u, w), q = *apex(w, u);
  apexes_.erase({u, w});
  apexes_.erase({w, u});
  put(p, u, q);
  put(q, w, p);
  return {p, q};
}

bool Constrained::add(std::uint32_t a, std::uint32_t b) {
  if (apex(a, b) || apex(b, a)) {
    stay_.insert(link(a, b));
    return true;
  }
  const auto edges = crossed(a, b);
  if (!edges) return false;
  for (const auto& [u, w] : *edges) {
    if (stay_.count(link(u, w)) > 0) return false;
  }
  std::deque<Directed> ahead(edges->begin(), edges->end());
  while (!ahead.empty()) {
    const auto [u, w] = ahead.front();
    ahead.pop_front();
    if (!is_convex(u, w)) {
      ahead.emplace_back(u, w);
      continue;
    }
    const auto [p, q] = flip(u, w);
    if (p != a && p != b && q != a && q != b && turn(a, b, p) * turn(a, b, q) < 0) {
      ahead.emplace_back(p, q);
    }
  }
  stay_.insert(link(a, b));
  return true;
}

void Constrained::settle() {
  std::set<std::array<std::uint32_t, 2>> ahead;
  for (const auto& [edge, apex] : apexes_) ahead.insert(link(edge.first, edge.second));
  while (!ahead.empty()) {
    const auto [u, w] = *ahead.begin();
    ahead.erase(ahead.begin());
    const auto p = apex(u, w), q = apex(w, u);
    if (!p || !q || stay_.count({u, w}) > 0) continue;
    const int inside = predicates::incircle(places_[u], places_[w], places_[*p], places_[*q]);
    if (inside <= 0 || !is_convex(u, w)) continue;
    flip(u, w);
    for (const std::uint32_t end : {u, w}) {
      ahead.insert(link(end, *p));
      ahead.insert(link(end, *q));
    }
  }
}

std::vector<std::vector<Triangle>> Constrained::inside(const Links& borders) const {
  std::map<Triangle, bool> known;  // whether it is inside
  std::vector<Triangle> ahead;
  const auto reach = [&](std::uint32_t u, std::uint32_t w, bool is_inside) {
    const Triangle t = in_order({u, w, *apex(u, w)});
    if (known.emplace(t, is_inside).second) ahead.push_back(t);
  };
  const auto is_border = [&](std::uint32_t u, std::uint32_t w) {
    return borders.count(link(u, w)) > 0;
  };
  for (const auto& [edge, apex_there] : apexes_) {
    const auto [u, w] = edge;
    if (!apex(w, u)) reach(u, w, is_border(u, w));
  }
  while (!ahead.empty()) {
    const Triangle t = ahead.back();
    ahead.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t u = t[i], w = t[(i + 1) % 3];
      if (apex(w, u)) reach(w, u, known.at(t) != is_border(u, w));
    }
  }
  std::vector<std::vector<Triangle>> parts;
  std::set<Triangle> seen;
  for (const auto& [first, is_inside] : known) {
    if (!is_inside || !seen.insert(first).second) continue;
    std::vector<Triangle>& part = parts.emplace_back();
    part.push_back(first);
    for (std::size_t k = 0; k < part.size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t u = part[k][i], w = part[k][(i + 1) % 3];
        if (is_border(u, w)) continue;
        const Triangle beside = in_order({w, u, *apex(w, u)});
        if (seen.insert(beside).second) part.push_back(beside);
      }
    }
    std::sort(part.begin(), part.end());
  }
  return parts;
}

namespace {

// Around a part: from each edge of its border, with the part on the left, to the next one.
class Walk {
 public:
  Walk(const std::vector<Triangle>& part, const Links& borders) : borders_(borders) {
    for (const Triangle& t : part) {
      for (std::size_t i = 0; i < 3; ++i) apexes_[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
    }
    for (const auto& [edge, apex] : apexes_) {
      if (is_border(edge.first, edge.second)) ahead_.insert(edge);
    }
  }
  // A walk that closes; nothing if there is no more. It may pass a point more than once.
  std::vector<std::uint32_t> next_loop() {
    std::vector<std::uint32_t> loop;
    if (ahead_.empty()) return loop;
    Edge edge = *ahead_.begin();
    while (ahead_.erase(edge) > 0) {
      loop.push_back(edge.first);
      Edge after{edge.second, apexes_.at(edge)};
      while (!is_border(after.first, after.second)) {
        after.second = apexes_.at({after.second, after.first});
      }
      edge = after;
    }
    return loop;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  [[nodiscard]] bool is_border(std::uint32_t u, std::uint32_t w) const {
    return borders_.count(link(u, w)) > 0;
  }
  const Links& borders_;
  std::map<Edge, std::uint32_t> apexes_;
  std::set<Edge> ahead_;
};

double area2(const std::vector<std::uint32_t>& loop, const std::vector<Point<2>>& places) {
  const Point<2>& o = places[loop[0]];
  double sum = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Point<2>&a = places[loop[i]], &b = places[loop[i + 1]];
    sum += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return sum;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> loops_around(const std::vector<Triangle>& part,
                                                     const Links& borders,
                                                     const std::vector<Point<2>>& places) {
  Walk walk(part, borders);
  std::vector<std::vector<std::uint32_t>> loops;
  for (auto around = walk.next_loop(); !around.empty(); around = walk.next_loop()) {
    std::vector<std::uint32_t> open;  // cut where it comes back to a point
    std::set<std::uint32_t> on_it;
    for (const std::uint32_t v : around) {
      if (!on_it.insert(v).second) {
        const auto seen = std::find(open.begin(), open.end(), v);
        loops.emplace_back(seen, open.end());
        for (auto it = seen + 1; it != open.end(); ++it) on_it.erase(*it);
        open.erase(seen, open.end());
      }
      open.push_back(v);
    }
    loops.push_back(std::move(open));
  }
  std::stable_sort(loops.begin(), loops.end(), [&](const auto& a, const auto& b) {
    return area2(a, places) > area2(b, places);
  });
  return loops;
}

}  // namespace mesher::detail
