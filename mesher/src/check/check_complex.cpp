// The edges of a complex, and whether they are unions of edges: a walk from end to end of each.
#include "check/check_complex.hpp"

#include <algorithm>
#include <utility>

#include "check/line_walk.hpp"
#include "mesh/locate.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

std::array<std::uint32_t, 2> ends_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

std::optional<std::uint32_t> tetrahedron_at(const Mesh<3>& mesh, const Point<3>& p) {
  std::optional<std::uint32_t> first;
  const auto corners = [&](std::size_t t) {
    const auto& [a, b, c, d] = mesh.simplices[t];
    const auto& v = mesh.vertices;
    return std::array<Point<3>, 4>{v[a], v[b], v[c], v[d]};
  };
  for_each_holding<3>({p}, mesh.simplices.size(), corners,
                      [&](std::uint32_t, std::uint32_t t, unsigned) {
                        if (!first) first = t;
                      });
  return first;
}

ComplexCheck::ComplexCheck(const Mesh<3>& mesh, const CheckOptions<3>& options,
                           const HalfFaces& faces)
    : mesh_(mesh),
      options_(options),
      rounding_(rounding_of(mesh)),
      segments_(Verdict::good("")),
      polygons_(Verdict::good("")) {
  for (const auto& p : options.graph->graph.points) places_[p.id] = p.at;
  add_lines();
  segments_ = find_segments(faces);
  polygons_ = find_polygons(faces);
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
  return options_.boundary != BoundaryRule::box && !tetrahedron_at(mesh_, p);
}

Verdict ComplexCheck::find_segments(const HalfFaces& faces) {
  LineWalk<3> walk(mesh_);
  std::set<Ends> edges, known;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto [a, b, c] = faces[i].face;
    for (const auto& e : {ends_of(a, b), ends_of(b, c), ends_of(c, a)}) edges.insert(e);
  }
  for (const auto& [a, b] : edges) walk.add_edge(a, b);
  if (options_.features != nullptr) {
    for (const MeshEdge& e : options_.features->edges) known.insert({e.low, e.high});
  }
  const auto is_known = [&](std::uint32_t a, std::uint32_t b) {
    return known.count(ends_of(a, b)) != 0;
  };
  const std::vector<HalfFace> border = faces.border();
  const auto is_outside_between = [&](const Point<3>& p, const Point<3>& q) {
    return is_outside(scaled(0.5, plus(p, q))) &&
           std::none_of(border.begin(), border.end(), [&](const HalfFace& half) {
             const auto [a, b, c] = half.face;
             return goes_through(p, q, {at(a), at(b), at(c)});
           });
  };
  Verdict verdict = Verdict::good("");
  std::size_t parts = 0, outside = 0, cut = 0;
  for (Line& l : lines_) {
    auto way = walk.find(l.from, l.to, is_known, is_outside_between);
    if (way.trouble && verdict.holds) {
      verdict = Verdict::bad(l.name + " from " + text::to_text<3>(l.from) + " to " +
                             text::to_text<3>(l.to) + ": " + *way.trouble);
    }
    if (way.trouble) continue;
    for (const auto& run : way.runs) parts += run.size() - 1;
    outside += way.runs.empty() ? 1 : 0;
    cut += way.runs.empty() || way.is_whole ? 0 : 1;
    l.runs = std::move(way.runs);
    l.alone = std::move(way.alone);
  }
  if (!verdict.holds) return verdict;
  return Verdict::good(std::to_string(lines_.size() - outside) +
                       " segments and edges of polygons are unions of " + std::to_string(parts) +
                       " edges" + outside_text(outside, cut));
}

}  // namespace mesher::detail
