// Meshers of several processes, here threads: at every step the mesh, and the change, are those of
// one process, whatever happens on the way.
#include "facade/joint_mesher.hpp"

#include <catch2/catch.hpp>

#include "joint_case.hpp"
#include "thread_peers.hpp"

namespace {

using mesher::Point;
using mesher::PointKind;
using mesher::detail::JointMesher;
using mesher::detail::Peers;

constexpr PointKind kFamilies[] = {PointKind::uniform, PointKind::clusters, PointKind::grid,
                                   PointKind::spread, PointKind::line_circle};

template <int D>
void check_edits(PointKind kind, std::size_t n, std::size_t processes, int threads, int steps,
                 std::uint64_t seed) {
  CAPTURE(D, static_cast<int>(kind), n, processes, threads, seed);
  const auto points = mesher::generate_points<D>(kind, n, seed);
  const auto run = [&](std::unique_ptr<Peers> peers, std::size_t self) {
    JointMesher<D> joint(std::move(peers), support::joint_options<D>(points, threads));
    support::JointCase<D, JointMesher<D>> both(joint, self, processes, points, seed);
    both.run(steps);
  };
  REQUIRE_NOTHROW(support::in_processes(processes, run));
}

}  // namespace

TEST_CASE("in several processes every update is that of one, in the plane") {
  std::uint64_t seed = 1;
  for (const PointKind kind : kFamilies) {
    for (const std::size_t processes : {1, 2, 3, 5}) {
      check_edits<2>(kind, 120, processes, 1 + static_cast<int>(seed % 3), 6, seed);
      ++seed;
    }
  }
  check_edits<2>(PointKind::uniform, 1000, 4, 1, 12, seed);
}

TEST_CASE("in several processes every update is that of one, in space") {
  std::uint64_t seed = 100;
  for (const PointKind kind : {PointKind::clusters, PointKind::grid, PointKind::spread}) {
    for (const std::size_t processes : {2, 5}) check_edits<3>(kind, 20, processes, 1, 2, seed++);
  }
  check_edits<3>(PointKind::uniform, 120, 3, 2, 2, seed);
}

TEST_CASE("more processes than points") {
  for (const std::size_t n : {0, 1, 2, 3, 5}) check_edits<2>(PointKind::uniform, n, 7, 1, 12, n);
  for (const std::size_t n : {0, 1, 3}) check_edits<3>(PointKind::uniform, n, 5, 1, 4, n);
}

TEST_CASE("places are judged when the edits of all processes are made; who is told of a change") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 200, 5);
  for (const std::size_t processes : {1, 2, 3}) {
    CAPTURE(processes);
    REQUIRE_NOTHROW(support::in_processes(processes, [&](auto peers, std::size_t self) {
      JointMesher<2> joint(std::move(peers), support::joint_options<2>(points));
      support::check_places(joint, self, processes);
    }));
    REQUIRE_NOTHROW(support::in_processes(processes, [&](auto peers, std::size_t self) {
      JointMesher<2> joint(std::move(peers), support::joint_options<2>(points));
      support::check_told<mesher::detail::Told>(joint, self, processes);
    }));
  }
}

TEST_CASE("an update that fails in one process is taken back in all") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 400, 4);
  for (const std::size_t processes : {1, 2, 5}) {
    CAPTURE(processes);
    REQUIRE_NOTHROW(support::in_processes(processes, [&](auto peers, std::size_t self) {
      JointMesher<2> joint(std::move(peers), support::joint_options<2>(points));
      support::check_failures(joint, self, processes);
    }));
  }
}

TEST_CASE("processes together have a limit of vertices") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 200, 7);
  auto options = support::joint_options<2>(points);
  options.max_vertices = mesher::mesh_statically<2>(points, options).vertices.size();
  for (const std::size_t processes : {1, 2, 5}) {
    CAPTURE(processes);
    REQUIRE_NOTHROW(support::in_processes(processes, [&](auto peers, std::size_t self) {
      JointMesher<2> joint(std::move(peers), options);
      support::check_too_many(joint, self, processes, points);
    }));
  }
}

TEST_CASE("what is thrown in one process, and options that differ") {
  struct Mine : std::runtime_error {
    Mine() : std::runtime_error("mine") {}
  };
  const auto points = mesher::generate_points<2>(PointKind::uniform, 400, 4);
  support::in_processes(3, [&](std::unique_ptr<Peers> peers, std::size_t self) {
    JointMesher<2> joint(std::move(peers), support::joint_options<2>(points));
    support::JointCase<2, JointMesher<2>> both(joint, self, 3, points, 1);
    if (self == 1) {
      for (std::int64_t i = 1; i <= 300; ++i) {
        joint.move(mesher::PointId{i}, {points[static_cast<std::size_t>(i) - 1][1],
                                        0.25 + 1e-3 * static_cast<double>(i)});
      }
    }
    mesher::RunControl control;
    if (self == 2) control.progress = [](const mesher::Progress&) -> bool { throw Mine(); };
    bool is_mine = false, is_other = false;
    try {
      static_cast<void>(joint.update(control));
    } catch (const Mine&) {
      is_mine = true;
    } catch (const std::runtime_error& other) {
      is_other = std::string(other.what()) == "another process has failed: mine";
    }
    support::demand(self == 2 ? is_mine : is_other, "what is thrown");
    both.check("after what was thrown");
    both.edit(1, std::nullopt);
    both.update("after what was thrown");
  });
  support::in_processes(3, [&](std::unique_ptr<Peers> peers, std::size_t self) {
    auto options = support::joint_options<2>(points);
    if (self == 1) options.rho = 1.5;
    support::demand(support::code_of([&] { JointMesher<2>(std::move(peers), options); }) ==
                        mesher::ErrorCode::bad_option,
                    "options that differ");
  });
  support::in_processes(2, [&](std::unique_ptr<Peers> peers, std::size_t) {
    auto options = support::joint_options<3>(mesher::generate_points<3>(PointKind::uniform, 20, 1));
    options.record_weights = true;
    const std::string said = support::said_by([&] { JointMesher<3>(std::move(peers), options); });
    support::demand(said.find("weights") != std::string::npos, "record_weights: " + said);
  });
  support::in_processes(2, [&](std::unique_ptr<Peers> peers, std::size_t self) {
    auto options = support::joint_options<2>(points);
    if (self == 1) options.rule = mesher::Rule::voronoi_aspect;
    support::demand(support::code_of([&] { JointMesher<2>(std::move(peers), options); }) ==
                        mesher::ErrorCode::bad_option,
                    "options of one that tiles do not have");
  });
}
