// mesher check: is this mesh what it should be?
#include "mesher/check.hpp"

#include <cstdio>
#include <memory>
#include <optional>

#include "arguments.hpp"
#include "commands.hpp"
#include "mesher/io.hpp"
#include "mesher/pslg.hpp"
#include "references.hpp"

namespace tool {
namespace {

struct CheckArguments {
  std::string mesh;
  std::string input;
  std::string rho;
  std::string boundary = "auto";
  std::string max_area;
  bool constrained = false;
};

void print_findings(const std::vector<mesher::Finding>& findings) {
  for (const auto& finding : findings) {
    std::printf("  %-12s%-8s%s\n", finding.property.c_str(), finding.holds ? "ok" : "BROKEN",
                finding.detail.c_str());
  }
  std::fflush(stdout);  // before an error on the other stream
}

void print_notes(const std::vector<mesher::Note>& notes) {
  for (const auto& note : notes) {
    std::printf("  %-12s%s: %s\n", "note", text_of(note.place).c_str(), note.text.c_str());
  }
}

bool has_lines(const mesher::Pslg& graph) {
  return !graph.segments.empty() || !graph.polylines.empty();
}

// What the boundary must be: as asked for, else lines if there are any.
mesher::BoundaryRule boundary_rule(const CheckArguments& args, const mesher::MeshData& mesh,
                                   const mesher::Pslg& graph) {
  if (args.boundary == "box") return mesher::BoundaryRule::box;
  if (args.boundary == "lines") return mesher::BoundaryRule::lines;
  if (args.boundary == "any") return mesher::BoundaryRule::any;
  const bool lines = !mesh.features.edges.empty() || has_lines(graph);
  return lines ? mesher::BoundaryRule::lines : mesher::BoundaryRule::box;
}

void run_check(const CheckArguments& args) {
  mesher::MeshData mesh = mesher::read_mesh(args.mesh);
  mesher::PslgFile graph;
  if (!args.input.empty()) graph = mesher::read_pslg(args.input);
  forget_counted_values(args.mesh, mesh, graph);
  mesher::CheckOptions options;
  options.features = &mesh.features;
  if (!args.input.empty()) options.graph = &graph;
  if (!args.rho.empty()) options.rho = option_rho(args.rho);
  if (!args.max_area.empty()) options.max_area = option_positive("--max-area", args.max_area);
  options.boundary = boundary_rule(args, mesh, graph.pslg);
  options.constrained = args.constrained;
  const auto findings = mesher::check_mesh(mesh, options);
  std::printf("%s: %zu vertices, %zu triangles\n", args.mesh.c_str(), mesh.vertices.size(),
              mesh.simplices.size());
  print_notes(mesh.notes);
  print_notes(graph.notes);
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
  check
      ->add_option("MESH", args->mesh,
                   "A mesh: .node with .ele beside it, .vtu, .vtk, .msh, .mesh, .off or .obj")
      ->required();
  check->add_option("--input", args->input,
                    "Points that must be vertices, bit for bit, and lines that must be unions of\n"
                    "edges: .poly, .geojson, .obj, .vtu, .node, .xyz or .csv");
  check->add_option("--rho", args->rho, "Bound of circumradius over shortest edge");
  check->add_option("--max-area", args->max_area, "Bound of the area of triangles");
  check
      ->add_option("--boundary", args->boundary,
                   "What bounds the mesh: box, lines (or the box), any; auto: lines if there are "
                   "any,\n"
                   "else box")
      ->check(CLI::IsMember({"auto", "box", "lines", "any"}))
      ->capture_default_str();
  check->add_flag("--constrained", args->constrained,
                  "Edges on lines need not be Delaunay: a constrained triangulation will do");
  check->footer(
      "Checks that the triangles do not overlap and fill a box, or what lines enclose; that the\n"
      "triangulation is Delaunay (by exact arithmetic), first off lines, then on them\n"
      "(conforming); that each point of --input is a vertex and each line a union of edges;\n"
      "that regions end at lines and are those of their seeds; that markers, where --input has\n"
      "some, are those of its points and lines; and that no triangle has a radius-edge ratio\n"
      "above --rho, but at small angles between lines: of --input, or MESH.\n"
      "It says what fails first, and where. Exit code 0 if all that holds, 1 if not.\n"
      "Examples:\n"
      "  mesher check mesh.node --input points.node --rho 1.4142\n"
      "  mesher check lake.1.node --input lake.poly --rho 1.4142 --max-area 0.01\n"
      "  mesher check plate.msh --constrained");
  check->callback([args] { run_check(*args); });
}

}  // namespace tool
