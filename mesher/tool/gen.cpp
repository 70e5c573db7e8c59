// mesher gen: families of points.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "commands.hpp"
#include "mesher/generate.hpp"
#include "outputs.hpp"

namespace tool {
namespace {

constexpr std::uint64_t kMostPoints = 1'000'000'000;  // some 40 GB of file

struct GenArguments {
  std::string kind;
  std::uint64_t n = 0;
  int dimension = 2;
  std::uint64_t seed = 1;
  std::string output;
};

template <int D>
void write_family(const GenArguments& args, mesher::TextFile& file) {
  const auto kind = mesher::point_kind(args.kind).value();
  mesher::write_points<D>(mesher::generate_points<D>(kind, args.n, args.seed), file);
}

void run_gen(const GenArguments& args) {
  if (std::filesystem::path(args.output).extension() != ".node") {
    throw mesher::Error(mesher::ErrorCode::unknown_format, "points are written to .node",
                        {args.output});
  }
  Outputs outputs;
  mesher::TextFile& file = outputs.open(args.output);
  args.dimension == 2 ? write_family<2>(args, file) : write_family<3>(args, file);
  outputs.commit();
}

}  // namespace

void add_gen(CLI::App& app) {
  const auto args = std::make_shared<GenArguments>();
  CLI::App* gen = app.add_subcommand("gen", "Writes a family of points to a .node file.");
  gen->add_option("KIND", args->kind, "uniform, gaussian, clusters, grid, line-circle or spiral")
      ->required()
      ->check(CLI::IsMember({"uniform", "gaussian", "clusters", "grid", "line-circle", "spiral"}));
  gen->add_option("--n", args->n, "How many points")
      ->required()
      ->check(CLI::Range(std::uint64_t{0}, kMostPoints));
  gen->add_option("--dim", args->dimension, "The dimension, 2 or 3")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  gen->add_option("--seed", args->seed, "Other random points for another seed")
      ->capture_default_str();
  gen->add_option("-o", args->output, "The .node file")->required()->type_name("FILE.node");
  gen->footer(
      "The points are distinct and the same on every machine. grid, line-circle and spiral have\n"
      "no randomness.\n"
      "Examples:\n"
      "  mesher gen gaussian --n 100000 --seed 7 -o g.node\n"
      "  mesher gen line-circle --n 2000 --dim 3 -o lc.node");
  gen->callback([args] { run_gen(*args); });
}

}  // namespace tool
