// Graphs are looked at in time that does not grow with their segments' lengths, and a run can be
// stopped meanwhile.
#include "plane/conflict_sweep.hpp"

#include <catch2/catch.hpp>
#include <optional>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Point;
using mesher::PointId;

struct Graph {
  std::vector<Point<2>> points;
  std::vector<mesher::Segment> segments;
  void add_square(double lo, double hi, double turn = 0) {
    const auto first = static_cast<std::int64_t>(points.size());
    for (const auto& p : {Point<2>{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}}) {
      points.push_back({p[0] - turn * p[1], p[1] + turn * p[0]});
    }
    for (std::int64_t j = 0; j < 4; ++j) {
      segments.push_back({mesher::LineId{first + j + 1}, PointId{first + j + 1},
                          PointId{first + (j + 1) % 4 + 1}});
    }
  }
};
Graph nested_squares(int count, double turn = 0) {
  Graph graph;
  const double most = 4.0 * count;
  for (int i = 0; i < count; ++i) graph.add_square(i, most - i, turn);
  return graph;
}

// How often progress is called until a run of the graph has been checked, or stopped.
struct Watched {
  long calls = 0;
  std::optional<mesher::ErrorCode> error;
  std::string message;
};
Watched update(const Graph& graph, long most) {
  mesher::Options<2> options;
  options.domain = mesher::snapped_domain<2>(graph.points);
  options.max_vertices = 4 * graph.points.size();
  mesher::BoxMesher<2> m(options);
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    m.insert(PointId{static_cast<std::int64_t>(i) + 1}, graph.points[i]);
  }
  for (const auto& s : graph.segments) m.insert_segment(s.id, s.from, s.to);
  Watched watched;
  mesher::RunControl control;
  control.progress = [&](const mesher::Progress&) { return ++watched.calls < most; };
  try {
    m.update(control);
  } catch (const mesher::Error& error) {
    watched.error = error.code();
    watched.message = error.message();
  }
  return watched;
}

}  // namespace

TEST_CASE("a run is stopped while its segments are looked at") {
  for (const double turn : {0.0, 0.25}) {
    const Watched watched = update(nested_squares(300, turn), 3);
    CHECK(watched.error == mesher::ErrorCode::cancelled);
    CHECK(watched.calls == 3);
  }
}

TEST_CASE("a segment that crosses one of many nested squares is found, whichever it is") {
  for (const double turn : {0.0, 0.25}) {
    for (const int square : {0, 150, 299}) {
      Graph graph = nested_squares(300, turn);
      const auto last = static_cast<std::int64_t>(graph.points.size());
      const auto at = [&](double x, double y) {
        graph.points.push_back({x - turn * y, y + turn * x});
      };
      at(600, square - 0.25), at(600, square + 0.25);
      graph.segments.push_back({mesher::LineId{9999}, PointId{last + 1}, PointId{last + 2}});
      const Watched watched = update(graph, 1000000);
      CAPTURE(turn, square, watched.message);
      CHECK(watched.error == mesher::ErrorCode::crossing_segments);
      const std::string id = std::to_string(4 * square + 1);
      CHECK(watched.message.starts_with("segment " + id + " crosses segment 9999 at "));
    }
  }
}
