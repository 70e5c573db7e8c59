// The meshing box: where it may lie, and the grid on its sides, which no vertex encroaches.
#include "rules/mesh_box.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "facade/graph_runs.hpp"
#include "mesher/check.hpp"
#include "mesher/error.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::ErrorCode;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::Rule;
using mesher::SplitMix64;
using mesher::VertexKind;
using mesher::detail::Cell;
using mesher::detail::Fixed;
using mesher::detail::kLevels;
using mesher::detail::mesh_box;
using mesher::detail::MeshBox;

constexpr Rule kRules[] = {Rule::radius_edge, Rule::voronoi_aspect};
constexpr double kBounds[] = {1.05, 1.1, 1.3, 1.4142, 2.0, 4.0, 100.0};

std::string text(const Options<2>& o) {
  return "rule " + std::to_string(static_cast<int>(o.rule)) + ", rho " + std::to_string(o.rho);
}

template <int D>
std::vector<Point<D>> boundary(const MeshBox<D>& box) {
  std::vector<Point<D>> all;
  box.for_each_boundary_point([&](const Point<D>& p) { all.push_back(p); });
  return all;
}

// Points that come as near to the sides of the box as they may, in ever denser clusters, or not.
std::vector<Point<2>> near_the_sides(SplitMix64& random, std::size_t n) {
  std::vector<Point<2>> points;
  while (points.size() < n) {
    Point<2> p{random.unit(), random.unit()};
    const double near = std::ldexp(1.0, -static_cast<int>(random.below(6)));
    p[random.below(2)] *= near;
    if (random.below(2) == 0) p = {1 - p[0], 1 - p[1]};
    points.push_back(p);
  }
  return points;
}

// Calls visit(from, to) for each edge of the hull.
template <class Visit>
void for_each_hull_edge(const Mesh<2>& mesh, Visit&& visit) {
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& [a, b, c] : mesh.simplices) edges.insert({{a, b}, {b, c}, {c, a}});
  for (const auto& e : edges) {
    if (!edges.contains({e[1], e[0]})) visit(mesh.vertices[e[0]], mesh.vertices[e[1]]);
  }
}

ErrorCode refusal(const Options<2>& options) {
  try {
    (void)mesh_box(options);
  } catch (const mesher::Error& error) {
    return error.code();
  }
  return ErrorCode::cancelled;  // never of a box
}

}  // namespace

TEST_CASE("the domain lies in the box, and the grid on its sides is exact and evenly spaced") {
  SplitMix64 random(31);
  INFO("seed 31");
  for (int round = 0; round < 300; ++round) {
    Options<2> o;
    o.rho = kBounds[random.below(std::size(kBounds))];
    o.rule = kRules[random.below(2)];
    const double size = std::ldexp(1 + random.unit(), static_cast<int>(random.below(100)) - 50);
    for (int i = 0; i < 2; ++i) {
      o.domain.lo[i] = std::ldexp(random.unit() - 0.5, static_cast<int>(random.below(30))) * size;
      o.domain.hi[i] = o.domain.lo[i] + size * random.unit();
    }
    const MeshBox<2> box = mesh_box(o);
    CHECK(box.contains(o.domain.lo));
    CHECK(box.contains(o.domain.hi));
    std::array<std::set<double>, 2> places;
    for (const Point<2>& p : boundary(box)) {
      CHECK((p[0] == box.lo[0] || p[0] == box.hi(0) || p[1] == box.lo[1] || p[1] == box.hi(1)));
      for (int i = 0; i < 2; ++i) places[static_cast<std::size_t>(i)].insert(p[i]);
    }
    CHECK(boundary(box).size() == 4 * static_cast<std::size_t>(box.boundary_steps));
    for (const auto& line : places) {
      REQUIRE(line.size() == static_cast<std::size_t>(box.boundary_steps) + 1);
      for (auto p = line.begin(), q = std::next(p); q != line.end(); ++p, ++q) {
        CHECK(*q - *p <= box.longest_boundary_step());
        CHECK(*q - *p >= box.shortest_boundary_step());
      }
    }
  }
}

TEST_CASE("the boundary has few vertices: what the lemma asks for [L 4.4.1]") {
  const auto steps = [](double rho, Rule rule) {
    return mesh_box(Options<2>{.domain = {{0, 0}, {1, 1}}, .rho = rho, .rule = rule})
        .boundary_steps;
  };
  CHECK(steps(1.4142, Rule::radius_edge) == 8);
  CHECK(steps(2, Rule::radius_edge) == 6);
  CHECK(steps(1.4142, Rule::voronoi_aspect) == 13);
  CHECK(steps(1.28, Rule::voronoi_aspect) > 16);
  CHECK(steps(1.05, Rule::radius_edge) < 48);
  const MeshBox<3> cube = mesh_box(Options<3>{.domain = {{0, 0, 0}, {1, 1, 1}}, .rho = 2});
  const auto n = static_cast<std::size_t>(cube.boundary_steps) + 1;
  CHECK(boundary(cube).size() == n * n * n - (n - 2) * (n - 2) * (n - 2));
}

TEST_CASE("three points in a square make a small mesh") {
  const auto vertices = [](double rho, Rule rule) {
    const Options<2> o{.domain = {{0, 0}, {1, 1}}, .rho = rho, .rule = rule};
    return mesher::mesh_statically<2>({{0.3, 0.4}, {0.6, 0.45}, {0.5, 0.7}}, o).vertices.size();
  };
  CHECK(vertices(1.4142, Rule::radius_edge) <= 48);
  CHECK(vertices(2, Rule::radius_edge) <= 32);
  CHECK(vertices(1.1, Rule::radius_edge) <= 200);
  CHECK(vertices(1.05, Rule::radius_edge) <= 400);
  CHECK(vertices(1.4142, Rule::voronoi_aspect) <= 90);
}

TEST_CASE("no vertex encroaches the boundary, and every triangle is good [L 4.4.1]") {
  SplitMix64 random(37);
  INFO("seed 37");
  for (const Rule rule : kRules) {
    for (const double rho : kBounds) {
      for (const std::size_t n : {1, 3, 40}) {
        const Options<2> o{.domain = {{0, 0}, {1, 1}}, .rho = rho, .rule = rule};
        INFO(text(o) << ", n " << n);
        const Mesh<2> mesh = mesher::mesh_statically<2>(near_the_sides(random, n), o);
        for_each_hull_edge(mesh, [&](const Point<2>& p, const Point<2>& q) {
          const Point<2> middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2};
          const double radius = std::hypot(q[0] - p[0], q[1] - p[1]) / 2;
          for (const Point<2>& v : mesh.vertices) {
            const double d = std::hypot(v[0] - middle[0], v[1] - middle[1]);
            if (d < radius * (1 + 1e-9) && v != p && v != q) FAIL_CHECK("encroached");
          }
        });
        CHECK(mesher::quality(mesh).max_radius_edge <= rho * (1 + 1e-9));
      }
    }
  }
}

TEST_CASE("triangles with all corners on the boundary are as good as the others") {
  for (const Rule rule : kRules) {
    for (const double rho : kBounds) {
      const Options<2> o{.domain = {{0, 0}, {1, 1}}, .rho = rho, .rule = rule};
      for (const auto& points : {std::vector<Point<2>>{}, std::vector<Point<2>>{{0.25, 0.625}}}) {
        INFO(text(o) << ", points " << points.size());
        const Mesh<2> mesh = mesher::mesh_statically<2>(points, o);
        mesher::CheckOptions<2> asked;
        asked.rho = rho;
        for (const auto& finding : mesher::check_mesh(mesh, asked)) {
          INFO(finding.property << ": " << finding.detail);
          CHECK(finding.holds);
        }
      }
    }
  }
}

TEST_CASE("a rule that is not there is refused") {
  CHECK(refusal({.domain = {{0, 0}, {1, 1}}, .rule = static_cast<Rule>(7)}) ==
        ErrorCode::bad_option);
}

TEST_CASE("a domain whose box is beyond the predicates' range is refused, one within is meshed") {
  const auto around = [](double x) { return Options<2>{.domain = {{-x, -x}, {x, x}}}; };
  CHECK(refusal(around(1.2e30)) == ErrorCode::bad_option);
  CHECK(refusal(around(0x1.8p99)) == ErrorCode::bad_option);
  CHECK(refusal({.domain = {{0, 0}, {0x1p100, 1}}}) == ErrorCode::bad_option);
  CHECK(refusal({.domain = {{0x1p100, 0}, {0x1p100, 1}}}) == ErrorCode::bad_option);
  SplitMix64 random(41);
  for (const double x : {0x1p98, 0x1p-101}) {
    mesher::GraphFile<2> input;
    for (int i = 0; i < 30; ++i) {
      const Point<2> p{x * (2 * random.unit() - 1), x * (2 * random.unit() - 1)};
      if (std::abs(p[0]) < 0x1p-100 || std::abs(p[1]) < 0x1p-100) continue;
      input.graph.points.push_back({mesher::PointId{i}, p});
    }
    const Mesh<2> mesh = mesher::mesh_statically<2>(places_of(input.graph), around(x));
    mesher::CheckOptions<2> asked;
    asked.graph = &input;
    asked.rho = 1.4142;
    for (const auto& finding : mesher::check_mesh(mesh, asked)) {
      INFO("domain " << x << ", " << finding.property << ": " << finding.detail);
      CHECK(finding.holds);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("the parents around a cell hold its neighbours of its own size",
                       "[template]", ((int D), D), 2, 3) {
  SplitMix64 random(43);
  INFO("seed 43");
  for (int round = 0; round < 2000; ++round) {
    const int level = 1 + static_cast<int>(random.below(round % 2 == 0 ? 3 : kLevels));
    const std::uint64_t size = std::uint64_t{1} << (kLevels - level);
    Fixed<D> f;
    for (auto& x : f) x = random.below(std::uint64_t{1} << kLevels);
    const Cell<D> c = MeshBox<D>::cell(f, level);
    std::set<Cell<D>> expected;
    int neighbours = 1;
    for (int i = 0; i < D; ++i) neighbours *= 3;
    for (int n = 0; n < neighbours; ++n) {
      Fixed<D> g = c.corner;
      for (int i = 0, rest = n; i < D; ++i, rest /= 3) g[i] += (rest % 3 - 1) * size;
      const bool inside =
          std::all_of(g.begin(), g.end(), [](auto x) { return x < std::uint64_t{1} << kLevels; });
      if (inside) expected.insert(MeshBox<D>::cell(g, level - 1));
    }
    std::vector<Cell<D>> found;
    MeshBox<D>::for_each_parent_around(c, [&](const Cell<D>& p) { found.push_back(p); });
    CHECK(found.front() == MeshBox<D>::cell(c.corner, level - 1));
    CHECK(std::set<Cell<D>>(found.begin(), found.end()) == expected);
    CHECK(found.size() == expected.size());
  }
}

TEMPLATE_TEST_CASE_SIG("Morton order interleaves the first bits of the coordinates", "[template]",
                       ((int D), D), 2, 3) {
  constexpr int kBits = 64 / D;
  SplitMix64 random(47);
  for (int round = 0; round < 1000; ++round) {
    Fixed<D> f;
    for (auto& x : f) x = random.below(std::uint64_t{1} << kLevels);
    std::uint64_t expected = 0;
    for (int bit = 0; bit < kBits; ++bit) {
      for (int i = 0; i < D; ++i) {
        expected |= (f[i] >> (kLevels - kBits + bit) & 1) << (D * bit + i);
      }
    }
    CHECK(mesher::detail::morton<D>(f) == expected);
  }
}
