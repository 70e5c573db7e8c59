// Slots: after every edit the arrays are mesh() with other numbers, what stays has its slot, and
// the change names what came and went.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <stdexcept>

#include "edit_sequence.hpp"
#include "facade/box_mesher.hpp"
#include "feature_ids.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/mesher.hpp"
#include "random_lake.hpp"
#include "rules/mesh_box.hpp"
#include "slot_twin.hpp"
#include "space_parcels.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Change;
using mesher::Options;
using mesher::Slot;
using support::id;
using support::LakeEditor;
using support::Shown;
using support::SlotTwin;

// What a solver knows by slots alone.
template <int D>
struct KeptTwin {
  std::set<Slot> kept;
  void follow(const mesher::DomainUpdate<D>& update) {
    for (const Slot s : update.kept.removed) REQUIRE(kept.erase(s) == 1);
    for (const Slot s : update.kept.added) REQUIRE(kept.insert(s).second);
  }
  void require(const mesher::Mesher<D>& m, const SlotTwin<D>& twin) const {
    for (const auto& [corners, slot] : twin.simplices()) {
      REQUIRE(m.keeps(slot) == kept.contains(slot));
      REQUIRE(m.label(slot) == m.label(corners));
    }
  }
};

// Stops an update once it has told how far it is. False if it was done before that.
template <class M>
bool stop_update(M& m, std::uint64_t after) {
  std::uint64_t told = 0;
  try {
    m.update({.progress = [&](const mesher::Progress&) { return ++told <= after; }, .stop = {}});
    return false;
  } catch (const mesher::Error& error) {
    REQUIRE(error.code() == mesher::ErrorCode::cancelled);
    return true;
  }
}

}  // namespace

TEST_CASE("after random edits of points the arrays are the mesh, and the change is exact") {
  for (const auto family : support::kFamilies) {
    const auto sequence = support::random_sequence(family, {}, 24, 40, 11);
    INFO(support::name(family));
    BoxMesher<2> m(sequence.options);
    m.keep_slots(true);
    SlotTwin<2> twin;
    support::PointSet points;
    for (const auto& step : sequence.steps) {
      try {
        for (const auto& edit : step) support::perform(edit, m, points);
        const Change<2> change = m.update();
        twin.follow(change, m.live());
      } catch (const mesher::Error&) {
        break;
      }
      twin.require(m.live(), m.mesh());
    }
    m.check_invariants();
  }
}

TEST_CASE("after random batches in the plane slots follow the mesh and what is kept of it") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5, 6);
  CAPTURE(seed);
  LakeEditor editor(seed);
  const auto extent = seed % 3 == 0 ? mesher::Extent::box : mesher::Extent::enclosed;
  Options<2> options = LakeEditor::options();
  options.extent = extent;
  mesher::Mesher<2> m(options);
  m.keep_slots(true);
  support::Lake lake;
  const auto box = mesher::detail::mesh_box(LakeEditor::options());
  SlotTwin<2> twin;
  KeptTwin<2> kept;
  int refused = 0;
  for (int step = 0; step < 60; ++step) {
    CAPTURE(step);
    support::Lake next = lake;
    auto batch = editor.batch(next);
    if (next.is_valid(box)) {
      const auto update = mesher::apply(std::move(batch), m);
      twin.follow(update.change, m.live());
      kept.follow(update.change);
      lake = next;
    } else {
      const Shown<2> before(m.live());
      CHECK_THROWS_AS(mesher::apply(std::move(batch), m), mesher::Error);
      REQUIRE(Shown<2>(m.live()) == before);
      ++refused;
    }
    twin.require(m.live(), m.box_mesh());
    kept.require(m, twin);
  }
  m.check_invariants();
  CHECK(refused > 0);
}

TEST_CASE("after random edits in space slots follow the mesh, its edges and faces on features") {
  const std::uint64_t seed = GENERATE(1, 2, 3);
  CAPTURE(seed);
  BoxMesher<3> m(Options<3>{.domain = {{0, 0, 0}, {2, 2, 2}}});
  m.keep_slots(true);
  support::SpaceParcels<BoxMesher<3>> parcels(m, seed);
  SlotTwin<3> twin;
  int refused = 0;
  for (int round = 0; round < 20; ++round) {
    CAPTURE(round);
    Change<3> change;
    const Shown<3> before(m.live());
    const auto count = round == 0 ? 5 : 1 + parcels.below(3);
    if (parcels.edit_and(count, [&] { change = m.update(); })) {
      twin.follow(change, m.live());
    } else {
      ++refused;
      REQUIRE(Shown<3>(m.live()) == before);
    }
    twin.require(m.live(), m.mesh());
  }
  m.check_invariants();
  CHECK(refused < 15);
}

TEST_CASE("in space slots follow what polygons enclose") {
  const std::uint64_t seed = GENERATE(1, 2);
  CAPTURE(seed);
  mesher::Mesher<3> m(Options<3>{.domain = {{0, 0, 0}, {2, 2, 2}}});
  m.keep_slots(true);
  support::SpaceParcels<mesher::Mesher<3>> parcels(m, seed);
  SlotTwin<3> twin;
  KeptTwin<3> kept;
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    mesher::DomainUpdate<3> update;
    const auto count = round == 0 ? 5 : 1 + parcels.below(3);
    if (!parcels.edit_and(count, [&] { update = m.update(); })) continue;
    twin.follow(update, m.live());
    kept.follow(update);
    twin.require(m.live(), m.box_mesh());
    kept.require(m, twin);
  }
}

TEST_CASE(
    "slots are a function of the updates that succeeded: what fails or is stopped leaves no "
    "trace") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4);
  CAPTURE(seed);
  LakeEditor editor(seed), mistakes(seed + 100);
  mesher::Mesher<2> straight(LakeEditor::options()), stumbling(LakeEditor::options());
  straight.keep_slots(true);
  stumbling.keep_slots(true);
  const auto box = mesher::detail::mesh_box(LakeEditor::options());
  support::Lake lake;
  int failed = 0, stopped = 0;
  for (int step = 0; step < 60; ++step) {
    CAPTURE(step);
    support::Lake wrong = lake;
    auto mistake = mistakes.batch(wrong);
    if (step > 0 && !wrong.is_valid(box)) {
      CHECK_THROWS_AS(mesher::apply(std::move(mistake), stumbling), mesher::Error);
      ++failed;
    }
    support::Lake next = lake;
    const auto batch = editor.batch(next);
    if (!next.is_valid(box)) continue;
    for (const auto& edit : mesher::announcing_order(batch)) announce(edit, stumbling);
    if (stop_update(stumbling, seed % 2)) {
      ++stopped;
      stumbling.update();
    }
    mesher::apply(batch, straight);
    lake = next;
    REQUIRE(Shown<2>(straight.live()) == Shown<2>(stumbling.live()));
  }
  stumbling.check_invariants();
  CHECK(failed > 0);
  CHECK(stopped > 3);
}

TEST_CASE(
    "slots begin with the numbers of mesh(), and begin so again when they are asked for again") {
  BoxMesher<2> m(Options<2>{.domain = {{0, 0}, {1, 1}}});
  CHECK_FALSE(m.keeps_slots());
  CHECK(m.live().vertex_slots() == 0);
  CHECK(m.keeps_slots());
  CHECK(m.live().find({0.25, 0.5}) == mesher::kNoSlot);
  m.insert(id(1), {0.25, 0.5});
  m.insert(id(2), {0.75, 0.5});
  const Change<2> first = m.update();
  const auto is_mesh = [&] {
    const auto mesh = m.mesh();
    const auto points = m.live().points();
    const auto triangles = m.live().simplices();
    return std::equal(points.begin(), points.end(), mesh.vertices.begin(), mesh.vertices.end()) &&
           std::equal(triangles.begin(), triangles.end(), mesh.simplices.begin(),
                      mesh.simplices.end());
  };
  CHECK(is_mesh());
  CHECK(first.slots.vertices_added.size() == first.vertices_added.size());
  m.insert(id(3), {0.5, 0.8});
  m.update();
  CHECK_FALSE(is_mesh());
  m.keep_slots(false);
  CHECK_FALSE(m.keeps_slots());
  m.remove(id(3));
  CHECK(m.update().slots == mesher::SlotChange());
  m.keep_slots(true);
  CHECK(is_mesh());
  m.check_invariants();
}

TEST_CASE("a last word that refuses the change leaves the slots of the last update") {
  BoxMesher<2> m(Options<2>{.domain = {{0, 0}, {1, 1}}});
  m.keep_slots(true);
  m.insert(id(1), {0.25, 0.5});
  const auto refuse = [](const Change<2>& change) {
    CHECK(change.slots.vertices_added.size() == change.vertices_added.size());
    throw std::runtime_error("no");
  };
  CHECK_THROWS_AS(m.update({}, refuse), std::runtime_error);
  CHECK(Shown<2>(m.live()) == Shown<2>());
  m.insert(id(1), {0.25, 0.5});
  m.update();
  const Shown<2> before(m.live());
  m.insert(id(2), {0.26, 0.5});
  CHECK_THROWS_AS(m.update({}, refuse), std::runtime_error);
  CHECK(Shown<2>(m.live()) == before);
  m.check_invariants();
}
