// Where two segments cross, rounded once.
#pragma once

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// The nearest coordinate that an input may have: 0, or of magnitude 2^-100 and more.
[[nodiscard]] double allowed(double x);

/// The place where ab and cd cross: that of twice the precision of doubles, rounded, and in the
/// boxes of both. If it is a pair of doubles, it is just that (but for angles near 2^-50).
/// Requires: they cross, and are not on one line.
[[nodiscard]] Point<2> crossing_place(const Point<2>& a, const Point<2>& b, const Point<2>& c,
                                      const Point<2>& d);

}  // namespace mesher::detail
