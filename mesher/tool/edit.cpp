// mesher edit: a mesh of a file of points that follows a script of edits.
#include <memory>

#include "arguments.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "first_run.hpp"
#include "mesher/edit_script.hpp"
#include "mesher/mesher.hpp"
#include "outputs.hpp"
#include "report.hpp"
#include "static_mesher.hpp"

namespace tool {
namespace {

struct EditArguments : MeshArguments {
  std::string script;
};

// Runs the script on `target`; the seconds of each update.
template <class Target>
std::vector<double> apply_script(const EditArguments& args, Target& target, Figures& figures,
                                 Progress& progress) {
  mesher::EditScript script(args.script);
  std::vector<double> seconds;
  const auto record = [&](const mesher::Update<2>& update) {
    seconds.push_back(update.seconds);
    if (figures.wanted()) figures << json_of(update).dump() << "\n";
    progress.set_task("after " + std::to_string(seconds.size()) + " updates, ");
  };
  Watched watched(target, progress);
  try {
    mesher::apply(script, watched, record);
  } catch (const mesher::Error& error) {
    throw with_domain_hint(error);
  }
  return seconds;
}

// The edges on lines, for the writers.
mesher::MeshFeatures features_of(const mesher::Mesh<2>& mesh) {
  mesher::MeshFeatures features;
  for (const auto& e : mesh.edges) features.edges.push_back({e.low, e.high, e.line});
  return features;
}

template <class Target>
void run_edit_on(Target target, const EditArguments& args, const mesher::PointFile<2>& input) {
  Outputs outputs;
  outputs.protect(args.script);
  open_outputs(args, outputs);
  Figures figures(args.stats, outputs);
  Progress progress(args.quiet);
  const Run run = first_run(input, target, progress).run;
  if (figures.wanted()) figures << json_of(run).dump() << "\n";
  const std::vector<double> seconds = apply_script(args, target, figures, progress);
  const mesher::Mesh<2> mesh = target.mesh();
  outputs.write(mesh, features_of(mesh));
  const auto targets = outputs.targets();
  progress.erase();
  figures.print();
  outputs.commit();
  if (args.quiet || figures.printed()) return;
  print_run(args.input, input.points.size(), run);
  print_updates(seconds);
  print_outputs(targets);
}

void run_edit(const EditArguments& args) {
  const auto input = mesher::read_points<2>(args.input);
  const auto options = mesh_options(args, input.points);
  require_inside(input, options.domain);
  if (args.is_static) return run_edit_on(StaticMesher(options), args, input);
  run_edit_on(mesher::Mesher<2>(options), args, input);
}

}  // namespace

void add_edit(CLI::App& app) {
  const auto args = std::make_shared<EditArguments>();
  CLI::App* edit = app.add_subcommand("edit", "Meshes a file of points and follows its edits.");
  add_mesh_options(*edit, *args);
  edit->add_option("--script", args->script, "The edits")->required()->type_name("EDITS");
  edit->footer(
      std::string(
          "EDITS has one edit a line: '+point ID x y', '-point ID', 'move ID x y'. Each is\n"
          "an update of its own, but those between 'begin' and 'commit' are one. '#' starts\n"
          "a comment. Ids are those of INPUT (1, 2, ... for .xyz and .csv).\n"
          "The mesh is the same bytes as a fresh one of the edited points in the same\n"
          "domain, which by default is that of INPUT. With --static each update meshes\n"
          "from scratch.\n"
          "--stats: a JSON object for the first run, then one a line for each update; - for\n"
          "standard output.\n") +
      kQualityHelp +
      "\nExamples:\n"
      "  mesher edit points.node --script edits.txt -o after.node --stats updates.jsonl\n"
      "  mesher edit cities.csv --domain -180 -90 180 90 --script edits.txt -o after.vtu");
  edit->callback([args] { run_edit(*args); });
}

}  // namespace tool
