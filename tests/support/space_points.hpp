// Points in space of many kinds, and the exact judge's verdict on a mesh of them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/mesh.hpp"
#include "scratch_file.hpp"
#include "test_paths.hpp"

namespace support {

enum class SpaceFamily { uniform, grid, rounded_grid, line_and_circle, sphere, clusters, spread };
inline constexpr SpaceFamily kSpaceFamilies[] = {
    SpaceFamily::uniform,         SpaceFamily::grid,   SpaceFamily::rounded_grid,
    SpaceFamily::line_and_circle, SpaceFamily::sphere, SpaceFamily::clusters,
    SpaceFamily::spread,
};

inline std::string name(SpaceFamily family) {
  constexpr const char* kNames[] = {"uniform", "grid",     "rounded grid", "line and circle",
                                    "sphere",  "clusters", "spread"};
  return kNames[static_cast<int>(family)];
}

/// The i-th of n points of a family, in the unit cube; nearly all differ.
inline mesher::Point<3> space_point(SpaceFamily family, mesher::SplitMix64& random, std::size_t i,
                                    std::size_t n) {
  const auto unit = [&] { return random.unit(); };
  const auto turn = [&](std::size_t k) {
    return 6.283185307179586 * static_cast<double>(k) / (static_cast<double>(n) / 2);
  };
  const auto side = static_cast<std::uint64_t>(std::ceil(std::cbrt(static_cast<double>(n)))) + 1;
  const auto step = [&] { return static_cast<double>(random.below(side)); };
  switch (family) {
    case SpaceFamily::uniform:
      return {unit(), unit(), unit()};
    case SpaceFamily::grid:
      return {step() / 64, step() / 64, step() / 64};
    case SpaceFamily::rounded_grid:
      return {0.1 + step() / 49, step() / 49, step() / 49};
    case SpaceFamily::line_and_circle:
      if (i % 2 == 0) return {0.5, 0.5, static_cast<double>(i) / static_cast<double>(n)};
      return {0.5 + 0.4 * std::cos(turn(i / 2)), 0.5 + 0.4 * std::sin(turn(i / 2)), 0.5};
    case SpaceFamily::sphere: {
      mesher::Point<3> p{unit() - 0.5, unit() - 0.5, unit() - 0.5};
      const double r = 2.5 * std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      for (double& x : p) x = 0.5 + x / r;
      return p;
    }
    case SpaceFamily::clusters: {
      const double r = std::ldexp(0.1, -static_cast<int>(i % 4) * 4);
      const double at = 0.15 + 0.2 * static_cast<double>(i % 4);
      return {at + r * unit(), 1 - at - r * unit(), at + r * unit()};
    }
    case SpaceFamily::spread: {
      const double r = std::pow(10, -12 * unit());
      return {r * unit(), r * unit(), r * unit()};
    }
  }
  return {};
}

/// No two in a finest cell, or nearly so.
inline std::vector<mesher::Point<3>> space_points(SpaceFamily family, std::size_t n,
                                                  std::uint64_t seed) {
  mesher::SplitMix64 random(seed);
  std::vector<mesher::Point<3>> points;
  std::set<std::array<long, 3>> taken;
  for (std::size_t i = 0; i < n; ++i) {
    const auto p = space_point(family, random, i, n);
    const auto cell = [&](std::size_t k) { return std::lround(p[k] * 0x1p46); };
    if (taken.insert({cell(0), cell(1), cell(2)}).second) points.push_back(p);
  }
  return points;
}

/// "" if the exact judge accepts the mesh, or is not there; else what it says.
template <int D>
std::string box_verdict(const mesher::Mesh<D>& mesh, const std::vector<mesher::Point<D>>& input,
                        double rho) {
  const std::string judge = D == 2 ? test_paths::kCgalCheck : test_paths::kCgalCheck3d;
  if (judge.empty()) return "";
  const ScratchFolder folder;
  const auto write = [&](const std::string& file, const std::vector<mesher::Point<D>>& points) {
    std::ofstream out(folder.path(file));
    out.precision(17);
    out << points.size() << ' ' << D << " 0 0\n";
    for (std::size_t i = 0; i < points.size(); ++i) {
      out << i;
      for (const double x : points[i]) out << ' ' << x;
      out << '\n';
    }
  };
  write("mesh.node", mesh.vertices);
  write("input.node", input);
  {
    std::ofstream out(folder.path("mesh.ele"));
    out << mesh.simplices.size() << ' ' << D + 1 << " 0\n";
    for (std::size_t t = 0; t < mesh.simplices.size(); ++t) {
      out << t;
      for (const auto v : mesh.simplices[t]) out << ' ' << v;
      out << '\n';
    }
  }
  const std::string command = judge + ' ' + folder.path("mesh.node") + ' ' +
                              folder.path("mesh.ele") + " --input " + folder.path("input.node") +
                              " --rho " + std::to_string(rho) + " > " + folder.path("verdict") +
                              " 2>&1";
  if (std::system(command.c_str()) == 0) return "";
  std::ifstream in(folder.path("verdict"));
  return {std::istreambuf_iterator<char>(in), {}};
}
inline std::string space_verdict(const mesher::Mesh<3>& mesh,
                                 const std::vector<mesher::Point<3>>& input, double rho) {
  return box_verdict<3>(mesh, input, rho);
}

}  // namespace support
