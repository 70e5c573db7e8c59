// The reports of the commands: figures as JSON, and a short table for people.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "arguments.hpp"
#include "input.hpp"
#include "mesher/check.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/mesher.hpp"
#include "mesher/meshing.hpp"
#include "mesher/out_of_core.hpp"
#include "mesher/reports.hpp"

namespace tool {

/// "1 point", "2 points".
[[nodiscard]] inline std::string counted(std::size_t n, const std::string& what) {
  return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
}

/// Keeps the order in which fields are given.
using Json = nlohmann::ordered_json;

/// What is wanted of a mesh: what lines, or in space polygons, enclose.
template <int D>
using Kept = mesher::DomainMesh<D>;

/// The first run of a mesh, or a run from scratch.
struct AnyRun {
  mesher::MeshStats stats;    ///< of the box
  std::size_t above_rho = 0;  ///< simplices kept, at small angles of the input
  std::size_t vertices = 0;   ///< kept
  std::size_t simplices = 0;  ///< kept
  std::size_t points = 0;     ///< of the input, kept
  std::size_t regions = 0;    ///< kept
  std::size_t holes = 0;
  std::size_t faults = 0;    ///< seeds without a region of their own
  double seconds_total = 0;  ///< from the first point inserted to the finished mesh
  std::string algorithm;     ///< empty: there was no choice
  std::size_t rounds = 0;    ///< meshes until periodic sides agreed; 0: there are none
  std::optional<mesher::OutOfCoreReport> tiles;  ///< of --out-of-core
  /// What happened in svr or refine, if it was asked for; `warped` and on are of svr.
  std::optional<mesher::SvrStats> refinement;
};
struct Run : AnyRun {
  mesher::Quality quality;                    ///< of what is kept
  double min_angle_within_rho = 0;            ///< degrees; off triangles above rho
  std::optional<mesher::AngleReport> angles;  ///< of the box, if it was asked for
};
/// In space.
struct SpaceRun : AnyRun {
  mesher::SpaceQuality quality;              ///< of what is kept
  std::optional<mesher::GuardReport> guard;  ///< of the box, if it was asked for
};

template <int D>
using RunOf = std::conditional_t<D == 2, Run, SpaceRun>;

/// An update of a script by a mesher that knows of domains.
using DomainStep = mesher::Update<2, mesher::DomainUpdate<2>>;
/// The same in space.
using SpaceStep = mesher::Update<3, mesher::DomainUpdate<3>>;

/// Sizes and quality of what is kept.
void measure(const Kept<2>& mesh, double rho, Run& run);
void measure(const Kept<3>& mesh, double rho, SpaceRun& run);

/// Figures of a run, as --stats writes them, with the process's peak memory.
[[nodiscard]] Json json_of(const Run& run);
[[nodiscard]] Json json_of(const SpaceRun& run);

/// Figures of an update, as --stats of `edit` writes them.
[[nodiscard]] Json json_of(const DomainStep& update);
[[nodiscard]] Json json_of(const SpaceStep& update);

/// Prints size, quality and time of a run on standard output.
void print_run(const Input<2>& input, const Run& run);
void print_run(const Input<3>& input, const SpaceRun& run);

/// Prints on standard error what of the input, or of what was asked for, is not used or was
/// repaired, and which seeds have no region of their own. `graph`: the input as it is now, edited.
void print_remarks(const MeshArguments& args, const Input<2>& input, const mesher::Graph<2>& graph,
                   const Kept<2>& mesh);
void print_remarks(const MeshArguments& args, const Input<3>& input, const mesher::Graph<3>& graph,
                   const Kept<3>& mesh);

/// Prints on standard error what a reader has to say of a file.
void print_notes(const std::vector<mesher::Note>& notes);

/// Prints on standard error what was repaired.
template <int D>
void print_repairs(const Input<D>& input);

/// Prints what small angles do to a mesh, and in space where the guard gave in, if that was looked
/// at.
void print_angles(const Run& run);
void print_angles(const SpaceRun& run);

/// Prints the number of updates with their median, 99th percentile and longest time.
/// `seconds`: one per update.
void print_updates(std::vector<double> seconds);

/// Prints how large the mesh is that updates have left.
void print_after(const Kept<2>& mesh);
void print_after(const Kept<3>& mesh);

/// Prints the names of the files written.
void print_outputs(const std::vector<std::string>& paths);

}  // namespace tool
