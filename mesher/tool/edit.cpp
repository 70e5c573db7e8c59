// mesher edit: a mesh of a file of points and lines, or of a complex in space, that follows a
// script of edits.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "arguments.hpp"
#include "commands.hpp"
#include "edit_journal.hpp"
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
  std::string script;  // empty: none
  JournalArguments journal;
  bool append = false;  // the script follows what the journal holds
};

// What the updates of a script leave besides the mesh.
template <int D>
struct Followed {
  std::vector<double> seconds;                  // of each update
  typename Outputs<D>::Simplices last_changed;  // what the last one brought
};

// Updates a mesh, batch by batch.
template <int D, class Target>
class Follower {
 public:
  Follower(Input<D>& input, Target& target, Figures& figures, Progress& progress)
      : input_(input), target_(target), figures_(figures), progress_(progress) {}

  // Throws: Error, said of the line to blame; the mesh is then as before.
  void follow(std::vector<mesher::Edit<D>> edits) {
    try {
      input_.follow(edits);
      Watched watched(target_, progress_);
      auto update = mesher::apply(std::move(edits), watched);
      followed_.seconds.push_back(update.seconds);
      if (figures_.wanted()) figures_ << json_of(update).dump() << "\n";
      followed_.last_changed = std::move(update.change.domain.kept_added);
      progress_.set_task("after " + std::to_string(followed_.seconds.size()) + " updates, ");
    } catch (const mesher::Error& error) {
      throw located(error);
    }
  }

  [[nodiscard]] mesher::Error located(const mesher::Error& error) const {
    return with_domain_hint<D>(input_.located(error));
  }
  [[nodiscard]] const Followed<D>& followed() const { return followed_; }
  [[nodiscard]] const Target& target() const { return target_; }

 private:
  Input<D>& input_;
  Target& target_;
  Figures& figures_;
  Progress& progress_;
  Followed<D> followed_;
};

// After an error: no output is written, but what was done is not lost.
void print_held(const Journal& journal) {
  std::fprintf(stderr, "%s: note: %llu updates are in the journal\n", journal.path().c_str(),
               static_cast<unsigned long long>(journal.place().updates));
}

// Passes over the updates of the script that the journal holds: it must begin with them.
template <int D>
void pass_over(mesher::EditScript<D>& script, const EditArguments& args, const Journal& journal) {
  JournalPlace place;
  while (place.updates < journal.place().updates) {
    const auto edits = script.next();
    if (!edits) break;
    std::string lines;
    for (const auto& edit : *edits) lines += edit.text + "\n";
    place = place.after(lines);
  }
  if (place == journal.place()) return;
  throw mesher::Error(mesher::ErrorCode::bad_option,
                      "does not begin with the " + std::to_string(journal.place().updates) +
                          " updates that the journal " + journal.path() +
                          " holds; --journal-append applies all of it after them",
                      {args.script});
}

// Replays the journal, then applies and records what the script has more.
template <int D, class Target>
void apply_script(const EditArguments& args, EditJournal<D>* journal,
                  Follower<D, Target>& follower) {
  if (journal != nullptr) {
    if (!args.quiet) print_journal(*journal);
    while (auto update = journal->next_found()) follower.follow(std::move(update->edits));
  }
  if (args.script.empty()) return;
  const std::string folder = std::filesystem::path(args.script).parent_path().string();
  mesher::EditScript<D> script(args.script);
  if (journal != nullptr && !args.append) pass_over<D>(script, args, journal->file());
  const auto next = [&] {
    try {
      return script.next();
    } catch (const mesher::Error& error) {
      throw follower.located(error);
    }
  };
  while (auto edits = next()) {
    if (journal == nullptr) {
      follower.follow(std::move(*edits));
      continue;
    }
    if (journal->is_long()) journal->make_room(follower.target().input());
    follower.follow(*edits);
    journal->append(*edits, folder);
  }
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
  if (!args.script.empty()) outputs.protect(args.script);
  if (!args.journal.path.empty()) outputs.protect(args.journal.path);
  open_outputs(args, input, outputs);
  std::optional<EditJournal<D>> journal;
  if (!args.journal.path.empty()) journal.emplace(args.journal, args, input, target.options());
  Figures figures(args.stats, outputs);
  Progress progress(args.quiet, D);
  RunOf<D> run = first_run<D>(input, target, progress);
  if (figures.wanted()) figures << json_of(run).dump() << "\n";
  Follower<D, Target> follower(input, target, figures, progress);
  try {
    apply_script<D>(args, journal ? &*journal : nullptr, follower);
  } catch (const mesher::Error&) {
    progress.erase();
    if (journal && !args.quiet) print_held(journal->file());
    throw;
  }
  const Followed<D>& followed = follower.followed();
  const Kept<D> mesh = kept_of<D>(args, target);
  outputs.write(mesh, followed.last_changed);
  const auto targets = outputs.targets();
  progress.erase();
  if (!args.quiet) print_remarks(args, input, follower.target().input(), mesh);
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
  const bool journaled = !args.journal.path.empty();
  if (args.is_static && !args.threads.empty()) {
    throw mesher::Error(mesher::ErrorCode::bad_option, "--threads and --static exclude each other");
  }
  if (args.script.empty() && !journaled) throw CLI::RequiredError("--script or --journal");
  if (!journaled && (args.append || args.journal.sync || !args.journal.limit.empty())) {
    throw mesher::Error(mesher::ErrorCode::bad_option,
                        "--journal-append, --journal-sync and --journal-limit need --journal");
  }
  if (journaled && args.journal.path == args.script) {
    throw mesher::Error(mesher::ErrorCode::bad_option, "the journal cannot be the script",
                        {args.script});
  }
  dimension_of(args) == 3 ? run_edit_in<3>(args) : run_edit_in<2>(args);
}

}  // namespace

void add_edit(CLI::App& app) {
  const auto args = std::make_shared<EditArguments>();
  CLI::App* edit = app.add_subcommand(
      "edit",
      "Meshes a file of points and lines, or of a complex in space, and follows its edits.");
  add_mesh_options(*edit, *args);
  add_threads_option(*edit, *args);
  edit->add_option("--script", args->script, "The edits; may be left out with --journal")
      ->type_name("EDITS");
  edit->add_option("--journal", args->journal.path,
                   "Record each update in this file. If it is there, go on from it: replay its\n"
                   "updates, and pass over those with which EDITS begins")
      ->type_name("FILE");
  edit->add_flag("--journal-append", args->append,
                 "Apply all of EDITS after what the journal holds");
  add_journal_options(*edit, args->journal);
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
          "+point, +segment, +polyline and +polygon may end with 'marker M', a marker for what is\n"
          "on them in the output.\n"
          "Each edit is an update of its own; those between 'begin' and 'commit' are one. '#'\n"
          "starts a comment. Ids are those of INPUT (1, 2, ... for formats without ids).\n"
          "The output equals, byte for byte, that of 'mesh' for the edited input in the same\n"
          "domain, which by default is that of INPUT; an .svg also shows the additions of the\n"
          "last update. With --static each update meshes from scratch.\n"
          "--stats: a JSON object for the first run, then one per line for each update, also\n"
          "for those replayed; - for standard output.\n"
          "In space the edits are +point ID x y z, -point ID, move ID x y z, segments and\n"
          "polylines, and\n"
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
      "  mesher edit lake.poly --script wall.txt --journal wall.journal -o lake.vtu\n"
      "  mesher edit cities.csv --domain -180 -90 180 90 --script edits.txt -o after.vtu");
  edit->callback([args] { run_edit(*args); });
}

}  // namespace tool
