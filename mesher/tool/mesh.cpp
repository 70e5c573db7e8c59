// mesher mesh: a mesh of a file of points.
#include <memory>

#include "arguments.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "first_run.hpp"
#include "mesher/mesher.hpp"
#include "outputs.hpp"
#include "report.hpp"

namespace tool {
namespace {

Result mesh_without_engine(const mesher::PointFile<2>& input, const mesher::Options<2>& options,
                           Progress& progress) {
  Result result;
  const double start = mesher::now();
  try {
    const StopPolitely stop;
    result.mesh = mesher::mesh_statically<2>(input.points, options, input.ids, &result.run.stats,
                                             progress.control());
  } catch (const mesher::Error& error) {
    if (error.code() == mesher::ErrorCode::cancelled) throw;
    throw error.at({input.file});
  }
  result.run.seconds_total = mesher::now() - start;
  result.run.quality = mesher::quality(result.mesh);
  return result;
}

Result mesh_with_engine(const mesher::PointFile<2>& input, const mesher::Options<2>& options,
                        Progress& progress) {
  mesher::Mesher<2> mesher(options);
  return first_run(input, mesher, progress);
}

void run_mesh(const MeshArguments& args) {
  const auto input = mesher::read_points<2>(args.input);
  const auto options = mesh_options(args, input.points);
  require_inside(input, options.domain);
  Outputs outputs;
  open_outputs(args, outputs);
  Figures figures(args.stats, outputs);
  Progress progress(args.quiet);
  const Result result = args.is_static ? mesh_without_engine(input, options, progress)
                                       : mesh_with_engine(input, options, progress);
  if (figures.wanted()) figures << json_of(result.run).dump(2) << "\n";
  outputs.write(result.mesh);
  const auto targets = outputs.targets();
  progress.erase();
  figures.print();
  outputs.commit();
  if (args.quiet || figures.printed()) return;
  print_run(args.input, input.points.size(), result.run);
  print_outputs(targets);
}

}  // namespace

void add_mesh(CLI::App& app) {
  const auto args = std::make_shared<MeshArguments>();
  CLI::App* mesh = app.add_subcommand("mesh", "Meshes a file of points.");
  add_mesh_options(*mesh, *args);
  mesh->footer(
      std::string("The mesh is a function of the points, the domain, --rho and --rule alone: its\n"
                  "files are the same bytes each time, with --static or without. Files appear\n"
                  "when all is done, or not at all.\n"
                  "--stats: one JSON object; - for standard output.\n") +
      kQualityHelp +
      "\nExamples:\n"
      "  mesher mesh points.node -o mesh.node -o mesh.svg --stats mesh.json\n"
      "  mesher mesh cities.csv --domain -180 -90 180 90 -o cities.vtu\n"
      "  mesher mesh points.xyz --rho 2 --static -o mesh.off");
  mesh->callback([args] { run_mesh(*args); });
}

}  // namespace tool
