// Which polygons of a facet lie in which, and which of them bound what is filled.
#include "io/facet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "space/polygon_shape.hpp"

namespace mesher {
namespace {

using detail::loop_contains;

// The facet's polygons of three corners and more, the largest first, in one frame.
class Nest {
 public:
  Nest(const FacetParts& facet, const std::vector<Point<3>>& places) : places_(places) {
    for (const auto& corners : facet.polygons) {
      if (corners.size() > 2) loops_.push_back({&corners, area_of(corners), {}, false});
    }
    std::stable_sort(loops_.begin(), loops_.end(),
                     [](const Loop& a, const Loop& b) { return a.area > b.area; });
    for (const Loop& loop : loops_) {
      for (const std::uint32_t v : *loop.corners) frame_.places.push_back(places[v]);
      frame_.loop_end.push_back(static_cast<std::uint32_t>(frame_.places.size()));
    }
    if (loops_.empty() || !detail::find_shape(frame_)) return;
    for (std::size_t i = 0; i < loops_.size(); ++i) loops_[i].around = innermost(middle(i), i);
  }

  [[nodiscard]] std::size_t size() const { return loops_.size(); }
  [[nodiscard]] const std::vector<std::uint32_t>& corners(std::size_t i) const {
    return *loops_[i].corners;
  }
  /// Returns whether a polygon goes around it.
  bool empty(const Point<3>& hole) {
    const auto in = innermost(frame_.plane.in_frame(hole), loops_.size());
    if (in) loops_[*in].is_empty = true;
    return in.has_value();
  }
  /// Whether what is directly in the polygon is filled; what is around all is not.
  [[nodiscard]] bool is_filled(std::optional<std::size_t> i) const {
    return i && !loops_[*i].is_empty;
  }
  [[nodiscard]] std::optional<std::size_t> around(std::size_t i) const { return loops_[i].around; }
  /// The outermost polygon around a place that is on polygons, or nothing.
  [[nodiscard]] std::optional<std::size_t> outermost(std::optional<std::size_t> i) const {
    while (i && loops_[*i].around) i = loops_[*i].around;
    return i;
  }
  [[nodiscard]] std::optional<std::size_t> innermost(const Point<3>& x) const {
    return innermost(frame_.plane.in_frame(x), loops_.size());
  }

 private:
  struct Loop {
    const std::vector<std::uint32_t>* corners;
    double area;
    std::optional<std::size_t> around;  // the smallest that it lies in
    bool is_empty;                      // a hole lies directly in it
  };

  [[nodiscard]] double area_of(const std::vector<std::uint32_t>& corners) const {
    std::vector<Point<3>> loop;
    for (const std::uint32_t v : corners) loop.push_back(places_[v]);
    return detail::squared(detail::twice_area(loop));
  }
  // The middle of a loop's first edge.
  [[nodiscard]] Point<2> middle(std::size_t i) const {
    const std::size_t begin = frame_.loop_begin(i);
    const Point<2>&a = frame_.outline[begin], &b = frame_.outline[begin + 1];
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  }
  // The smallest of the first `count` loops that goes around it.
  [[nodiscard]] std::optional<std::size_t> innermost(const Point<2>& uv, std::size_t count) const {
    if (frame_.outline.empty()) return std::nullopt;
    for (std::size_t i = count; i-- > 0;) {
      if (loop_contains(frame_, i, uv)) return i;
    }
    return std::nullopt;
  }

  const std::vector<Point<3>>& places_;
  std::vector<Loop> loops_;
  detail::Polygon frame_;
};

template <class Visit>
void for_each_edge(const std::vector<std::uint32_t>& corners, Visit&& visit) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    visit(corners[i], corners[(i + 1) % corners.size()]);
  }
}

class Sorter {
 public:
  Sorter(const FacetParts& facet, const std::vector<Point<3>>& places)
      : facet_(facet), places_(places), nest_(facet, places), part_of_(nest_.size()) {}

  FacetPolygons sort() {
    for (std::size_t i = 0; i < facet_.holes.size(); ++i) {
      if (!nest_.empty(facet_.holes[i])) out_.useless_holes.push_back(i);
    }
    for (std::size_t i = 0; i < nest_.size(); ++i) place_loop(i);
    for (const auto& corners : facet_.polygons) {
      if (corners.size() == 2) place_edge(corners[0], corners[1]);
      if (corners.size() == 1) place_point(corners[0]);
    }
    return std::move(out_);
  }

 private:
  void place_loop(std::size_t i) {
    const bool inside = nest_.is_filled(i), outside = nest_.is_filled(nest_.around(i));
    FacetPolygons::Part* part = part_with(nest_.outermost(i));
    if (inside == outside) {
      return for_each_edge(nest_.corners(i), [&](auto a, auto b) { add_edge(part, a, b); });
    }
    if (part == nullptr) {
      part_of_[i] = ++count_;
      part = &out_.parts.emplace_back();
    }
    part->loops.push_back(nest_.corners(i));
  }
  void place_edge(std::uint32_t a, std::uint32_t b) {
    const Point<3> middle = detail::scaled(0.5, detail::plus(places_[a], places_[b]));
    add_edge(part_with(nest_.outermost(nest_.innermost(middle))), a, b);
  }
  // Nothing lies in no part: a point is a point.
  void place_point(std::uint32_t v) {
    if (auto* part = part_with(nest_.outermost(nest_.innermost(places_[v])))) {
      part->points.push_back(v);
    }
  }
  void add_edge(FacetPolygons::Part* part, std::uint32_t a, std::uint32_t b) {
    (part != nullptr ? part->edges : out_.segments).emplace_back(a, b);
  }
  // The part that begins with this loop; null if there is none.
  FacetPolygons::Part* part_with(std::optional<std::size_t> outermost) {
    if (!outermost || part_of_[*outermost] == 0) return nullptr;
    return &out_.parts[part_of_[*outermost] - 1];
  }

  const FacetParts& facet_;
  const std::vector<Point<3>>& places_;
  Nest nest_;
  std::vector<std::size_t> part_of_;  // by outermost loops: 1 + the number of their part; 0: none
  std::size_t count_ = 0;
  FacetPolygons out_;
};

}  // namespace

FacetPolygons polygons_of(const FacetParts& facet, const std::vector<Point<3>>& places) {
  return Sorter(facet, places).sort();
}

}  // namespace mesher
