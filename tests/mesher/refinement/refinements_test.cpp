// Meshes of points by each refinement: what is promised of them, on all kinds of points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "delaunay_case.hpp"
#include "failing_new.hpp"
#include "mesher/delaunay.hpp"
#include "refined_case.hpp"
#include "refinement/refine.hpp"
#include "refinement/svr.hpp"
#include "space_points.hpp"

namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointKind;
using mesher::RefineOrder;
using support::Kind;
using support::SpaceFamily;

constexpr PointKind kFamilies[] = {
    PointKind::uniform,     PointKind::gaussian, PointKind::clusters, PointKind::grid,
    PointKind::line_circle, PointKind::spiral,   PointKind::sphere,   PointKind::spread,
};

template <int D>
Options<D> options_for(const std::vector<Point<D>>& points) {
  return {.domain = mesher::snapped_domain<D>(points)};
}

// SVR by each structure for point location, and refinement in each order.
enum class By { svr, shells, simplex, circumball, shortest_first, largest_first, strictly };

constexpr mesher::PointLocation location(By by) {
  using mesher::PointLocation;
  return by == By::shells       ? PointLocation::voronoi_shells
         : by == By::simplex    ? PointLocation::simplex
         : by == By::circumball ? PointLocation::circumball
                                : PointLocation::voronoi;
}

template <int D, By B>
Mesh<D> mesh_of(const std::vector<Point<D>>& points, const Options<D>& options,
                const std::vector<mesher::PointId>& ids = {},
                const mesher::RunControl& control = {}) {
  if (B == By::svr || location(B) != mesher::PointLocation::voronoi) {
    return mesher::svr<D>(points, options, {.location = location(B)}, ids, nullptr, control);
  }
  const auto order =
      B == By::largest_first ? RefineOrder::largest_first : RefineOrder::shortest_edge_first;
  return mesher::refine<D>(points, options, {order, B == By::strictly}, ids, nullptr, control);
}
template <int D, By B>
Mesh<D> mesh_of(const std::vector<Point<D>>& points) {
  return mesh_of<D, B>(points, options_for<D>(points));
}

template <int D, By B>
ErrorCode refusal(const std::vector<Point<D>>& points, const Options<D>& options) {
  try {
    static_cast<void>(mesh_of<D, B>(points, options));
  } catch (const Error& e) {
    return e.code();
  }
  FAIL("not refused");
  return {};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a refined mesh is Delaunay with its points, and has no poor simplex", "",
                       ((int D, By B), D, B), (2, By::svr), (3, By::svr), (2, By::shells),
                       (3, By::shells), (2, By::simplex), (3, By::simplex), (2, By::circumball),
                       (3, By::circumball), (2, By::largest_first), (3, By::largest_first),
                       (2, By::shortest_first), (3, By::shortest_first), (2, By::strictly),
                       (3, By::strictly)) {
  for (const PointKind family : kFamilies) {
    for (const std::size_t n : {1, 2, 3, 4, 5, 40, 400}) {
      INFO("family " << static_cast<int>(family) << ", " << n << " points");
      const auto points = mesher::generate_points<D>(family, n, 7 + n);
      support::check_refined<D>(mesh_of<D, B>(points), points, Options<D>{}.rho);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("so it is of points with many ties, on lines, in planes and on balls", "",
                       ((int D, By B), D, B), (2, By::svr), (3, By::svr), (2, By::shells),
                       (3, By::shells), (2, By::simplex), (3, By::simplex), (2, By::circumball),
                       (3, By::circumball), (2, By::largest_first), (3, By::largest_first),
                       (2, By::shortest_first), (3, By::shortest_first), (2, By::strictly),
                       (3, By::strictly)) {
  for (const Kind kind : support::kKinds) {
    for (const std::size_t n : {2, 6, 30, 150}) {
      INFO(name(kind) << ", " << n << " points");
      const auto points = support::distinct_points<D>(kind, n, 3 + n);
      support::check_refined<D>(mesh_of<D, B>(points), points, Options<D>{}.rho);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("so it is of the families of points in space that gap balls are tested with",
                       "", ((By B), B), By::svr, By::shells, By::simplex, By::circumball,
                       By::largest_first, By::shortest_first, By::strictly) {
  for (const SpaceFamily family : support::kSpaceFamilies) {
    INFO(name(family));
    const auto points = support::space_points(family, 200, 29);
    support::check_refined<3>(mesh_of<3, B>(points), points, 2);
  }
}

TEMPLATE_TEST_CASE_SIG("so it is of points all in one line or plane, and of none", "", ((By B), B),
                       By::svr, By::shells, By::simplex, By::circumball, By::largest_first,
                       By::shortest_first, By::strictly) {
  std::vector<Point<3>> line, plane;
  for (int i = 0; i < 30; ++i) {
    line.push_back({0.1 * i, 0.3, 0.7});
    for (int j = 0; j < 8; ++j) plane.push_back({0.1 * i, 0.1 * j, 0.25});
  }
  support::check_refined<3>(mesh_of<3, B>(line), line, 2);
  support::check_refined<3>(mesh_of<3, B>(plane), plane, 2);
  const Mesh<3> none = mesh_of<3, B>({}, {.domain = {{0, 0, 0}, {1, 1, 1}}});
  CHECK(support::box_verdict<3>(none, {}, 2) == "");
}

TEMPLATE_TEST_CASE_SIG("so it is for other bounds", "", ((int D, By B), D, B), (2, By::svr),
                       (3, By::svr), (2, By::shells), (3, By::shells), (2, By::simplex),
                       (3, By::simplex), (2, By::circumball), (3, By::circumball),
                       (2, By::largest_first), (3, By::largest_first), (2, By::shortest_first),
                       (3, By::shortest_first), (2, By::strictly), (3, By::strictly)) {
  for (const double rho : {1.1, 1.3, 1.7, 3.0, 20.0}) {
    if (D == 3 && rho < 1.2) continue;  // too many vertices for a judge
    INFO("rho " << rho);
    const auto points = mesher::generate_points<D>(PointKind::clusters, 60, 5);
    auto options = options_for<D>(points);
    options.rho = rho;
    support::check_refined<D>(mesh_of<D, B>(points, options), points, rho);
  }
}

TEMPLATE_TEST_CASE_SIG("a refined mesh does not depend on the order of points", "",
                       ((int D, By B), D, B), (2, By::svr), (3, By::svr), (2, By::shells),
                       (3, By::shells), (2, By::simplex), (3, By::simplex), (2, By::circumball),
                       (3, By::circumball), (2, By::largest_first), (3, By::largest_first),
                       (2, By::shortest_first), (3, By::shortest_first), (2, By::strictly),
                       (3, By::strictly)) {
  for (const Kind kind : support::kKinds) {
    INFO(name(kind));
    auto points = support::distinct_points<D>(kind, 150, 77);
    const auto options = options_for<D>(points);
    const Mesh<D> mesh = mesh_of<D, B>(points, options);
    mesher::SplitMix64 random(11);
    for (int round = 0; round < 3; ++round) {
      support::shuffle(points, random);
      CHECK(mesh_of<D, B>(points, options) == mesh);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("scaling by a power of two scales the mesh, and extreme scales are meshed",
                       "", ((int D, By B), D, B), (2, By::svr), (3, By::svr), (2, By::shells),
                       (3, By::shells), (2, By::simplex), (3, By::simplex), (2, By::circumball),
                       (3, By::circumball), (2, By::largest_first), (3, By::largest_first),
                       (2, By::shortest_first), (3, By::shortest_first), (2, By::strictly),
                       (3, By::strictly)) {
  const auto points = mesher::generate_points<D>(PointKind::clusters, 80, 3);
  const Mesh<D> mesh = mesh_of<D, B>(points);
  const auto scaled = [&](std::vector<Point<D>> all, int exponent) {
    for (auto& p : all) {
      for (double& x : p) x = std::ldexp(x, exponent);
    }
    return all;
  };
  for (const int exponent : {-30, -1, 1, 40}) {
    const Mesh<D> other = mesh_of<D, B>(scaled(points, exponent));
    CHECK(other.vertices == scaled(mesh.vertices, exponent));
    CHECK(other.simplices == mesh.simplices);
  }
  for (const int exponent : {-90, 95}) {
    INFO("scaled by 2^" << exponent);
    const auto small = scaled(mesher::generate_points<D>(PointKind::grid, 80, 3), exponent);
    support::check_refined<D>(mesh_of<D, B>(small), small, Options<D>{}.rho);
  }
}

TEMPLATE_TEST_CASE_SIG("a refinement refuses what gap balls refuse, by name", "", ((By B), B),
                       By::svr, By::shells, By::simplex, By::circumball, By::largest_first,
                       By::shortest_first, By::strictly) {
  const Options<3> options{.domain = {{0, 0, 0}, {1, 1, 1}}};
  CHECK(refusal<3, B>({{0.5, 0.5, 2}}, options) == ErrorCode::outside_domain);
  CHECK(refusal<3, B>({{0.5, std::numeric_limits<double>::quiet_NaN(), 0}}, options) ==
        ErrorCode::not_finite);
  CHECK(refusal<3, B>({{0.5, 0.5, 0x1p-120}}, options) == ErrorCode::magnitude);
  CHECK(refusal<3, B>({{0.5, 0.5, 0.5}, {0.1, 0, 0}, {0.5, 0.5, 0.5}}, options) ==
        ErrorCode::duplicate_point);
  CHECK(refusal<3, B>({{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5 + 0x1p-52}}, options) ==
        ErrorCode::too_close);
  Options<3> limited = options;
  limited.max_measure = -1;
  CHECK(refusal<3, B>({}, limited) == ErrorCode::bad_option);
  Options<3> rule = options;
  rule.rule = mesher::Rule::voronoi_aspect;
  CHECK(refusal<3, B>({}, rule) == ErrorCode::bad_option);
  try {
    static_cast<void>(mesh_of<2, B>({{0.5, 0.5}, {0.25, 0.25}, {0.25, 0.25}},
                                    {.domain = {{0, 0}, {1, 1}}},
                                    {mesher::PointId{7}, mesher::PointId{9}, mesher::PointId{8}}));
    FAIL("not refused");
  } catch (const Error& e) {
    CHECK(std::string(e.what()).find("point 8 (0.25, 0.25) lies on point 9") != std::string::npos);
  }
}

TEMPLATE_TEST_CASE_SIG("a refinement keeps to the vertices it may have, exactly", "", ((By B), B),
                       By::svr, By::shells, By::simplex, By::circumball, By::largest_first,
                       By::shortest_first, By::strictly) {
  const auto points = mesher::generate_points<3>(PointKind::uniform, 100, 3);
  auto options = options_for<3>(points);
  const std::size_t needed = mesh_of<3, B>(points).vertices.size();
  options.max_vertices = needed;
  CHECK(mesh_of<3, B>(points, options).vertices.size() == needed);
  for (const std::size_t most : {std::size_t{1}, needed / 2, needed - 1}) {
    options.max_vertices = most;
    CHECK(refusal<3, B>(points, options) == ErrorCode::too_many);
  }
}

TEMPLATE_TEST_CASE_SIG("a refinement stops when asked to, and says how far it is", "", ((By B), B),
                       By::svr, By::shells, By::simplex, By::circumball, By::largest_first,
                       By::shortest_first, By::strictly) {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 3000, 3);
  const auto run = [&](const mesher::RunControl& control) {
    return mesh_of<2, B>(points, options_for<2>(points), {}, control);
  };
  std::uint64_t done = 0;
  static_cast<void>(run({.progress = [&](const mesher::Progress& p) {
    CHECK(p.done >= done);
    done = p.done;
    return true;
  }}));
  CHECK(done > 3000);
  int calls = 0;
  const mesher::RunControl third{.progress = [&](const mesher::Progress&) { return ++calls < 3; }};
  CHECK_THROWS_AS(run(third), Error);
  CHECK(calls == 3);
  std::stop_source stop;
  stop.request_stop();
  CHECK_THROWS_AS(run({.stop = stop.get_token()}), Error);
}

TEMPLATE_TEST_CASE_SIG("a refinement without memory fails, and the next is as ever", "",
                       ((By B), B), By::svr, By::shells, By::simplex, By::circumball,
                       By::largest_first, By::shortest_first, By::strictly) {
  const auto points = mesher::generate_points<3>(PointKind::uniform, 60, 3);
  const auto options = options_for<3>(points);
  const Mesh<3> mesh = mesh_of<3, B>(points, options);
  bool burnt = true;
  std::uint64_t failures = 0;
  for (std::uint64_t count = 1; burnt; ++count) {
    Mesh<3> got = mesh;
    const bool failed = support::fails(count, burnt, [&] { got = mesh_of<3, B>(points, options); });
    failures += failed ? 1 : 0;
    REQUIRE((failed || got == mesh));  // a sort can do without
  }
  CHECK(failures > 20);
  CHECK(mesh_of<3, B>(points, options) == mesh);
}
