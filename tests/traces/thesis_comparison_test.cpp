// The thesis's programs (sac/examples/thesis) beside ours, on equal input in an equal box: both
// trees keep the bounds of Theorem 4.1.4 with their constants, both meshes those of Theorem 4.2.5,
// and their numbers of vertices are near each other.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "facade/mesh_statically.hpp"
#include "mesher/delaunay.hpp"
#include "mesher/extra/generate.hpp"
#include "naive_quadtree.hpp"
#include "thesis/mesh.hpp"

namespace {

namespace thesis = examples::thesis;
using mesher::Point;

template <int D>
double distance(const Point<D>& a, const Point<D>& b) {
  double sum = 0;
  for (int i = 0; i < D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}
// The distance from x to the second nearest of the points.
template <int D>
double second_nearest(const std::vector<Point<D>>& points, const Point<D>& x) {
  double nearest = HUGE_VAL, second = HUGE_VAL;
  for (const auto& p : points) {
    const double apart = distance<D>(p, x);
    second = std::min(second, std::max(nearest, apart));
    nearest = std::min(nearest, apart);
  }
  return second;
}

// --- Meshes

template <int D>
double circumradius(const std::array<Point<D>, D + 1>& corner) {
  std::array<std::array<double, D + 1>, D> a{};  // 2 (p_i - p_0) . x = |p_i - p_0|^2
  for (std::size_t i = 0; i < D; ++i) {
    for (std::size_t j = 0; j < D; ++j) {
      a[i][j] = 2 * (corner[i + 1][j] - corner[0][j]);
      a[i][D] += a[i][j] * a[i][j] / 4;
    }
  }
  for (std::size_t c = 0; c < D; ++c) {
    std::swap(a[c], *std::max_element(a.begin() + static_cast<std::ptrdiff_t>(c), a.end(),
                                      [&](const auto& x, const auto& y) {
                                        return std::abs(x[c]) < std::abs(y[c]);
                                      }));
    for (std::size_t r = 0; r < D; ++r) {
      const double part = a[r][c] / a[c][c];
      for (std::size_t j = c; r != c && j <= D; ++j) a[r][j] -= part * a[c][j];
    }
  }
  double r2 = 0;
  for (std::size_t c = 0; c < D; ++c) r2 += a[c][D] / a[c][c] * (a[c][D] / a[c][c]);
  return std::sqrt(r2);
}

// Of the Delaunay triangulation of these vertices.
struct Quality {
  double radius_edge = 0;      // the greatest circumradius over shortest edge of a simplex
  double aspect = 0;           // the greatest circumradius over NN of a corner
  std::size_t incomplete = 0;  // vertices above rho in that
};
template <int D>
Quality quality_of(const std::vector<Point<D>>& vertices, double rho) {
  Quality q;
  std::vector<double> nearest(vertices.size(), HUGE_VAL), farthest(vertices.size(), 0);
  for (const auto& simplex : mesher::delaunay<D>(vertices).simplices) {
    std::array<Point<D>, D + 1> corner;
    for (std::size_t i = 0; i <= D; ++i) corner[i] = vertices[simplex[i]];
    const double radius = circumradius<D>(corner);
    for (std::size_t i = 0; i <= D; ++i) {
      farthest[simplex[i]] = std::max(farthest[simplex[i]], radius);
      for (std::size_t j = 0; j <= D; ++j) {
        if (i == j) continue;
        const double edge = distance<D>(corner[i], corner[j]);
        nearest[simplex[i]] = std::min(nearest[simplex[i]], edge);
        q.radius_edge = std::max(q.radius_edge, radius / edge);
      }
    }
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double aspect = farthest[v] / nearest[v];
    q.aspect = std::max(q.aspect, aspect);
    if (aspect > rho * (1 + 1e-9)) ++q.incomplete;
  }
  return q;
}

// Both meshes of the same points, moved so that the box begins at the origin.
template <int D>
struct Meshes {
  std::vector<Point<D>> input;  // with the box's vertices
  std::vector<Point<D>> ours, theirs;
  double L = 0;

  Meshes(std::vector<Point<D>> points, double rho) {
    for (auto& p : points) {  // so that moving them is exact
      for (double& x : p) x = std::round(x * 0x1p40) * 0x1p-40;
    }
    mesher::Options<D> options;
    options.domain = mesher::snapped_domain<D>(points);
    options.rho = rho;
    options.rule = mesher::Rule::voronoi_aspect;
    const mesher::Mesh<D> mesh = mesher::mesh_statically<D>(points, options);
    const Point<D> lo = mesh.vertices.front();  // a corner of the box
    L = mesh.vertices.back()[0] - lo[0];
    const auto moved = [&](Point<D> p) {
      for (int i = 0; i < D; ++i) p[i] -= lo[i];
      return p;
    };
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      ours.push_back(moved(mesh.vertices[i]));
      if (mesh.kinds[i] == mesher::VertexKind::boundary) input.push_back(ours.back());
    }
    for (const auto& p : points) input.push_back(moved(p));
    run_theirs(rho);
  }

 private:
  void run_theirs(double rho) {
    sac::PlainScope scope;
    thesis::PointMesh<sac::PlainScope, D> mesh(scope, {.L = L, .rho = rho, .gamma = 2 * rho});
    for (const auto& p : input) {
      thesis::Point<D> q;
      for (std::size_t i = 0; i < D; ++i) q.x[i] = p[i];
      mesh.insert(q);
    }
    mesh.run();
    for (const auto& v : mesh.vertices()) {
      Point<D>& p = theirs.emplace_back();
      for (std::size_t i = 0; i < D; ++i) p[i] = v[i];
    }
  }
};

using mesher::PointKind;
constexpr PointKind kKinds[] = {PointKind::uniform, PointKind::clusters, PointKind::grid,
                                PointKind::line_circle};

template <int D>
void compare(PointKind kind, std::size_t n, double rho) {
  const Meshes<D> m(mesher::generate_points<D>(kind, n, 3), rho);
  const Quality theirs = quality_of<D>(m.theirs, rho), ours = quality_of<D>(m.ours, rho);
  INFO("kind " << static_cast<int>(kind) << ", D " << D << ", rho " << rho << ": "
               << m.theirs.size() << " vertices, " << theirs.incomplete << " incomplete, up to "
               << theirs.aspect << "; ours " << m.ours.size() << ", " << ours.incomplete
               << ", up to " << ours.aspect);
  CHECK(theirs.radius_edge <= rho * (1 + 1e-9));
  CHECK(ours.radius_edge <= rho * (1 + 1e-9));
  CHECK(theirs.aspect <= 2 * rho);  // rho but for vertices whose neighbours came too late
  CHECK(ours.aspect <= 2 * rho);
  CHECK(100 * theirs.incomplete <= m.theirs.size());
  CHECK(100 * ours.incomplete <= m.ours.size());
  CHECK(static_cast<double>(m.theirs.size()) <= 1.25 * static_cast<double>(m.ours.size()));
  CHECK(static_cast<double>(m.ours.size()) <= 1.25 * static_cast<double>(m.theirs.size()));

  const double high = 2 * (1 + (rho + 1) / (rho - 1) + rho);
  mesher::SplitMix64 random(9);
  for (int i = 0; i < 300; ++i) {
    Point<D> x = m.input[random.below(m.input.size())];
    const double reach = std::ldexp(m.L, -static_cast<int>(random.below(16)));
    for (double& xi : x) xi = std::clamp(xi + reach * (random.unit() - 0.5), 0.0, m.L);
    const double lfs = second_nearest<D>(m.input, x);
    for (const auto* vertices : {&m.theirs, &m.ours}) {
      const double lms = second_nearest<D>(*vertices, x);
      REQUIRE(lms <= lfs);
      REQUIRE(lfs <= high * lms);
    }
  }
}

}  // namespace

TEST_CASE("thesis: meshes are ours within a quarter of their vertices, and as good, in the plane",
          "[Theorem 4.2.5, Theorem 4.3.4]") {
  for (const auto kind : kKinds) {
    compare<2>(kind, 400, 2);
    compare<2>(kind, 400, 1.4142);
  }
}

TEST_CASE("thesis: meshes are ours within a quarter of their vertices, and as good, in space",
          "[Theorem 4.2.5, Theorem 4.3.4]") {
  for (const auto kind : {PointKind::uniform, PointKind::clusters}) compare<3>(kind, 60, 2);
}

// --- Trees

namespace {

constexpr int kLevels = mesher::detail::kLevels;

support::Fixed fixed(const Point<2>& p) {
  return {static_cast<std::uint64_t>(std::ldexp(p[0], kLevels)),
          static_cast<std::uint64_t>(std::ldexp(p[1], kLevels))};
}
// The side of the leaf that holds p. is_split(level): whether the cell of that level is.
template <class IsSplit>
double leaf_side(IsSplit&& is_split) {
  int level = 0;
  while (is_split(level)) ++level;
  return std::ldexp(1, -level);
}

}  // namespace

// Our tree is kCoarser = 4 levels coarser; its bounds are those of the paper map, (a) and (c).
TEST_CASE("thesis: leaves of its tree and of ours have the sides that local feature sizes allow",
          "[Theorem 4.1.4]") {
  for (const auto kind : {PointKind::uniform, PointKind::clusters}) {
    auto points = mesher::generate_points<2>(kind, 300, 7);
    sac::PlainScope scope;
    thesis::PointMesh<sac::PlainScope, 2> theirs(scope, {});
    std::vector<support::Fixed> places;
    for (auto& p : points) {
      p = {std::clamp(p[0], 0.0, 0x1.fp-1), std::clamp(p[1], 0.0, 0x1.fp-1)};
      theirs.insert({{p[0], p[1]}});
      places.push_back(fixed(p));
    }
    theirs.run(true);
    const auto cells = theirs.split_cells();
    const std::set<thesis::Cell<2>> split(cells.begin(), cells.end());
    const support::NaiveQuadtree ours(places);
    CAPTURE(static_cast<int>(kind), split.size(), ours.split().size());
    double least = HUGE_VAL, most = 0;
    const auto check = [&](const Point<2>& x, bool is_input) {
      const double lfs = second_nearest<2>(points, x);
      const double side = leaf_side([&](int level) {
        return split.contains(thesis::cell_at(thesis::Point<2>{{x[0], x[1]}}, level, 1));
      });
      const double our_side = leaf_side([&](int level) {
        return ours.split().contains(mesher::detail::MeshBox<2>::cell(fixed(x), level));
      });
      REQUIRE(lfs >= side / (is_input ? 2 : 4));
      REQUIRE(lfs <= 6 * std::sqrt(2) * side);
      REQUIRE(lfs >= our_side / (is_input ? 16 : 64));
      if (our_side < 1) REQUIRE(lfs <= 4 * std::sqrt(2) * our_side);
      least = std::min(least, our_side / side), most = std::max(most, our_side / side);
    };
    for (const auto& p : points) check(p, true);
    mesher::SplitMix64 random(4);
    for (int i = 0; i < 2000; ++i) check({random.unit(), random.unit()}, false);
    CAPTURE(least, most);
    CHECK(least >= 1);
    CHECK(most <= 64);
  }
}
