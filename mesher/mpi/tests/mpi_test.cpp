// Ranks: at every step the mesh, and the change, are those of one process, whatever happens on the
// way. One case, by name, on the ranks that mpirun starts.
//
//   mpirun -n P mpi_test plane|space|lines|complexes|lines_memory|complexes_memory|places|failures|
//                        limit|memory|files|reading|sizes|refused|sizes_memory
//     FOLDER
#include "mesher/mpi.hpp"

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "failing_new.hpp"
#include "joint_limits_case.hpp"
#include "joint_twin.hpp"
#include "mesher/read.hpp"
#include "space_parcels.hpp"

namespace {

using mesher::MpiMesher;
using mesher::Point;
using mesher::PointId;
using mesher::PointKind;
using support::demand;

std::size_t self, size;
std::string folder;

std::uint64_t least(std::uint64_t value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
  return value;
}

template <int D>
void check_edits(PointKind kind, std::size_t n, int threads, int steps, std::uint64_t seed) {
  const auto points = mesher::generate_points<D>(kind, n, seed);
  MpiMesher<D> m(MPI_COMM_WORLD, support::joint_options<D>(points, threads));
  support::JointCase<D, MpiMesher<D>> both(m, self, size, points, seed);
  both.run(steps);
}

constexpr PointKind kFamilies[] = {PointKind::uniform, PointKind::clusters, PointKind::grid,
                                   PointKind::spread};

void check_plane() {
  std::uint64_t seed = 1;
  for (const PointKind kind : kFamilies) {
    check_edits<2>(kind, 150, 1 + static_cast<int>(seed % 2), 12, seed);
    ++seed;
  }
  for (const std::size_t n : {0, 1, 3}) check_edits<2>(PointKind::uniform, n, 1, 6, ++seed);
}

void check_space() {
  std::uint64_t seed = 100;
  for (const PointKind kind : kFamilies) check_edits<3>(kind, 20, 1, 2, seed++);
  check_edits<3>(PointKind::uniform, 2, 1, 3, seed);
}

template <class Check>
void check_with(const Check& check) {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 200, 5);
  MpiMesher<2> m(MPI_COMM_WORLD, support::joint_options<2>(points));
  check(m);
}

void check_places() {
  check_with([](auto& m) { support::check_places(m, self, size); });
  check_with([](auto& m) { support::check_told<mesher::Told>(m, self, size); });
}

void check_failures() {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 400, 4);
  MpiMesher<2> m(MPI_COMM_WORLD, support::joint_options<2>(points));
  support::check_failures(m, self, size);
}

void check_limit() {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 200, 7);
  auto options = support::joint_options<2>(points);
  options.max_vertices = mesher::mesh_statically<2>(points, options).vertices.size();
  MpiMesher<2> m(MPI_COMM_WORLD, options);
  support::check_too_many(m, self, size, points);
}

// act(), of which an allocation fails on the last rank. Whether it has failed.
template <class Act>
bool fails_at(std::uint64_t count, bool& burnt, const Act& act) {
  if (self == size - 1) return support::fails(count, burnt, act);
  try {
    act();
    return false;
  } catch (const std::bad_alloc&) {
    return true;
  }
}

// The mesh is that of one process that has had none of the failures.
template <int D>
void require_fresh(MpiMesher<D>& m) {
  mesher::BoxMesher<D> one(m.options());
  for (int to = 0; to < m.ranks(); ++to) {
    for (const auto& p : m.gather_points(to)) one.insert(p.id, p.at);
  }
  for (const auto& l : m.lines()) one.insert_polyline(l.id, l.points);
  for (const auto& f : m.polygons()) one.insert_polygon(f);
  one.update();
  demand(m.gather() == (self == 0 ? one.mesh() : mesher::Mesh<D>()), "the mesh after failures");
  demand(m.certificate().empty(), "the certificate after failures");
}

// One allocation after the other fails on the last rank, in an update of what announce() announces:
// all take it back.
template <int D, class Announce>
void check_failing_updates(MpiMesher<D>& m, const Announce& announce) {
  const auto update = [&] { static_cast<void>(m.update()); };
  const mesher::Mesh<D> before = m.gather();
  bool burnt = true;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 12) {
    burnt = false;
    announce();
    const bool failed = fails_at(count, burnt, update);
    burnt = least(burnt ? 0 : 1) == 0;
    demand(least(failed ? 0 : 1) == (failed ? 0u : 1u), "one has failed, and others have not");
    if (!failed) return;
    demand(m.gather() == before, "a failure leaves the mesh");
    m.check_invariants();
  }
  announce();
  update();
}

// The same in updates that are refused: all say so, or all have no memory.
template <class Announce>
void check_failing_refusals(MpiMesher<2>& m, const Announce& announce) {
  bool refused = false;
  const auto update = [&] {
    refused = support::code_of([&] { static_cast<void>(m.update()); }).has_value();
  };
  const mesher::Mesh<2> before = m.own_mesh();
  bool burnt = true;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 12) {
    burnt = refused = false;
    announce();
    const bool failed = fails_at(count, burnt, update);
    burnt = least(burnt ? 0 : 1) == 0;
    demand(failed != refused, "neither refused nor failed");
    demand(burnt || least(refused ? 1 : 0) == 1, "all refuse it");
    demand(m.own_mesh() == before, "a failure leaves the mesh");
    m.check_invariants();
  }
}

// One allocation after the other fails on the last rank: no rank gets a mesher, and all take an
// update back.
void check_memory() {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 24, 6);
  const auto options = support::joint_options<2>(points);
  bool fails = true;
  for (std::uint64_t count = 1; fails; ++count) {
    bool burnt = false;
    const bool failed =
        fails_at(count, burnt, [&] { static_cast<void>(MpiMesher<2>(MPI_COMM_WORLD, options)); });
    fails = least(failed ? 0 : 1) == 0;
    demand(least(failed ? 1 : 0) == (fails ? 1u : 0u), "a mesher on some ranks alone");
  }
  MpiMesher<2> m(MPI_COMM_WORLD, options);
  check_failing_updates(m, [&] {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % size == self) m.insert(PointId(i + 1), points[i]);
    }
  });
  check_failing_updates(m, [&] {
    for (std::size_t i = 0; i < 4; ++i) {
      if (i % size == self) m.move(PointId(i + 1), {points[i][1], points[i][0]});
    }
  });
  check_failing_updates(m, [&] {
    if (self == 0) m.move(PointId{7}, points[7]), m.move(PointId{8}, points[6]);
    if (self == size - 1) m.remove(PointId{9}), m.insert(PointId{100}, points[8]);
  });
  check_failing_refusals(m, [&] {
    if (self == 0) m.move(PointId{10}, points[11]);
    if (self == size - 1) m.move(PointId{14}, points[12]);
  });
  check_failing_updates(m, [&] {  // from now on each rank has all points
    if (self == size - 1) m.limit({.max_measure = 1e-2});
    if (self == 0) m.remove(PointId{100});
  });
  require_fresh(m);
}

// --- Lines and polygons

void check_lines() {
  std::uint64_t seed = 1;
  for (const auto kind :
       {mesher::PslgKind::segments, mesher::PslgKind::trees, mesher::PslgKind::fan}) {
    MpiMesher<2> m(MPI_COMM_WORLD, {.domain = {{0, 0}, {1, 1}}});
    support::JointTwin<2, MpiMesher<2>> twin(m, self, size);
    support::JointLines edits(twin, seed);
    edits.insert(mesher::generate_pslg({kind, 24, seed++}));
    twin.update();
    for (int step = 0; step < 8; ++step) {
      for (std::uint64_t i = 1 + edits.below(3); i > 0; --i) edits.edit();
      try {
        twin.update();
      } catch (const mesher::Error&) {  // of both
      }
    }
    twin.check();
  }
}

void check_complexes() {
  mesher::Options<3> options;
  options.domain.hi = {2, 2, 2};
  for (const double least : {0.0, 8.0}) {
    options.min_dihedral = least;
    MpiMesher<3> m(MPI_COMM_WORLD, options);
    support::JointTwin<3, MpiMesher<3>> twin(m, self, size);
    support::SpaceParcels<support::JointTwin<3, MpiMesher<3>>> parcels(twin, 5);
    for (int update = 0; update < 4; ++update) {
      static_cast<void>(
          parcels.edit_and(update == 0 ? 4 : 1 + parcels.below(3), [&] { twin.update(); }));
    }
    twin.check();
  }
}

// One allocation after the other fails on the last rank, so that handles of features differ between
// ranks from then on.
void check_lines_memory() {
  using mesher::LineId;
  const auto graph = mesher::generate_pslg({mesher::PslgKind::trees, 10, 3});
  MpiMesher<2> m(MPI_COMM_WORLD, {.domain = {{0, 0}, {1, 1}}});
  check_failing_updates(m, [&] {
    if (self != 0) return;
    for (const auto& p : graph.points) m.insert(p.id, p.at);
    for (const auto& s : graph.segments) m.insert_segment(s.id, s.from, s.to);
  });
  const auto ends = [&](std::size_t i) {
    return std::pair(graph.segments[i].from, graph.segments[i].to);
  };
  check_failing_updates(m, [&] {
    if (self == size - 1) m.remove_line(graph.segments[2].id), m.remove_line(graph.segments[5].id);
  });
  check_failing_updates(m, [&] {
    const auto [a, b] = ends(5);
    if (self == 0) m.insert_segment(LineId{5000}, a, b);
    if (self == size - 1) m.insert(PointId{9000}, {0.013, 0.987});
  });
  check_failing_updates(m, [&] {
    const auto [a, b] = ends(2);
    if (self == size - 1) m.insert_segment(LineId{5001}, a, b), m.remove(PointId{9000});
  });
  require_fresh(m);
}

void check_complexes_memory() {
  mesher::Options<3> options;
  options.domain.hi = {1, 1, 1};
  MpiMesher<3> m(MPI_COMM_WORLD, options);
  const auto insert_face = [&](std::int64_t id, const std::array<std::int64_t, 3>& corners) {
    mesher::Polygon face{mesher::PolygonId{id}, {{}}};
    for (const std::int64_t i : corners) face.loops[0].push_back(PointId{i});
    m.insert_polygon(face);
  };
  check_failing_updates(m, [&] {
    if (self != 0) return;
    const Point<3> corners[] = {{0.2, 0.2, 0.2}, {0.8, 0.3, 0.2}, {0.4, 0.8, 0.3}, {0.5, 0.5, 0.9}};
    for (int i = 0; i < 4; ++i) m.insert(PointId{i + 1}, corners[i]);
    insert_face(1, {1, 2, 3}), insert_face(2, {1, 2, 4});
  });
  check_failing_updates(m, [&] {
    if (self == size - 1) m.remove_polygon(mesher::PolygonId{1});
    if (self == 0) m.move(PointId{4}, {0.5, 0.45, 0.85});
  });
  check_failing_updates(m, [&] {
    if (self == size - 1) insert_face(3, {2, 3, 4});
    if (self == 0) m.insert_segment(mesher::LineId{1}, PointId{1}, PointId{3});
  });
  require_fresh(m);
}

// --- Limits of size

template <int D>
std::unique_ptr<MpiMesher<D>> make(const mesher::Options<D>& options) {
  return std::make_unique<MpiMesher<D>>(MPI_COMM_WORLD, options);
}

void check_sizes() {
  std::uint64_t seed = 1;
  for (const PointKind kind : kFamilies) {
    support::check_limits_in_plane(make<2>, self, size, kind, 40, 6, seed++);
  }
  for (const PointKind kind : {PointKind::uniform, PointKind::grid}) {
    support::check_limits_in_space(make<3>, self, size, kind, 20, 2, seed++);
  }
}

void check_refused() {
  support::check_limits_refused(make<2>, self, size);
  support::check_limits_stopped(make<2>, self, size);
}

void check_sizes_memory() {
  const auto points = support::limited_points<2>(PointKind::uniform, 16, 6);
  const auto sloped = std::make_shared<mesher::SlopedSizes<2>>(
      [](const Point<2>& p) { return 3 + 0.1 * p[0]; }, 0.1, 3);
  MpiMesher<2> m(MPI_COMM_WORLD, support::limited_options<2>(1, {.max_measure = 8}));
  check_failing_updates(m, [&] {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % size == self) m.insert(PointId(i + 1), points[i]);
    }
  });
  check_failing_updates(m, [&] {
    if (self == 0) m.move(PointId{3}, {points[3][1], points[3][0]});
    m.limit({{2, 2}, {7, 6}}, {.sizes = sloped});
    if (self == size - 1) m.limit({{5, 5}, {11, 9}}, {.max_measure = 2});
  });
  check_failing_updates(m, [&] {  // all begin anew
    if (self == size - 1) m.limit({.max_measure = 6});
  });
  const auto tiny = std::make_shared<mesher::SlopedSizes<2>>(
      [](const Point<2>& p) { return p[0] > 5 && p[1] > 5 ? 1e-15 : 4.0; }, 0, 1e-15);
  check_failing_refusals(m, [&] { m.limit({{2, 2}, {9, 8}}, {.sizes = tiny}); });
  check_failing_refusals(m, [&] { m.limit({.sizes = tiny}); });
}

std::vector<std::array<Point<2>, 3>> corners_of(const mesher::Mesh<2>& mesh) {
  std::vector<std::array<Point<2>, 3>> all;
  for (const auto& [a, b, c] : mesh.simplices) {
    all.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  return all;
}

// Pieces have each simplex once; other formats have the bytes of one process.
void check_files() {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 500, 3);
  MpiMesher<2> m(MPI_COMM_WORLD, support::joint_options<2>(points));
  support::JointCase<2, MpiMesher<2>> both(m, self, size, points, 3);
  const std::string name = folder + "/mpi_" + std::to_string(size);
  mesher::write_mesh(m, name + ".pvtu");
  mesher::write_mesh(m, name + ".vtu");
  demand(std::filesystem::exists(name + ".pvtu"), "the index");
  const mesher::Mesh<2> piece = mesher::read_mesh<2>(name + "_" + std::to_string(self) + ".vtu");
  const mesher::Mesh<2> own = m.own_mesh();
  demand(piece == own, "a piece");
  if (self == 0) {
    const mesher::Mesh<2> whole = mesher::read_mesh<2>(name + ".vtu");
    demand(whole == both.one().mesh(), "the merged file");
  }
  mesher::write_pieces(m, name + ".msh");
  const mesher::Mesh<2> msh = mesher::read_mesh<2>(name + "_" + std::to_string(self + 1) + ".msh");
  demand(corners_of(msh) == corners_of(own), "a piece of Gmsh");
  demand(!std::filesystem::exists(name + ".msh"), "pieces alone");
  mesher::write_partitions(m, name + "_all.msh");
  if (self == 0) {
    const mesher::Mesh<2> one = mesher::read_mesh<2>(name + "_all.msh");
    auto corners = corners_of(one), expected = corners_of(both.one().mesh());
    std::sort(corners.begin(), corners.end()), std::sort(expected.begin(), expected.end());
    demand(corners == expected, "one file of all partitions");
  }
  const auto no_pieces = support::code_of([&] { mesher::write_pieces(m, name + ".off"); });
  demand(no_pieces == mesher::ErrorCode::unknown_format, "a format without pieces");
  const auto refused = support::code_of([&] { mesher::write_mesh(m, name + "/none/a.pvtu"); });
  demand(refused == mesher::ErrorCode::cannot_write, "a folder that is not there");
}

// One allocation after the other fails on the last rank, while shares of a file are read; places
// are not in order, so that what repeats is looked for.
void check_reading() {
  const std::string path = folder + "/reading_" + std::to_string(size) + ".node";
  constexpr int kPoints = 60;
  if (self == 0) {
    std::ofstream file(path);
    file << kPoints << " 2 0 1\n";
    for (int i = kPoints; i > 0; --i) file << i << ' ' << i % 7 << ' ' << i / 7 << " 1\n";
  }
  MPI_Barrier(MPI_COMM_WORLD);
  std::uint64_t count = 1, points = 0;
  for (bool burnt = true; burnt; ++count) {
    burnt = false;
    const bool failed = fails_at(
        count, burnt, [&] { points = mesher::read<2>(MPI_COMM_WORLD, path).graph.points.size(); });
    burnt = least(burnt ? 0 : 1) == 0;
    demand(failed == burnt && least(failed ? 0 : 1) == (failed ? 0u : 1u), "all fail, or none");
  }
  MPI_Allreduce(MPI_IN_PLACE, &points, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  demand(points == kPoints && count > 20, "each point comes to one rank");
}

}  // namespace

int main(int argc, char** argv) {
  int level = 0, rank = 0, ranks = 1;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  self = static_cast<std::size_t>(rank);
  size = static_cast<std::size_t>(ranks);
  folder = argc > 2 ? argv[2] : ".";
  const struct {
    const char* name;
    void (*check)();
  } kCases[] = {{"plane", check_plane},
                {"space", check_space},
                {"lines", check_lines},
                {"complexes", check_complexes},
                {"lines_memory", check_lines_memory},
                {"complexes_memory", check_complexes_memory},
                {"failures", check_failures},
                {"places", check_places},
                {"limit", check_limit},
                {"memory", check_memory},
                {"files", check_files},
                {"reading", check_reading},
                {"sizes", check_sizes},
                {"refused", check_refused},
                {"sizes_memory", check_sizes_memory}};
  bool is_known = false;
  try {
    for (const auto& one : kCases) {
      if (argc < 2 || std::strcmp(argv[1], one.name) != 0) continue;
      is_known = true;
      one.check();
    }
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "rank %d of %d: %s\n", rank, ranks, failure.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return is_known ? 0 : 2;
}
