// Inputs with segments, for benchmarks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/mesh_statically.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "mesher/read.hpp"
#include "sample.hpp"

namespace bench {

using mesher::Point;
using mesher::PointId;

/// An input, as both meshers take it.
struct Input {
  std::string name;
  std::vector<Point<2>> points;
  std::vector<PointId> ids;
  std::vector<mesher::Segment> segments;
  mesher::Options<2> options;
  double length = 0;  // of what is edited

  Input(std::string called, const mesher::Graph<2>& given) : name(std::move(called)) {
    const mesher::Graph<2> pslg = mesher::without_polylines(given);
    for (const auto& v : pslg.points) points.push_back(v.at), ids.push_back(v.id);
    for (const auto& s : pslg.segments) segments.push_back({s.id, s.from, s.to});
    options.domain = mesher::snapped_domain<2>(points);
    length = side() / std::sqrt(static_cast<double>(segments.size()));
  }
  [[nodiscard]] double side() const {
    const auto& [lo, hi] = options.domain;
    return std::max(hi[0] - lo[0], hi[1] - lo[1]);
  }
};

/// `n` segments and as many points (family `segments` of `mesher gen`).
inline Input random_segments(std::size_t n) {
  return Input(std::to_string(n), mesher::generate_pslg({mesher::PslgKind::segments, n}));
}
inline Input file_input(const std::string& path) {
  return Input(std::filesystem::path(path).stem().string(), mesher::read<2>(path).graph);
}

inline mesher::BoxMesher<2> first_run(const Input& in) {
  mesher::BoxMesher<2> m(in.options);
  m.insert(in.ids, in.points);
  for (const auto& s : in.segments) m.insert_segment(s.id, s.from, s.to);
  m.update();
  return m;
}

/// Seconds of a static run and all that belongs to it.
inline double static_seconds(const Input& in) {
  return seconds_of([&] {
    static_cast<void>(mesher::mesh_statically(in.points, in.segments, in.options, in.ids));
  });
}

}  // namespace bench
