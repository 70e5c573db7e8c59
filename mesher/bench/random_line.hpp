// Lines to be edited by benchmarks.
#pragma once

#include <cmath>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/mesh.hpp"

namespace bench {

/// A line of equal pieces from p on that turns by up to 45 degrees at each point: (x, y) moves by
/// (dx, dy) on a diamond, whose circuit is 4, from `at` on it.
inline std::vector<mesher::Point<2>> random_line(const mesher::Point<2>& p, double at, int pieces,
                                                 double piece, mesher::SplitMix64& random) {
  std::vector<mesher::Point<2>> line{p};
  const auto triangle = [](double t) { return std::abs(t - 4 * std::floor(t / 4) - 2) - 1; };
  for (int i = 0; i < pieces; ++i, at += random.unit() - 0.5) {
    const mesher::Point<2>& end = line.back();
    line.push_back({end[0] + piece * triangle(at), end[1] + piece * triangle(at + 1)});
  }
  return line;
}

}  // namespace bench
