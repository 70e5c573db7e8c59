// A mesh of points and segments under edits, against runs from scratch; the leaves' answers.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "pslg_judge.hpp"
#include "random_pslg.hpp"
#include "traced_world.hpp"

namespace {

using support::Pslg;
using support::PslgEditor;
using support::PslgJudge;
using support::TracedWorld;

constexpr std::uint64_t kMostCalls = 20000;

// Lets a world follow a random graph; what is wrong first, "" if nothing is.
class Follower {
 public:
  Follower(PslgEditor::Family family, std::uint64_t seed)
      : family_(family), editor_(family, seed) {}

  // `edits` edits as one update; those of a graph that needs too large a mesh are not made.
  std::string step(int edits) {
    const Pslg before = pslg_;
    support::Recorded recorded;
    for (int i = 0; i < edits; ++i) editor_.edit(pslg_, world_.box(), recorded);
    mesher::Mesh<2> expected;
    try {
      expected = static_mesh(pslg_, options_, kMostCalls);
    } catch (const mesher::Error& error) {
      if (error.code() == mesher::ErrorCode::cancelled) return pslg_ = before, "";
      return refused(before, recorded);
    }
    recorded.replay(world_);
    world_.update();
    if (!(world_.mesh() == expected)) return "not the mesh of a run from scratch";
    if (family_ == PslgEditor::Family::steiner) editor_.look_at(expected);
    world_.engine().check_invariants();
    world_.world().vertices.check_invariants();
    world_.world().segments.check_invariants();
    return PslgJudge(expected, pslg_).fault(options_.rho);
  }
  [[nodiscard]] const TracedWorld& world() const { return world_; }

 private:
  // What a run from scratch refuses, an update does, and leaves what was there.
  std::string refused(const Pslg& before, const support::Recorded& recorded) {
    pslg_ = before;
    const mesher::Mesh<2> mesh = world_.mesh();
    try {
      recorded.replay(world_);
      world_.update();
      return "not refused";
    } catch (const mesher::Error&) {
      return world_.mesh() == mesh ? "" : "a refused update left another mesh";
    }
  }

  mesher::Options<2> options_ = PslgEditor::options();
  PslgEditor::Family family_;
  PslgEditor editor_;
  TracedWorld world_{options_};
  Pslg pslg_;
};

std::string follow(PslgEditor::Family family, std::uint64_t seed, int steps) {
  Follower follower(family, seed);
  for (int i = 0; i < steps; ++i) {
    const std::string fault = follower.step(i == 0 ? 25 : i % 7 == 0 ? 6 : 1);
    if (!fault.empty()) return "step " + std::to_string(i) + ": " + fault;
  }
  const auto& audit = follower.world().engine().audit();
  if (audit.duplicates != 0) return "two calls " + audit.first_duplicate;
  if (audit.reordered != 0) return "made anew " + audit.first_reordered;
  return "";
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
  const auto id = [](int i) { return mesher::FeatureId{i}; };
  const double angle = 0.25;  // not so small that the legs are split beforehand
  pslg.points = {{1, {4, 4}}, {2, {9, 4}}, {3, {4 + 5 * std::cos(angle), 4 + 5 * std::sin(angle)}}};
  for (const auto& [i, p] : pslg.points) world.insert(mesher::FeatureId{i}, p);
  const auto update = [&] {
    world.update();
    REQUIRE(world.mesh() == static_mesh(pslg, options));
    const mesher::Mesh<2> mesh = world.mesh();
    const PslgJudge judge(mesh, pslg);
    REQUIRE(judge.fault(options.rho) == "");
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
