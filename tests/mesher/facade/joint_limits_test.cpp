// Limits of size in several processes, here threads: at every step the mesh, the change and the
// errors are those of one, whatever happens on the way.
#include <catch2/catch.hpp>
#include <memory>

#include "facade/joint_mesher.hpp"
#include "facade/whole_change.hpp"
#include "joint_limits_case.hpp"
#include "rules/mesh_box.hpp"
#include "sizes/region_limits.hpp"
#include "thread_peers.hpp"

namespace {

using mesher::Options;
using mesher::Point;
using mesher::PointKind;
using mesher::detail::JointMesher;
using mesher::detail::Peers;

// check(make, self) in each process; make(options) makes its mesher, once.
template <int D, class Check>
void in_each(std::size_t processes, const Check& check) {
  CAPTURE(D, processes);
  REQUIRE_NOTHROW(
      support::in_processes(processes, [&](std::unique_ptr<Peers> peers, std::size_t self) {
        const auto make = [&](const Options<D>& options) {
          return std::make_unique<JointMesher<D>>(std::move(peers), options);
        };
        check(make, self);
      }));
}

void check_plane(PointKind kind, std::size_t n, std::size_t processes, int steps,
                 std::uint64_t seed) {
  CAPTURE(static_cast<int>(kind), n, seed);
  in_each<2>(processes, [&](const auto& make, std::size_t self) {
    support::check_limits_in_plane(make, self, processes, kind, n, steps, seed);
  });
}
void check_space(PointKind kind, std::size_t n, std::size_t processes, int steps,
                 std::uint64_t seed) {
  CAPTURE(static_cast<int>(kind), n, seed);
  in_each<3>(processes, [&](const auto& make, std::size_t self) {
    support::check_limits_in_space(make, self, processes, kind, n, steps, seed);
  });
}

constexpr PointKind kFamilies[] = {PointKind::uniform, PointKind::clusters,    PointKind::grid,
                                   PointKind::spread,  PointKind::line_circle, PointKind::spiral};

}  // namespace

TEST_CASE("with limits in several processes every update is that of one, in the plane") {
  std::uint64_t seed = 1;
  for (const PointKind kind : kFamilies) {
    for (const std::size_t processes : {1, 2, 3}) check_plane(kind, 40, processes, 5, seed++);
  }
  check_plane(PointKind::uniform, 300, 4, 6, seed++);
  for (const std::size_t n : {0, 1, 3}) check_plane(PointKind::uniform, n, 5, 6, seed++);
}
TEST_CASE("soak: with limits in several processes, the same in the plane", "[.soak][soak]") {
  std::uint64_t seed = 100;
  for (const PointKind kind : kFamilies) {
    for (const std::size_t processes : {2, 3, 5}) check_plane(kind, 60, processes, 16, seed++);
  }
}

TEST_CASE("with limits in several processes every update is that of one, in space") {
  std::uint64_t seed = 1;
  for (const PointKind kind : {PointKind::uniform, PointKind::clusters, PointKind::grid}) {
    for (const std::size_t processes : {2, 3}) check_space(kind, 20, processes, 2, seed++);
  }
}
TEST_CASE("soak: with limits in several processes, the same in space", "[.soak][soak]") {
  std::uint64_t seed = 100;
  for (const PointKind kind : kFamilies) {
    for (const std::size_t processes : {2, 5}) check_space(kind, 30, processes, 8, seed++);
  }
}

TEST_CASE("in several processes limits that cannot be kept are refused as in one") {
  for (const std::size_t processes : {1, 2, 5}) {
    in_each<2>(processes, [&](const auto& make, std::size_t self) {
      support::check_limits_refused(make, self, processes);
    });
  }
}

TEST_CASE("with limits, an update that one process stops, anywhere, is taken back in all") {
  for (const std::size_t processes : {1, 3}) {
    in_each<2>(processes, [&](const auto& make, std::size_t self) {
      support::check_limits_stopped(make, self, processes);
    });
  }
}

TEST_CASE("limits of regions in several processes") {
  const auto points = support::limited_points<2>(PointKind::uniform, 60, 4);
  auto options = support::limited_options<2>(1, {.max_measure = 0.5});
  const auto box = mesher::detail::mesh_box(options);
  const auto regions_with = [&](double measure) {
    auto regions = std::make_shared<mesher::RegionLimits<2>>(box);
    regions->insert({Point<2>{0, 0}, {12, 0}, {6, 14}}, {true, measure, {}});
    regions->insert({Point<2>{12, 0}, {16, 16}, {6, 14}}, {true, 1.0, {}});
    regions->set_measures({measure, 1.0});
    return regions;
  };
  options.region_limits = regions_with(0.1);
  for (const std::size_t processes : {2, 3}) {
    in_each<2>(processes, [&](const auto& make, std::size_t self) {
      const auto joint = make(options);
      support::JointCase<2, JointMesher<2>> both(*joint, self, processes, points, 7);
      for (int step = 0; step < 4; ++step) {
        both.edit_any();
        both.limit(mesher::Box<2>{{3, 3}, {9, 8}}, {.max_measure = step == 1 ? 0.05 : 0.7});
        both.update("step " + std::to_string(step));
      }
    });
    in_each<2>(processes, [&](const auto& make, std::size_t self) {
      auto mine = options;
      if (self == 1) mine.region_limits = regions_with(0.2);
      support::demand(support::code_of([&] { make(mine); }) == mesher::ErrorCode::bad_option,
                      "limits of regions that differ");
    });
  }
}

TEST_CASE("parts that change hands: each process is told of its own") {
  const auto points = support::limited_points<2>(PointKind::uniform, 200, 4);
  in_each<2>(3, [&](const auto& make, std::size_t self) {
    const auto joint = make(support::limited_options<2>(1, {}));
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % 3 == self) joint->insert(mesher::PointId(i + 1), points[i]);
    }
    const auto corners = [&] {
      return mesher::detail::whole_change(joint->own_mesh()).simplices_added;
    };
    static_cast<void>(joint->update());
    auto parts = corners();
    // So many vertices in a corner that most of the domain is of one process.
    if (self == 0) joint->limit({.max_measure = 30});
    if (self == 0) joint->limit({{0, 0}, {3, 3}}, {.max_measure = 0.005});
    const auto change = joint->update({}, mesher::detail::Told::own);
    auto added = change.simplices_added;
    mesher::detail::keep_difference(parts, change.simplices_removed, added);
    support::demand(added.size() == change.simplices_added.size(), "what was not there has gone");
    parts.insert(parts.end(), added.begin(), added.end());
    std::sort(parts.begin(), parts.end());
    auto now = corners();
    std::sort(now.begin(), now.end());
    support::demand(parts == now, "the simplices of a part");
    if (self == 0) support::demand(!change.simplices_removed.empty(), "nothing has gone");
  });
}
