// A surface of triangles under edits: its vertices move, triangles go and come, handles open. After
// each update the mesh is that of a fresh run.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "mesher/mesher.hpp"
#include "mesher/meshing.hpp"

namespace {

using mesher::Graph;
using mesher::Mesher;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;

// An octahedron, each triangle cut into four `depth` times, on a sphere.
Graph<3> sphere(int depth) {
  std::vector<Point<3>> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  using Triangle = std::array<std::size_t, 3>;
  std::vector<Triangle> triangles;
  for (const std::size_t x : {0U, 1U}) {
    for (const std::size_t y : {2U, 3U}) {
      for (const std::size_t z : {4U, 5U}) triangles.push_back({x, y, z});
    }
  }
  const auto middle = [&](std::size_t a, std::size_t b) {
    Point<3> p{};
    double length = 0;
    for (std::size_t i = 0; i < 3; ++i) p[i] = points[a][i] + points[b][i], length += p[i] * p[i];
    for (double& x : p) x /= std::sqrt(length);
    const auto found = std::find(points.begin(), points.end(), p);
    if (found != points.end()) return static_cast<std::size_t>(found - points.begin());
    points.push_back(p);
    return points.size() - 1;
  };
  for (; depth > 0; --depth) {
    std::vector<Triangle> parts;
    for (const auto& [a, b, c] : triangles) {
      const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(parts);
  }
  Graph<3> graph;
  for (std::size_t i = 0; i < points.size(); ++i) {
    graph.points.push_back({PointId(static_cast<std::int64_t>(i + 1)), points[i], 0});
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    mesher::Polygon f{PolygonId(static_cast<std::int64_t>(i + 1)), {}};
    auto& loop = f.loops.emplace_back();
    for (const std::size_t v : triangles[i]) loop.push_back(graph.points[v].id);
    graph.polygons.push_back(std::move(f));
  }
  return graph;
}

class Surface {
 public:
  Surface(std::uint64_t seed, double min_dihedral)
      : random_(seed),
        whole_(sphere(2)),
        mesher_({.domain = {{-2, -2, -2}, {2, 2, 2}}, .min_dihedral = min_dihedral}) {
    mesher_.insert(whole_);
    for (int i = 0; i < 12; ++i) {
      const double at = 0.5 * i;
      disc_.loops[0].push_back(PointId(1000 + i));
      mesher_.insert(disc_.loops[0].back(), {0.5 * std::cos(at), 0.5 * std::sin(at), 0.125});
    }
    mesher_.update();
  }
  [[nodiscard]] Mesher<3>& mesher() noexcept { return mesher_; }

  void edit() {
    switch (random_() % 10) {
      case 7:
        return swap();
      case 8:
        return toggle(disc_);
      case 9:
        return toggle_line();
      case 0:
        return toggle(whole_.polygons[random_() % whole_.polygons.size()]);
      case 1:
        return move(0.08);
      case 2:
        return move(1e-9);
      default:
        return move(0.02);
    }
  }
  /// The segments that there are, and what to take for them after a discarded edit.
  [[nodiscard]] std::vector<mesher::LineId> lines() const { return lines_; }
  void set_lines(std::vector<mesher::LineId> lines) { lines_ = std::move(lines); }
  /// All that is announced afterwards is as it was at first.
  void restore() {
    for (const auto& p : whole_.points) mesher_.move(p.id, p.at);
    for (const auto& f : whole_.polygons) {
      if (!mesher_.contains(f.id)) mesher_.insert_polygon(f);
    }
    if (mesher_.contains(disc_.id)) mesher_.remove_polygon(disc_.id);
    for (const mesher::LineId id : lines_) mesher_.remove_line(id);
  }

 private:
  void move(double by) {
    const auto& p = whole_.points[random_() % whole_.points.size()];
    Point<3> to = p.at;
    for (double& x : to) x += by * (static_cast<double>(random_() % 2001) / 1000 - 1);
    mesher_.move(p.id, to);
  }
  // Two points change places: triangles cross, unless those are neighbours.
  void swap() {
    const auto& p = whole_.points[random_() % whole_.points.size()];
    const auto& q = whole_.points[random_() % whole_.points.size()];
    if (p.id == q.id) return;
    const Point<3> at = mesher_.point(p.id)->at;
    mesher_.move(p.id, mesher_.point(q.id)->at);
    mesher_.move(q.id, at);
  }
  void toggle(const mesher::Polygon& f) {
    if (mesher_.contains(f.id)) {
      mesher_.remove_polygon(f.id);
    } else {
      mesher_.insert_polygon(f);
    }
  }

  // Along a side of a triangle, which may be there, or not.
  void toggle_line() {
    if (!lines_.empty() && random_() % 2 == 0) {
      mesher_.remove_line(lines_.back());
      return lines_.pop_back();
    }
    const auto& loop = whole_.polygons[random_() % whole_.polygons.size()].loops[0];
    const auto id_at = [&](std::size_t k) {
      return mesher::LineId(static_cast<std::int64_t>(loop[k]));
    };
    const auto has = [&](mesher::LineId id) {
      return std::find(lines_.begin(), lines_.end(), id) != lines_.end();
    };
    if (has(id_at(0)) || has(id_at(1))) return;  // by their first ends: it may be there
    lines_.push_back(id_at(0));
    mesher_.insert_segment(lines_.back(), loop[0], loop[1]);
  }

  std::mt19937_64 random_;
  Graph<3> whole_;
  mesher::Polygon disc_{PolygonId(5000), {{}}};  // of more sides, inside
  std::vector<mesher::LineId> lines_;
  Mesher<3> mesher_;
};

// After each of some random edits.
void check_edits(std::uint64_t seed, double min_dihedral) {
  Surface surface(seed, min_dihedral);
  Mesher<3>& m = surface.mesher();
  const auto first = m.mesh();
  for (int update = 0; update < 10; ++update) {
    INFO("seed " << seed << ", update " << update);
    const auto before = m.mesh();
    const auto lines = surface.lines();
    for (int n = 0; n <= update % 3; ++n) surface.edit();
    try {
      m.update();
    } catch (const mesher::Error& e) {
      INFO(e.what());
      m.discard_edits();
      surface.set_lines(lines);
      REQUIRE(m.mesh().vertices == before.vertices);
      REQUIRE(m.mesh().simplices == before.simplices);
      m.check_invariants();
      continue;
    }
    const auto fresh = mesher::mesh(m.input(), m.options());
    REQUIRE(m.mesh().vertices == fresh.mesh.vertices);
    REQUIRE(m.mesh().simplices == fresh.mesh.simplices);
    REQUIRE(m.mesh().features.faces == fresh.mesh.features.faces);
    if (update % 5 == 4) m.check_invariants();
  }
  const auto last = m.mesh();
  surface.restore();
  m.update();
  CHECK(m.mesh().vertices == first.vertices);
  CHECK(last.vertices != first.vertices);
}

}  // namespace

TEST_CASE("after each edit of a surface the mesh is a fresh run's") {
  for (const std::uint64_t seed : {1, 2, 3}) check_edits(seed, 0);
}

TEST_CASE(
    "after each edit of a surface the mesh is a fresh run's, with a bound of dihedral angles") {
  for (const std::uint64_t seed : {4, 5, 6}) check_edits(seed, 10);
}

TEST_CASE("soak: after each edit of a surface the mesh is a fresh run's", "[.soak][soak]") {
  for (std::uint64_t seed = 10; seed < 60; ++seed) check_edits(seed, seed % 4 == 0 ? 10 : 0);
}
