// What the commands report: figures as JSON, and a short table for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mesher/check.hpp"
#include "mesher/edit_script.hpp"
#include "mesher/mesher.hpp"

namespace tool {

/// Keeps the order in which fields are given.
using Json = nlohmann::ordered_json;

/// The first run of a mesh, or a run from scratch.
struct Run {
  mesher::MeshStats stats;
  mesher::Quality quality;
  double seconds_total = 0;  ///< from the first point inserted to the finished mesh
};

/// Figures of a run, as --stats writes them, with the process's peak memory.
[[nodiscard]] Json json_of(const Run& run);

/// Figures of an update, as --stats of `edit` writes them.
[[nodiscard]] Json json_of(const mesher::Update<2>& update);

/// Prints size, quality and time of a run on standard output.
void print_run(const std::string& input, std::size_t points, const Run& run);

/// Prints the number of updates with their median, 99th percentile and longest time.
/// `seconds`: one per update.
void print_updates(std::vector<double> seconds);

/// Prints the names of the files written.
void print_outputs(const std::vector<std::string>& paths);

}  // namespace tool
