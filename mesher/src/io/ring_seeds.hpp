// Positions just inside rings, from which a flood stopped by lines would start.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher {

/// A closed ring of places, the last one equal to the first.
using Ring = std::vector<Point<2>>;

/// What is asked: a place inside `outer` and outside each of `inner`, beside one of these rings.
struct SeedQuestion {
  const Ring* outer;
  std::vector<const Ring*> inner;
};

/// For each question a place such that no line of `lines` lies between it and one of its rings, on
/// a horizontal line; nothing where doubles leave no room. `lines`: pairs of ends, the rings' own
/// among them. The answer depends on the places alone.
/// Cost: O((lines + questions) log questions + crossings of the horizontal lines).
[[nodiscard]] std::vector<std::optional<Point<2>>> find_seeds(
    const std::vector<SeedQuestion>& questions, const std::vector<std::array<Point<2>, 2>>& lines);

}  // namespace mesher
