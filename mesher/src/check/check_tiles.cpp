// Whether polygons are unions of faces: of those that tile them.
#include <algorithm>
#include <cmath>

#include "check/check_complex.hpp"
#include "check/flat_polygon.hpp"
#include "check/line_walk.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/cube_around.hpp"
#include "records/reach_tree.hpp"
#include "sets/make_set.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

constexpr double kArea = 1e-9;  // areas that differ by no more of them are equal

std::string name_of(const char* kind, FeatureId id) {
  return std::string(kind) + std::to_string(static_cast<std::int64_t>(id));
}

FlatPolygon flat(const Polygon& polygon, const std::map<FeatureId, Point<3>>& places) {
  std::vector<std::vector<Point<3>>> loops;
  for (const auto& loop : polygon.loops) {
    auto& corners = loops.emplace_back();
    for (const FeatureId id : loop) corners.push_back(places.at(id));
  }
  return FlatPolygon(loops);
}

std::array<std::uint32_t, 2> ends_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

void ComplexCheck::add_edges(Surface& surface, const std::vector<FeatureId>& ends,
                             std::set<Ends>& edges) {
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    for (const auto& run : lines_[line(ends[i], ends[i + 1], "")].runs) {
      for (std::size_t k = 1; k < run.size(); ++k) edges.insert(ends_of(run[k - 1], run[k]));
      surface.on.insert(surface.on.end(), run.begin(), run.end());
    }
  }
}

void ComplexCheck::add_named_tiles() {
  std::map<FeatureId, std::size_t> number;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) number[surfaces_[i].polygon->id] = i;
  for (const MeshFace& f : options_.features->faces) {
    if (!f.polygon) continue;
    const auto found = number.find(*f.polygon);
    if (found != number.end()) surfaces_[found->second].tiles.push_back(f.key());
  }
}

namespace {

// Faces whose corners are all near a polygon, found by the place of their first.
class FacesBeside {
 public:
  FacesBeside(const Mesh<3>& mesh, const HalfFaces& faces)
      : mesh_(mesh),
        faces_(faces),
        cube_(cube_around<3>(mesh.vertices)),
        tree_(cube_),
        near_(mesh.vertices.size()) {
    for (std::uint32_t v = 0; v < near_.size(); ++v) tree_.insert(mesh.vertices[v], 0, v);
  }

  FacesBeside(const FacesBeside&) = delete;
  FacesBeside& operator=(const FacesBeside&) = delete;

  /// Calls visit(i, n) for the faces in a box with all corners `tolerance` from the polygon's plane
  /// at most: by their half-faces, n from the i-th on, ascending.
  template <class Visit>
  void visit(const FlatPolygon& f, const Box<3>& box, double tolerance, Visit&& visit) {
    std::vector<std::uint32_t> found;
    tree_.visit_in(box, [&](std::uint32_t v) {
      if (std::abs(f.height(mesh_.vertices[v])) <= tolerance) found.push_back(v);
    });
    std::sort(found.begin(), found.end());
    for (const std::uint32_t v : found) near_[v] = true;
    for (const std::uint32_t v : found) {
      for (std::size_t i = faces_.first_at(v), n = 0; i < faces_.size(); i += n) {
        const auto [a, b, c] = faces_[i].face;
        if (a != v) break;
        n = faces_.partners(i);
        if (near_[b] && near_[c]) visit(i, n);
      }
    }
    for (const std::uint32_t v : found) near_[v] = false;
  }

 private:
  const Mesh<3>& mesh_;
  const HalfFaces& faces_;
  MeshBox<3> cube_;
  ReachTree<std::uint32_t, 3> tree_;
  std::vector<bool> near_;
};

// What the corners of a polygon are in, and places that are off it by no more than this.
Box<3> box_of(const Polygon& polygon, const std::map<FeatureId, Point<3>>& places, double by) {
  std::vector<Point<3>> corners;
  for (const auto& loop : polygon.loops) {
    for (const FeatureId id : loop) corners.push_back(places.at(id));
  }
  Box<3> box = bounding_box<3>(corners);
  for (int i = 0; i < 3; ++i) box.lo[i] -= by, box.hi[i] += by;
  return box;
}

}  // namespace

// Of faces beside the polygon with their corners on its plane, those whose Voronoi edge crosses it;
// on the boundary, where that is a ray, those with their middle in it.
void ComplexCheck::add_crossed_tiles(const HalfFaces& faces) {
  const auto centre = [&](std::uint32_t t) {
    const auto& [a, b, c, d] = mesh_.simplices[t];
    const Circumcentre o = circumcentre(at(a), at(b), at(c), at(d));
    return FlatPolygon::wide(plus(at(a), o.q));
  };
  const auto is_tile = [&](const FlatPolygon& f, std::size_t i, std::size_t n) {
    if (n == 1) {
      const auto [a, b, c] = faces[i].face;
      const Point<3> middle = scaled(1.0 / 3, plus(at(a), plus(at(b), at(c))));
      return f.contains(FlatPolygon::wide(middle));
    }
    const auto p = centre(faces[i].tetrahedron), q = centre(faces[i + 1].tetrahedron);
    const auto from = f.height(p), to = f.height(q);
    if ((from > 0) == (to > 0)) return false;
    const auto t = from / (from - to);
    return f.contains(
        {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
  };
  FacesBeside beside(mesh_, faces);
  for (Surface& surface : surfaces_) {
    const FlatPolygon f = flat(*surface.polygon, places_);
    const double tolerance = static_cast<double>(f.deviation()) + 4 * rounding_;
    const Box<3> box = box_of(*surface.polygon, places_, tolerance);
    beside.visit(f, box, tolerance, [&](std::size_t i, std::size_t n) {
      if (is_tile(f, i, n)) surface.tiles.push_back(faces[i].key());
    });
  }
}

Verdict ComplexCheck::find_polygons(const HalfFaces& faces) {
  const auto* features = options_.features;
  const bool named =
      features != nullptr && std::any_of(features->faces.begin(), features->faces.end(),
                                         [](const MeshFace& f) { return f.polygon.has_value(); });
  for (Surface& surface : surfaces_) {
    for (auto loop : surface.polygon->loops) {
      loop.push_back(loop.front());
      add_edges(surface, loop, surface.border);
    }
    for (const auto& [a, b] : surface.polygon->edges) add_edges(surface, {a, b}, surface.inner);
  }
  named ? add_named_tiles() : add_crossed_tiles(faces);
  std::set<Face> there;
  for (std::size_t i = 0; i < faces.size(); i += faces.partners(i)) there.insert(faces[i].key());
  std::size_t tiles = 0, outside = 0;
  Verdict verdict = Verdict::good("");
  for (Surface& surface : surfaces_) {
    for (const Face& tile : surface.tiles) {
      tiles_.insert(tile);
      surface.on.insert(surface.on.end(), tile.begin(), tile.end());
    }
    make_set(surface.on);
    tiles += surface.tiles.size();
    if (surface.tiles.empty() && is_outside(flat(*surface.polygon, places_).inner_place())) {
      ++outside;
    } else if (const auto trouble = trouble_of(surface); trouble && verdict.holds) {
      verdict = Verdict::bad(name_of("polygon ", surface.polygon->id) + ": " + *trouble);
    }
  }
  for (const Face& tile : tiles_) {
    if (!verdict.holds || there.count(tile) != 0) continue;
    verdict = Verdict::bad("no tetrahedron has the face of " + vertex_name(mesh_, tile[0]) + ", " +
                           vertex_name(mesh_, tile[1]) + " and " + vertex_name(mesh_, tile[2]));
  }
  if (!verdict.holds) return verdict;
  return Verdict::good(std::to_string(surfaces_.size() - outside) + " polygons are unions of " +
                       std::to_string(tiles) + " faces" +
                       (outside > 0 ? ", " + std::to_string(outside) + " are outside" : ""));
}

// Why the tiles do not make up the polygon; nothing if they do.
std::optional<std::string> ComplexCheck::trouble_of(const Surface& surface) const {
  const FlatPolygon f = flat(*surface.polygon, places_);
  const double tolerance = static_cast<double>(f.deviation()) + 4 * rounding_;
  long double area = 0;
  std::map<Ends, int> sides;
  for (const auto& [a, b, c] : surface.tiles) {
    for (const std::uint32_t v : {a, b, c}) {
      if (std::abs(f.height(at(v))) <= tolerance) continue;
      return vertex_name(mesh_, v) + ", a corner of one of its faces, is " +
             text::to_text(static_cast<double>(f.height(at(v)))) + " off its plane";
    }
    area += twice_area(at(a), at(b), at(c)) / 2;
    for (const auto& e : {ends_of(a, b), ends_of(b, c), ends_of(c, a)}) ++sides[e];
  }
  const auto edge = [&](const Ends& e) {
    return "the edge from " + vertex_name(mesh_, e[0]) + " to " + vertex_name(mesh_, e[1]);
  };
  for (const Ends& e : surface.border) {
    if (sides[e] != 1)
      return edge(e) + ", on its border, is of " + std::to_string(sides[e]) + " of its faces";
  }
  for (const Ends& e : surface.inner) {
    if (sides[e] != 2)
      return edge(e) + ", which it declares, is of " + std::to_string(sides[e]) + " of its faces";
  }
  for (const auto& [e, count] : sides) {
    if (count == 2 || surface.border.count(e) != 0) continue;
    return edge(e) + " is of " + std::to_string(count) + " of its faces, and not on its border";
  }
  const long double whole = f.area();
  if (std::abs(area - whole) <= kArea * whole) return std::nullopt;
  return "its faces' area is " + text::to_text(static_cast<double>(area)) + ", its own " +
         text::to_text(static_cast<double>(whole));
}

}  // namespace mesher::detail
