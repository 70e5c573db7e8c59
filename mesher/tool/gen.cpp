// mesher gen: families of points, of points and lines, and of complexes in space.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "commands.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/graph.hpp"
#include "mesher/write.hpp"
#include "outputs.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;

constexpr std::uint64_t kMostPoints = 1'000'000'000;  // some 40 GB of file

struct GenArguments {
  std::string kind;
  std::optional<std::uint64_t> n;
  std::optional<int> dimension;
  std::string seed = "1";
  std::string angle;
  std::string size;
  std::string output;
};

std::vector<std::string> kinds() {
  std::vector<std::string> all{"uniform",     "gaussian", "clusters", "grid",
                               "line-circle", "spiral",   "sphere",   "spread"};
  for (const auto* names : {&mesher::pslg_kind_names(), &mesher::plc_kind_names()}) {
    all.insert(all.end(), names->begin(), names->end());
  }
  return all;
}

std::uint64_t count_of(const GenArguments& args) {
  if (args.n) return *args.n;
  throw Error(ErrorCode::bad_option, "--n is required for " + args.kind);
}

std::uint64_t seed_of(const GenArguments& args) {
  std::uint64_t seed = 0;
  const char* const end = args.seed.data() + args.seed.size();
  const auto [rest, status] = std::from_chars(args.seed.data(), end, seed);
  if (status == std::errc{} && rest == end) return seed;
  throw Error(ErrorCode::bad_option, "--seed '" + args.seed + "': not a whole number below 2^64");
}

template <int D>
void write_points(const GenArguments& args, mesher::TextFile& file) {
  const auto kind = mesher::point_kind(args.kind).value();
  mesher::write_points<D>(mesher::generate_points<D>(kind, count_of(args), seed_of(args)), file);
}

mesher::PslgFamily family_of(const GenArguments& args) {
  mesher::PslgFamily family{
      mesher::pslg_kind(args.kind).value(), count_of(args), seed_of(args), {}};
  if (args.angle.empty()) return family;
  const bool is_fan = family.kind == mesher::PslgKind::fan;
  if (!is_fan && family.kind != mesher::PslgKind::bundle) {
    throw Error(ErrorCode::bad_option, "--angle is for fan and bundle");
  }
  const double angle = option_number("--angle", args.angle);
  const double all = is_fan ? angle * static_cast<double>(*args.n) : angle;
  if (angle <= 0 || all > 360) {
    throw Error(ErrorCode::bad_option,
                "--angle " + args.angle + ": must be above 0, and 360 degrees in all at most");
  }
  family.angle = angle;
  return family;
}

void require_extension(const GenArguments& args, std::vector<std::string> allowed,
                       const std::string& what) {
  const std::string extension = std::filesystem::path(args.output).extension().string();
  if (std::find(allowed.begin(), allowed.end(), extension) != allowed.end()) return;
  throw Error(ErrorCode::unknown_format, what, {args.output});
}

void refuse_option(const std::string& given, const std::string& message) {
  if (!given.empty()) throw Error(ErrorCode::bad_option, message);
}

void gen_points(const GenArguments& args, CommandFiles& outputs) {
  require_extension(args, {".node"}, "points are written to .node");
  refuse_option(args.angle, "--angle is for fan and bundle");
  refuse_option(args.size, "--size is for complexes");
  mesher::TextFile& file = outputs.open(args.output);
  args.dimension.value_or(2) == 2 ? write_points<2>(args, file) : write_points<3>(args, file);
}

void gen_lines(const GenArguments& args, CommandFiles& outputs) {
  require_extension(args, {".poly", ".obj"}, "points and lines are written to .poly and .obj");
  refuse_option(args.size, "--size is for complexes");
  if (args.dimension.value_or(2) != 2) {
    throw Error(ErrorCode::bad_option, "--dimension: lines are in the plane");
  }
  const mesher::Graph<2> pslg = mesher::generate_pslg(family_of(args));
  write_graph(pslg, args.output, outputs.open(args.output));
}

void gen_complex(const GenArguments& args, CommandFiles& outputs) {
  require_extension(args, {".poly", ".smesh"}, "complexes are written to .poly and .smesh");
  refuse_option(args.angle, "--angle is for fan and bundle; complexes have --size");
  if (args.n) throw Error(ErrorCode::bad_option, "--n is for points and lines");
  if (args.dimension.value_or(3) != 3) {
    throw Error(ErrorCode::bad_option, "--dimension: complexes are in space");
  }
  mesher::PlcFamily family{mesher::plc_kind(args.kind).value(), {}, seed_of(args)};
  if (!args.size.empty()) family.size = option_number("--size", args.size);
  const mesher::Graph<3> plc = mesher::generate_plc(family);
  const bool is_poly = std::filesystem::path(args.output).extension() == ".poly";
  if (!is_poly) mesher::require_single_loops(plc);
  write_graph(plc, args.output, outputs.open(args.output));
}

void run_gen(const GenArguments& args) {
  CommandFiles outputs;
  if (mesher::point_kind(args.kind)) {
    gen_points(args, outputs);
  } else if (mesher::pslg_kind(args.kind)) {
    gen_lines(args, outputs);
  } else {
    gen_complex(args, outputs);
  }
  outputs.commit();
}

}  // namespace

void add_gen(CLI::App& app) {
  const auto args = std::make_shared<GenArguments>();
  CLI::App* gen =
      app.add_subcommand("gen", "Writes a family of points, of points and lines, or of complexes.");
  gen->add_option(
         "KIND", args->kind,
         "Points: uniform, gaussian, clusters, grid, line-circle, spiral, sphere, spread.\n"
         "Lines: segments, lengths, polylines, trees, corridors, zigzag, fan, bundle.\n"
         "Complexes in space: cube, cube-square, skew, dumbbell, nested, l-hole, plates, cloud,\n"
         "wedge, pages, spike, vee, leaning, tetrahedron, pump, faults, bricks, tee, shells, "
         "island")
      ->required()
      ->check(CLI::IsMember(kinds()));
  gen->add_option("--n", args->n, "The number of points; for lines, of segments")
      ->check(CLI::Range(std::uint64_t{0}, kMostPoints));
  gen->add_option("--dimension,--dim", args->dimension, "2: the plane; 3: space [2 for points]")
      ->check(CLI::IsMember({2, 3}));
  gen->add_option("--seed", args->seed, "The seed of the random numbers")
      ->type_name("UINT")
      ->capture_default_str();
  gen->add_option("--angle", args->angle,
                  "In degrees: for fan between neighbours, for bundle in total")
      ->type_name("DEGREES");
  gen->add_option("--size", args->size,
                  "For a complex: a gap, an angle in degrees, a side, or a number of parts")
      ->type_name("NUMBER");
  gen->add_option("-o", args->output,
                  "A .node file; for lines, a .poly or .obj file; for complexes, .poly or .smesh")
      ->required()
      ->type_name("FILE");
  gen->footer(
      "The points are distinct and the same on every machine. Lines do not cross and meet\n"
      "only at ends; if there is no room, there are fewer. grid, line-circle, spiral, spread\n"
      "and fan have no randomness. In spread, distances differ by a factor of 10^12.\n"
      "Examples:\n"
      "  mesher gen gaussian --n 100000 --seed 7 -o g.node\n"
      "  mesher gen line-circle --n 2000 --dimension 3 -o lc.node\n"
      "  mesher gen trees --n 10000 -o trees.poly\n"
      "  mesher gen fan --n 2 --angle 0.01 -o wedge.poly\n"
      "  mesher gen plates --size 0.02 -o plates.poly");
  gen->callback([args] { run_gen(*args); });
}

}  // namespace tool
