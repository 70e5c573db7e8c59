// Points for tests of Delaunay triangulations, and what a triangulation must be: by its definition,
// and by the exact judge.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "mesher/delaunay.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"
#include "scratch_file.hpp"
#include "test_paths.hpp"

namespace support {

/// Simplices as sets of corners.
template <int D>
using SimplexSet = std::set<std::array<std::uint32_t, D + 1>>;

template <int D, class Simplices>
SimplexSet<D> as_set(const Simplices& simplices) {
  SimplexSet<D> set;
  for (auto s : simplices) {
    std::sort(s.begin(), s.end());
    set.insert(s);
  }
  return set;
}

/// The same with the places of corners in place of their numbers.
template <int D>
using PlacedSet = std::set<std::array<mesher::Point<D>, D + 1>>;

template <int D, class Place>
PlacedSet<D> placed_set(const mesher::Delaunay<D>& t, Place&& place) {
  PlacedSet<D> set;
  for (const auto& s : t.simplices) {
    std::array<mesher::Point<D>, D + 1> corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = place(s[i]);
    std::sort(corners.begin(), corners.end());
    set.insert(corners);
  }
  return set;
}
template <int D>
PlacedSet<D> fresh_set(const std::vector<mesher::Point<D>>& points) {
  return placed_set<D>(mesher::delaunay<D>(points), [&](std::uint32_t i) { return points[i]; });
}

inline int orientation(const std::array<mesher::Point<2>, 3>& q) {
  return mesher::predicates::orient2d(q[0], q[1], q[2]);
}
inline int orientation(const std::array<mesher::Point<3>, 4>& q) {
  return mesher::predicates::orient3d(q[0], q[1], q[2], q[3]);
}
inline int in_ball(const std::array<mesher::Point<2>, 3>& q, const mesher::Point<2>& p) {
  return mesher::predicates::incircle_perturbed(q[0], q[1], q[2], p);
}
inline int in_ball(const std::array<mesher::Point<3>, 4>& q, const mesher::Point<3>& p) {
  return mesher::predicates::insphere_perturbed(q[0], q[1], q[2], q[3], p);
}

/// All simplices that are not flat and have every other point outside. Requires: no equal points.
template <int D>
SimplexSet<D> by_definition(const std::vector<mesher::Point<D>>& points) {
  SimplexSet<D> all;
  std::array<std::uint32_t, D + 1> s;
  const auto n = static_cast<std::uint32_t>(points.size());
  const auto look = [&] {
    std::array<mesher::Point<D>, D + 1> q;
    for (std::size_t i = 0; i <= D; ++i) q[i] = points[s[i]];
    const int sign = orientation(q);
    bool empty = sign != 0;
    for (std::uint32_t p = 0; p < n && empty; ++p) {
      if (std::find(s.begin(), s.end(), p) == s.end()) empty = in_ball(q, points[p]) * sign < 0;
    }
    if (empty) all.insert(s);
  };
  const auto choose = [&](const auto& self, std::size_t k, std::uint32_t from) -> void {
    if (k == D + 1) return look();
    for (std::uint32_t i = from; i < n; ++i) s[k] = i, self(self, k + 1, i + 1);
  };
  choose(choose, 0, 0);
  return all;
}

/// Kinds of points; most have many ties, or all points on a line or in a plane.
enum class Kind { uniform, grid, rounded_grid, ball, line, plane, spread, walls };
inline constexpr Kind kKinds[] = {Kind::uniform, Kind::grid,  Kind::rounded_grid, Kind::ball,
                                  Kind::line,    Kind::plane, Kind::spread,       Kind::walls};
inline std::string name(Kind kind) {
  constexpr const char* kNames[] = {"uniform", "grid",  "rounded grid", "ball",
                                    "line",    "plane", "spread",       "walls"};
  return kNames[static_cast<int>(kind)];
}

/// A point of a kind, of a set of about n; it may come twice.
template <int D>
mesher::Point<D> point_of(Kind kind, std::size_t n, mesher::SplitMix64& random) {
  const auto side =
      static_cast<std::uint64_t>(std::ceil(std::pow(static_cast<double>(n), 1.0 / D))) + 1;
  const auto step = [&] { return static_cast<double>(random.below(side)); };
  mesher::Point<D> p;
  switch (kind) {
    case Kind::uniform:
      for (double& x : p) x = random.unit();
      break;
    case Kind::grid:
      for (double& x : p) x = step() - 2;
      break;
    case Kind::rounded_grid:
      for (double& x : p) x = 0.1 + step() / 49;
      break;
    case Kind::ball: {  // 3^2 + 4^2 = 5^2 and the like: exactly on circles and spheres around 0
      p.fill(0);
      constexpr int kOn[5][3] = {{5, 0, 0}, {3, 4, 0}, {4, 3, 0}, {0, 5, 0}, {0, 3, 4}};
      const auto& on = kOn[random.below(D == 2 ? 4 : 5)];
      const std::uint64_t turn = D == 2 ? 0 : random.below(3);
      for (std::size_t i = 0; i < D; ++i) {
        p[(i + turn) % D] = random.below(2) == 0 ? on[i] : -on[i];
      }
      break;
    }
    case Kind::line:
      p.fill(step());
      if (random.below(16) == 0) p[0] = step();
      break;
    case Kind::plane:
      for (double& x : p) x = step();
      if (random.below(8) != 0) p[D - 1] = p[0];
      break;
    case Kind::spread:
      for (double& x : p) {
        const double fraction = random.unit() + 0x1p-60;
        x = std::ldexp(fraction, -static_cast<int>(random.below(46)));
      }
      break;
    case Kind::walls: {  // of a box
      for (double& x : p) x = step();
      const std::uint64_t axis = random.below(D);
      p[axis] = random.below(2) == 0 ? 0 : static_cast<double>(side);
      break;
    }
  }
  return p;
}

/// n draws, each place kept once.
template <int D>
std::vector<mesher::Point<D>> distinct_points(Kind kind, std::size_t n, std::uint64_t seed) {
  mesher::SplitMix64 random(seed);
  std::set<mesher::Point<D>> seen;
  std::vector<mesher::Point<D>> points;
  for (std::size_t i = 0; i < n; ++i) {
    const auto p = point_of<D>(kind, n, random);
    if (seen.insert(p).second) points.push_back(p);
  }
  return points;
}

template <class T>
void shuffle(std::vector<T>& items, mesher::SplitMix64& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

/// Adds the corners of the points' bounding box, as far as they are not there: the judge wants a
/// box.
template <int D>
void add_corners(std::vector<mesher::Point<D>>& points) {
  mesher::Point<D> lo = points.front(), hi = lo;
  for (const auto& p : points) {
    for (std::size_t i = 0; i < D; ++i)
      lo[i] = std::min(lo[i], p[i]), hi[i] = std::max(hi[i], p[i]);
  }
  for (int corner = 0; corner < 1 << D; ++corner) {
    mesher::Point<D> p;
    for (std::size_t i = 0; i < D; ++i) p[i] = (corner >> i & 1) != 0 ? hi[i] : lo[i];
    if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
  }
}

/// "" if the exact judge accepts the triangulation of points whose hull is a box, or is not there;
/// else what it says.
template <int D>
std::string delaunay_verdict(const std::vector<mesher::Point<D>>& points,
                             const mesher::Delaunay<D>& t) {
  const std::string judge = D == 2 ? test_paths::kCgalCheck : test_paths::kCgalCheck3d;
  if (judge.empty()) return "";
  const ScratchFolder folder;
  {
    std::ofstream nodes(folder.path("t.node")), elements(folder.path("t.ele"));
    nodes.precision(17);
    nodes << points.size() << ' ' << D << " 0 0\n";
    for (std::size_t i = 0; i < points.size(); ++i) {
      nodes << i;
      for (const double x : points[i]) nodes << ' ' << x;
      nodes << '\n';
    }
    elements << t.simplices.size() << ' ' << D + 1 << " 0\n";
    for (std::size_t s = 0; s < t.simplices.size(); ++s) {
      elements << s;
      for (const auto v : t.simplices[s]) elements << ' ' << v;
      elements << '\n';
    }
  }
  const std::string command = judge + ' ' + folder.path("t.node") + ' ' + folder.path("t.ele") +
                              " > " + folder.path("verdict") + " 2>&1";
  if (std::system(command.c_str()) == 0) return "";
  return folder.read("verdict");
}

}  // namespace support
