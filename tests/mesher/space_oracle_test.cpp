// After every edit the dynamic mesh in space is what a run from scratch gives, bit for bit.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "space_points.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Change;
using mesher::Error;
using mesher::ErrorCode;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PolygonId;
using mesher::Rule;
using mesher::SplitMix64;
using support::SpaceFamily;

using PointSet = std::map<std::int64_t, Point<3>>;

std::vector<Point<3>> places(const PointSet& points) {
  std::vector<Point<3>> all;
  for (const auto& [id, p] : points) all.push_back(p);
  return all;
}

// A mesh as sets, to which a change is applied.
struct Parts {
  std::set<Point<3>> vertices;
  std::set<std::array<Point<3>, 4>> simplices;
  friend bool operator==(const Parts&, const Parts&) = default;
};

Parts parts_of(const Mesh<3>& mesh) {
  Parts parts{{mesh.vertices.begin(), mesh.vertices.end()}, {}};
  for (const auto& s : mesh.simplices) {
    parts.simplices.insert(
        {mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]], mesh.vertices[s[3]]});
  }
  return parts;
}

template <class T>
void apply(const std::vector<T>& added, const std::vector<T>& removed, std::set<T>& all) {
  for (const T& x : removed) REQUIRE(all.erase(x) == 1);
  for (const T& x : added) REQUIRE(all.insert(x).second);
}

// One random edit of the mesher and of its twin.
class Editor {
 public:
  Editor(SpaceFamily family, std::size_t n, SplitMix64& random)
      : family_(family), n_(n), random_(random) {}

  void edit(BoxMesher<3>& mesher, PointSet& points) {
    const std::uint64_t kind = random_.below(8);
    if (points.empty() || kind < 3) return insert(mesher, points);
    const auto it = std::next(points.begin(), static_cast<long>(random_.below(points.size())));
    if (kind < 6) {
      mesher.remove(AnyId{it->first});
      points.erase(it);
    } else {
      move(mesher, *it, points);
    }
  }

 private:
  Point<3> place(const PointSet& points) {
    if (points.empty() || random_.below(4) != 0) {
      return support::space_point(family_, random_, random_.below(n_), n_);
    }
    // beside another point, at any distance
    Point<3> p = std::next(points.begin(), static_cast<long>(random_.below(points.size())))->second;
    const double step = std::pow(10, -10 * random_.unit());
    for (double& x : p) x = std::clamp(x + step * (random_.unit() - 0.5), 0.0, 1.0);
    return p;
  }
  void insert(BoxMesher<3>& mesher, PointSet& points) {
    const Point<3> p = place(points);
    const std::int64_t id = ++last_;
    if (attempt([&] { mesher.insert(AnyId{id}, p); })) points[id] = p;
  }
  // Where points have moved, update() judges; so places that it would refuse are left out here.
  void move(BoxMesher<3>& mesher, const PointSet::value_type& point, PointSet& points) {
    const std::int64_t id = point.first;
    const Point<3> p = place(points);
    const bool is_free = std::none_of(points.begin(), points.end(), [&](const auto& other) {
      const Point<3>& q = other.second;
      return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < 0x1p-40;
    });
    if (!is_free) return;
    mesher.move(AnyId{id}, p);
    points[id] = p;
  }
  template <class F>
  static bool attempt(F&& f) {
    try {
      f();
      return true;
    } catch (const Error& e) {
      const bool refused =
          e.code() == ErrorCode::duplicate_point || e.code() == ErrorCode::too_close;
      if (!refused) throw;
      return false;
    }
  }

  SpaceFamily family_;
  std::size_t n_;
  SplitMix64& random_;
  std::int64_t last_ = 1000;
};

void check(const BoxMesher<3>& mesher, const Change<3>& change, const PointSet& points,
           const Options<3>& options, Parts& parts) {
  const Mesh<3> mesh = mesher.mesh();
  REQUIRE(mesh == mesher::mesh_statically<3>(places(points), options));
  apply(change.vertices_added, change.vertices_removed, parts.vertices);
  apply(change.simplices_added, change.simplices_removed, parts.simplices);
  REQUIRE(parts == parts_of(mesh));
}

void run(SpaceFamily family, const Options<3>& options, std::size_t n, int edits,
         std::uint64_t seed) {
  INFO(name(family) << ", rho " << options.rho << ", rule " << static_cast<int>(options.rule)
                    << ", " << n << " points, seed " << seed);
  SplitMix64 random(seed);
  BoxMesher<3> mesher(options);
  PointSet points;
  for (const auto& p : support::space_points(family, n, seed)) {
    const auto id = static_cast<std::int64_t>(points.size());
    mesher.insert(AnyId{id}, p);
    points[id] = p;
  }
  Parts parts;
  check(mesher, mesher.update(), points, options, parts);
  mesher.check_invariants();
  Editor editor(family, n, random);
  for (int i = 0; i < edits; ++i) {
    INFO("step " << i);
    const std::uint64_t batch = random.below(4) == 0 ? 1 + random.below(6) : 1;
    for (std::uint64_t k = 0; k < batch; ++k) editor.edit(mesher, points);
    check(mesher, mesher.update(), points, options, parts);
    if (i == edits / 2)
      CHECK(support::space_verdict(mesher.mesh(), places(points), options.rho) == "");
  }
  for (const auto& [id, p] : points) mesher.remove(AnyId{id});
  check(mesher, mesher.update(), {}, options, parts);
  mesher.check_invariants();
}

Options<3> options(Rule rule = Rule::radius_edge, double rho = 2) {
  return {.domain = {{0, 0, 0}, {1.25, 1.25, 1.25}}, .rho = rho, .rule = rule};
}

Options<3> without_slivers(double min_dihedral) {
  Options<3> with = options();
  with.min_dihedral = min_dihedral;
  return with;
}

}  // namespace

TEST_CASE("in space, after every edit mesh and change are those of a run from scratch") {
  for (const SpaceFamily family : support::kSpaceFamilies) run(family, options(), 20, 18, 3);
}

TEST_CASE("in space, the same for other bounds and for the paper's rule") {
  for (const SpaceFamily family : support::kSpaceFamilies) {
    run(family, options(Rule::radius_edge, 1.7), 8, 3, 5);
    run(family, options(Rule::voronoi_aspect, 2), 8, 3, 7);
  }
}

TEST_CASE("in space, the same with a bound of dihedral angles") {
  for (const SpaceFamily family : support::kSpaceFamilies) {
    run(family, without_slivers(10), 20, 12, 11);
    run(family, without_slivers(18), 12, 6, 13);
  }
}

TEST_CASE("in space, what is refused leaves the mesh") {
  BoxMesher<3> mesher(options());
  mesher.insert(AnyId{1}, {0.5, 0.5, 0.5});
  mesher.insert(AnyId{2}, {0.25, 0.5, 0.5});
  mesher.update();
  const Mesh<3> before = mesher.mesh();
  CHECK_THROWS_AS(mesher.insert(AnyId{1}, {0, 0, 0}), Error);
  CHECK_THROWS_AS(mesher.insert(AnyId{3}, {0, 0, 2}), Error);
  CHECK_THROWS_AS(mesher.insert(AnyId{3}, {0.5, 0.5, 0.5}), Error);
  CHECK_THROWS_AS(mesher.insert_segment(LineId{1}, AnyId{1}, AnyId{1}), Error);
  CHECK_THROWS_AS(mesher.remove_polygon(PolygonId{1}), Error);
  CHECK_THROWS_AS(mesher.remove_line(LineId{1}), Error);
  CHECK(mesher.lines().empty());
  mesher.move(AnyId{1}, {0.25, 0.5, 0.5});
  CHECK_THROWS_AS(mesher.update(), Error);
  CHECK(mesher.mesh() == before);
  mesher.move(AnyId{1}, {0.25, 0.5, 0.5});  // both swap
  mesher.move(AnyId{2}, {0.5, 0.5, 0.5});
  mesher.update();
  CHECK(mesher.mesh() == before);
  mesher.check_invariants();
}

TEST_CASE("soak: the same in space over many seeds", "[.soak][soak]") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const SpaceFamily family : support::kSpaceFamilies) {
      run(family, options(), 5 + seed * 11 % 60, 100, seed);
      run(family, options(Rule::voronoi_aspect, 2), 5 + seed * 7 % 30, 30, seed);
      run(family, options(Rule::radius_edge, 1.6), 5 + seed * 5 % 30, 30, seed);
      run(family, without_slivers(8 + static_cast<double>(seed % 10)), 5 + seed * 9 % 50, 50, seed);
    }
  }
}
