// mesher check: is this mesh what it should be?
#include "mesher/check.hpp"

#include <cstdio>
#include <memory>
#include <optional>

#include "arguments.hpp"
#include "commands.hpp"
#include "mesher/io.hpp"

namespace tool {
namespace {

struct CheckArguments {
  std::string mesh;
  std::string input;
  std::string rho;
};

void print_findings(const std::vector<mesher::Finding>& findings) {
  for (const auto& finding : findings) {
    std::printf("  %-12s%-8s%s\n", finding.property.c_str(), finding.holds ? "ok" : "BROKEN",
                finding.detail.c_str());
  }
  std::fflush(stdout);  // before an error on the other stream
}

void run_check(const CheckArguments& args) {
  const mesher::Mesh<2> mesh = mesher::read_mesh(args.mesh);
  mesher::CheckOptions options;
  if (!args.rho.empty()) options.rho = option_rho(args.rho);
  std::optional<mesher::PointFile<2>> input;
  if (!args.input.empty()) input = mesher::read_points<2>(args.input);
  if (input) options.input = &*input;
  const auto findings = mesher::check_mesh(mesh, options);
  std::printf("%s: %zu vertices, %zu triangles\n", args.mesh.c_str(), mesh.vertices.size(),
              mesh.simplices.size());
  print_findings(findings);
  for (const auto& finding : findings) {
    if (finding.holds) continue;
    throw mesher::Error(mesher::ErrorCode::bad_quality, finding.property + ": " + finding.detail,
                        {args.mesh});
  }
}

}  // namespace

void add_check(CLI::App& app) {
  const auto args = std::make_shared<CheckArguments>();
  CLI::App* check = app.add_subcommand("check", "Verifies a mesh, whoever made it.");
  check->add_option("MESH", args->mesh, "A mesh: .node with .ele beside it, or .off")->required();
  check->add_option("--input", args->input, "Points that must be vertices, bit for bit");
  check->add_option("--rho", args->rho, "Bound of circumradius over shortest edge");
  check->footer(
      "Checks that the triangles tile a box without coinciding vertices, that the triangulation "
      "is\n"
      "Delaunay (by exact arithmetic), that each point of --input is a vertex, and that no\n"
      "triangle with a vertex off the box's sides has a radius-edge ratio above --rho.\n"
      "Exit code 0 if all that holds, 1 if not.\n"
      "Examples:\n"
      "  mesher check mesh.node --input points.node --rho 1.4142\n"
      "  mesher check mesh.off");
  check->callback([args] { run_check(*args); });
}

}  // namespace tool
