// The parts of the demonstration. Each prints what it measures and adds its pictures to `files`.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesher/mesher.hpp"
#include "mesher/write.hpp"

namespace demo {

/// Meshes lakes, and moves a harbour wall through one of them.
/// Throws: Error; std::logic_error if the mesh differs from one made from scratch.
void show_lakes(const std::string& path, const std::string& folder, mesher::OutputFiles& files);

/// Meshes points, and removes, adds and moves some of them. Throws: likewise.
void show_cities(const std::string& path, const std::string& folder, mesher::OutputFiles& files);

using Triangles = std::vector<std::array<mesher::Point<2>, 3>>;

/// Seconds of a run, the median of five.
[[nodiscard]] double seconds_of(const std::function<void()>& run);

/// Prints the seconds of updates beside those from scratch. Requires: one update.
void print_seconds(double scratch, std::vector<double> updates);

}  // namespace demo
