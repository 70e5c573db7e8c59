// The same questions as of a whole mesh, asked of the program's indices.
#include "facade/angle_finder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "check/forced.hpp"
#include "check/shrink_test.hpp"
#include "facade/tile_mesh.hpp"
#include "mesher/check.hpp"
#include "plane/exempt.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The input as the program has it.
template <class AnyMesh>
class WorldInput {
 public:
  explicit WorldInput(const AnyMesh& mesh) : mesh_(mesh), world_(mesh.world()) {}

  [[nodiscard]] const Point<2>& place(VertexHandle v) const { return mesh_.vertex(v).p; }
  [[nodiscard]] std::vector<std::uint32_t> codes_near(const Point<2>& p, double r) const {
    std::vector<std::uint32_t> near;
    near.reserve(32);
    while (!collect(p, r, near)) {
      const std::size_t room = 2 * near.capacity();
      near.clear();
      near.reserve(room);
    }
    if (distance_of_boundary(p) <= r) add_boundary(p, r, near);
    return near;
  }
  [[nodiscard]] SegmentHandle through(VertexHandle v) const {
    const SegmentHandle on = mesh_.role(v).on;
    return on != 0 ? on : kPointFeature;
  }
  [[nodiscard]] std::array<VertexHandle, 2> ends(SegmentHandle s) const {
    return {segment(s).a, segment(s).b};
  }
  [[nodiscard]] LineId line(SegmentHandle s) const { return world_.names->line(s); }
  template <class Visit>
  void for_each_ending_at(VertexHandle v, Visit&& visit) const {
    world_.segments.store().visit_at(v, [&](const Segment& s) { visit(s.self); });
  }
  [[nodiscard]] double degrees(SegmentHandle s, SegmentHandle t, VertexHandle apex) const {
    return degrees_between(along(s, apex), along(t, apex));
  }

 private:
  [[nodiscard]] const Segment& segment(SegmentHandle s) const { return world_.segments.pool()[s]; }
  [[nodiscard]] Point<2> along(SegmentHandle s, VertexHandle apex) const {
    const Point<2>& o = place(apex);
    const Point<2>& e = place(segment(s).other(apex));
    return {e[0] - o[0], e[1] - o[1]};
  }
  // What is visited must not throw: whether there was room for all.
  bool collect(const Point<2>& p, double r, std::vector<std::uint32_t>& near) const {
    const auto add = [&](std::uint32_t code) {
      if (near.size() == near.capacity()) return true;
      near.push_back(code);
      return false;
    };
    return !world_.segments.store().visit_near(p, p, r, [&](auto& s) { return add(s.self); }) &&
           !world_.features.visit_points_in(
               around(p, r), [&](const auto& v) { return add(v.self | kPointFeature); });
  }
  [[nodiscard]] double distance_of_boundary(const Point<2>& p) const {
    double least = kInfinity;
    for (int i = 0; i < 2; ++i) {
      least = std::min({least, p[i] - world_.box.lo[i], world_.box.hi(i) - p[i]});
    }
    return least;
  }
  void add_boundary(const Point<2>& p, double r, std::vector<std::uint32_t>& near) const {
    world_.box.for_each_boundary_point([&](const Point<2>& q) {
      if (!contains(around(p, r), q)) return;
      near.push_back(world_.vertices.tree().find(q)->self | kPointFeature);
    });
  }

  const AnyMesh& mesh_;
  World<sac::Scope>& world_;
};

}  // namespace

void AngleParts::add(AngleParts&& more) {
  for (const auto& [wedge, angle] : more.forced) {
    const auto [it, is_new] = forced.try_emplace(wedge, angle);
    if (!is_new) add_count(it->second, angle);
  }
  std::move(more.shrunk.begin(), more.shrunk.end(), std::back_inserter(shrunk));
}

AngleNews AngleParts::news() && {
  AngleNews news;
  for (const auto& [wedge, angle] : forced) news.forced.push_back(angle);
  std::sort(news.forced.begin(), news.forced.end(), is_before);
  std::sort(shrunk.begin(), shrunk.end(), [](auto& a, auto& b) { return a.at < b.at; });
  news.shrunk = std::move(shrunk);
  return news;
}

template <class AnyMesh>
AngleNews AngleFinder<AnyMesh>::news(const std::vector<Triangle>& come) const {
  if (world_.segments.store().live() == 0) return {};
  std::vector<VertexHandle> corners;
  for (const Triangle& t : come) corners.insert(corners.end(), t.begin(), t.end());
  make_set(corners);
  return parts(come, corners).news();
}

template <class AnyMesh>
AngleParts AngleFinder<AnyMesh>::parts(const std::vector<Triangle>& come,
                                       const std::vector<VertexHandle>& corners) const {
  AngleParts all;
  for (const Triangle& t : come) find_forced(t, all);
  all.shrunk = shrunk(corners);
  return all;
}

template <class AnyMesh>
bool AngleFinder<AnyMesh>::is_poor(const Triangle& t) const {
  return radius_edge(place(t[0]), place(t[1]), place(t[2])) > rho_ * (1 + kPoorRounding);
}

template <class AnyMesh>
void AngleFinder<AnyMesh>::find_forced(Triangle t, AngleParts& parts) const {
  const WorldInput<AnyMesh> input(mesh_);
  const auto angle = [&](const Wedge& w) -> SmallAngle& {
    const auto [first, second] = std::minmax({w.s, w.t});
    const auto [it, is_new] = parts.forced.try_emplace({w.apex, first, second});
    if (is_new) {
      const auto [one, other] = std::minmax({input.line(first), input.line(second)});
      it->second.at = place(w.apex);
      it->second.lines = {one, other};
      it->second.degrees = input.degrees(first, second, w.apex);
    }
    return it->second;
  };
  const auto is_before = [&](VertexHandle a, VertexHandle b) { return place(a) < place(b); };
  // What is said of it is not to depend on handles.
  std::rotate(t.begin(), std::min_element(t.begin(), t.end(), is_before), t.end());
  if (!is_poor(t)) return;
  const auto [p, q] = shortest_edge(t, [&](VertexHandle v) { return place(v); });
  const double degrees = smallest_angle_deg(place(t[0]), place(t[1]), place(t[2]));
  for (const Wedge& w : wedges_across(world_.segments.store(), on_lines(p), on_lines(q), false)) {
    count(angle(w), degrees);
  }
}

// To the nearest neighbour that counts.
template <class AnyMesh>
double AngleFinder<AnyMesh>::nearest(VertexHandle v) const {
  double nearest2 = kInfinity;
  for_each_neighbour(v, [&](VertexHandle w) {
    const double far2 = distance2(place(v), place(w), place(w));
    if (far2 >= nearest2) return;
    const auto& store = world_.segments.store();
    if (wedges_across(store, on_lines(v), on_lines(w), true).empty()) nearest2 = far2;
  });
  return std::sqrt(nearest2);
}

// Whether two features without a common point are within r of v, most of the time: v or its segment
// and an input point, or two of these, among v's neighbours or further away.
template <class AnyMesh>
bool AngleFinder<AnyMesh>::is_near_two(VertexHandle h, double r) const {
  const Point<2> p = place(h);
  const SegmentHandle on = mesh_.role(h).on;
  VertexHandle first = mesh_.vertex(h).input ? h : 0;
  const auto is_second = [&](VertexHandle other, const Vertex<2>& w) {
    if (!w.input || other == first || distance2(p, w.p, w.p) > r * r) return false;
    if (on != 0 && !world_.segments.pool()[on].has_end(other)) return true;
    return std::exchange(first, other) != 0;
  };
  bool found = false;
  for_each_neighbour(h, [&](VertexHandle w) { found = found || is_second(w, mesh_.vertex(w)); });
  return found || world_.features.visit_points_in(
                      around(p, r), [&](const Vertex<2>& w) { return is_second(w.self, w); });
}

template <class AnyMesh>
std::vector<ShrunkVertex> AngleFinder<AnyMesh>::shrunk(
    const std::vector<VertexHandle>& corners) const {
  const WorldInput<AnyMesh> input(mesh_);
  const ShrinkTest<WorldInput<AnyMesh>> test(input, kShrinks, world_.box.side);
  std::vector<ShrunkVertex> found;
  for (const VertexHandle v : corners) {
    const double length = mesh_.vertex(v).boundary ? kInfinity : nearest(v);
    if (length == kInfinity || is_near_two(v, kShrinks * length)) continue;
    if (!test.has_shrunk(v, length)) continue;
    ShrunkVertex shrunk = test.report(v, length);
    if (!is_wanted(shrunk, world_.limits)) found.push_back(std::move(shrunk));
  }
  return found;
}

template class AngleFinder<WorldMesh>;
template class AngleFinder<TileMesh>;

}  // namespace mesher::detail
