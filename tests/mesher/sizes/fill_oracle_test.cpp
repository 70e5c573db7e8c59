// Meshes with a largest area under edits, against runs from scratch.
#include <catch2/catch.hpp>

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
  options.max_area = area;
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
