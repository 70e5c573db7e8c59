// Meshes made tile after tile are those of one run, to the last bit, wherever the cuts are and
// however narrow halos are to begin with; and a run that ends early goes on from its folder.
#include "facade/out_of_core.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "code_of.hpp"
#include "facade/mesh_statically.hpp"
#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::ErrorCode;
using mesher::Mesh;
using mesher::Options;
using mesher::OutOfCore;
using mesher::OutOfCoreReport;
using mesher::Point;
using mesher::PointKind;
namespace fs = std::filesystem;

constexpr PointKind kFamilies[] = {PointKind::uniform, PointKind::gaussian,    PointKind::clusters,
                                   PointKind::grid,    PointKind::line_circle, PointKind::spiral,
                                   PointKind::sphere,  PointKind::spread};

template <int D>
Options<D> options_for(const std::vector<Point<D>>& points) {
  Options<D> options;
  options.domain = mesher::snapped_domain<D>(points);
  return options;
}

// How often tiles were compared.
template <int D>
std::size_t check(const std::vector<Point<D>>& points, const OutOfCore& how, double width,
                  const Options<D>& options) {
  OutOfCoreReport report;
  const Mesh<D> mesh =
      mesher::detail::mesh_in_tiles<D>(points, options, how, width, {}, report, {});
  REQUIRE(mesh == mesher::mesh_statically<D>(points, options));
  REQUIRE(report.tiles <= how.tiles + 1);
  REQUIRE(report.runs >= report.tiles);
  return report.rounds;
}

template <int D>
void check_families(std::size_t n, const std::vector<std::size_t>& tiles) {
  std::uint64_t seed = 1;
  std::size_t again = 0;
  for (const PointKind kind : kFamilies) {
    const auto points = mesher::generate_points<D>(kind, n, seed);
    for (const std::size_t count : tiles) {
      for (const double width : {0.25, 4.0}) {
        CAPTURE(D, static_cast<int>(kind), seed, count, width);
        const int threads = 1 + static_cast<int>(count % 2);
        if (check<D>(points, {.tiles = count, .threads = threads}, width, options_for<D>(points)) >
            1)
          ++again;
      }
    }
    ++seed;
  }
  REQUIRE(again > std::size(kFamilies));  // narrow halos were found out
}

// Calls until the run is stopped; then it goes on. Returns what the folder had for it.
std::size_t stopped_and_resumed(const std::vector<Point<2>>& points, std::uint64_t calls,
                                const std::string& folder) {
  const OutOfCore how{.folder = folder, .tiles = 6};
  mesher::RunControl control;
  control.progress = [&](const mesher::Progress& progress) { return progress.done < calls; };
  REQUIRE(support::code_of([&] {
            static_cast<void>(
                mesher::box_mesh_out_of_core<2>(points, {}, how, {}, nullptr, control));
          }) == ErrorCode::cancelled);
  OutOfCoreReport report;
  const Mesh<2> mesh = mesher::box_mesh_out_of_core<2>(points, {}, how, {}, &report);
  REQUIRE(mesh == mesher::mesh_statically<2>(points, options_for<2>(points)));
  REQUIRE(report.runs + report.tiles_found >= report.tiles);
  REQUIRE_FALSE(fs::exists(folder));
  return report.tiles_found;
}

}  // namespace

TEST_CASE("tile after tile the mesh is that of one run, in the plane") {
  check_families<2>(400, {1, 2, 5, 16});
}

TEST_CASE("tile after tile the mesh is that of one run, in space") {
  check_families<3>(60, {1, 3, 8});
}

TEST_CASE("tile after tile with other bounds of quality, scales and offsets") {
  const auto unit = mesher::generate_points<2>(PointKind::uniform, 500, 3);
  for (const double rho : {1.05, 2.0, 8.0, 100.0}) {
    Options<2> options = options_for<2>(unit);
    options.rho = rho;
    CAPTURE(rho);
    check<2>(unit, {.tiles = 4}, 2, options);
  }
  for (const double scale : {0x1p-60, 0x1p80}) {
    for (const double offset : {0.0, 1000.0}) {
      CAPTURE(scale, offset);
      std::vector<Point<2>> points = unit;
      for (auto& p : points) p = {(p[0] + offset) * scale, (p[1] - offset) * scale};
      check<2>(points, {.tiles = 5}, 1, options_for<2>(points));
    }
  }
}

TEST_CASE("few points, points on a line, and more tiles than points") {
  for (const std::size_t n : {0, 1, 2, 3, 7}) {
    const auto points = mesher::generate_points<2>(PointKind::uniform, n, n);
    CAPTURE(n);
    REQUIRE(mesher::box_mesh_out_of_core<2>(points, {}, {.tiles = 20}) ==
            mesher::mesh_statically<2>(points, options_for<2>(points)));
  }
  std::vector<Point<2>> line;
  std::vector<Point<3>> flat;
  for (int i = 0; i < 60; ++i) {
    line.push_back({i * 0.25, 0.5});
    flat.push_back({i % 8 * 0.125, 0.25, i / 8 * 0.125});
  }
  check<2>(line, {.tiles = 4}, 1, options_for<2>(line));
  check<3>(flat, {.tiles = 4}, 1, options_for<3>(flat));
}

TEST_CASE("a run out of core that was stopped goes on from its folder") {
  const support::ScratchFolder scratch;
  const auto points = mesher::generate_points<2>(PointKind::uniform, 3000, 5);
  OutOfCoreReport whole;
  static_cast<void>(mesher::box_mesh_out_of_core<2>(points, {}, {.tiles = 6}, {}, &whole));
  std::size_t found = 0;
  for (const double part : {0.0, 0.3, 0.6, 0.9}) {
    const auto calls = static_cast<std::uint64_t>(part * static_cast<double>(whole.calls));
    CAPTURE(calls);
    const std::size_t now = stopped_and_resumed(points, calls, scratch.path("tiles"));
    REQUIRE(now >= found);
    found = now;
  }
  REQUIRE(found >= 3);
}

TEST_CASE("a tile's file that was cut off or changed counts as not there") {
  const support::ScratchFolder scratch;
  const std::string folder = scratch.path("tiles");
  const auto points = mesher::generate_points<2>(PointKind::uniform, 1500, 6);
  const OutOfCore how{.folder = folder, .tiles = 3};
  const auto stop_late = [&] {
    mesher::RunControl control;
    control.progress = [&](const mesher::Progress&) { return !fs::exists(folder + "/view_2"); };
    REQUIRE_THROWS(mesher::box_mesh_out_of_core<2>(points, {}, how, {}, nullptr, control));
  };
  const Mesh<2> expected = mesher::mesh_statically<2>(points, options_for<2>(points));
  for (const char* what : {"view_1", "vertices_1", "simplices_0", "looks_2", "points_1"}) {
    for (const bool is_cut : {true, false}) {
      CAPTURE(what, is_cut);
      stop_late();
      const std::string path = folder + "/" + what;
      std::string bytes = scratch.read("tiles/" + std::string(what));
      if (is_cut) {
        bytes.resize(bytes.size() - 1);
      } else {
        bytes[bytes.size() / 2] ^= 4;
      }
      scratch.write("tiles/" + std::string(what), bytes);
      OutOfCoreReport report;
      REQUIRE(mesher::box_mesh_out_of_core<2>(points, {}, how, {}, &report) == expected);
      REQUIRE(report.tiles_found == (std::string(what) == "points_1" ? 3u : 2u));
    }
  }
}

TEST_CASE("a folder with tiles of something else is left alone") {
  const support::ScratchFolder scratch;
  const std::string folder = scratch.path("tiles");
  auto points = mesher::generate_points<2>(PointKind::uniform, 1500, 6);
  const OutOfCore how{.folder = folder, .tiles = 3};
  mesher::RunControl control;
  control.progress = [](const mesher::Progress& progress) { return progress.done < 6000; };
  REQUIRE_THROWS(mesher::box_mesh_out_of_core<2>(points, {}, how, {}, nullptr, control));
  const auto code = [&](const Options<2>& options, const OutOfCore& other) {
    return support::code_of(
        [&] { static_cast<void>(mesher::box_mesh_out_of_core<2>(points, options, other)); });
  };
  REQUIRE(code({.rho = 2}, how) == ErrorCode::cannot_write);
  REQUIRE(code({}, {.folder = folder, .tiles = 4}) == ErrorCode::cannot_write);
  points[7][0] += 0x1p-30;
  REQUIRE(code({}, how) == ErrorCode::cannot_write);
  points[7][0] -= 0x1p-30;
  scratch.write("tiles/notes", "not ours");
  OutOfCoreReport report;
  REQUIRE_FALSE(mesher::box_mesh_out_of_core<2>(points, {}, how, {}, &report).vertices.empty());
  REQUIRE(report.tiles_found > 0);
  REQUIRE(scratch.read("tiles/notes") == "not ours");
  REQUIRE(std::distance(fs::directory_iterator(folder), {}) == 1);
  REQUIRE(code({}, {.folder = scratch.write("file", ""), .tiles = 2}) == ErrorCode::cannot_write);
}

TEST_CASE("bad input out of core is an error as it is in one run") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 300, 2);
  const auto code = [](const std::vector<Point<2>>& p, const Options<2>& options,
                       const OutOfCore& how = {.tiles = 3, .threads = 2}) {
    return support::code_of(
        [&] { static_cast<void>(mesher::box_mesh_out_of_core<2>(p, options, how)); });
  };
  const auto with = [&](const Point<2>& p) {
    auto more = points;
    more.push_back(p);
    return more;
  };
  REQUIRE(code(with(points[17]), {}) == ErrorCode::duplicate_point);
  REQUIRE(code(with({points[17][0] + 0x1p-53, points[17][1]}), {}) == ErrorCode::too_close);
  REQUIRE(code(with({NAN, 0}), {}) == ErrorCode::not_finite);
  REQUIRE(code(with({0x1p-101, 0}), {}) == ErrorCode::magnitude);
  REQUIRE(code(with({2, 0}), {.domain = {{0, 0}, {1, 1}}}) == ErrorCode::outside_domain);
  REQUIRE(code(points, {.max_measure = 0.01}) == ErrorCode::bad_option);
  REQUIRE(code(points, {.algorithm = mesher::Algorithm::svr}) == ErrorCode::bad_option);
  REQUIRE(code(points, {.growth = 1.5}) == ErrorCode::bad_option);
  REQUIRE(code(points, {.rule = mesher::Rule::voronoi_aspect}) == ErrorCode::bad_option);
  for (const int threads : {0, 257}) {
    REQUIRE(code(points, {}, {.tiles = 2, .threads = threads}) == ErrorCode::bad_option);
  }
  const std::size_t all =
      mesher::mesh_statically<2>(points, options_for<2>(points)).vertices.size();
  REQUIRE(code(points, {.max_vertices = all - 1}) == ErrorCode::too_many);
  REQUIRE_FALSE(code(points, {.max_vertices = all}).has_value());
}

TEST_CASE("a point that is on a cut, or on the points' box, belongs to one tile") {
  std::vector<Point<2>> points;
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) points.push_back({i * 0.5, j * 0.5});
  }
  for (const std::size_t tiles : {2, 4, 9}) {
    CAPTURE(tiles);
    check<2>(points, {.tiles = tiles}, 1, options_for<2>(points));
  }
}

TEST_CASE("a run out of core in which an allocation fails leaves a folder that is good") {
  const support::ScratchFolder scratch;
  const std::string folder = scratch.path("tiles");
  const auto points = mesher::generate_points<2>(PointKind::uniform, 120, 9);
  const Mesh<2> expected = mesher::mesh_statically<2>(points, options_for<2>(points));
  bool burnt = true;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 6) {
    const auto run = [&] {
      static_cast<void>(
          mesher::box_mesh_out_of_core<2>(points, {}, {.folder = folder, .tiles = 2}));
    };
    if (!support::fails(count, burnt, run)) continue;
    CAPTURE(count);
    REQUIRE(mesher::box_mesh_out_of_core<2>(points, {}, {.folder = folder, .tiles = 2}) ==
            expected);
  }
}
