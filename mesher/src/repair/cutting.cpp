// The borders are edges that an odd number of loops have; what they go around is seen in a plane.
#include "repair/cutting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "repair/constrained.hpp"
#include "repair/least_surface.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

class Cutting {
 public:
  Cutting(const PolygonParts& parts, bool is_cut_up, double tolerance, FeatureStore& store)
      : parts_(parts), is_cut_up_(is_cut_up), tolerance_(tolerance), store_(store) {
    for (const Loop& loop : parts.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        if (loop[i] == loop[(i + 1) % loop.size()]) continue;
        const Ends e = in_order(loop[i], loop[(i + 1) % loop.size()]);
        if (!borders_.insert(e).second) borders_.erase(e);
      }
    }
  }

  [[nodiscard]] bool is_empty() const { return borders_.empty(); }
  /// Nothing if it cannot be. What lies inside and cannot stay will be found to lie on the parts.
  std::optional<std::vector<PolygonParts>> cut() {
    const Point<3> normal = find_simple_loops();
    if (auto all = cut_with(parts_, normal)) return all;
    is_cut_up_ = is_cut_up_ || !parts_.edges.empty() || !parts_.points.empty();
    if (auto all = cut_with({}, normal)) return all;
    if (auto all = least_surfaces()) return all;
    return best_;
  }

 private:
  // With what is to lie inside; as seen along the normal, or else along an axis.
  std::optional<std::vector<PolygonParts>> cut_with(const PolygonParts& inside,
                                                    const Point<3>& normal) {
    inside_ = {{}, inside.edges, inside.points};
    find_points();
    if (!largest_.empty()) {
      PolygonParts largest;
      largest.loops = {largest_};
      const Polygon& f = store_.record(largest);
      if (has_area(f)) {
        const Plane plane = f.plane;
        auto all = cut_in([&](const Point<3>& p) { return plane.in_frame(p); });
        if (all) return all;
      }
    }
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](std::size_t i, std::size_t k) {
      return std::abs(normal[i]) > std::abs(normal[k]);
    });
    for (const std::size_t k : axes) {
      auto all = cut_in([&](const Point<3>& p) {
        return Point<2>{p[(k + 1) % 3], p[(k + 2) % 3]};
      });
      if (all) return all;
    }
    return std::nullopt;
  }
  [[nodiscard]] const Point<3>& place(VertexHandle v) const { return store_.points()[v].p; }

  // One if an edge of a triangle will be led through its third corner.
  [[nodiscard]] std::size_t fault(VertexHandle a, VertexHandle b, VertexHandle c) const {
    const Point<3>&p = place(a), &q = place(b), &r = place(c);
    const double least = std::min({distance2(p, q, r), distance2(q, r, p), distance2(r, p, q)});
    return least <= tolerance_ * tolerance_ ? 1 : 0;
  }

  // The same of each simple loop by itself, if there was but one, in which nothing lies.
  std::optional<std::vector<PolygonParts>> least_surfaces() {
    constexpr std::size_t kMost = 256;  // the cost is cubic
    std::vector<PolygonParts> all;
    std::size_t faults = 0;
    for (const Loop& loop : simple_loops_) {
      if (parts_.loops.size() > 1 || loop.size() > kMost) return std::nullopt;
      faults += add_least_surface(loop, all);
    }
    return best_or(std::move(all), faults);
  }
  // Returns how many faults they have.
  std::size_t add_least_surface(const Loop& around, std::vector<PolygonParts>& all) const {
    std::vector<Loop> loops{around};
    put_in_order(loops, [&](VertexHandle v) { return place(v); });
    const Loop& loop = loops[0];
    std::vector<Point<3>> places;
    for (const VertexHandle v : loop) places.push_back(place(v));
    const LeastSurface least =
        least_surface(places, [&](std::size_t i, std::size_t k, std::size_t j) {
          return fault(loop[i], loop[k], loop[j]);
        });
    for (const auto& [i, k, j] : least.triangles) add_triangle({loop[i], loop[k], loop[j]}, all);
    return least.faults;
  }
  void add_triangle(Loop corners, std::vector<PolygonParts>& all) const {
    PolygonParts triangle;
    triangle.loops = {std::move(corners)};
    if (has_area(store_.record(triangle))) all.push_back(std::move(triangle));
  }

  // In the order of places.
  void find_points() {
    points_ = inside_.points;
    for (const auto& [a, b] : borders_) points_.insert(points_.end(), {a, b});
    for (const auto& [a, b] : inside_.edges) points_.insert(points_.end(), {a, b});
    const auto before = [&](VertexHandle v, VertexHandle w) { return place(v) < place(w); };
    std::sort(points_.begin(), points_.end(), before);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    numbers_.clear();
    for (std::uint32_t i = 0; i < points_.size(); ++i) numbers_.emplace(points_[i], i);
  }
  [[nodiscard]] std::array<std::uint32_t, 2> numbers(const Ends& e) const {
    return link(numbers_.at(e.first), numbers_.at(e.second));
  }

  // Finds simple loops that the borders are a sum of. Returns the normal of the largest.
  Point<3> find_simple_loops() {
    find_points();
    std::map<VertexHandle, std::vector<VertexHandle>> ahead;
    std::vector<Ends> edges(borders_.begin(), borders_.end());
    std::sort(edges.begin(), edges.end(),
              [&](const Ends& e, const Ends& f) { return numbers(e) < numbers(f); });
    for (const auto& [a, b] : edges) ahead[a].push_back(b), ahead[b].push_back(a);
    Point<3> normal{};
    const auto take = [&](Loop loop) {
      if (loop.size() < 3) return;
      std::vector<Point<3>> places;
      for (const VertexHandle v : loop) places.push_back(place(v));
      const Point<3> area = twice_area(places);
      if (squared(area) > squared(normal)) normal = area, largest_ = loop;
      simple_loops_.push_back(std::move(loop));
    };
    for (const VertexHandle start : points_) {
      while (ahead.count(start) > 0 && !ahead[start].empty()) {
        Loop walk{start};
        std::set<VertexHandle> on_it{start};
        while (!ahead[walk.back()].empty()) {
          const VertexHandle from = walk.back(), to = ahead[from].back();
          ahead[from].pop_back();
          ahead[to].erase(std::find(ahead[to].begin(), ahead[to].end(), from));
          if (on_it.insert(to).second) {
            walk.push_back(to);
            continue;
          }
          const auto seen = std::find(walk.begin(), walk.end(), to);
          take(Loop(seen, walk.end()));
          for (auto it = seen + 1; it != walk.end(); ++it) on_it.erase(*it);
          walk.erase(seen + 1, walk.end());
        }
      }
    }
    return normal;
  }

  template <class InPlane>
  std::optional<std::vector<PolygonParts>> cut_in(InPlane&& in_plane) {
    std::vector<Point<2>> places;
    for (const VertexHandle v : points_) places.push_back(in_plane(place(v)));
    Constrained triangulation(places);
    Links borders;
    for (const Ends& e : borders_) borders.insert(numbers(e));
    for (const auto& [a, b] : borders) {
      if (!triangulation.add(a, b)) return std::nullopt;
    }
    for (const Ends& e : inside_.edges) {
      const auto [a, b] = numbers(e);
      static_cast<void>(triangulation.add(a, b));  // else it crosses what lies above or below it
    }
    triangulation.settle();
    const auto fault_at = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      return fault(points_[a], points_[b], points_[c]);
    };
    triangulation.better(fault_at);
    std::vector<PolygonParts> all;
    std::size_t faults = 0;
    for (const auto& part : triangulation.inside(borders)) {
      if (add_whole(part, borders, places, all)) continue;
      for (const auto& [a, b, c] : part) {
        add_triangle({points_[a], points_[b], points_[c]}, all);
        faults += fault_at(a, b, c);
      }
    }
    return best_or(std::move(all), faults);
  }
  // What has no faults; of others the best is kept.
  std::optional<std::vector<PolygonParts>> best_or(std::vector<PolygonParts> all,
                                                   std::size_t faults) {
    if (faults == 0) return all;
    if (!best_ || faults < least_faults_) best_ = std::move(all), least_faults_ = faults;
    return std::nullopt;
  }

  // A part as it is, if it is flat and may be. Returns whether it is.
  bool add_whole(const std::vector<Constrained::Triangle>& part, const Links& borders,
                 const std::vector<Point<2>>& places, std::vector<PolygonParts>& all) {
    if (is_cut_up_) return false;
    PolygonParts whole;
    for (const auto& loop : loops_around(part, borders, places)) {
      Loop& corners = whole.loops.emplace_back();
      for (const std::uint32_t i : loop) corners.push_back(points_[i]);
    }
    whole.edges = inside_.edges;
    whole.points = inside_.points;
    auto polygon = polygon_of(std::move(whole), store_);
    if (polygon) all.push_back(std::move(*polygon));
    return polygon.has_value();
  }

  const PolygonParts& parts_;
  PolygonParts inside_;  // without loops
  bool is_cut_up_;
  double tolerance_;
  FeatureStore& store_;
  std::set<Ends> borders_;  // edges that an odd number of loops have
  std::vector<VertexHandle> points_;
  std::map<VertexHandle, std::uint32_t> numbers_;
  std::vector<Loop> simple_loops_;
  Loop largest_;                                   // of these
  std::optional<std::vector<PolygonParts>> best_;  // of what has faults
  std::size_t least_faults_ = 0;
};

}  // namespace

std::optional<std::vector<PolygonParts>> cut(const PolygonParts& parts, bool is_cut_up,
                                             double tolerance, FeatureStore& store) {
  Cutting cutting(parts, is_cut_up, tolerance, store);
  if (cutting.is_empty()) return std::vector<PolygonParts>{};
  return cutting.cut();
}

}  // namespace mesher::detail
