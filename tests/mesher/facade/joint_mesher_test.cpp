// Meshers of several processes, here threads: at every step the mesh, and the change, are those of
// one process, whatever happens on the way.
#include "facade/joint_mesher.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

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

// Edits of some of the points: to places of others, at tiny distances from them, on a coarse grid.
template <int D>
class Beside {
 public:
  explicit Beside(std::uint64_t seed) : random_(seed * 77 + 1) {}

  template <class M>
  void edit_some(support::JointCase<D, M>& both, const mesher::Box<D>& domain) {
    domain_ = domain;
    const std::vector<std::pair<std::int64_t, Point<D>>> all(both.points().begin(),
                                                             both.points().end());
    if (all.empty()) return;
    std::set<std::int64_t> edited;
    const std::uint64_t edits = 1 + random_.below(random_.below(4) == 0 ? 40 : 6);
    for (std::uint64_t i = 0; i < edits; ++i) {
      const auto& [id, p] = all[random_.below(all.size())];
      if (!edited.insert(id).second) continue;
      const Point<D>& other = all[random_.below(all.size())].second;
      const std::uint64_t how = random_.below(10);
      if (how == 0) {
        both.edit(id, std::nullopt);
      } else {
        both.edit(how < 8 ? id : next_++, inside(place(p, other, how)));
      }
    }
  }

 private:
  Point<D> place(Point<D> p, const Point<D>& other, std::uint64_t how) {
    if (how == 1 && random_.below(4) == 0) return other;
    const auto toward_middle = [&](auto&& by) {
      for (std::size_t i = 0; i < D; ++i) p[i] = other[i] + (0.5 - other[i]) * by();
    };
    if (how == 2) {
      for (std::size_t i = 0; i < D; ++i) p[i] = std::nextafter(other[i], 0.5);
      if (random_.below(6) == 0) return p;
      toward_middle([&] { return std::ldexp(1.0, -20 - static_cast<int>(random_.below(24))); });
    } else if (how < 6) {
      toward_middle([&] {
        const int exponent = -static_cast<int>(random_.below(20));
        return std::ldexp(random_.unit(), exponent);
      });
    } else if (how == 6) {
      for (double& x : p) x = std::round(x * 8) / 8;
    } else {
      for (std::size_t i = 0; i < D; ++i) {
        p[i] = domain_.lo[i] + random_.unit() * (domain_.hi[i] - domain_.lo[i]);
      }
    }
    return p;
  }
  Point<D> inside(Point<D> p) const {
    for (std::size_t i = 0; i < D; ++i) {
      p[i] = std::clamp(p[i], domain_.lo[i], domain_.hi[i]);
      if (std::abs(p[i]) < 0x1p-100) p[i] = 0;
    }
    return p;
  }

  mesher::SplitMix64 random_;
  mesher::Box<D> domain_;
  std::int64_t next_ = 100000;
};

// Batches of up to 40 edits, some of which put points where others are. Returns how many were
// refused.
template <int D>
int run_beside(std::size_t processes, std::size_t n, int steps, std::uint64_t seed) {
  CAPTURE(D, n, processes, seed);
  const auto points = mesher::generate_points<D>(kFamilies[seed % (D == 2 ? 5 : 4)], n, seed);
  std::atomic<int> refused{0};
  const auto run = [&](std::unique_ptr<Peers> peers, std::size_t self) {
    const int threads = 1 + static_cast<int>(seed % 2);
    JointMesher<D> joint(std::move(peers), support::joint_options<D>(points, threads));
    support::JointCase<D, JointMesher<D>> both(joint, self, processes, points, seed);
    Beside<D> beside(seed);
    for (int step = 0; step < steps; ++step) {
      beside.edit_some(both, joint.options().domain);
      const bool is_done = both.update("step " + std::to_string(step));
      if (!is_done && self == 0) ++refused;
    }
  };
  REQUIRE_NOTHROW(support::in_processes(processes, run));
  return refused;
}

}  // namespace

TEST_CASE("points come near to others, and onto them, in several processes") {
  int refused = 0;
  for (const std::uint64_t seed : {2, 3, 6, 9, 10, 13}) {
    refused += run_beside<2>(2 + seed % 6, 20 + seed % 7 * 25, 14, seed);
  }
  // A tile knows two neighbours that are nearly one, and nothing near them.
  refused += run_beside<2>(7, 20, 14, 1001);
  for (const std::uint64_t seed : {1, 4}) refused += run_beside<3>(2 + seed, 12, 4, seed);
  REQUIRE(refused > 5);
}

TEST_CASE("soak: points come near to others, and onto them, in several processes",
          "[.soak][soak]") {
  for (std::uint64_t seed = 2000; seed < 2060; ++seed) {
    run_beside<2>(2 + seed % 6, 20 + seed % 7 * 25, 14, seed);
    run_beside<3>(2 + seed % 4, 12 + seed % 5 * 8, 5, seed);
  }
}

TEST_CASE("points of single processes become those of all where there are limits") {
  const auto points = mesher::generate_points<2>(PointKind::uniform, 200, 6);
  for (const std::size_t processes : {2, 3}) {
    CAPTURE(processes);
    REQUIRE_NOTHROW(support::in_processes(processes, [&](auto peers, std::size_t self) {
      JointMesher<2> joint(std::move(peers), support::joint_options<2>(points));
      support::JointCase<2, JointMesher<2>> both(joint, self, processes, points, 3);
      both.run(3);
      support::demand(joint.size() == both.points().size(), "how many points there are");
      const auto all = joint.gather_points(1);
      support::demand(all.size() == (self == 1 ? both.points().size() : 0), "the points");
      // Refused: points stay where they are.
      both.limit(std::nullopt, {.max_measure = 1e-3});
      both.edit(1, both.points().at(2));
      support::demand(!both.update("a limit, and a point onto another"), "it is refused");
      both.run(2);
      both.limit(std::nullopt, {.max_measure = 1e-3});
      both.edit(1, std::nullopt);
      both.update("a limit");
      both.run(2);
      both.limit(std::nullopt, {});
      both.update("no limit");
      support::demand(joint.size() == both.points().size(), "how many points there are");
    }));
  }
}

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
