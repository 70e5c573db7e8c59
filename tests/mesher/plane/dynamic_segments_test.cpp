// A mesh of points and segments under edits, against runs from scratch; the leaves' answers.
#include <catch2/catch.hpp>
#include <string>

#include "any_id.hpp"
#include "pslg_follower.hpp"

namespace {

using support::Pslg;
using support::PslgEditor;
using support::PslgJudge;
using support::TracedWorld;

std::string follow(PslgEditor::Family family, std::uint64_t seed, int steps) {
  return support::PslgFollower(family, seed).follow(steps);
}

constexpr PslgEditor::Family kFamilies[] = {
    PslgEditor::Family::uniform, PslgEditor::Family::lattice, PslgEditor::Family::beside,
    PslgEditor::Family::fan,     PslgEditor::Family::wedge,   PslgEditor::Family::steiner};

}  // namespace

TEST_CASE(
    "After every edit of points and segments the mesh is that of a run from scratch, conforms "
    "and keeps its bound") {
  for (const PslgEditor::Family family : kFamilies) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      REQUIRE(follow(family, seed, 45) == "");
    }
  }
}

TEST_CASE("A triangle between two equal legs stays as long as both are there") {
  const mesher::Options<2> options = PslgEditor::options();
  TracedWorld world(options);
  Pslg pslg;
  const auto id = [](int i) { return AnyId{i}; };
  const double angle = 0.25;  // not so small that the legs are split beforehand
  pslg.points = {{1, {4, 4}}, {2, {9, 4}}, {3, {4 + 5 * std::cos(angle), 4 + 5 * std::sin(angle)}}};
  for (const auto& [i, p] : pslg.points) world.insert(mesher::PointId{i}, p);
  const auto update = [&] {
    world.update();
    REQUIRE(world.mesh() == static_mesh(pslg, options));
    const mesher::Mesh<2> mesh = world.mesh();
    const PslgJudge judge(mesh, pslg);
    REQUIRE(judge.fault(options) == "");
    return judge.forced();
  };
  CHECK(update() == 0);
  for (int round = 0; round < 2; ++round) {
    world.insert_segment(id(4), id(1), id(2));
    pslg.segments[{1, 2}] = 4;
    CHECK(update() == 0);
    world.insert_segment(id(5), id(1), id(3));
    pslg.segments[{1, 3}] = 5;
    CHECK(update() == 1);
    world.remove_segment(id(1), id(2));
    pslg.segments.erase({1, 2});
    CHECK(update() == 0);
    world.remove_segment(id(1), id(3));
    pslg.segments.erase({1, 3});
  }
}

TEST_CASE("Long sequences of edits of points and segments follow runs from scratch", "[.soak]") {
  for (std::uint64_t seed = 1000; seed < 1200; ++seed) {
    for (const PslgEditor::Family family : kFamilies) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      REQUIRE(follow(family, seed, 200) == "");
    }
  }
}
