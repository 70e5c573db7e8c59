// What the predicates in space cost: random points, points on a grid's plane or cube, nearly
// degenerate ones, and the widest that there are. One JSON line per figure.
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
using Random = std::mt19937_64;
using Five = std::array<Point<3>, 5>;

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

template <class Coordinate>
Five five_of(Coordinate coordinate) {
  Five five;
  for (Point<3>& p : five) p = {coordinate(0), coordinate(1), coordinate(2)};
  return five;
}

Five random_five(Random& random) {
  return five_of([&](int) { return uniform(random, 0, 1); });
}

/// Corners of a cube of a grid, the first four of one face.
Five grid_cube(Random& random) {
  Point<3> at;
  for (double& x : at) x = 0x1p-10 * static_cast<double>(random() % 1024);
  const auto corner = [&](int i, int j, int k) {
    return Point<3>{at[0] + i * 0x1p-10, at[1] + j * 0x1p-10, at[2] + k * 0x1p-10};
  };
  return {corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0), corner(1, 0, 1)};
}

Five near_plane(Random& random) {
  Five five = random_five(random);
  for (Point<3>& p : five) p[2] = 0.3 * p[0] + 0.7 * p[1];
  return five;
}

Five near_sphere(Random& random) {
  Five five;
  for (Point<3>& p : five) {
    const double z = uniform(random, -1, 1), angle = uniform(random, 0, 6.283185307179586);
    const double r = std::sqrt(1 - z * z);
    p = {0.5 + 0.3 * r * std::cos(angle), 0.5 + 0.3 * r * std::sin(angle), 0.5 + 0.3 * z};
  }
  return five;
}

/// Corners of a box between 2^-100 and 2^100.
Five widest(Random& random) {
  const double x = 0x1p-100 * uniform(random, 1, 2), y = 0x1p99 * uniform(random, 1, 2);
  return {Point<3>{x, x, x}, {y, x, x}, {y, y, x}, {x, y, x}, {x, x, y}};
}

/// Prints the nanoseconds per call: the median of 9 passes over 1024 fives.
template <class Call>
void report(const char* name, Five (*make)(Random&), Call call) {
  using Clock = std::chrono::steady_clock;
  constexpr int kRepeats = 20;
  Random random(1);
  std::vector<Five> fives(1024);
  for (Five& five : fives) five = make(random);
  std::array<double, 9> passes{};
  for (double& ns : passes) {
    const auto start = Clock::now();
    int sum = 0;
    for (int r = 0; r < kRepeats; ++r) {
      for (const Five& five : fives) sum += call(five);
    }
    const std::chrono::duration<double, std::nano> time = Clock::now() - start;
    [[maybe_unused]] volatile int used = sum;
    ns = time.count() / (kRepeats * static_cast<double>(fives.size()));
  }
  std::nth_element(passes.begin(), passes.begin() + 4, passes.end());
  std::printf("{\"name\": \"predicates3d/%s\", \"ns_per_call\": %.1f}\n", name, passes[4]);
}

int orient(const Five& q) { return mesher::predicates::orient3d(q[0], q[1], q[2], q[3]); }
int insphere(const Five& q) { return mesher::predicates::insphere(q[0], q[1], q[2], q[3], q[4]); }
int perturbed(const Five& q) {
  return mesher::predicates::insphere_perturbed(q[0], q[1], q[2], q[3], q[4]);
}

/// The last point is near the sphere of half the radius around the first 2, 3 or 4.
template <std::size_t N>
Five near_half(Random& random) {
  Five five = near_sphere(random);
  Point<3> centre{0.5, 0.5, 0.5};
  if (N == 2) {
    for (std::size_t i = 0; i < 3; ++i) five[1][i] = 1 - five[0][i];
  } else if (N == 3) {
    for (Point<3>& p : five) p[2] = 0.5;
    const auto onto = [&](Point<3>& p) {
      const double x = p[0] - 0.5, y = p[1] - 0.5, scale = 0.3 / std::hypot(x, y);
      p[0] = 0.5 + scale * x;
      p[1] = 0.5 + scale * y;
    };
    for (Point<3>& p : five) onto(p);
  }
  for (std::size_t i = 0; i < 3; ++i) five[4][i] = centre[i] + (five[4][i] - centre[i]) / 2;
  return five;
}

int segment_ball(const Five& q) {
  return mesher::predicates::in_shrunken_ball(q[0], q[1], q[4], 0.5);
}
int triangle_ball(const Five& q) {
  return mesher::predicates::in_shrunken_ball(q[0], q[1], q[2], q[4], 0.5);
}
int tetrahedron_ball(const Five& q) {
  return mesher::predicates::in_shrunken_ball(q[0], q[1], q[2], q[3], q[4], 0.5);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  report("orient3d/random", random_five, orient);
  report("orient3d/grid", grid_cube, orient);
  report("orient3d/near_degenerate", near_plane, orient);
  report("orient3d/widest", widest, orient);
  report("insphere/random", random_five, insphere);
  report("insphere/grid", grid_cube, insphere);
  report("insphere/near_degenerate", near_sphere, insphere);
  report("insphere/widest", widest, insphere);
  report("insphere_perturbed/grid", grid_cube, perturbed);
  report("in_shrunken_ball/segment/random", random_five, segment_ball);
  report("in_shrunken_ball/segment/near_degenerate", near_half<2>, segment_ball);
  report("in_shrunken_ball/segment/widest", widest, segment_ball);
  report("in_shrunken_ball/triangle/random", random_five, triangle_ball);
  report("in_shrunken_ball/triangle/near_degenerate", near_half<3>, triangle_ball);
  report("in_shrunken_ball/triangle/widest", widest, triangle_ball);
  report("in_shrunken_ball/tetrahedron/random", random_five, tetrahedron_ball);
  report("in_shrunken_ball/tetrahedron/near_degenerate", near_half<4>, tetrahedron_ball);
  report("in_shrunken_ball/tetrahedron/widest", widest, tetrahedron_ball);
}
