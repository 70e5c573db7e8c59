// mesher edit: a mesh of a file of points and lines, or of a complex in space, that follows a
// script of edits.
#include <memory>
#include <utility>

#include "arguments.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "first_run.hpp"
#include "mesher/extra/edit_script.hpp"
#include "mesher/mesher.hpp"
#include "mesher/reports.hpp"
#include "no_flat.hpp"
#include "outputs.hpp"
#include "report.hpp"
#include "static_mesher.hpp"

namespace tool {
namespace {

struct EditArguments : MeshArguments {
  std::string script;
};

// What the updates of a script leave besides the mesh.
template <int D>
struct Followed {
  std::vector<double> seconds;                  // of each update
  typename Outputs<D>::Simplices last_changed;  // what the last one brought
};

template <int D, class Target>
Followed<D> apply_script(const EditArguments& args, Input<D>& input, Target& target,
                         Figures& figures, Progress& progress) {
  mesher::EditScript<D> script(args.script);
  Followed<D> followed;
  Watched watched(target, progress);
  try {
    while (auto edits = script.next()) {
      input.follow(*edits);
      auto update = mesher::apply(std::move(*edits), watched);
      followed.seconds.push_back(update.seconds);
      if (figures.wanted()) figures << json_of(update).dump() << "\n";
      followed.last_changed = std::move(update.change.domain.kept_added);
      progress.set_task("after " + std::to_string(followed.seconds.size()) + " updates, ");
    }
  } catch (const mesher::Error& error) {
    throw with_domain_hint<D>(input.located(error));
  }
  return followed;
}

template <class Target>
void look_at_angles(const Target& target, Run& run) {
  run.angles = mesher::angle_report(target.box_mesh(), target.options());
}
template <class Target>
void look_at_angles(const Target& target, SpaceRun& run) {
  run.guard = mesher::guard_report(target.box_mesh(), target.input(), target.options().rho);
}

template <int D, class Target>
void run_edit_on(Target target, const EditArguments& args, Input<D> input) {
  Outputs<D> outputs;
  outputs.protect(args.script);
  open_outputs(args, input, outputs);
  Figures figures(args.stats, outputs);
  Progress progress(args.quiet, D);
  RunOf<D> run = first_run<D>(input, target, progress);
  if (figures.wanted()) figures << json_of(run).dump() << "\n";
  const auto followed = apply_script<D>(args, input, target, figures, progress);
  const Kept<D> mesh = kept_of<D>(args, target);
  outputs.write(mesh, followed.last_changed);
  const auto targets = outputs.targets();
  progress.erase();
  if (!args.quiet) print_remarks(args, input, mesh);
  figures.print();
  outputs.commit();
  if (args.quiet || figures.printed()) return;
  print_run(input, run);
  print_updates(followed.seconds);
  print_after(mesh);
  look_at_angles(target, run);
  print_angles(run);
  print_outputs(targets);
}

template <int D>
void run_edit_in(const EditArguments& args) {
  Input<D> input = read_input<D>(args);
  const auto options = mesh_options(args, input);
  if (args.is_static) return run_edit_on<D>(StaticMesher<D>(options), args, std::move(input));
  auto mesher = locating(input, [&] { return mesher::Mesher<D>(options); });
  run_edit_on<D>(std::move(mesher), args, std::move(input));
}

void run_edit(const EditArguments& args) {
  dimension_of(args) == 3 ? run_edit_in<3>(args) : run_edit_in<2>(args);
}

}  // namespace

void add_edit(CLI::App& app) {
  const auto args = std::make_shared<EditArguments>();
  CLI::App* edit = app.add_subcommand(
      "edit",
      "Meshes a file of points and lines, or of a complex in space, and follows its edits.");
  add_mesh_options(*edit, *args);
  edit->add_option("--script", args->script, "The edits")->required()->type_name("EDITS");
  edit->footer(
      std::string(
          "EDITS has one edit per line:\n"
          "  +point ID x y          -point ID      move ID x y\n"
          "  +segment ID A B        -segment ID    between points A and B\n"
          "  +polyline ID P Q ...   -polyline ID   segments under one id\n"
          "  +hole ID x y           -hole ID       excludes what lines enclose there\n"
          "  +region ID x y ATTRIBUTE [MAX_AREA]\n"
          "                         -region ID     an attribute for what lines enclose there\n"
          "  limit area A           no triangle is larger; or 'size H', its edge; 'sizes FILE',\n"
          "                         a background of H beside EDITS; 'none'\n"
          "  limit ... in XMIN YMIN XMAX YMAX   in this box; elsewhere limits stay\n"
          "+point, +segment and +polyline may end with 'marker M', a marker for the vertices\n"
          "and edges on them in the output.\n"
          "Each edit is an update of its own; those between 'begin' and 'commit' are one. '#'\n"
          "starts a comment. Ids are those of INPUT (1, 2, ... for formats without ids).\n"
          "The output equals, byte for byte, that of 'mesh' for the edited input in the same\n"
          "domain, which by default is that of INPUT; an .svg also shows the additions of the\n"
          "last update. With --static each update meshes from scratch.\n"
          "--stats: a JSON object for the first run, then one per line for each update; - for\n"
          "standard output.\n"
          "In space the edits are +point ID x y z, -point ID, move ID x y z, segments and\n"
          "polylines without markers (features of INPUT keep theirs), and\n"
          "  +polygon ID P P P ... [/ P P P ...] ... [on P ...] [along A B ...]\n"
          "                         -polygon ID    its loops, then points and edges inside\n"
          "  +hole ID x y z         -hole ID\n"
          "  +region ID x y z ATTRIBUTE [MAX_VOLUME]\n"
          "                         -region ID     what polygons enclose there\n"
          "  limit volume V         no tetrahedron is larger; or as above, 'size H',\n"
          "                         'sizes FILE', 'none';\n"
          "                         'in XMIN YMIN ZMIN XMAX YMAX ZMAX': in this box\n") +
      kQualityHelp +
      "\nExamples:\n"
      "  mesher edit lake.poly --script wall.txt -o lake.vtu -o lake.svg\n"
      "  mesher edit points.node --script edits.txt -o after.node --stats updates.jsonl\n"
      "  mesher edit cities.csv --domain -180 -90 180 90 --script edits.txt -o after.vtu");
  edit->callback([args] { run_edit(*args); });
}

}  // namespace tool
