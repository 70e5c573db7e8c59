// mesher mesh: a mesh of a file of points and lines, or of a complex in space.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "memory.hpp"
#include "mesher/meshing.hpp"
#include "mesher/reports.hpp"
#include "mesher/sizes.hpp"
#include "no_flat.hpp"
#include "outputs.hpp"
#include "platform/process.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace tool {
namespace {

template <int D>
struct Result {
  Kept<D> mesh;
  RunOf<D> run;
};

void look_at_angles(const Input<2>&, const mesher::Mesh<2>& all, const mesher::Options<2>& options,
                    Run& run) {
  if (all.edges.empty()) return;
  run.angles = mesher::angle_report(all, options);
}
void look_at_angles(const Input<3>& input, const mesher::Mesh<3>& all,
                    const mesher::Options<3>& options, SpaceRun& run) {
  run.guard = mesher::guard_report(all, input.graph(), options.rho);
}

// The mesh of the box, and of --periodic what pairs its sides, without the mesh.
template <int D>
struct Box {
  mesher::Mesh<D> mesh;
  mesher::PeriodicBox periodic;
  std::optional<mesher::OutOfCoreReport> tiles{};
};

template <int D>
bool has_points_alone(const mesher::Graph<D>& graph) {
  bool has_more = !graph.segments.empty() || !graph.polylines.empty();
  if constexpr (D == 3) has_more = has_more || !graph.polygons.empty();
  return !has_more;
}

template <int D>
Box<D> box_out_of_core(const MeshArguments& args, const Input<D>& input,
                       const mesher::Options<D>& options, mesher::RunReport& report,
                       const mesher::RunControl& control) {
  if (!has_points_alone(input.graph())) {
    throw mesher::Error(mesher::ErrorCode::unsupported,
                        "--out-of-core meshes points alone, without lines and polygons",
                        {args.input});
  }
  std::vector<mesher::Point<D>> points = mesher::places_of(input.graph());
  std::vector<mesher::PointId> ids;
  ids.reserve(points.size());
  for (const auto& p : input.graph().points) ids.push_back(p.id);
  Box<D> box;
  box.tiles.emplace();
  box.mesh = mesher::box_mesh_out_of_core<D>(std::move(points), options, out_of_core_of(args), ids,
                                             &*box.tiles, control);
  report.algorithm = mesher::Algorithm::gap_balls;
  report.stats.vertices = box.mesh.vertices.size();
  report.stats.simplices = box.mesh.simplices.size();
  return box;
}

template <int D>
Box<D> made_box(const MeshArguments& args, const Input<D>& input, const mesher::Options<D>& options,
                mesher::RunReport& report, const mesher::RunControl& control) {
  if (!args.out_of_core.empty()) return box_out_of_core(args, input, options, report, control);
  const auto pairs = periodic_of(args, D);
  if constexpr (D == 2) {
    if (!pairs.empty()) {
      Box<D> box{{},
                 mesher::periodic_box_mesh(input.graph(), pairs, options, &report, control,
                                           !args.stats.empty())};
      box.mesh = std::move(box.periodic.mesh);
      return box;
    }
  }
  return {mesher::box_mesh(input.graph(), options, &report, control, !args.stats.empty()), {}, {}};
}

// Inputs that need more are seen early; out of core other things count.
bool is_bound_by_memory(const MeshArguments& args) {
  return args.max_vertices.empty() && args.out_of_core.empty();
}

template <int D>
Kept<D> kept_of_box(const MeshArguments& args, Box<D> box, const mesher::Options<D>& options,
                    const Input<D>& input) {
  if constexpr (D == 2) {
    if (box.periodic.rounds > 0) {
      box.periodic.mesh = std::move(box.mesh);
      return mesher::periodic_domain_mesh(std::move(box.periodic), options.extent);
    }
  }
  return mesher::domain_mesh(without_flat(args, std::move(box.mesh), options.rho), input.graph(),
                             options.extent);
}

// `run` is told by which algorithm, and what happened.
template <int D>
Box<D> box_mesh(const MeshArguments& args, const Input<D>& input, const mesher::Options<D>& options,
                AnyRun& run, Progress& progress) {
  mesher::RunReport report;
  Box<D> box = locating(input, [&] {
    const StopPolitely stop;
    return within_memory(is_bound_by_memory(args), [&] {
      return made_box(args, input, options, report, progress.control());
    });
  });
  if (report.gave_up) {
    progress.erase();
    const std::string tried(name_of(report.tried));
    const mesher::Error error = input.located(*report.gave_up);
    if (!args.quiet)
      std::fprintf(stderr, "%s: %s; now by %s\n", tried.c_str(), error.what(),
                   std::string(name_of(report.algorithm)).c_str());
  }
  run.algorithm = name_of(report.algorithm);
  run.stats = report.stats;
  run.refinement = report.refinement;
  run.rounds = box.periodic.rounds;
  run.tiles = box.tiles;
  return box;
}

// What is said of a mesh is looked at only where it is said.
template <int D>
Result<D> mesh(const MeshArguments& args, const Input<D>& input, const mesher::Options<D>& options,
               Progress& progress) {
  const bool is_silent = args.quiet && args.stats.empty();
  Result<D> result;
  auto& run = result.run;
  double start = mesher::now();
  Box<D> box = box_mesh<D>(args, input, options, run, progress);
  run.seconds_total = mesher::now() - start;
  if (!is_silent) look_at_angles(input, box.mesh, options, run);
  start = mesher::now();
  result.mesh = kept_of_box<D>(args, std::move(box), options, input);
  run.seconds_total += mesher::now() - start;
  if (!is_silent) measure(result.mesh, options.rho, run);
  return result;
}

template <int D>
void run_mesh_in(const MeshArguments& args) {
  const auto input = read_input<D>(args);
  auto options = mesh_options(args, input);
  if (is_bound_by_memory(args)) options.max_vertices = most_vertices_in_memory(D);
  Outputs<D> outputs;
  open_outputs(args, input, outputs);
  Figures figures(args.stats, outputs);
  Progress progress(args.quiet, D);
  const Result<D> result = mesh<D>(args, input, options, progress);
  if (figures.wanted()) figures << json_of(result.run).dump(2) << "\n";
  outputs.write(result.mesh);
  const auto targets = outputs.targets();
  progress.erase();
  if (!args.quiet) print_remarks(args, input, input.graph(), result.mesh);
  figures.print();
  outputs.commit();
  if (args.quiet || figures.printed()) return;
  print_run(input, result.run);
  print_angles(result.run);
  print_outputs(targets);
}

void run_mesh(MeshArguments args) {
  args.merge = args.merge || (args.surface && !args.no_merge && !is_complex(args.input));
  if (args.algorithm != "gap-balls") platform::keep_freed_memory();
  dimension_of(args) == 3 ? run_mesh_in<3>(args) : run_mesh_in<2>(args);
}

}  // namespace

void add_mesh(CLI::App& app) {
  const auto args = std::make_shared<MeshArguments>();
  CLI::App* mesh =
      app.add_subcommand("mesh", "Meshes a file of points and lines, or of a complex in space.");
  add_mesh_options(*mesh, *args);
  mesh->add_flag("--no-merge", args->no_merge,
                 "With --surface: every face stays a polygon of its own")
      ->needs(mesh->get_option("--surface"))
      ->excludes(mesh->get_option("--merge"));
  mesh->add_option(
          "--algorithm", args->algorithm,
          "svr: sparse Voronoi refinement; refine: Delaunay refinement, from the triangulation\n"
          "of all points; gap-balls: the mesh that `edit` maintains, in 1.4 to 2 times the time,\n"
          "with limits of size in 10 to 15 times. auto: refine in the plane and for evenly spread\n"
          "points in space, else svr; gap-balls with --static, another rule, or a --rho below its\n"
          "default if there are lines or polygons. If that finds features too close or needs too\n"
          "many vertices, in space refine is tried after svr, then gap-balls")
      ->check(CLI::IsMember({"auto", "gap-balls", "svr", "refine"}))
      ->capture_default_str();
  mesh->add_option(
          "--growth", args->growth,
          "Sizes grow by at most this factor from one simplex to the next, 1.05 to 100:\n"
          "at a distance d from edges of length e simplices are about as large as regular\n"
          "ones with edges of e + (G - 1) d, or smaller. For refine and svr")
      ->type_name("G");
  mesh->add_option(
          "--periodic", args->periodic,
          "In the plane: the lines of marker TO are those of marker FROM, moved; their meshes\n"
          "are the same, moved, and .msh pairs their nodes. May be repeated")
      ->type_name("FROM=TO")
      ->allow_extra_args(false);
  mesh->add_option(
          "--out-of-core", args->out_of_core,
          "For points that are too many for memory: gap-balls tile after tile, which are\n"
          "kept in FOLDER until all is done. A command that was stopped or killed goes on\n"
          "from there. The mesh is the same")
      ->type_name("FOLDER")
      ->excludes("--periodic");
  mesh->add_option("--tiles", args->tiles,
                   "How many (default: one for each 1000000 points; in space for each 500000)")
      ->type_name("N")
      ->needs("--out-of-core");
  mesh->add_option("--threads", args->threads,
                   "With --out-of-core: how many tiles at a time (default: 1)")
      ->type_name("N")
      ->needs("--out-of-core");
  mesh->footer(
      std::string(
          "Every line is a union of edges. If lines enclose something, the output is what they\n"
          "enclose, without the holes, with the attributes of regions and the markers of points\n"
          "and lines; else, or with --box, it is the whole box. A seed without a region of its\n"
          "own causes a warning.\n"
          "If the format of INPUT has lines, a .node output has .edge, .poly and .neigh beside\n"
          ".ele.\n"
          "The mesh is a function only of INPUT, the domain, --rho, --rule, --algorithm and the\n"
          "limits of size: its files are the same bytes each time, with --static or without,\n"
          "and out of core.\n"
          "Files appear when all is done, or not at all.\n"
          "Limits of size hold in the output inside the domain. They are met by vertices of a\n"
          "lattice, so that edits change few vertices. The smallest of several limits counts.\n"
          "In space the same holds for polygons: every one is a union of faces, and the output\n"
          "is what they enclose. .poly and .smesh have segments and polygons; of surfaces and\n"
          "grids the points are meshed, and with --surface the faces of .off, .obj, .ply, .stl,\n"
          ".vtu and .vtk, those of one plane merged. An .svg is a cutaway view: polygons are\n"
          "green, and tetrahedra bluer where radius-edge ratios are worse.\n"
          "--stats: one JSON object; - for standard output.\n") +
      kQualityHelp +
      "\nExamples:\n"
      "  mesher mesh lake.poly -o lake.1.node -o lake.svg\n"
      "  mesher mesh coast.geojson --box --max-vertices 100000 -o coast.vtu\n"
      "  mesher mesh lake.poly --max-area 1e-4 -o lake.vtu\n"
      "  mesher mesh lake.poly --sizes depth.csv -o lake.vtu\n"
      "  mesher mesh points.node -o mesh.node -o mesh.svg --stats mesh.json\n"
      "  mesher mesh scan.ply -o scan.vtu -o scan.svg\n"
      "  mesher mesh pump.poly -o pump.vtu -o pump.svg\n"
      "  mesher mesh pump.poly --max-volume 1e-4 -o pump.vtu\n"
      "  mesher mesh part.stl --surface -o part.msh\n"
      "  mesher mesh part.poly --name-marker 7=inlet --order 2 -o part.inp\n"
      "  mesher mesh cell.poly --periodic 4=2 --periodic 1=3 -o cell.msh\n"
      "  mesher mesh scan.ply --algorithm svr -o scan.vtu\n"
      "  mesher mesh lake.poly --algorithm refine -o lake.vtu\n"
      "  mesher mesh scan.xyz --out-of-core scratch --threads 2 -o scan.vtu\n"
      "  mesher mesh cities.csv --domain -180 -90 180 90 --rho 2 --static -o cities.vtu");
  mesh->callback([args] { run_mesh(*args); });
}

}  // namespace tool
