// The guard's question (mesher/guard.hpp), asked of the input alone and apart from the mesher.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "check/flat_polygon.hpp"
#include "mesher/graph.hpp"
#include "mesher/reports.hpp"
#include "records/reach_tree.hpp"

namespace mesher::detail {

class IsolatedEdges {
 public:
  /// Requires: what segments and polygons name is a point.
  explicit IsolatedEdges(const Graph<3>& complex);
  IsolatedEdges(const IsolatedEdges&) = delete;
  IsolatedEdges& operator=(const IsolatedEdges&) = delete;

  /// A segment or polygon.
  using Beside = mesher::Feature;
  /// The nearest feature beside which pq is isolated; of equally near ones segments first, and by
  /// id. Cost: O(log L/s), and that of a look at what is within kIsolated lengths.
  [[nodiscard]] std::optional<Beside> find(const Point<3>& p, const Point<3>& q) const;

 private:
  enum class Kind : std::uint8_t { line, polygon, point };
  struct Corner {
    PointId id;
    Point<3> at;
  };
  struct Feature {
    Kind kind = Kind::line;
    Beside name;
    std::vector<PointId> points;               // all that it names, ascending
    std::vector<std::array<Corner, 2>> lines;  // its own; of a point from it to itself
    std::vector<Corner> others;                // points inside a polygon
    std::optional<FlatPolygon> shape;
    Point<3> middle{};  // all of it is within `reach` of that
    double reach = 0;
  };
  [[nodiscard]] static double distance(const Feature& f, const Point<3>& x);
  [[nodiscard]] static bool has_two_parts(const Feature& f, const Point<3>& x, double within);
  // A line, or a point.
  [[nodiscard]] static Feature straight(Kind kind, const Beside& name, const Corner& a,
                                        const Corner& b);
  void add(Feature f);
  // Those that may be within a distance of x, and perhaps others, in the order of features_.
  [[nodiscard]] std::vector<const Feature*> find_near(const Point<3>& x, double within) const;

  std::vector<Feature> features_;  // lines, polygons, then points
  MeshBox<3> cube_;
  ReachTree<std::uint32_t, 3> tree_;  // of their numbers
};

}  // namespace mesher::detail
