// Polygons that cross in one point, as repair() leaves them: lines of intersection that meet at
// whatever angle comes, and edges with vertices on their balls.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "mesher/repair.hpp"
#include "refined_complex.hpp"

namespace {

using mesher::Graph;
using support::By;
using Triangle = std::array<std::array<int, 3>, 3>;  // in quarters

int height(const Triangle& t, const std::array<int, 3>& p) {
  int u[3], v[3], w[3];
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i], w[i] = p[i] - t[0][i];
  }
  return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
         w[2] * (u[0] * v[1] - u[1] * v[0]);
}

// Whether p is strictly inside of t, seen from a place off its plane.
bool is_inside(const Triangle& t, const std::array<int, 3>& p) {
  if (height(t, p) != 0) return false;
  for (const std::array<int, 3>& from : {std::array{7, 11, 13}, {17, 5, 3}, {3, 19, 8}}) {
    if (height(t, from) == 0) continue;
    int left = 0, right = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int side = height({t[i], t[(i + 1) % 3], from}, p);
      left += side > 0 ? 1 : 0, right += side < 0 ? 1 : 0;
    }
    return left == 3 || right == 3;
  }
  return false;
}

// Three triangles around one place.
std::vector<Triangle> random_triangles(std::mt19937_64& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const std::array<int, 3> middle{1 + below(3), 1 + below(3), 1 + below(3)};
  std::vector<Triangle> all;
  while (all.size() < 3) {
    Triangle t;
    for (auto& corner : t) {
      for (int& x : corner) x = below(5);
    }
    if (is_inside(t, middle)) all.push_back(t);
  }
  return all;
}

Graph<3> repaired(const std::vector<Triangle>& triangles, double unit) {
  support::Complex all;
  for (const Triangle& t : triangles) {
    std::vector<std::size_t> loop;
    for (const auto& corner : t) {
      loop.push_back(all.points.size());
      all.points.push_back({unit * corner[0], unit * corner[1], unit * corner[2]});
    }
    all.faces.push_back({{loop}, {}});
  }
  return mesher::repair(support::plc_of(all)).file.graph;
}

// A triangle, and a fan whose apex is on the other side of it, as little as `depth` away.
Graph<3> poked(std::mt19937_64& random, double depth) {
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  support::Complex all;
  all.points = {{0, 0, 0.02 * unit()}, {1, 0.1 * unit(), 0.02 * unit()}, {0.3, 1, 0.02 * unit()}};
  all.faces.push_back({{{0, 1, 2}}, {}});
  const double u = 0.3 + 0.1 * unit(), v = 0.3 + 0.1 * unit();
  mesher::Point<3> apex;
  for (std::size_t i = 0; i < 3; ++i) {
    apex[i] = u * all.points[0][i] + v * all.points[1][i] + (1 - u - v) * all.points[2][i];
  }
  apex[2] -= depth;
  all.points.push_back(apex);
  const std::size_t n = 4 + random() % 3;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle =
        2 * 3.14159265358979 * (static_cast<double>(k) + 0.8 * unit()) / static_cast<double>(n);
    all.points.push_back({apex[0] + 0.2 * std::cos(angle), apex[1] + 0.2 * std::sin(angle),
                          apex[2] + 0.03 * unit() - 0.005});
    all.faces.push_back({{{3, 4 + k, 4 + (k + 1) % n}}, {}});
  }
  return mesher::repair(support::plc_of(all)).file.graph;
}

// Without quality: check excuses fewer of those that small angles leave.
template <By B>
void require_meshed(const Graph<3>& plc) {
  const auto mesh = support::mesh_of<B>(plc, support::options_for(plc));
  CHECK(support::fault(mesh, plc, mesher::Extent::box, std::nullopt) == "");
}

}  // namespace

// There is no proof that refinement ends where edges meet at small angles; of these inputs few are
// refused.
TEMPLATE_TEST_CASE_SIG("three polygons that cross in one point are in the mesh", "", ((By B), B),
                       By::svr, By::refine) {
  std::mt19937_64 random(20);
  int refused = 0;
  for (int i = 0; i < 120; ++i) {
    INFO("input " << i);
    const Graph<3> plc = repaired(random_triangles(random), i % 3 == 0 ? 0x1p-12 : 0.25);
    try {
      require_meshed<B>(plc);
    } catch (const mesher::Error& e) {
      CHECK(e.code() == mesher::ErrorCode::too_close);
      ++refused;
    }
  }
  CHECK(refused <= 1);
}

// Repairs make needles there: their faces are far below the rounding of their polygon's area, and
// near their tips distances are rounded by much more than 2^-40 of them.
TEMPLATE_TEST_CASE_SIG("a vertex that pokes through a polygon by little is in the mesh", "",
                       ((By B), B), By::svr, By::refine, By::gap_balls) {
  for (const double depth : {1e-2, 1e-4, 1e-6}) {
    for (const std::uint64_t seed : {0u, 3u, 7u, 10u, 14u, 17u, 18u}) {
      INFO("depth " << depth << ", seed " << seed);
      std::mt19937_64 random(seed);
      const Graph<3> plc = poked(random, depth);
      const auto mesh = support::mesh_of<B>(plc, support::options_for(plc));
      CHECK(support::fault(mesh, plc, mesher::Extent::box, 2.0) == "");
    }
  }
}

// On the ball of an edge there comes a vertex that is not in it, and ties are decided against it.
TEMPLATE_TEST_CASE_SIG("an edge that a vertex on its ball takes is split", "", ((By B), B), By::svr,
                       By::refine) {
  require_meshed<B>(repaired({{{{2, 2, 1}, {0, 2, 3}, {1, 0, 0}}},
                              {{{3, 3, 2}, {2, 2, 3}, {0, 0, 0}}},
                              {{{3, 1, 1}, {1, 2, 0}, {0, 0, 2}}}},
                             0.25));
  require_meshed<B>(repaired({{{{3, 2, 3}, {1, 2, 4}, {1, 2, 1}}},
                              {{{1, 2, 3}, {4, 4, 4}, {3, 0, 2}}},
                              {{{0, 1, 4}, {4, 1, 4}, {2, 3, 2}}}},
                             0.25));
  require_meshed<B>(repaired({{{{0, 1, 4}, {3, 4, 1}, {2, 3, 0}}},
                              {{{2, 2, 0}, {3, 4, 0}, {1, 4, 4}}},
                              {{{4, 0, 4}, {0, 1, 3}, {2, 4, 0}}}},
                             0.25));
}

// Where it crosses is any place of it, then, and another one when it has become shorter.
TEMPLATE_TEST_CASE_SIG("a Voronoi edge may be in a polygon's plane", "", ((By B), B), By::svr,
                       By::refine) {
  require_meshed<B>(repaired({{{{4, 1, 1}, {2, 4, 4}, {0, 0, 0}}},
                              {{{1, 0, 0}, {1, 0, 3}, {3, 2, 1}}},
                              {{{3, 0, 0}, {0, 0, 3}, {1, 4, 2}}}},
                             0.25));
}
