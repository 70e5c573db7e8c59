// Small dihedral angles: few are left, at a bounded number of vertices, and what is left is
// counted.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "mesher/mesher.hpp"
#include "refined_complex.hpp"

namespace {

using mesher::Extent;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using support::By;

// In degrees, by the angles between the faces at each edge: the rule works with squared cosines of
// normals.
double least_dihedral(const Mesh<3>& mesh, const Mesh<3>::Simplex& s) {
  const auto minus = [](const Point<3>& p, const Point<3>& q) {
    return Point<3>{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  };
  const auto dot = [](const Point<3>& p, const Point<3>& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  double least = 180;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      std::vector<Point<3>> across;  // from the edge to the other corners, at right angles to it
      const Point<3> along = minus(mesh.vertices[s[k]], mesh.vertices[s[i]]);
      for (std::size_t m = 0; m < 4; ++m) {
        if (m == i || m == k) continue;
        const Point<3> to = minus(mesh.vertices[s[m]], mesh.vertices[s[i]]);
        const double share = dot(to, along) / dot(along, along);
        across.push_back(minus(to, {share * along[0], share * along[1], share * along[2]}));
      }
      const double cosine = dot(across[0], across[1]) /
                            std::sqrt(dot(across[0], across[0]) * dot(across[1], across[1]));
      least = std::min(least, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::acos(-1.0));
    }
  }
  return least;
}

std::size_t count_below(const Mesh<3>& mesh, double bound) {
  return static_cast<std::size_t>(
      std::count_if(mesh.simplices.begin(), mesh.simplices.end(), [&](const Mesh<3>::Simplex& s) {
        const bool is_of_box = std::all_of(s.begin(), s.end(), [&](std::uint32_t v) {
          return mesh.kinds[v] == mesher::VertexKind::boundary;
        });
        return !is_of_box && least_dihedral(mesh, s) < bound * (1 - 1e-9);
      }));
}

template <By B>
Mesh<3> mesh_points(const std::vector<Point<3>>& points, const Options<3>& options,
                    mesher::SvrStats& stats) {
  if constexpr (B == By::svr) return mesher::svr<3>(points, options, {}, {}, &stats);
  return mesher::refine<3>(points, options, {}, {}, &stats);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("few small dihedral angles of points are left, and these are counted", "",
                       ((By B), B), By::svr, By::refine) {
  using mesher::PointKind;
  std::size_t all_left = 0;
  for (const PointKind kind : {PointKind::uniform, PointKind::gaussian, PointKind::clusters,
                               PointKind::grid, PointKind::line_circle, PointKind::sphere}) {
    const auto points = mesher::generate_points<3>(kind, 2000, 5);
    Options<3> options{.domain = mesher::snapped_domain<3>(points)};
    mesher::SvrStats stats;
    const Mesh<3> before = mesh_points<B>(points, options, stats);
    for (const double bound : {10.0, 15.0}) {
      INFO("kind " << static_cast<int>(kind) << ", " << bound << " degrees");
      options.min_dihedral = bound;
      const Mesh<3> mesh = mesh_points<B>(points, options, stats);
      mesher::GraphFile<3> file;
      file.graph = support::plc_of({.points = points, .segments = {}, .faces = {}});
      mesher::CheckOptions<3> check;
      check.graph = &file;
      check.rho = 2;
      for (const auto& f : check_mesh(mesh, check)) {
        CHECK((f.holds ? "" : f.property + ": " + f.detail) == "");
      }
      CHECK(count_below(mesh, bound) == stats.slivers_left);
      CHECK(stats.slivers_split > 0);
      all_left += stats.slivers_left;
      // Of a line and a circle most vertices are in long thin parts; else it is up to 1.3.
      const double most = kind == PointKind::line_circle ? 1.8 : bound == 10 ? 1.25 : 1.45;
      CHECK(static_cast<double>(mesh.vertices.size()) <
            most * static_cast<double>(before.vertices.size()));
    }
  }
  CHECK(all_left < 12);
}

TEMPLATE_TEST_CASE_SIG("complexes conform as before, and have fewer small dihedral angles", "",
                       ((By B), B), By::svr, By::refine) {
  std::size_t before = 0, after = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    support::RandomComplex random(seed);
    for (int kind = 2; kind < support::RandomComplex::kKinds; ++kind) {
      const Graph<3> plc = support::plc_of(random.part({0, 0, 0}, kind));
      for (const Extent extent : {Extent::enclosed, Extent::box}) {
        INFO("seed " << seed << ", kind " << kind << ", " << (extent == Extent::box ? "box" : ""));
        Options<3> options = support::options_for(plc);
        const Mesh<3> plain = support::mesh_of<B>(plc, options, extent);
        options.min_dihedral = 12;
        const Mesh<3> mesh = support::mesh_of<B>(plc, options, extent);
        CHECK(support::fault(mesh, plc, extent) == "");
        before += count_below(domain_mesh(plain, plc, extent).mesh, 12);
        after += count_below(domain_mesh(mesh, plc, extent).mesh, 12);
      }
    }
  }
  // Half of these have small angles, where vertices that follow have small angles of their own.
  REQUIRE(before > 100);
  CHECK(after < (B == By::svr ? before / 2 : before));
}

TEMPLATE_TEST_CASE_SIG("where features meet at small angles, splitting slivers ends", "",
                       ((By B), B), By::svr, By::refine) {
  using mesher::PlcKind;
  for (const PlcKind kind : {PlcKind::wedge, PlcKind::pages, PlcKind::spike, PlcKind::vee,
                             PlcKind::leaning, PlcKind::tetrahedron, PlcKind::shells}) {
    for (const double bound : {10.0, 20.0}) {
      INFO("kind " << static_cast<int>(kind) << ", " << bound << " degrees");
      const Graph<3> plc = mesher::generate_plc({kind});
      Options<3> options = support::options_for(plc);
      const std::size_t before = support::mesh_of<B>(plc, options).vertices.size();
      options.min_dihedral = bound;
      const Mesh<3> mesh = support::mesh_of<B>(plc, options);
      CHECK(support::fault(mesh, plc, Extent::box, std::nullopt) == "");
      CHECK(mesh.vertices.size() < 5 * before);
    }
  }
}

TEST_CASE("a bound of dihedral angles that cannot be kept is refused") {
  const Graph<3> plc = mesher::generate_plc({mesher::PlcKind::cube});
  Options<3> options;
  const auto refused = [&] {
    try {
      static_cast<void>(mesh(plc, options));
    } catch (const mesher::Error& error) {
      return error.code() == mesher::ErrorCode::bad_option;
    }
    return false;
  };
  options.min_dihedral = 12;
  CHECK_FALSE(refused());
  for (const double bound : {-1.0, 20.1, std::nan("")}) {
    options.min_dihedral = bound;
    CHECK(refused());
  }
  options.min_dihedral = 12;
  options.algorithm = mesher::Algorithm::gap_balls;
  CHECK_FALSE(refused());
  options.rule = mesher::Rule::voronoi_aspect;
  CHECK(refused());
  CHECK_THROWS_AS(mesher::Mesher<3>({.domain = {{0, 0, 0}, {1, 1, 1}},
                                     .rule = mesher::Rule::voronoi_aspect,
                                     .min_dihedral = 12.0}),
                  mesher::Error);
  options.algorithm = mesher::Algorithm::automatic;
  options.rule = mesher::Rule::radius_edge;
  options.max_measure = 1e-3;
  CHECK_FALSE(refused());
}
