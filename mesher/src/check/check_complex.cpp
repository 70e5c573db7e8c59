// The edges of a complex, and whether they are unions of edges: a walk from end to end of each.
#include "check/check_complex.hpp"

#include <algorithm>
#include <utility>

#include "check/line_walk.hpp"
#include "text/text.hpp"

namespace mesher::detail {

ComplexCheck::ComplexCheck(const CheckedMesh<3>& mesh, const CheckOptions<3>& options)
    : mesh_(mesh),
      options_(options),
      rounding_(rounding_of(mesh.mesh())),
      segments_(Verdict::good("")),
      polygons_(Verdict::good("")) {
  for (const auto& p : options.graph->graph.points) places_[p.id] = p.at;
  add_lines();
  segments_ = find_segments();
  polygons_ = find_polygons();
  name_vertices();
}

// --- Segments --------------------------------------------------------------------------------

std::size_t ComplexCheck::line(PointId a, PointId b, const std::string& name) {
  const std::array<PointId, 2> ends{std::min(a, b), std::max(a, b)};
  const auto [it, is_new] = line_of_.try_emplace(ends, lines_.size());
  if (is_new) lines_.push_back({name, ends, places_.at(ends[0]), places_.at(ends[1])});
  return it->second;
}

void ComplexCheck::add_lines() {
  const Graph<3>& plc = options_.graph->graph;
  for (const auto& s : segments_of(plc)) line(s.from, s.to, text_of(s.id));
  for (const auto& f : plc.polygons) {
    Surface& surface = surfaces_.emplace_back();
    surface.polygon = &f;
    const std::string name = "an edge of " + text_of(f.id);
    for (const auto& loop : f.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        surface.lines.push_back(line(loop[i], loop[(i + 1) % loop.size()], name));
      }
      surface.points.insert(loop.begin(), loop.end());
    }
    for (const auto& [a, b] : f.edges) {
      surface.lines.push_back(line(a, b, name));
      surface.points.insert({a, b});
    }
    surface.points.insert(f.points.begin(), f.points.end());
  }
}

bool ComplexCheck::is_outside(const Point<3>& p) const {
  return options_.boundary != BoundaryRule::box && !mesh_.simplex_at(p);
}

Verdict ComplexCheck::find_segments() {
  LineWalk<3> walk(mesh_.mesh());
  std::set<Ends> edges, known;
  for (std::size_t i = 0; i < mesh_.sides().size(); ++i) {
    const auto [a, b, c] = mesh_.sides()[i].face;
    for (const auto& e : {ends_of(a, b), ends_of(b, c), ends_of(c, a)}) edges.insert(e);
  }
  for (const auto& [a, b] : edges) walk.add_edge(a, b);
  if (options_.features != nullptr) {
    for (const MeshEdge& e : options_.features->edges) known.insert({e.low, e.high});
  }
  const auto is_known = [&](std::uint32_t a, std::uint32_t b) {
    return known.count(ends_of(a, b)) != 0;
  };
  const Outside<3> outside(mesh_, walk, options_.boundary);
  WalkedLines<3> all;
  for (Line& l : lines_) {
    auto way = walk.find(l.from, l.to, is_known, outside);
    all.add(l.name, l.from, l.to, way);
    if (way.trouble) continue;
    l.runs = std::move(way.runs);
    l.alone = std::move(way.alone);
  }
  return all.verdict("segments and edges of polygons");
}

}  // namespace mesher::detail
