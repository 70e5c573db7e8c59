// mesher check: is this mesh what it should be?
#include "mesher/check.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <variant>

#include "arguments.hpp"
#include "commands.hpp"
#include "input.hpp"
#include "mesher/graph.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "pipe.hpp"
#include "references.hpp"

namespace tool {
namespace {

struct CheckArguments {
  std::string mesh;
  std::string input;
  std::string format, input_format;  // empty: as extensions say
  std::string rho;
  std::string boundary = "auto";
  std::string max_area, max_volume;
  bool constrained = false;
  bool ties = false, near = false;
  bool surface = false, merge = false, no_merge = false;
  bool repair = false;
  std::string repair_tolerance;
};

/// What was looked at, and what was found.
struct Judged {
  std::vector<mesher::Finding> findings;
  std::vector<mesher::Note> notes;
  std::string counts;
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
    std::printf("  %-12s%s: %s\n", "note", text_of(note.location).c_str(), note.text.c_str());
  }
}

// What the boundary must be: as asked for, else as the mesh looks.
template <int D, class File>
mesher::BoundaryRule boundary_rule(const CheckArguments& args, const mesher::MeshData<D>& mesh,
                                   const File* input) {
  if (args.boundary == "box") return mesher::BoundaryRule::box;
  if (args.boundary == "lines") return mesher::BoundaryRule::lines;
  if (args.boundary == "any") return mesher::BoundaryRule::any;
  return mesher::boundary_rule(mesh, input);
}

template <int D>
std::string counts_of(const mesher::MeshData<D>& mesh) {
  return std::to_string(mesh.vertices.size()) + " vertices, " +
         std::to_string(mesh.simplices.size()) + (D == 2 ? " triangles" : " tetrahedra");
}

[[noreturn]] void refuse(const CheckArguments& args, const std::string& option, const char* of) {
  throw mesher::Error(mesher::ErrorCode::bad_option, option + " is for meshes of " + of,
                      {args.mesh});
}

/// --input, as 'mesh' would mesh it.
template <int D>
Input<D> input_of(const CheckArguments& args, Faces faces) {
  Input<D> input(args.input, faces, coinciding(args.repair));
  if (!args.repair) return input;
  const mesher::RepairOptions<D> options{.domain = {},
                                         .tolerance = option_tolerance(args.repair_tolerance)};
  locating(input, [&] { input.repair(options); });
  return input;
}

Judged judge(const CheckArguments& args, mesher::MeshData<2>& mesh) {
  if (args.ties) refuse(args, "--ties", "tetrahedra");
  if (!args.max_volume.empty()) refuse(args, "--max-volume", "tetrahedra");
  if (args.near) refuse(args, "--near", "tetrahedra");
  if (args.surface || args.merge) refuse(args, args.merge ? "--merge" : "--surface", "tetrahedra");
  mesher::GraphFile<2> graph;
  if (!args.input.empty()) graph = input_of<2>(args, Faces::unless_points).file();
  forget_counted_values(args.mesh, mesh, graph);
  mesher::CheckOptions<2> options;
  options.features = &mesh.features;
  if (!args.input.empty()) options.graph = &graph;
  if (!args.rho.empty()) options.rho = option_rho(args.rho);
  if (!args.max_area.empty()) options.max_measure = option_positive("--max-area", args.max_area);
  options.boundary = boundary_rule<2>(args, mesh, options.graph);
  options.constrained = args.constrained;
  Judged judged{mesher::check_mesh(mesh, options), mesh.notes, counts_of(mesh)};
  judged.notes.insert(judged.notes.end(), graph.notes.begin(), graph.notes.end());
  return judged;
}

/// As 'mesh --surface' does; but of a mesh that was made without it the polygons stay as they are.
void merge_unless_named(mesher::GraphFile<3>& file, const mesher::MeshData<3>& mesh) {
  mesher::GraphFile<3> merged = with_merged_polygons(file);
  std::set<mesher::PolygonId> there;
  for (const mesher::Polygon& f : merged.graph.polygons) there.insert(f.id);
  const auto& faces = mesh.features.faces;
  const bool fits = std::all_of(faces.begin(), faces.end(), [&](const mesher::MeshFace& f) {
    return !f.polygon || there.count(*f.polygon) != 0;
  });
  if (fits) file = std::move(merged);
}

// With a repair no mesh names polygons as they were before it: they are merged as by 'mesh'.
Faces faces_of(const CheckArguments& args) {
  if (args.merge || (args.surface && args.repair && !args.no_merge)) return Faces::merged;
  return args.surface ? Faces::polygons : Faces::unless_points;
}

Judged judge(const CheckArguments& args, mesher::MeshData<3>& mesh) {
  if (args.constrained) refuse(args, "--constrained", "triangles");
  if (!args.max_area.empty()) refuse(args, "--max-area", "triangles");
  std::optional<Input<3>> input;
  mesher::GraphFile<3> complex;
  if (!args.input.empty()) {
    input.emplace(input_of<3>(args, faces_of(args)));
    complex = input->file();
    if (faces_of(args) == Faces::polygons && !args.no_merge && !is_complex(args.input)) {
      merge_unless_named(complex, mesh);
    }
    forget_counted_values(args.mesh, mesh, complex);
  }
  mesher::CheckOptions<3> options;
  options.features = &mesh.features;
  if (input) options.graph = &complex;
  if (!args.rho.empty()) options.rho = option_rho(args.rho);
  if (!args.max_volume.empty()) {
    options.max_measure = option_positive("--max-volume", args.max_volume);
  }
  options.boundary = boundary_rule<3>(args, mesh, options.graph);
  options.ties = args.ties;
  options.near_delaunay = args.near;
  Judged judged{mesher::check_mesh(mesh, options), mesh.notes, counts_of(mesh)};
  if (input) {
    judged.notes.insert(judged.notes.end(), input->notes().begin(), input->notes().end());
  }
  return judged;
}

void run_check(CheckArguments args) {
  const std::string called = args.mesh;
  args.mesh = readable(args.mesh, args.format);
  args.input = readable(args.input, args.input_format);
  mesher::AnyMesh any = mesher::read_any_mesh(args.mesh);
  const Judged judged = std::visit([&](auto& mesh) { return judge(args, mesh); }, any);
  std::printf("%s: %s\n", called.c_str(), judged.counts.c_str());
  print_notes(judged.notes);
  print_findings(judged.findings);
  for (const auto& finding : judged.findings) {
    if (finding.holds) continue;
    throw mesher::Error(mesher::ErrorCode::bad_quality, finding.property + ": " + finding.detail,
                        {args.mesh});
  }
}

}  // namespace

void add_check(CLI::App& app) {
  const auto args = std::make_shared<CheckArguments>();
  CLI::App* check = app.add_subcommand("check", "Verifies a mesh of this or another program.");
  check
      ->add_option(
          "MESH", args->mesh,
          "A mesh of triangles or tetrahedra: .node with .ele beside it, .vtu, .vtk, .msh\n"
          "or .mesh; of triangles also .off or .obj")
      ->required();
  check
      ->add_option(
          "--input", args->input,
          "Points that must be vertices, bit for bit, and lines that must be unions of edges:\n"
          ".poly, .geojson, .obj, .vtu, .node, .xyz or .csv. For tetrahedra complexes, whose\n"
          "polygons must be unions of faces: .poly or .smesh; points: all formats of 'mesh'")
      ->type_name("FILE");
  check
      ->add_option("--format", args->format,
                   "The format of MESH, given as an extension; for pipes and files without one")
      ->type_name("EXTENSION");
  check->add_option("--input-format", args->input_format, "The format of --input, likewise")
      ->type_name("EXTENSION");
  check->add_flag("--surface", args->surface,
                  "The faces of .off, .obj, .ply or .stl are polygons, as for 'mesh'");
  check->add_flag("--merge", args->merge, "As --surface, with polygons merged as by 'mesh'");
  check
      ->add_flag("--no-merge", args->no_merge,
                 "With --surface: as by 'mesh --surface --no-merge'; else that is seen by the\n"
                 "polygons that the mesh names")
      ->needs(check->get_option("--surface"))
      ->excludes(check->get_option("--merge"));
  check
      ->add_flag("--repair", args->repair,
                 "Repair --input as 'mesh --repair' does (without --domain), before the checks")
      ->needs(check->get_option("--input"));
  add_tolerance_option(*check, args->repair_tolerance)->needs("--repair");
  check->add_option("--rho", args->rho, "Bound of circumradius over shortest edge");
  check->add_option("--max-area", args->max_area, "Bound of the area of triangles");
  check->add_option("--max-volume", args->max_volume, "Bound of the volume of tetrahedra");
  check
      ->add_option(
          "--boundary", args->boundary,
          "The boundary of the mesh: box, lines (or the box; for tetrahedra: polygons, or the\n"
          "box), any (for tetrahedra: any convex body); auto: box if there are no lines (for\n"
          "tetrahedra: polygons), or if MESH fills a box that they do not bound, else lines")
      ->check(CLI::IsMember({"auto", "box", "lines", "any"}))
      ->capture_default_str();
  check->add_flag("--constrained", args->constrained,
                  "Edges on lines need not be Delaunay, as in a constrained triangulation");
  check->add_flag(
      "--ties", args->ties,
      "Of points on one sphere, the tetrahedra must be those chosen by coordinates, as in\n"
      "all meshes of this tool");
  check->add_flag("--near", args->near,
                  "Tetrahedra need not be Delaunay by less than 10^-6 of their radius, as after\n"
                  "'mesh --no-flat'");
  check->footer(
      "Checks that the triangles do not overlap and fill a box, or what lines enclose; that\n"
      "the triangulation is Delaunay (by exact arithmetic), first off lines, then on them\n"
      "(conforming); that each point of --input is a vertex and each line a union of edges;\n"
      "that regions end at lines and are those of their seeds; that markers, if --input has\n"
      "some, are those of its points and lines; and that no triangle has a radius-edge ratio\n"
      "above --rho, except at small angles between lines of --input, or else of MESH.\n"
      "For tetrahedra: that they fill a box, or what polygons enclose, without gap or\n"
      "overlap, are Delaunay, have the points of --input as vertices (with their kinds and\n"
      "ids, if MESH has them), and are within --rho, also outside the domain, except at\n"
      "small angles of --input; that each segment of --input is a union of edges, and each\n"
      "polygon a union of faces with its area; that markers, if --input has some, are those\n"
      "of its points, segments and polygons; and that regions end at polygons and are those\n"
      "of their seeds.\n"
      "Prints the first property that fails, and where. Exit code 0 if all hold, 1 if not.\n"
      "Examples:\n"
      "  mesher check mesh.node --input points.node --rho 1.4142\n"
      "  mesher check lake.1.node --input lake.poly --rho 1.4142 --max-area 0.01\n"
      "  mesher check plate.msh --constrained\n"
      "  mesher check cloud.vtu --input cloud.node --rho 2 --ties\n"
      "  mesher check pump.vtu --input pump.poly --rho 2 --max-volume 0.01");
  check->callback([args] { run_check(*args); });
}

}  // namespace tool
