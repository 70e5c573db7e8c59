// Time per call of the plane predicates, one JSON line per figure.
//
//   random           coordinates uniform in the unit square: the filter decides
//   grid             squares (incircle) and lines (orient2d) of a grid of side 2^-10: always 0
//   decimal_grid     the same of side 0.01, whose multiples are rounded: nearly, not always, 0
//   near_degenerate  rounded points of one circle or line in the unit square
//   near_axis        the same, crossing an axis: coordinates of very different magnitude
//   widest           the same, with coordinates from 2^-100 to 2^100: the widest integers
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "bench_help.hpp"
#include "mesher/predicates.hpp"

namespace {

using mesher::Point;
using Quad = std::array<Point<2>, 4>;
using Random = std::mt19937_64;

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

Point<2> uniform_point(Random& random) { return {uniform(random, 0, 1), uniform(random, 0, 1)}; }

Quad random_quad(Random& random) {
  return {uniform_point(random), uniform_point(random), uniform_point(random),
          uniform_point(random)};
}

/// Corners of a square of a grid.
Quad grid_square(Random& random, double side) {
  std::uniform_int_distribution<int> cell(0, 1000);
  const int i = cell(random), j = cell(random), k = 1 + cell(random) % 16;
  const auto at = [&](int x, int y) { return Point<2>{x * side, y * side}; };
  return {at(i, j), at(i + k, j), at(i + k, j + k), at(i, j + k)};
}

/// Grid points of a line.
Quad grid_line(Random& random, double side) {
  std::uniform_int_distribution<int> cell(0, 1000);
  const int i = cell(random), j = cell(random), k = 1 + cell(random) % 16, l = cell(random) % 16;
  const auto at = [&](int t) { return Point<2>{(i + t * k) * side, (j + t * l) * side}; };
  return {at(0), at(2), at(5), at(3)};
}

Quad on_circle(Random& random, Point<2> centre, double radius) {
  Quad quad;
  for (Point<2>& p : quad) {
    const double angle = uniform(random, 0, 6.28);
    p = {centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
  }
  return quad;
}

Quad on_line(Random& random, Point<2> from, Point<2> direction) {
  Quad quad;
  for (Point<2>& p : quad) {
    const double t = uniform(random, -1, 1);
    p = {from[0] + t * direction[0], from[1] + t * direction[1]};
  }
  return quad;
}

/// Points of y = x.
Quad widest_line(Random& random) {
  Quad quad;
  for (Point<2>& p : quad) {
    const double x = std::ldexp(uniform(random, 1, 2), -100 + 66 * static_cast<int>(&p - &quad[0]));
    p = {x, x};
  }
  return quad;
}

/// Corners of a rectangle.
Quad widest_circle(Random& random) {
  const double x = 0x1p-100 * uniform(random, 1, 2), y = 0x1p99 * uniform(random, 1, 2);
  return {Point<2>{x, -x}, {y, -x}, {y, x}, {x, x}};
}

/// Prints the nanoseconds per call: the median of 9 passes over 2048 quads.
template <class Make, class Call>
void report(const char* name, Make make, Call call) {
  using Clock = std::chrono::steady_clock;
  constexpr int kRepeats = 40;
  Random random(1);
  std::vector<Quad> quads(2048);
  for (Quad& quad : quads) quad = make(random);
  std::array<double, 9> passes{};
  for (double& ns : passes) {
    const auto start = Clock::now();
    int sum = 0;
    for (int r = 0; r < kRepeats; ++r) {
      for (const Quad& quad : quads) sum += call(quad);
    }
    const std::chrono::duration<double, std::nano> time = Clock::now() - start;
    [[maybe_unused]] volatile int used = sum;
    ns = time.count() / (kRepeats * static_cast<double>(quads.size()));
  }
  std::nth_element(passes.begin(), passes.begin() + 4, passes.end());
  std::printf("{\"name\": \"predicates/%s\", \"ns_per_call\": %.1f}\n", name, passes[4]);
}

int orient(const Quad& q) { return mesher::predicates::orient2d(q[0], q[1], q[2]); }
int incircle(const Quad& q) { return mesher::predicates::incircle(q[0], q[1], q[2], q[3]); }
int perturbed(const Quad& q) {
  return mesher::predicates::incircle_perturbed(q[0], q[1], q[2], q[3]);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const double r = 0.3;
  const auto circle = [=](Random& random) { return on_circle(random, {0.6, 0.5}, r); };
  const auto line = [=](Random& random) { return on_line(random, {0.6, 0.5}, {r, 0.1}); };
  const auto axis_circle = [=](Random& random) { return on_circle(random, {0, r}, r); };
  const auto axis_line = [=](Random& random) { return on_line(random, {0, 0}, {r, 0.1}); };
  const auto square = [](Random& random) { return grid_square(random, 0x1p-10); };
  const auto diagonal = [](Random& random) { return grid_line(random, 0x1p-10); };
  const auto decimal_square = [](Random& random) { return grid_square(random, 0.01); };
  const auto decimal_diagonal = [](Random& random) { return grid_line(random, 0.01); };

  report("orient2d/random", random_quad, orient);
  report("orient2d/grid", diagonal, orient);
  report("orient2d/decimal_grid", decimal_diagonal, orient);
  report("orient2d/near_degenerate", line, orient);
  report("orient2d/near_axis", axis_line, orient);
  report("orient2d/widest", widest_line, orient);

  report("incircle/random", random_quad, incircle);
  report("incircle/grid", square, incircle);
  report("incircle/decimal_grid", decimal_square, incircle);
  report("incircle/near_degenerate", circle, incircle);
  report("incircle/near_axis", axis_circle, incircle);
  report("incircle/widest", widest_circle, incircle);

  report("incircle_perturbed/random", random_quad, perturbed);
  report("incircle_perturbed/grid", square, perturbed);
}
