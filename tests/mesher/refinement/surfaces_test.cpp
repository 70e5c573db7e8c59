// Triangulated surfaces: most edges and faces are in the Delaunay triangulation of the corners, so
// few vertices are needed beside these.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/predicates.hpp"
#include "refined_complex.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using support::By;
using support::Complex;

// A ball by degrees of latitude and longitude, times scale(i, j). Its quadrilaterals are flat if
// that is 1, and have their corners on circles.
template <class Scale>
Complex ball(std::size_t rings, std::size_t sides, Scale&& scale) {
  Complex all;
  const double pi = std::acos(-1.0);
  const auto add = [&](std::size_t i, std::size_t j) {
    const double theta = pi * static_cast<double>(i) / static_cast<double>(rings),
                 phi = 2 * pi * static_cast<double>(j) / static_cast<double>(sides);
    const double r = scale(i, j);
    all.points.push_back({r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi),
                          r * std::cos(theta)});
  };
  add(0, 0);
  for (std::size_t i = 1; i < rings; ++i) {
    for (std::size_t j = 0; j < sides; ++j) add(i, j);
  }
  add(rings, 0);
  const auto at = [&](std::size_t i, std::size_t j) {
    if (i == 0) return std::size_t{0};
    return i == rings ? all.points.size() - 1 : 1 + (i - 1) * sides + j % sides;
  };
  const auto face = [&](std::vector<std::size_t> loop) {
    all.faces.push_back({{std::move(loop)}, {}});
  };
  for (std::size_t i = 0; i < rings; ++i) {
    for (std::size_t j = 0; j < sides; ++j) {
      if (i > 0) face({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < rings) face({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  }
  return all;
}

// The sides of a cube, n x n squares each, cut by diagonals.
Graph<3> grid_cube(int n) {
  Complex all;
  std::map<std::array<int, 3>, std::size_t> known;
  const auto at = [&](const std::array<int, 3>& p) {
    const auto [it, is_new] = known.try_emplace(p, all.points.size());
    if (is_new) {
      all.points.push_back(
          {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    }
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int u, int v) {
            std::array<int, 3> p{};
            p[axis] = side, p[(axis + 1) % 3] = i + u, p[(axis + 2) % 3] = j + v;
            return at(p);
          };
          all.faces.push_back({{{corner(0, 0), corner(1, 0), corner(1, 1)}}, {}});
          all.faces.push_back({{{corner(0, 0), corner(1, 1), corner(0, 1)}}, {}});
        }
      }
    }
  }
  return support::plc_of(all);
}

std::size_t inside(const Mesh<3>& mesh, const Graph<3>& plc) {
  return domain_mesh(mesh, plc, Extent::enclosed).mesh.vertices.size();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a surface of triangles gets few vertices", "", ((By B), B), By::svr,
                       By::refine, By::gap_balls) {
  std::mt19937_64 random(7);
  for (const double rough : {0.02, 0.3}) {
    const Graph<3> plc = support::plc_of(ball(14, 20, [&](std::size_t, std::size_t) {
      return 1 + rough * static_cast<double>(random() % 1024) / 1024;
    }));
    for (const double rho : {2.0, 100.0}) {
      INFO("rough " << rough << ", rho " << rho);
      Options<3> options = support::options_for(plc);
      options.rho = rho;
      const Mesh<3> mesh = support::mesh_of<B>(plc, options, Extent::enclosed);
      CHECK(support::fault(mesh, plc, Extent::enclosed, rho) == "");
      // With balls that must be empty there were 5 to 8 times as many as corners.
      const double most = (rho == 2.0 ? 3.6 : 2.0) * static_cast<double>(plc.points.size());
      CHECK(static_cast<double>(inside(mesh, plc)) < most);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("a cube of squares cut by diagonals", "", ((By B), B), By::svr, By::refine,
                       By::gap_balls) {
  const Graph<3> cut = grid_cube(6);
  const Graph<3> merged = mesher::with_merged_polygons(cut);
  REQUIRE(merged.polygons.size() == 6);
  for (const Graph<3>* plc : {&cut, &merged}) {
    const Mesh<3> mesh = support::mesh_of<B>(*plc, support::options_for(*plc), Extent::enclosed);
    CHECK(support::fault(mesh, *plc, Extent::enclosed) == "");
    if (plc == &merged) CHECK(inside(mesh, *plc) < 1.2 * static_cast<double>(cut.points.size()));
  }
}

// Four corners of a quadrilateral are on a circle but for rounding, so there are tetrahedra on it.
TEMPLATE_TEST_CASE_SIG("what is flat on a polygon is outside", "", ((By B), B), By::svr,
                       By::refine) {
  const Complex round = ball(8, 11, [](std::size_t, std::size_t) { return 1.0; });
  const Graph<3> plc = mesher::with_merged_polygons(support::plc_of(round));
  REQUIRE(plc.polygons.size() < round.faces.size());
  const Mesh<3> mesh = support::mesh_of<B>(plc, support::options_for(plc), Extent::enclosed);
  CHECK(support::fault(mesh, plc, Extent::enclosed) == "");
  const auto is_flat = [](const auto& of, const Mesh<3>::Simplex& s) {
    std::array<Point<3>, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = of.vertices[s[i]];
    double det = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      det += (p[1][i] - p[0][i]) * ((p[2][j] - p[0][j]) * (p[3][k] - p[0][k]) -
                                    (p[2][k] - p[0][k]) * (p[3][j] - p[0][j]));
    }
    return std::abs(det) < 1e-12;
  };
  const auto flat = [&](const auto& of) {
    return std::count_if(of.simplices.begin(), of.simplices.end(),
                         [&](const auto& s) { return is_flat(of, s); });
  };
  CHECK(flat(mesh) > 0);
  CHECK(flat(domain_mesh(mesh, plc, Extent::enclosed).mesh) == 0);
}

// Where the mesh ends at flat tetrahedra, their far faces are the polygon's; in a mirror these are
// on the other side of it.
TEMPLATE_TEST_CASE_SIG("a mesh without names is accepted, on whatever side flat tetrahedra are", "",
                       ((By B), B), By::svr, By::refine, By::gap_balls) {
  for (const double mirror : {1.0, -1.0}) {
    Complex round = ball(8, 11, [](std::size_t, std::size_t) { return 1.0; });
    for (Point<3>& p : round.points) p[0] *= mirror;
    const Graph<3> plc = mesher::with_merged_polygons(support::plc_of(round));
    const Mesh<3> all = support::mesh_of<B>(plc, support::options_for(plc), Extent::enclosed);
    mesher::GraphFile<3> file;
    file.graph = plc;
    mesher::CheckOptions<3> options;
    options.graph = &file;
    options.boundary = mesher::BoundaryRule::lines;
    for (const auto& f : check_mesh(domain_mesh(all, plc, Extent::enclosed).mesh, options)) {
      CHECK((f.holds ? "" : f.property + ": " + f.detail) == "");
    }
  }
}

TEMPLATE_TEST_CASE_SIG("a mesh of a surface depends on no order", "", ((By B), B), By::svr,
                       By::refine, By::gap_balls) {
  std::mt19937_64 random(11);
  const Graph<3> plc = support::plc_of(ball(7, 9, [&](std::size_t, std::size_t) {
    return 1 + 0.4 * static_cast<double>(random() % 1024) / 1024;
  }));
  const Mesh<3> mesh = support::mesh_of<B>(plc, support::options_for(plc), Extent::enclosed);
  Graph<3> other = plc;
  std::shuffle(other.points.begin(), other.points.end(), random);
  std::shuffle(other.polygons.begin(), other.polygons.end(), random);
  for (mesher::Polygon& f : other.polygons) {
    std::rotate(f.loops[0].begin(), f.loops[0].begin() + 1, f.loops[0].end());
  }
  const Mesh<3> again = support::mesh_of<B>(other, support::options_for(plc), Extent::enclosed);
  CHECK(again.vertices == mesh.vertices);
  CHECK(again.simplices == mesh.simplices);
}
