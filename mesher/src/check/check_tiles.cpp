// Whether polygons are unions of faces: of those that tile them.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "check/check_complex.hpp"
#include "check/flat_polygon.hpp"
#include "check/line_walk.hpp"
#include "geometry/cube_around.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/predicates.hpp"
#include "records/reach_tree.hpp"
#include "sets/make_set.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

// Areas that differ by no more of them are equal, but for the rounding of vertices on the border.
constexpr double kArea = 1e-9;
// Of the length of an edge: so near its middle a place beside it is in the polygon beside it.
constexpr double kBeside = 0x1p-10;

FlatPolygon flat(const mesher::Polygon& polygon, const std::map<PointId, Point<3>>& places) {
  std::vector<std::vector<Point<3>>> loops;
  for (const auto& loop : polygon.loops) {
    auto& corners = loops.emplace_back();
    for (const PointId id : loop) corners.push_back(places.at(id));
  }
  return FlatPolygon(loops);
}

}  // namespace

// How far vertices on a polygon may be off its plane: twice as far as what it names, since new ones
// are in planes of vertices that are off it, too.
double ComplexCheck::flatness(const Surface& surface, const FlatPolygon& f) const {
  double most = 0;
  for (const PointId id : surface.points) {
    most = std::max(most, static_cast<double>(std::abs(f.height(places_.at(id)))));
  }
  return 2 * most + 4 * rounding_;
}

void ComplexCheck::add_edges(Surface& surface, const std::vector<PointId>& ends,
                             std::set<Ends>& edges) {
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const std::size_t l = line(ends[i], ends[i + 1], "");
    for (const auto& run : lines_[l].runs) {
      for (const std::uint32_t v : run) surface.lines_at[v].push_back(l);
      for (std::size_t k = 1; k < run.size(); ++k) edges.insert(ends_of(run[k - 1], run[k]));
      surface.on.insert(surface.on.end(), run.begin(), run.end());
    }
  }
}

void ComplexCheck::add_named_tiles() {
  std::map<PolygonId, std::size_t> number;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) number[surfaces_[i].polygon->id] = i;
  for (const MeshFace& f : options_.features->faces) {
    if (!f.polygon) continue;
    const auto found = number.find(*f.polygon);
    if (found != number.end()) surfaces_[found->second].tiles.push_back(f.key());
  }
}

namespace {

// Vertices of a mesh by their places, and which of them are on the polygon that is looked at.
class VerticesOn {
 public:
  explicit VerticesOn(const Mesh<3>& mesh)
      : mesh_(mesh), cube_(cube_around<3>(mesh.vertices)), tree_(cube_), on_(mesh.vertices.size()) {
    for (std::uint32_t v = 0; v < on_.size(); ++v) tree_.insert(mesh.vertices[v], 0, v);
  }

  VerticesOn(const VerticesOn&) = delete;
  VerticesOn& operator=(const VerticesOn&) = delete;

  /// Those in a box, `tolerance` from the polygon's plane at most, that are inside or `known`.
  void look_at(const FlatPolygon& f, const Box<3>& box, double tolerance,
               const std::vector<std::uint32_t>& known) {
    for (const std::uint32_t v : all_) on_[v] = false;
    all_ = known;
    tree_.visit_in(box, [&](std::uint32_t v) {
      const Point<3>& p = mesh_.vertices[v];
      if (std::abs(f.height(p)) <= tolerance && f.contains(FlatPolygon::wide(p))) {
        all_.push_back(v);
      }
    });
    make_set(all_);
    for (const std::uint32_t v : all_) on_[v] = true;
  }
  [[nodiscard]] bool operator[](std::uint32_t v) const { return on_[v]; }
  [[nodiscard]] const std::vector<std::uint32_t>& all() const noexcept { return all_; }

 private:
  const Mesh<3>& mesh_;
  MeshBox<3> cube_;
  ReachTree<std::uint32_t, 3> tree_;
  std::vector<bool> on_;
  std::vector<std::uint32_t> all_;  // ascending
};

// What the corners of a polygon are in, and places that are off it by no more than this.
Box<3> box_of(const mesher::Polygon& polygon, const std::map<PointId, Point<3>>& places,
              double by) {
  std::vector<Point<3>> corners;
  for (const auto& loop : polygon.loops) {
    for (const PointId id : loop) corners.push_back(places.at(id));
  }
  Box<3> box = bounding_box<3>(corners);
  for (int i = 0; i < 3; ++i) box.lo[i] -= by, box.hi[i] += by;
  return box;
}

}  // namespace

// Of faces with their corners on the polygon, and their middles, those on one side of which is no
// tetrahedron that is flat on it: so these are a surface, whatever is flat. The side is one on
// which no face that ends the mesh is left out, since nothing is behind that.
void ComplexCheck::add_tiles_beside_flat() {
  VerticesOn on(mesh_.mesh());
  for (Surface& surface : surfaces_) {
    const FlatPolygon f = flat(*surface.polygon, places_);
    const double tolerance = flatness(surface, f);
    on.look_at(f, box_of(*surface.polygon, places_, tolerance), tolerance, surface.on);
    const auto is_flat = [&](std::uint32_t t) {
      const auto& corners = mesh_.mesh().simplices[t];
      return std::all_of(corners.begin(), corners.end(), [&](auto w) { return on[w]; }) &&
             !has_three_on_line(surface, corners);
    };
    const auto is_part = [&](const Face& face) {
      const auto& [a, b, c] = face;
      if (!on[b] || !on[c] || cuts_edge(surface, face)) return false;
      const Point<3> middle = scaled(1.0 / 3, plus(at(a), plus(at(b), at(c))));
      return f.contains(FlatPolygon::wide(middle));
    };
    const HalfFaces& faces = mesh_.sides();
    std::array<std::vector<Face>, 2> tiles;  // with nothing flat below, above
    std::array<bool, 2> has_gap{};
    for (const std::uint32_t v : on.all()) {
      for (std::size_t i = faces.first_at(v), n = 0; i < faces.size(); i += n) {
        const Face face = faces[i].key();
        if (face[0] != v) break;
        n = faces.partners(i);
        if (!is_part(face)) continue;
        std::array<bool, 2> is_covered{};
        for (std::size_t k = i; k < i + n; ++k) {
          const std::uint32_t t = faces[k].tetrahedron;
          if (is_flat(t)) is_covered[is_above(f, face, t) ? 1 : 0] = true;
        }
        for (std::size_t side = 0; side < 2; ++side) {
          if (!is_covered[side]) tiles[side].push_back(face);
          if (is_covered[side] && n == 1) has_gap[side] = true;
        }
      }
    }
    surface.tiles = std::move(tiles[has_gap[1] ? 0 : 1]);
  }
}

// Whether two of its corners are on one edge of the polygon, but are not joined by a part of it.
bool ComplexCheck::cuts_edge(const Surface& surface, const Face& face) const {
  for (const auto& [v, w] : {std::pair(face[0], face[1]), {face[1], face[2]}, {face[0], face[2]}}) {
    if (share_line(surface, {v, w}) && surface.border.count(ends_of(v, w)) == 0 &&
        surface.inner.count(ends_of(v, w)) == 0) {
      return true;
    }
  }
  return false;
}

bool ComplexCheck::has_three_on_line(const Surface& surface,
                                     const Mesh<3>::Simplex& corners) const {
  const auto& [a, b, c, d] = corners;
  return share_line(surface, {a, b, c}) || share_line(surface, {a, b, d}) ||
         share_line(surface, {a, c, d}) || share_line(surface, {b, c, d});
}

// Whether an edge of the polygon has all of these vertices.
bool ComplexCheck::share_line(const Surface& surface,
                              const std::vector<std::uint32_t>& vertices) const {
  const auto with = [&](std::uint32_t v) {
    const auto it = surface.lines_at.find(v);
    return it == surface.lines_at.end() ? std::vector<std::size_t>{} : it->second;
  };
  std::vector<std::size_t> common = with(vertices.front());
  for (const std::uint32_t v : vertices) {
    const std::vector<std::size_t> lines = with(v);
    std::erase_if(common, [&](std::size_t line) {
      return std::find(lines.begin(), lines.end(), line) == lines.end();
    });
  }
  return !common.empty();
}

// Whether a tetrahedron with that face is on the side of it that the polygon's normal is on.
bool ComplexCheck::is_above(const FlatPolygon& f, const Face& face, std::uint32_t t) const {
  const auto& corners = mesh_.mesh().simplices[t];
  const auto apex = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t w) {
    return std::find(face.begin(), face.end(), w) == face.end();
  });
  const auto& [a, b, c] = face;
  const bool is_left = predicates::orient3d(at(a), at(b), at(c), at(*apex)) > 0;
  return is_left == f.is_left(at(a), at(b), at(c));
}

Verdict ComplexCheck::find_polygons() {
  const HalfFaces& faces = mesh_.sides();
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
  named ? add_named_tiles() : add_tiles_beside_flat();
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
    const auto trouble = trouble_of(surface);
    if (!trouble && surface.tiles.empty()) ++outside;
    if (trouble && verdict.holds) {
      verdict = Verdict::bad(text_of(surface.polygon->id) + ": " + *trouble);
    }
  }
  for (const Face& tile : tiles_) {
    if (!verdict.holds || there.count(tile) != 0) continue;
    verdict = Verdict::bad("no tetrahedron has " + mesh_.face(tile));
  }
  if (!verdict.holds) return verdict;
  return Verdict::good(std::to_string(surfaces_.size() - outside) + " polygons are unions of " +
                       std::to_string(tiles) + " faces" +
                       (outside > 0 ? ", " + std::to_string(outside) + " are outside" : ""));
}

// Whether the mesh has nothing at an edge on the way to a place. (The signs are of the planes
// through the edge and another corner of a tetrahedron; on such a plane is in the mesh.)
bool ComplexCheck::is_open(const Ends& edge, const Point<3>& towards) {
  if (options_.boundary == BoundaryRule::box) return false;
  if (around_.empty()) {
    for (const Surface& surface : surfaces_) {
      for (const Ends& e : surface.border) around_[e];
      for (const Ends& e : surface.inner) around_[e];
    }
    const auto& simplices = mesh_.mesh().simplices;
    for (std::uint32_t t = 0; t < simplices.size(); ++t) {
      const auto& s = simplices[t];
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = i + 1; k < 4; ++k) {
          const auto found = around_.find(ends_of(s[i], s[k]));
          if (found != around_.end()) found->second.push_back(t);
        }
      }
    }
  }
  const auto side = [&](std::uint32_t v, const Point<3>& p) {
    return predicates::orient3d(at(edge[0]), at(edge[1]), at(v), p);
  };
  return std::none_of(around_[edge].begin(), around_[edge].end(), [&](std::uint32_t t) {
    std::vector<std::uint32_t> others;
    for (const std::uint32_t v : mesh_.mesh().simplices[t]) {
      if (v != edge[0] && v != edge[1]) others.push_back(v);
    }
    const auto [r, s] = std::pair(others[0], others[1]);
    return side(r, towards) * side(r, at(s)) >= 0 && side(s, towards) * side(s, at(r)) >= 0;
  });
}

// Why the tiles do not make up the polygon, or what of it is in the mesh; nothing if they do. Edges
// cut it into parts, each of which is in the mesh or outside: so where no tile is beside an edge
// there is nothing at all.
std::optional<std::string> ComplexCheck::trouble_of(const Surface& surface) {
  const FlatPolygon f = flat(*surface.polygon, places_);
  const double tolerance = flatness(surface, f);
  long double area = 0;
  std::map<Ends, std::vector<std::uint32_t>> opposite;  // corners of tiles, by their edges
  for (const auto& [a, b, c] : surface.tiles) {
    for (const std::uint32_t v : {a, b, c}) {
      if (std::abs(f.height(at(v))) <= tolerance) continue;
      return mesh_.vertex(v) + ", a corner of one of its faces, is " +
             text::to_text(static_cast<double>(f.height(at(v)))) + " off its plane";
    }
    area += f.area_of(at(a), at(b), at(c));
    for (const auto& [p, q, other] : {std::tuple(a, b, c), {b, c, a}, {c, a, b}}) {
      opposite[ends_of(p, q)].push_back(other);
    }
  }
  const auto edge = [&](const Ends& e) { return mesh_.edge(e[0], e[1]); };
  const auto place_beside = [&](std::uint32_t from, std::uint32_t to) {
    const auto far = f.beside(at(from), at(to));
    Point<3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = static_cast<double>(far[i]);
      if (std::abs(p[i]) < rounding_ * 0x1p-20) p[i] = 0;  // digits that no predicate can judge
    }
    return p;
  };
  const auto is_on_side = [&](const Ends& e, const Point<3>& p, std::uint32_t corner) {
    const Point<3> along = minus(at(e[1]), at(e[0])),
                   middle = scaled(0.5, plus(at(e[0]), at(e[1])));
    const auto across = [&](const Point<3>& x) { return cross(along, minus(x, middle)); };
    return dot(across(p), across(at(corner))) > 0;
  };
  // Whether there is a tile on each side of an edge that has some of the polygon, or nothing at
  // all; the sides that have nothing are counted.
  std::size_t open = 0;
  const auto fits = [&](const Ends& e, bool both_sides) {
    const auto& corners = opposite[e];
    for (const auto& [from, to] : {std::pair(e[0], e[1]), {e[1], e[0]}}) {
      const Point<3> p = place_beside(from, to);
      const auto tiles = std::count_if(corners.begin(), corners.end(),
                                       [&](std::uint32_t c) { return is_on_side(e, p, c); });
      if (tiles > 1) return false;
      if (tiles == 1) continue;
      const Point<3> middle = scaled(0.5, plus(at(e[0]), at(e[1])));
      const bool has_some =
          both_sides ||
          f.contains(FlatPolygon::wide(plus(middle, scaled(kBeside, minus(p, middle)))));
      if (!has_some) continue;
      if (!is_open(e, p)) return false;
      ++open;
    }
    return true;
  };
  for (const Ends& e : surface.border) {
    const std::size_t count = opposite[e].size();
    if (count == 1 || (count == 0 && fits(e, false))) continue;
    return edge(e) + ", on its border, is of " + std::to_string(count) + " of its faces";
  }
  for (const Ends& e : surface.inner) {
    const std::size_t count = opposite[e].size();
    if (count <= 2 && fits(e, true)) continue;
    return edge(e) + ", which it declares, is of " + std::to_string(count) + " of its faces";
  }
  for (const auto& [e, corners] : opposite) {
    if (corners.size() == 2 || surface.border.count(e) != 0 || surface.inner.count(e) != 0)
      continue;
    return edge(e) + " is of " + std::to_string(corners.size()) +
           " of its faces, and not on its border";
  }
  if (open > 0) return std::nullopt;
  if (surface.tiles.empty() && is_outside(f.inner_place())) return std::nullopt;
  const long double whole = f.area();
  if (std::abs(area - whole) <= kArea * whole + rounding_ * outline_of(surface))
    return std::nullopt;
  return "its faces' area is " + text::to_text(static_cast<double>(area)) + ", its own " +
         text::to_text(static_cast<double>(whole));
}

// The length of what of the border is in the mesh.
double ComplexCheck::outline_of(const Surface& surface) const {
  double length = 0;
  for (const auto& [a, b] : surface.border) length += std::sqrt(squared_distance(at(a), at(b)));
  return length;
}

}  // namespace mesher::detail
