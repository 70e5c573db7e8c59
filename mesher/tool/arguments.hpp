// The arguments that `mesh`, `edit` and `trace` share, and what they mean.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "input.hpp"
#include "mesher/mesh.hpp"
#include "mesher/meshing.hpp"
#include "mesher/out_of_core.hpp"
#include "mesher/periodic.hpp"
#include "outputs.hpp"

namespace tool {

struct MeshArguments {
  std::string input;   // where it is read
  std::string source;  // as it was called
  std::string format;  // empty: as its extension says
  std::vector<std::string> outputs;
  std::string dimension;              // empty: that of the input
  std::string rho;                    // empty: the default of the dimension
  std::string min_angle;              // degrees, in place of rho
  std::string min_dihedral;           // degrees
  std::string growth;                 // of `mesh` alone
  std::vector<std::string> periodic;  // of `mesh` alone: FROM=TO, markers
  std::string rule = "radius-edge";
  std::vector<std::string> domain;  // the lower corner, the upper corner; or nothing
  std::string max_area, max_volume, max_size, sizes;
  std::string max_vertices;
  std::string threads;             // of `edit` and `view`, and of `mesh --out-of-core`
  std::string out_of_core, tiles;  // of `mesh` alone: a folder, how many
  bool region_areas = false;
  bool surface = false, merge = false, no_merge = false;
  bool repair = false;
  std::string repair_tolerance;
  bool box = false;
  bool is_static = false;
  bool no_flat = false;            // in space
  std::string algorithm = "auto";  // of `mesh` alone
  std::string stats;
  std::string order = "1", msh_version = "4.1";
  std::vector<std::string> marker_names, line_names, region_names;  // NUMBER=NAME
  bool quiet = false;
};

/// What the help says of the quality figures.
inline constexpr const char* kQualityHelp =
    "Its 'vertices' and 'simplices' count the box, 'kept' the output; min_angle_deg and\n"
    "max_radius_edge are those of the output, null if it is empty.";

/// Adds what says what is read: INPUT, --format, what its faces are, its dimension, --domain.
/// `args` must outlive `command`.
void add_input_options(CLI::App& command, MeshArguments& args);

/// Adds these and what says which mesh it is: --rho, --rule, limits of size, --max-vertices.
void add_program_options(CLI::App& command, MeshArguments& args);

/// Where the meshes of a command go: to files that are named (-o, --static, --stats), or elsewhere.
enum class MeshGoes { to_files, elsewhere };

/// Adds these and what is to become of the mesh.
void add_mesh_options(CLI::App& command, MeshArguments& args, MeshGoes goes = MeshGoes::to_files);

/// Adds --threads, for commands whose mesh follows edits.
void add_threads_option(CLI::App& command, MeshArguments& args);

/// A number from the command line. Throws: Error(bad_option) naming `option`.
[[nodiscard]] double option_number(const std::string& option, const std::string& text);

/// The same, above 0. Throws: likewise.
/// --repair-tolerance.
CLI::Option* add_tolerance_option(CLI::App& command, std::string& text);
/// Its number, if it is given. Throws: Error(bad_option).
[[nodiscard]] std::optional<double> option_tolerance(const std::string& text);
[[nodiscard]] double option_positive(const std::string& option, const std::string& text);

/// The value of --rho, at most `most`. Throws: Error(bad_option).
[[nodiscard]] double option_rho(const std::string& text, double most = INFINITY);

/// The rho that --min-angle stands for. Throws: Error(bad_option).
[[nodiscard]] double option_min_angle(const std::string& text);

/// What faces of INPUT in space are.
[[nodiscard]] inline Faces faces(const MeshArguments& args) {
  if (args.merge) return Faces::merged;
  return args.surface ? Faces::polygons : Faces::unless_points;
}

/// The dimension that is asked for, or else that of the input. Throws: as mesher::dimension_of.
[[nodiscard]] int dimension_of(const MeshArguments& args);

/// The input as it is to be meshed: repaired, if that is asked for. D is 2 or 3.
/// Throws: Error, as Input and mesher::repair.
template <int D = 2>
[[nodiscard]] Input<D> read_input(const MeshArguments& args);

/// What to mesh: the domain as given, or around the input.
/// Throws: Error(bad_option), also for options that mean nothing in space; Error(outside_domain)
/// with the line of the first point outside, naming --domain; as read_sizes.
template <int D>
[[nodiscard]] mesher::Options<D> mesh_options(const MeshArguments& args, const Input<D>& input);

/// The same error with a hint to --domain, if it is one of a point outside.
template <int D = 2>
[[nodiscard]] mesher::Error with_domain_hint(const mesher::Error& error);

/// What is read is not written: says so to outputs that are yet to be opened.
template <class Files>
void protect_inputs(const MeshArguments& args, const auto& input, Files& files) {
  files.protect(args.input);
  files.protect(args.source);
  files.protect(with_own_paths(input.point_file()));
  if (!args.sizes.empty()) files.protect(args.sizes);
}

/// The names that are given. Throws: Error(bad_option), also for names that no group can have.
[[nodiscard]] mesher::GroupNames names_of(const MeshArguments& args, int dimension);

/// The pairs of --periodic. Throws: Error(bad_option), also in space.
[[nodiscard]] std::vector<mesher::PeriodicMarkers> periodic_of(const MeshArguments& args,
                                                               int dimension);

/// What --out-of-core, --tiles and --threads say. Throws: Error(bad_option).
[[nodiscard]] mesher::OutOfCore out_of_core_of(const MeshArguments& args);

/// Opens the mesh outputs: those of `.node` with all files, if INPUT is of a format that has lines,
/// or polygons that are meshed. Groups have the names of INPUT and those given.
/// Throws: Error (unknown_format, cannot_write, bad_option).
template <int D>
void open_outputs(const MeshArguments& args, const Input<D>& input, Outputs<D>& outputs);

}  // namespace tool
