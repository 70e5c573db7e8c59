// Points of the unit circle, computed the same on every machine.
#pragma once

#include "mesher/mesh.hpp"

namespace mesher {

/// The point after `turns` >= 0 turns from (1, 0). Only + - * / and roundings of doubles.
[[nodiscard]] Point<2> on_circle(double turns);

}  // namespace mesher
