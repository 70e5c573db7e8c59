// Whether vertices, edges and faces have the markers of the complex's points, segments and
// polygons.
//
// As meshes of this tool have them: a vertex has its point's; else, as any mesh may choose, that of
// a segment or polygon that it is on. An edge has its segment's, or else that of a polygon that it
// is on; a face its polygon's. What the mesh does not list has none to compare, and none is
// compared where the mesh has no markers of its kind at all.
#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "check/check_complex.hpp"
#include "check/marked.hpp"

namespace mesher::detail {

class ComplexCheck::Markers {
 public:
  explicit Markers(const ComplexCheck& check)
      : check_(check), features_(*check.options_.features), points_(*check.options_.graph) {
    const GraphFile<3>& file = *check.options_.graph;
    const Graph<3>& plc = file.graph;
    const auto add_piece = [&](PointId from, PointId to, const Marked& line) {
      const auto ends = std::minmax(from, to);
      segments_.emplace(check.line_of_.at({ends.first, ends.second}), line);
    };
    for (std::size_t i = 0; i < plc.segments.size(); ++i) {
      const auto& s = plc.segments[i];
      add_piece(s.from, s.to, marked(s.marker, "segment", s.id, file.segments, i));
    }
    for (std::size_t i = 0; i < plc.polylines.size(); ++i) {
      const auto& l = plc.polylines[i];
      for (std::size_t k = 1; k < l.points.size(); ++k) {
        add_piece(l.points[k - 1], l.points[k],
                  marked(l.marker, "polyline", l.id, file.polylines, i));
      }
    }
    for (std::size_t i = 0; i < plc.polygons.size(); ++i) {
      const auto& f = plc.polygons[i];
      polygons_.push_back(marked(f.marker, "polygon", f.id, file.polygons, i));
      for (const Face& tile : check.surfaces_[i].tiles) polygon_at_[tile] = i;
    }
    add_alone();
    for (const HalfFace& half : check.mesh_.sides().border()) {
      border_.insert(half.key());
      for (const std::uint32_t v : half.face) border_vertices_.insert(v);
    }
  }

  [[nodiscard]] Verdict run() const {
    std::size_t vertices = 0;
    for (std::uint32_t v = 0; v < features_.markers.size(); ++v) {
      const std::string trouble = trouble_at(v);
      if (!trouble.empty()) return Verdict::bad(check_.mesh_.vertex(v) + trouble);
      vertices += features_.markers[v] != 0 ? 1 : 0;
    }
    const auto& edges = features_.edges;
    for (const MeshEdge& e : edges) {
      const std::string trouble = has_marker(edges) ? trouble_of(e) : "";
      if (trouble.empty()) continue;
      return Verdict::bad(check_.mesh_.edge(e.low, e.high) + trouble);
    }
    const auto& faces = features_.faces;
    for (const MeshFace& f : faces) {
      const std::string trouble = has_marker(faces) ? trouble_of(f) : "";
      if (trouble.empty()) continue;
      return Verdict::bad(check_.mesh_.face(f.key()) + trouble);
    }
    return Verdict::good(std::to_string(vertices) + " vertices, " + count(edges) + " edges and " +
                         count(faces) + " faces have one");
  }

 private:
  static std::string count(const auto& parts) {
    return std::to_string(std::count_if(parts.begin(), parts.end(),
                                        [](const auto& part) { return part.marker != 0; }));
  }
  [[nodiscard]] const Featured& at(std::uint32_t v) const {
    static const Featured nothing;
    const auto it = check_.featured_.find(v);
    return it == check_.featured_.end() ? nothing : it->second;
  }
  template <class All>
  static All common(const All& a, const All& b) {
    All both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
  }
  // What is outside of the mesh but for vertices gives them markers as what is in it.
  void add_alone() {
    const auto& lines = check_.lines_;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      for (const std::uint32_t v : lines[i].alone) alone_[v].lines.push_back(i);
    }
    for (std::size_t i = 0; i < check_.surfaces_.size(); ++i) {
      for (const std::size_t line : check_.surfaces_[i].lines) {
        for (const std::uint32_t v : lines[line].alone) alone_[v].surfaces.push_back(i);
      }
    }
  }
  void add_segments(const std::vector<std::size_t>& lines, Givers& givers) const {
    for (const std::size_t line : lines) {
      const auto segment = segments_.find(line);
      if (segment != segments_.end()) givers.push_back(&segment->second);
    }
  }
  void add_polygons(const std::vector<std::size_t>& surfaces, Givers& givers) const {
    for (const std::size_t i : surfaces) givers.push_back(&polygons_[i]);
  }

  [[nodiscard]] std::string trouble_at(std::uint32_t v) const {
    const std::int64_t marker = features_.markers[v];
    if (const auto trouble = points_.trouble(marker, check_.at(v))) return *trouble;
    Givers givers;
    add_segments(at(v).lines, givers);
    add_polygons(at(v).surfaces, givers);
    if (const auto alone = alone_.find(v); alone != alone_.end()) {
      add_segments(alone->second.lines, givers);
      add_polygons(alone->second.surfaces, givers);
    }
    return marker_trouble(marker, givers, border_vertices_.contains(v), "segment or polygon");
  }
  // Of an edge on no edge of the complex nothing is known.
  [[nodiscard]] std::string trouble_of(const MeshEdge& e) const {
    const auto lines = common(at(e.low).lines, at(e.high).lines);
    if (lines.empty()) return "";
    Givers givers;
    add_segments(lines, givers);
    const bool by_segment =
        std::any_of(givers.begin(), givers.end(), [](const Marked* m) { return m->marker != 0; });
    if (!by_segment) add_polygons(common(at(e.low).surfaces, at(e.high).surfaces), givers);
    const bool at_border = border_vertices_.contains(e.low) && border_vertices_.contains(e.high);
    return marker_trouble(e.marker, givers, at_border, "segment or polygon");
  }
  [[nodiscard]] std::string trouble_of(const MeshFace& f) const {
    const auto polygon = polygon_at_.find(f.key());
    Givers givers;
    if (polygon != polygon_at_.end()) givers.push_back(&polygons_[polygon->second]);
    return marker_trouble(f.marker, givers, border_.contains(f.key()), "polygon");
  }

  const ComplexCheck& check_;
  const MeshFeatures& features_;
  MarkedPoints<3> points_;
  std::map<std::uint32_t, Featured> alone_;  // by vertex: those of which it is on no edge
  std::map<std::size_t, Marked> segments_;   // by their lines
  std::vector<Marked> polygons_;             // by their surfaces
  std::map<Face, std::size_t> polygon_at_;
  std::set<Face> border_;
  std::set<std::uint32_t> border_vertices_;
};

Verdict ComplexCheck::markers() const { return Markers(*this).run(); }

}  // namespace mesher::detail
