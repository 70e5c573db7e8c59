// What processes have told each other is certified, or is not all.
#include <catch2/catch.hpp>
#include <exception>

#include "facade/joint_mesher.hpp"
#include "facade/mesh_statically.hpp"
#include "joint_limits_case.hpp"
#include "lossy_peers.hpp"
#include "thread_peers.hpp"
#include "tiles/known_of.hpp"

namespace {

using mesher::Mesh;
using mesher::Point;
using mesher::PointKind;
using mesher::detail::JointMesher;
using mesher::detail::Peers;
using support::Wrong;

struct Outcome {
  std::string fault;  // what the certificate says, or an exception
  std::size_t messages = 0;
  bool is_right = false;  // the mesh
};

// One message of the first process goes wrong, in a first run or in an update.
template <int D>
Outcome outcome(std::size_t processes, std::size_t which, Wrong wrong, bool in_update) {
  const auto points = support::limited_points<D>(PointKind::uniform, D == 2 ? 40 : 24, 11);
  const auto options = support::limited_options<D>(1, {.max_measure = D == 2 ? 2.0 : 0.0});
  auto later = points;
  for (std::size_t i = 0; i < points.size(); i += 4) {
    for (double& x : later[i]) x *= 0.97;
  }
  Outcome all;
  const auto run = [&](std::unique_ptr<Peers> peers, std::size_t self) {
    auto lossy = std::make_unique<support::LossyPeers<D>>(std::move(peers), which, wrong);
    support::LossyPeers<D>& loss = *lossy;
    JointMesher<D> joint(std::move(lossy), options);
    std::size_t asked = 0;
    mesher::RunControl control;  // what goes wrong may go on for ever
    control.progress = [&](const mesher::Progress&) { return ++asked < 1000; };
    const auto update = [&] {
      static_cast<void>(joint.update(control, mesher::detail::Told::own));
    };
    for (std::size_t i = 0; i < points.size() && self == 0; ++i) {
      joint.insert(mesher::PointId(i + 1), points[i]);
    }
    if (in_update) {
      update();
      for (std::size_t i = 0; i < points.size() && self == 0; ++i) {
        joint.move(mesher::PointId(i + 1), later[i]);
      }
    }
    loss.set_lossy(self == 0);
    update();
    loss.set_lossy(false);
    const std::string fault = joint.certificate();
    const Mesh<D> mesh = joint.gather();
    if (self != 0) return;
    all = {fault, loss.messages(),
           mesh == mesher::mesh_statically<D>(in_update ? later : points, options)};
  };
  try {
    support::in_processes(processes, run);
  } catch (const std::exception& error) {
    all.fault = error.what();
  }
  return all;
}

template <int D>
void check_all(std::size_t processes, bool in_update, std::size_t step) {
  CAPTURE(D, processes, in_update);
  const Outcome good = outcome<D>(processes, ~std::size_t{0}, Wrong::lost, in_update);
  REQUIRE(good.fault.empty());
  REQUIRE(good.is_right);
  REQUIRE(good.messages > 20);
  std::size_t tried = 0, noticed = 0;
  for (const Wrong wrong : {Wrong::lost, Wrong::another}) {
    for (std::size_t which = 0; which < good.messages; which += step) {
      CAPTURE(static_cast<int>(wrong), which);
      const Outcome bad = outcome<D>(processes, which, wrong, in_update);
      ++tried;
      if (!bad.fault.empty()) ++noticed;
      REQUIRE((bad.is_right || !bad.fault.empty()));
    }
  }
  CHECK(noticed * 10 > tried * 9);
}

}  // namespace

TEST_CASE("the certificate of several processes sees a message that is lost, or another") {
  check_all<2>(2, false, 7);
  check_all<2>(3, false, 11);
  check_all<2>(2, true, 5);
  check_all<3>(2, false, 61);
}
TEST_CASE("soak: the certificate sees each message that is lost, or another", "[.soak][soak]") {
  for (const bool in_update : {false, true}) {
    for (const std::size_t processes : {2, 3, 4}) {
      check_all<2>(processes, in_update, 1);
      check_all<3>(processes, in_update, 7);
    }
  }
}

TEST_CASE("what is known of a tile is told apart by any part of it") {
  using mesher::detail::KnownOf;
  using mesher::detail::Look;
  const Look<2> look{{1, 2}, 3, {mesher::detail::Stage::steiner, 4, 5, {6, 7}}};
  const auto differs = [&](const Look<2>& other) {
    KnownOf a, b;
    a.add(look), b.add(other);
    return !difference(a, b, 0, 1).empty();
  };
  CHECK_FALSE(differs(look));
  for (int part = 0; part < 7; ++part) {
    Look<2> other = look;
    if (part == 0) other.p[1] = 1;
    if (part == 1) other.radius = 4;
    if (part == 2) other.turn.stage = mesher::detail::Stage::stars;
    if (part == 3) other.turn.rank = 5;
    if (part == 4) other.turn.order = 4;
    if (part == 5) other.turn.p[0] = 7;
    if (part == 6) std::swap(other.p[0], other.p[1]);
    CHECK(differs(other));
  }
}
