// The same questions as of a whole mesh, asked of the program's indices.
#include "facade/angle_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "check/forced.hpp"
#include "check/shrink_test.hpp"
#include "facade/tiles_mesh.hpp"
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
    const SegmentHandle on = mesh_.role(mesh_.vertex(v)).on;
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

template <class AnyMesh>
AngleNews AngleFinder<AnyMesh>::news(std::vector<Triangle> come) const {
  if (world_.segments.store().live() == 0) return {};
  const auto is_before = [&](VertexHandle a, VertexHandle b) { return place(a) < place(b); };
  for (Triangle& t : come) {  // what is said of it is not to depend on handles
    std::rotate(t.begin(), std::min_element(t.begin(), t.end(), is_before), t.end());
  }
  return {forced(come), shrunk(come)};
}

template <class AnyMesh>
bool AngleFinder<AnyMesh>::is_poor(const Triangle& t) const {
  return radius_edge(place(t[0]), place(t[1]), place(t[2])) > rho_ * (1 + kPoorRounding);
}

template <class AnyMesh>
std::vector<SmallAngle> AngleFinder<AnyMesh>::forced(const std::vector<Triangle>& come) const {
  const WorldInput<AnyMesh> input(mesh_);
  std::map<std::array<std::uint32_t, 3>, SmallAngle> angles;
  const auto angle = [&](const Wedge& w) -> SmallAngle& {
    const auto [s, t] = std::minmax({w.s, w.t});
    const auto [it, is_new] = angles.try_emplace({w.apex, s, t});
    if (is_new) {
      const auto [one, other] = std::minmax({input.line(s), input.line(t)});
      it->second.at = place(w.apex);
      it->second.lines = {one, other};
      it->second.degrees = input.degrees(s, t, w.apex);
    }
    return it->second;
  };
  for (const Triangle& t : come) {
    if (!is_poor(t)) continue;
    const auto [p, q] = shortest_edge(t, [&](VertexHandle v) { return place(v); });
    const double degrees = smallest_angle_deg(place(t[0]), place(t[1]), place(t[2]));
    for (const Wedge& w : wedges_across(world_.segments.store(), on_lines(mesh_.vertex(p)),
                                        on_lines(mesh_.vertex(q)), false)) {
      count(angle(w), degrees);
    }
  }
  std::vector<SmallAngle> all;
  for (const auto& [key, found] : angles) all.push_back(found);
  std::sort(all.begin(), all.end(), is_before);
  return all;
}

// To the nearest neighbour that counts.
template <class AnyMesh>
double AngleFinder<AnyMesh>::nearest(const Vertex<2>& v) const {
  double nearest2 = kInfinity;
  for_each_neighbour(v, [&](const Vertex<2>& w) {
    const double far2 = distance2(v.p, w.p, w.p);
    if (far2 >= nearest2) return;
    const auto& store = world_.segments.store();
    if (wedges_across(store, on_lines(v), on_lines(w), true).empty()) nearest2 = far2;
  });
  return std::sqrt(nearest2);
}

// Whether two features without a common point are within r of v, most of the time: v or its segment
// and an input point, or two of these, among v's neighbours or further away.
template <class AnyMesh>
bool AngleFinder<AnyMesh>::is_near_two(const Vertex<2>& v, double r) const {
  const SegmentHandle on = mesh_.role(v).on;
  VertexHandle first = v.input ? v.self : 0;
  const auto is_second = [&](const Vertex<2>& w) {
    if (!w.input || w.self == first || distance2(v.p, w.p, w.p) > r * r) return false;
    if (on != 0 && !world_.segments.pool()[on].has_end(w.self)) return true;
    return std::exchange(first, w.self) != 0;
  };
  bool found = false;
  for_each_neighbour(v, [&](const Vertex<2>& w) { found = found || is_second(w); });
  return found || world_.features.visit_points_in(around(v.p, r), is_second);
}

template <class AnyMesh>
std::vector<ShrunkVertex> AngleFinder<AnyMesh>::shrunk(const std::vector<Triangle>& come) const {
  std::vector<VertexHandle> corners;
  for (const Triangle& t : come) corners.insert(corners.end(), t.begin(), t.end());
  make_set(corners);
  const WorldInput<AnyMesh> input(mesh_);
  const ShrinkTest<WorldInput<AnyMesh>> test(input, kShrinks, world_.box.side);
  std::vector<ShrunkVertex> found;
  for (const VertexHandle h : corners) {
    const Vertex<2>& v = mesh_.vertex(h);
    const double length = v.boundary ? kInfinity : nearest(v);
    if (length == kInfinity || is_near_two(v, kShrinks * length)) continue;
    if (!test.has_shrunk(h, length)) continue;
    ShrunkVertex shrunk = test.report(h, length);
    if (!is_wanted(shrunk, world_.limits)) found.push_back(std::move(shrunk));
  }
  std::sort(found.begin(), found.end(), [](auto& a, auto& b) { return a.at < b.at; });
  return found;
}

template class AngleFinder<WorldMesh>;
template class AngleFinder<TilesMesh>;

}  // namespace mesher::detail
