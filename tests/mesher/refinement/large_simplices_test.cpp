// Limits of size by svr and refine: nothing is too large where they count, the mesh conforms, and
// sizes grow as slowly as is asked for.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "any_id.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/meshing.hpp"
#include "mesher/sizes.hpp"
#include "random_complex.hpp"
#include "refined_complex.hpp"

namespace {

using mesher::Algorithm;
using mesher::Extent;
using mesher::Graph;
using mesher::MeshData;
using mesher::Options;
using mesher::Point;
using mesher::RegionAreas;

constexpr double kAny = std::numeric_limits<double>::infinity();

double measure(const MeshData<2>& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.simplices[t];
  const Point<2>&p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
  return ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
}
double measure(const MeshData<3>& mesh, std::size_t t) {
  std::array<Point<3>, 3> u;
  const auto& s = mesh.simplices[t];
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      u[k][i] = mesh.vertices[s[k + 1]][i] - mesh.vertices[s[0]][i];
    }
  }
  return (u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1]) -
          u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0]) +
          u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0])) /
         6;
}

template <int D>
Point<D> middle(const MeshData<D>& mesh, std::size_t t) {
  Point<D> sum{};
  for (const std::uint32_t v : mesh.simplices[t]) {
    for (std::size_t i = 0; i < D; ++i) sum[i] += mesh.vertices[v][i] / (D + 1);
  }
  return sum;
}

// But for rounding.
template <int D>
bool is_in(const mesher::Box<D>& box, const Point<D>& p) {
  for (std::size_t i = 0; i < D; ++i) {
    const double near = 1e-9 * (box.hi[i] - box.lo[i]);
    if (p[i] < box.lo[i] + near || p[i] > box.hi[i] - near) return false;
  }
  return true;
}

// The simplices that are larger than limit(t) allows, but for rounding.
template <int D, class Limit>
std::size_t count_large(const MeshData<D>& mesh, Limit&& limit) {
  std::size_t large = 0;
  for (std::size_t t = 0; t < mesh.simplices.size(); ++t) {
    large += measure(mesh, t) > limit(t) * (1 + 1e-12) ? 1 : 0;
  }
  return large;
}

// What check_mesh() says against it.
template <int D>
std::string fault(const MeshData<D>& mesh, const Graph<D>& graph) {
  mesher::GraphFile<D> file;
  file.graph = graph;
  if constexpr (D == 2) file.points.resize(graph.points.size());
  mesher::CheckOptions<D> options;
  options.rho = Options<D>().rho;
  options.graph = &file;
  options.features = &mesh.features;
  options.boundary = mesher::BoundaryRule::lines;
  for (const mesher::Finding& f : check_mesh(mesh, options)) {
    if (!f.holds) return f.property + ": " + f.detail;
  }
  return "";
}

// The box [0, 1]^D with a wall at x = 1/2, and a region seed on each side.
Graph<2> parted(std::integral_constant<int, 2>) {
  Graph<2> graph;
  const std::vector<Point<2>> at{{0, 0}, {.5, 0}, {1, 0}, {1, 1}, {.5, 1}, {0, 1}};
  for (std::size_t i = 0; i < 6; ++i) {
    graph.points.push_back({support::id(i), at[i], 0});
    graph.segments.push_back({support::id(i), support::id(i), support::id((i + 1) % 6), 0});
  }
  graph.segments.push_back({support::id(6), support::id(1), support::id(4), 0});
  graph.seeds = {mesher::region_seed<2>(1, {.1, .1}, 1, 1e-3),
                 mesher::region_seed<2>(2, {.9, .1}, 2)};
  return graph;
}
Graph<3> parted(std::integral_constant<int, 3>) {
  Graph<3> graph;
  for (std::size_t i = 0; i < 12; ++i) {
    const double x = static_cast<double>(i % 3) / 2;
    const std::size_t side = i / 3;
    graph.points.push_back(
        {support::id(i), {x, side == 1 || side == 2 ? 1. : 0., side >= 2 ? 1. : 0.}, 0});
  }
  const auto add = [&](std::vector<std::size_t> corners) {
    mesher::Polygon polygon{.id = support::id(graph.polygons.size()), .loops = {{}}};
    for (const std::size_t c : corners) polygon.loops[0].push_back(support::id(c));
    graph.polygons.push_back(polygon);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t a = 3 * k, b = 3 * ((k + 1) % 4);
    add({a, a + 1, b + 1, b}), add({a + 1, a + 2, b + 2, b + 1});
  }
  for (const std::size_t x : {0, 1, 2}) add({x, x + 3, x + 6, x + 9});
  graph.seeds = {mesher::region_seed<3>(1, {.1, .1, .1}, 1, 1e-4),
                 mesher::region_seed<3>(2, {.9, .1, .1}, 2)};
  return graph;
}
template <int D>
Graph<D> parted() {
  return parted(std::integral_constant<int, D>());
}

template <int D>
double smallest(const MeshData<D>& mesh) {
  double least = kAny;
  for (std::size_t t = 0; t < mesh.simplices.size(); ++t) least = std::min(least, measure(mesh, t));
  return least;
}

constexpr Algorithm kBoth[] = {Algorithm::svr, Algorithm::refine};

}  // namespace

TEMPLATE_TEST_CASE_SIG("nothing is larger than a constant limit, with as few vertices as lattices",
                       "", ((int D), D), 2, 3) {
  const Graph<D> graph = parted<D>();
  for (const Algorithm algorithm : kBoth) {
    for (const double limit : {1e-2, 1e-3, 1e-4}) {
      INFO(name_of(algorithm) << ", " << limit);
      const auto made = mesh(graph, {.max_measure = limit, .algorithm = algorithm});
      CHECK(fault(made.mesh, graph) == "");
      CHECK(count_large(made.mesh, [&](std::size_t) { return limit; }) == 0);
      // A lattice has 1 / (2 limit) vertices, or 1 / (6 limit), and some more on walls.
      const double lattice = 1 / ((D == 2 ? 2 : 6) * limit);
      const double on_walls = D == 2 ? 4 / std::sqrt(limit) : 4 / std::pow(limit, 2. / 3);
      const auto vertices = static_cast<double>(made.mesh.vertices.size());
      CHECK(vertices > lattice);
      CHECK(vertices < 1.2 * lattice + on_walls + 30);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("points alone, and all of the box, have limits", "", ((int D), D), 2, 3) {
  Graph<D> graph;
  for (const Point<D>& p : mesher::generate_points<D>(mesher::PointKind::clusters, 300, 3)) {
    graph.points.push_back({support::id(graph.points.size()), p, 0});
  }
  const double limit = D == 2 ? 1e-3 : 1e-4;
  for (const Algorithm algorithm : kBoth) {
    INFO(name_of(algorithm));
    const Options<D> in_box{.domain = mesher::snapped_domain<D>(places_of(graph)),
                            .max_measure = limit,
                            .extent = Extent::box,
                            .algorithm = algorithm};
    const auto made = mesh(graph, in_box);
    CHECK(fault(made.mesh, graph) == "");
    CHECK(count_large(made.mesh, [&](std::size_t t) {
            return is_in<D>(in_box.domain, middle(made.mesh, t)) ? limit : kAny;
          }) == 0);
  }
}

TEMPLATE_TEST_CASE_SIG("regions have limits of their own, and what is not kept has none", "",
                       ((int D), D), 2, 3) {
  const Graph<D> graph = parted<D>();
  const double limit = *graph.seeds[0].max_measure;
  for (const Algorithm algorithm : kBoth) {
    for (const Extent extent : {Extent::enclosed, Extent::box}) {
      INFO(name_of(algorithm) << (extent == Extent::box ? ", box" : ""));
      Options<D> options{
          .extent = extent, .region_areas = RegionAreas::limits, .algorithm = algorithm};
      const auto made = mesh(graph, options);
      CHECK(fault(made.mesh, graph) == "");
      const auto of_region = [&](double inside, double outside) {
        return count_large(made.mesh, [&](std::size_t t) {
          return made.mesh.features.regions[t] == 1 ? inside : outside;
        });
      };
      CHECK(of_region(limit, kAny) == 0);
      CHECK(of_region(kAny, 4 * limit) > 10);
      options.region_areas = RegionAreas::ignored;
      const auto ignored = mesh(graph, options);
      CHECK(ignored.mesh.vertices.size() < made.mesh.vertices.size() / 2);
    }
    // A limit everywhere counts in what is kept alone.
    Options<D> options{.max_measure = limit, .algorithm = algorithm};
    const auto kept = box_mesh(graph, options).vertices.size();
    options.extent = Extent::box;
    options.domain = mesher::snapped_domain<D>(places_of(graph));
    for (std::size_t i = 0; i < D; ++i) options.domain.hi[i] += 1, options.domain.lo[i] -= 1;
    CHECK(box_mesh(graph, options).vertices.size() > 3 * kept);
    options.extent = Extent::enclosed;
    CHECK(box_mesh(graph, options).vertices.size() < kept + kept / 2);
  }
}

TEMPLATE_TEST_CASE_SIG("limits vary, by a field and by boxes", "", ((int D), D), 2, 3) {
  const Graph<D> graph = parted<D>();
  const auto size = [](const Point<D>& p) { return 0.05 + 0.3 * p[0]; };
  const auto field = std::make_shared<mesher::SlopedSizes<D>>(size, 0.3, 0.05);
  for (const Algorithm algorithm : kBoth) {
    INFO(name_of(algorithm));
    Options<D> options{.sizes = field, .algorithm = algorithm};
    mesher::Box<D> box;
    for (std::size_t i = 0; i < D; ++i) box.lo[i] = 0.75, box.hi[i] = 1;
    set_limits(options, box, {.max_measure = mesher::measure_of_size<D>(0.04)});
    const auto made = mesh(graph, options);
    CHECK(fault(made.mesh, graph) == "");
    CHECK(count_large(made.mesh, [&](std::size_t t) {
            const Point<D> p = middle(made.mesh, t);
            const bool in_box = *std::min_element(p.begin(), p.end()) >= 0.75;
            return mesher::measure_of_size<D>(in_box ? 0.04 : size(p));
          }) == 0);
  }
}

TEST_CASE("random complexes have limits, and conform as before") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    support::RandomComplex random(seed);
    for (int kind = 2; kind < support::RandomComplex::kKinds; ++kind) {
      const Graph<3> plc = support::plc_of(random.part({0, 0, 0}, kind));
      Options<3> options = support::options_for(plc);
      double side = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        side = std::max(side, options.domain.hi[i] - options.domain.lo[i]);
      }
      options.max_measure = mesher::measure_of_size<3>(side / 12);
      for (const Algorithm algorithm : kBoth) {
        for (const double bound : {0.0, 12.0}) {
          INFO("seed " << seed << ", kind " << kind << ", " << name_of(algorithm) << ", " << bound);
          options.algorithm = algorithm;
          options.min_dihedral = bound;
          const auto made = mesh(plc, options);
          CHECK(fault(made.mesh, plc) == "");
          CHECK(count_large(made.mesh, [&](std::size_t t) {
                  return is_in<3>(options.domain, middle(made.mesh, t)) ? options.max_measure
                                                                        : kAny;
                }) == 0);
        }
      }
    }
  }
}

// From the vertices of the mesh without growth, each with the size of its smallest simplex. Sizes
// spread along edges, so that they may be somewhat larger than along straight lines.
TEMPLATE_TEST_CASE_SIG("sizes grow as slowly as is asked for", "", ((int D), D), 2, 3) {
  Graph<D> graph = parted<D>();
  Point<D> near{};  // two points near to each other
  for (std::size_t i = 0; i < D; ++i) near[i] = 0.3;
  graph.points.push_back({support::id(50), near, 0});
  near[0] += 0.004;
  graph.points.push_back({support::id(51), near, 0});
  for (const Algorithm algorithm : kBoth) {
    Options<D> options{.algorithm = algorithm};
    const auto plain = mesh(graph, options);
    std::vector<double> size(plain.mesh.vertices.size(), kAny);
    for (const auto& s : plain.mesh.simplices) {
      double longest = 0;
      for (const auto v : s) {
        for (const auto w : s) {
          double d2 = 0;
          for (std::size_t i = 0; i < D; ++i) {
            d2 += std::pow(plain.mesh.vertices[v][i] - plain.mesh.vertices[w][i], 2);
          }
          longest = std::max(longest, std::sqrt(d2));
        }
      }
      for (const auto v : s) size[v] = std::min(size[v], longest);
    }
    std::size_t before = plain.mesh.vertices.size();
    for (const double growth : {1.5, 1.2}) {
      INFO(name_of(algorithm) << ", " << growth);
      options.growth = growth;
      const auto made = mesh(graph, options);
      CHECK(fault(made.mesh, graph) == "");
      const auto count_above = [&](const MeshData<D>& mesh) {
        return count_large(mesh, [&](std::size_t t) {
          double least = kAny;
          for (std::size_t v = 0; v < size.size(); ++v) {
            double d2 = 0;
            for (std::size_t i = 0; i < D; ++i) {
              d2 += std::pow(plain.mesh.vertices[v][i] - middle(mesh, t)[i], 2);
            }
            least = std::min(least, size[v] + (growth - 1) * std::sqrt(d2));
          }
          return mesher::measure_of_size<D>(1.25 * least);
        });
      };
      CHECK(count_above(made.mesh) == 0);
      CHECK(count_above(plain.mesh) > 0);
      CHECK(made.mesh.vertices.size() > before);
      before = made.mesh.vertices.size();
    }
  }
}

TEST_CASE("growth that cannot be had is refused") {
  const Graph<2> graph = parted<2>();
  for (const double growth : {-1., 1., 1.04, 101., std::nan("")}) {
    CHECK_THROWS_AS(mesh(graph, {.growth = growth}), mesher::Error);
  }
  CHECK_THROWS_AS(mesh(graph, {.algorithm = Algorithm::gap_balls, .growth = 1.3}), mesher::Error);
  CHECK_THROWS_AS(mesher::Mesher<2>({.domain = {{0, 0}, {1, 1}}, .growth = 1.3}), mesher::Error);
  CHECK_THROWS_AS(mesh(graph, {.rho = 1.2, .growth = 1.3}), mesher::Error);
}

TEST_CASE("a limit that asks for too many vertices is an error") {
  try {
    static_cast<void>(mesh(parted<3>(), {.max_measure = 1e-6, .max_vertices = 2000}));
    FAIL();
  } catch (const mesher::Error& error) {
    CHECK(error.code() == mesher::ErrorCode::too_many);
  }
  CHECK_THROWS_AS(mesh(parted<3>(), {.max_measure = 1e-80}), mesher::Error);
}
