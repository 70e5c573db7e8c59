// Meshes with a largest area under edits, against runs from scratch.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/sizes.hpp"
#include "pslg_follower.hpp"

namespace {

using support::PslgEditor;
using support::PslgFollower;

constexpr PslgEditor::Family kFamilies[] = {
    PslgEditor::Family::uniform, PslgEditor::Family::lattice, PslgEditor::Family::beside,
    PslgEditor::Family::fan,     PslgEditor::Family::wedge,   PslgEditor::Family::steiner,
    PslgEditor::Family::filled};

// The pitch of the lattice is 1 for the first; a point of the lattice family is on it now and then.
constexpr double kAreas[] = {0.4375, 0.2, 3};

std::string follow(PslgEditor::Family family, std::uint64_t seed, double area, int steps) {
  mesher::Options<2> options = PslgEditor::options();
  options.max_measure = area;
  return PslgFollower(family, seed, options).follow(steps);
}

}  // namespace

TEST_CASE(
    "With a largest area, the mesh after every edit is that of a run from scratch, conforms, keeps "
    "its bound, and no triangle is larger") {
  for (const PslgEditor::Family family : kFamilies) {
    for (const double area : kAreas) {
      INFO("family " << static_cast<int>(family) << " area " << area);
      REQUIRE(follow(family, 1, area, 30) == "");
    }
  }
}

TEST_CASE("The same with sizes that vary: by a slope, in steps, by a background") {
  const auto sloped = [](const mesher::Point<2>& p) {
    return 0.7 + 0.3 * std::hypot(p[0] - 7, p[1] - 9);
  };
  std::vector<mesher::SizeSample<2>> samples;
  mesher::SplitMix64 random(9);
  for (int i = 0; i < 30; ++i) {
    samples.push_back({{16 * random.unit(), 16 * random.unit()}, 0.8 + 3 * random.unit()});
  }
  const std::shared_ptr<const mesher::SizeField<2>> fields[] = {
      std::make_shared<mesher::SlopedSizes<2>>(sloped, 0.3, 0.7),
      std::make_shared<support::Chessboard>(), mesher::sampled_sizes(samples)};
  for (const PslgEditor::Family family : kFamilies) {
    for (std::size_t i = 0; i < std::size(fields); ++i) {
      mesher::Options<2> options = PslgEditor::options();
      options.sizes = fields[i];
      if (i == 0) options.max_measure = 2;
      INFO("family " << static_cast<int>(family) << " field " << i);
      REQUIRE(PslgFollower(family, 2, options).follow(20) == "");
    }
  }
}

TEST_CASE(
    "Limits are edited, too, everywhere and in boxes: after every update the mesh and the trace "
    "are those of a run from scratch") {
  for (const PslgEditor::Family family : kFamilies) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      PslgFollower follower(family, seed);
      follower.edit_limits(seed);
      REQUIRE(follower.follow(25) == "");
    }
  }
}

TEST_CASE("Long sequences of edits with edited limits follow runs from scratch", "[.soak]") {
  for (std::uint64_t seed = 1000; seed < 1060; ++seed) {
    for (const PslgEditor::Family family : kFamilies) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      PslgFollower follower(family, seed);
      follower.edit_limits(seed);
      REQUIRE(follower.follow(150) == "");
    }
  }
}

TEST_CASE("Long sequences of edits with a largest area follow runs from scratch", "[.soak]") {
  for (std::uint64_t seed = 1000; seed < 1060; ++seed) {
    for (const PslgEditor::Family family : kFamilies) {
      for (const double area : kAreas) {
        INFO("family " << static_cast<int>(family) << " seed " << seed << " area " << area);
        REQUIRE(follow(family, seed, area, 150) == "");
      }
    }
  }
}
