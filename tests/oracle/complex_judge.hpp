// Whether a mesh of tetrahedra contains a complex: its segments are unions of edges, its polygons
// of faces. Reads what it judges by itself, and shares no code with the mesher.
//
// What is exact: a polygon's faces, projected along an axis that its plane is not parallel to, all
// go round the same way (exact signs), each of their edges is of two of them, on different sides,
// or of one; and those of one are chains from corner to corner of the polygon's loops. So as many
// faces cover a place as these chains wind round it: once inside, nowhere else. Vertices of doubles
// are hardly ever on a line or a plane: how far they are off is measured, and must be rounding.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "judge_main.hpp"
#include "node_file.hpp"

namespace oracle {

/// A .poly file of TetGen: facets as lists of polygons, by the positions of points.
struct ComplexFile {
  using Ring = std::vector<std::size_t>;
  Numbered<std::array<double, 3>> points;
  std::vector<std::vector<Ring>> facets;
};

inline ComplexFile read_complex(const std::string& path) {
  TokenLines lines(path);
  ComplexFile file{read_places<3>(lines), {}};
  std::unordered_map<long, std::size_t> position;
  for (std::size_t i = 0; i < file.points.ids.size(); ++i) position[file.points.ids[i]] = i;
  const auto count = lines.parse<std::size_t>(lines.next(1)[0]);
  for (std::size_t f = 0; f < count; ++f) {
    const auto header = lines.next(1);
    const auto holes = header.size() > 1 ? lines.parse<std::size_t>(header[1]) : 0;
    auto& facet = file.facets.emplace_back();
    for (auto left = lines.parse<std::size_t>(header[0]); left > 0; --left) {
      auto tokens = lines.next(1);
      const auto corners = lines.parse<std::size_t>(tokens[0]);
      std::size_t at = 1;
      auto& ring = facet.emplace_back();
      while (ring.size() < corners) {
        if (at == tokens.size()) tokens = lines.next(1), at = 0;
        const auto found = position.find(lines.parse<long>(tokens[at++]));
        if (found == position.end()) lines.fail("unknown point");
        ring.push_back(found->second);
      }
    }
    for (std::size_t h = 0; h < holes; ++h) lines.next(4);
  }
  return file;
}

/// The faces of a .face file that name a polygon (behind the marker), by polygon.
inline std::map<long, std::vector<std::array<std::size_t, 3>>> read_faces(
    const std::string& path, const std::vector<long>& ids) {
  std::unordered_map<long, std::size_t> position;
  for (std::size_t i = 0; i < ids.size(); ++i) position[ids[i]] = i;
  TokenLines lines(path);
  std::map<long, std::vector<std::array<std::size_t, 3>>> faces;
  for (auto left = lines.parse<std::size_t>(lines.next(1)[0]); left > 0; --left) {
    const auto tokens = lines.next(4);
    std::array<std::size_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = position.find(lines.parse<long>(tokens[k + 1]));
      if (found == position.end()) lines.fail("unknown vertex");
      corners[k] = found->second;
    }
    if (tokens.size() > 5) faces[lines.parse<long>(tokens[5])].push_back(corners);
  }
  return faces;
}

class ComplexJudge {
 public:
  using Place = std::array<double, 3>;
  using Face = std::array<std::size_t, 3>;
  using Edge = std::array<std::size_t, 2>;  // ascending

  /// `faces`, `edges`: of the tetrahedra, corners ascending.
  ComplexJudge(const std::vector<Place>& vertices, const std::set<Face>& faces,
               const std::set<Edge>& edges, Failures& failures)
      : vertices_(vertices), faces_(faces), edges_(edges), failures_(failures) {
    for (std::size_t v = 0; v < vertices.size(); ++v) at_[vertices[v]] = v;
    for (const Place& p : vertices)
      for (const double x : p) largest_ = std::max(largest_, std::abs(x));
  }

  void judge(const std::string& poly, const std::string& face_file, const std::vector<long>& ids) {
    complex_ = read_complex(poly);
    const auto named = read_faces(face_file, ids);
    long polygon = 0;
    for (const auto& facet : complex_.facets) {
      ++polygon;
      const bool is_surface =
          std::any_of(facet.begin(), facet.end(), [](const auto& ring) { return ring.size() > 2; });
      if (is_surface) {
        const auto found = named.find(polygon);
        if (found == named.end()) {
          fail("polygon", polygon, "has no faces");
        } else {
          judge_polygon(polygon, facet, found->second);
        }
        continue;
      }
      for (const auto& ring : facet) {
        std::set<Edge> left = edges_;
        if (ring.size() == 2 && !take_chain(ring[0], ring[1], left))
          fail("segment", polygon, "is no chain of edges");
      }
    }
    for (const auto& [id, tiles] : named) {
      if (id < 1 || id > polygon) fail("polygon", id, "is not in the complex");
    }
  }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  static constexpr double kRounding = 0x1p-46;  // of the largest coordinate

  void fail(const char* kind, long id, const std::string& what) {
    failures_.add(kind, std::to_string(id) + ' ' + what);
  }
  static Edge edge(std::size_t a, std::size_t b) { return {std::min(a, b), std::max(a, b)}; }
  static Place minus(const Place& a, const Place& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static Place cross(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static double dot(const Place& a, const Place& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  const Place& place(std::size_t point) const { return complex_.points.items[point]; }

  Place normal_of(const ComplexFile::Ring& ring) const {
    Place sum{};
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      const Place n =
          cross(minus(place(ring[i]), place(ring[0])), minus(place(ring[i + 1]), place(ring[0])));
      for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
    }
    const double length = std::sqrt(dot(sum, sum));
    for (double& x : sum) x /= length;
    return sum;
  }

  void judge_polygon(long id, const std::vector<ComplexFile::Ring>& facet,
                     const std::vector<Face>& tiles) {
    const auto outer =
        *std::find_if(facet.begin(), facet.end(), [](const auto& ring) { return ring.size() > 2; });
    const Place normal = normal_of(outer);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    double bent = kRounding * largest_;  // what the corners themselves are off the plane
    for (const auto& ring : facet)
      for (const std::size_t p : ring)
        bent = std::max(bent, 2 * std::abs(dot(minus(place(p), place(outer[0])), normal)));
    std::map<Edge, std::array<int, 2>> sides;  // one way, and the other
    for (Face t : tiles) {
      Face key = t;
      std::sort(key.begin(), key.end());
      if (!faces_.count(key)) return fail("polygon", id, "has a face of no tetrahedron");
      for (const std::size_t v : t) {
        if (std::abs(dot(minus(vertices_[v], place(outer[0])), normal)) > bent)
          return fail("polygon", id, "has a face off its plane");
      }
      const auto way = orientation(t, axis);
      if (way == CGAL::COLLINEAR) return fail("polygon", id, "has a face without area");
      if (way == CGAL::RIGHT_TURN) std::swap(t[1], t[2]);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = t[k], b = t[(k + 1) % 3];
        ++sides[edge(a, b)][a < b ? 0 : 1];
      }
    }
    std::set<Edge> border, inner;
    for (const auto& [e, ways] : sides) {
      if (ways[0] > 1 || ways[1] > 1) return fail("polygon", id, "has faces that overlap");
      (ways[0] == ways[1] ? inner : border).insert(e);
    }
    for (const auto& ring : facet) {
      if (ring.size() < 2) continue;
      const std::size_t pieces = ring.size() == 2 ? 1 : ring.size();
      for (std::size_t i = 0; i < pieces; ++i) {
        const std::size_t a = ring[i], b = ring[(i + 1) % ring.size()];
        if (!take_chain(a, b, ring.size() > 2 ? border : inner) &&
            !take_chain(a, b, ring.size() > 2 ? inner : border))
          return fail("polygon", id, "has an edge that is no chain of its faces' edges");
      }
    }
    if (!border.empty()) fail("polygon", id, "has faces that end within it");
  }

  CGAL::Orientation orientation(const Face& t, std::size_t axis) const {
    std::array<Kernel::Point_2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Place& v = vertices_[t[k]];
      p[k] = Kernel::Point_2(v[(axis + 1) % 3], v[(axis + 2) % 3]);
    }
    return CGAL::orientation(p[0], p[1], p[2]);
  }

  // Takes a chain of edges along the straight line between two points out of `left`.
  bool take_chain(std::size_t from, std::size_t to, std::set<Edge>& left) const {
    const auto a = at_.find(place(from)), b = at_.find(place(to));
    if (a == at_.end() || b == at_.end()) return false;
    const Place along = minus(place(to), place(from));
    const double length = std::sqrt(dot(along, along));
    const auto is_on = [&](std::size_t v) {
      const Place n = cross(minus(vertices_[v], place(from)), along);
      return std::sqrt(dot(n, n)) <= kRounding * largest_ * length;
    };
    const auto how_far = [&](std::size_t v) {
      return dot(minus(vertices_[v], place(from)), along);
    };
    std::map<std::size_t, std::size_t> next;  // the nearest ahead, on the line
    for (const auto& [u, v] : left) {
      if (!is_on(u) || !is_on(v)) continue;
      const auto [back, ahead] = how_far(u) < how_far(v) ? std::pair(u, v) : std::pair(v, u);
      const auto [it, is_new] = next.try_emplace(back, ahead);
      if (!is_new && how_far(ahead) < how_far(it->second)) it->second = ahead;
    }
    std::vector<Edge> chain;
    for (std::size_t v = a->second; v != b->second; v = next.at(v)) {
      if (!next.count(v) || how_far(next.at(v)) > dot(along, along)) return false;
      chain.push_back(edge(v, next.at(v)));
    }
    for (const Edge& e : chain) left.erase(e);
    return true;
  }

  const std::vector<Place>& vertices_;
  const std::set<Face>& faces_;
  const std::set<Edge>& edges_;
  Failures& failures_;
  std::map<Place, std::size_t> at_;
  double largest_ = 0;
  ComplexFile complex_;
};

}  // namespace oracle
