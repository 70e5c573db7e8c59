// Commands of pages as edits, their journal and history, and changes as messages.
#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "archive.hpp"
#include "call_picture.hpp"
#include "fields.hpp"
#include "first_run.hpp"
#include "graph_edits.hpp"
#include "input_index.hpp"
#include "limit_lines.hpp"
#include "mesh_arrays.hpp"
#include "mesher/mesher.hpp"
#include "message.hpp"
#include "no_flat.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "scratch_folder.hpp"

namespace tool::view {
namespace {

namespace fs = std::filesystem;
using mesher::Edit;
using mesher::Error;
using mesher::ErrorCode;
using mesher::Feature;
using mesher::Graph;
using mesher::PointId;

constexpr const char* kPage = "the page";    // where its edits stand
constexpr const char* kStart = "# start\n";  // of updates of the script with which a view begins

// A value, for as long as this lives.
class Set {
 public:
  Set(bool& of, bool value) : of_(of), before_(std::exchange(of, value)) {}
  ~Set() { of_ = before_; }
  Set(const Set&) = delete;
  Set& operator=(const Set&) = delete;

 private:
  bool& of_;
  bool before_;
};

template <int D>
class ModelOf final : public Model {
 public:
  ModelOf(const MeshArguments& args, const JournalArguments& journal, const std::string& script)
      : args_(args),
        input_(read_input<D>(args)),
        mesher_(locating(input_, [&] { return mesher::Mesher<D>(mesh_options(args, input_)); })),
        index_(mesher_),
        journal_(journal, args, input_, mesher_.options()),
        progress_(args.quiet, D) {
    names_ = input_.graph().names;
    names_.add(names_of(args, D));
    mesher::require_names(names_);
    if (!args.quiet) print_journal(journal_);
    insert_all(input_, mesher_, progress_);
    for (const Feature& f : view::features_of(input_.graph())) require_showable(f);
    index_.take(input_.graph());
    replay();
    // A kill may have left a part of the script in the journal, and then nothing else.
    if (!script.empty() && started_ == journal_.updates_found()) make_updates_of(script);
    mesher_.keep_slots(true);
    kept_ = count_kept(mesher_);
    progress_.erase();
    if (!args.quiet) print_remarks(args_, input_, mesher_.input(), mesher_.domain_mesh());
  }

  void set_meanwhile(Meanwhile meanwhile) override {
    progress_.set_meanwhile([this, meanwhile = std::move(meanwhile)](const mesher::Progress& p) {
      return meanwhile(p) || takes_back_;
    });
  }
  std::string snapshot() override;
  Work command(ClientId client, const std::string& text, const Send& send,
               bool runs_fresh) override;
  std::string edit(const std::string& script, const Send& send) override;
  void left(ClientId client, const Send& send) override {
    if (drag_ && drag_->client == client) settle(send);
  }
  SavedFile saved(const std::string& name, const Send& send) override;
  std::string calls() const override { return calls_ ? calls_->picture() : ""; }
  std::string summary() const override {
    const auto stats = mesher_.stats();
    return std::to_string(stats.vertices) + " vertices, " + std::to_string(stats.simplices) +
           (D == 2 ? " triangles" : " tetrahedra") + " in the box; journal " +
           journal_.file().path();
  }
  void finish(const Send& send) override { settle(send); }

 private:
  using Lines = std::vector<std::string>;
  using Edits = std::vector<Edit<D>>;
  using Made = mesher::Update<D, mesher::DomainUpdate<D>>;
  using Simplices = typename Outputs<D>::Simplices;
  using Simplex = typename Simplices::value_type;
  struct Done {  // an update in the history
    Lines again, back;
  };
  using Places = std::map<PointId, mesher::Point<D>>;
  struct Drag {
    ClientId client = 0;
    Feature feature;
    Places from;  // of its points, before
    bool moved = false;
    std::set<Simplex> came, went;  // since it began

    void follow(const mesher::DomainChange<D>& change) {
      for (const Simplex& s : change.kept_removed) {
        if (came.erase(s) == 0) went.insert(s);
      }
      for (const Simplex& s : change.kept_added) {
        if (went.erase(s) == 0) came.insert(s);
      }
    }
  };
  enum class Why { edit, undo, redo };

  void replay();
  void make_updates_of(const std::string& script);
  void follow_update(const Edits& edits, Why why, bool undoable);
  static void require_showable(const Feature& feature);
  static Lines texts_of(const Edits& edits);
  static Edits edits_of(const Lines& lines);
  static std::set<Feature> features_of(const Edits& edits);
  [[nodiscard]] std::optional<mesher::Options<D>> limits_before(const Edits& edits) const;
  [[nodiscard]] static std::optional<Lines> lines_back(
      Lines lines, const std::optional<mesher::Options<D>>& limits);

  void run_script(const std::string& text, const Json& tag, const Send& send);

  void change(const Lines& lines, Why why, const Json& tag, const Send& send);
  void drag(ClientId client, const Json& command, const Json& tag, const Send& send);
  void settle(const Send& send);
  [[nodiscard]] Drag drag_of(ClientId client, const Json& command) const;
  [[nodiscard]] static Places targets_of(const Json& command, const Places& from);
  [[nodiscard]] Lines moves_to(const Places& places) const;
  void go_back(bool redo, const Json& tag, const Send& send);
  void record(const Edits& edits, Why why, const std::optional<Lines>& back);
  void remember(Why why, Lines again, Lines back);
  Made update(Edits edits);
  Made take_back(Edits edits);
  void take_back(const Lines& lines, const std::optional<mesher::Options<D>>& limits);
  Work fresh(const Json& tag);
  void watch_calls(const Json& command, const Json& tag, const Send& send);
  void draw_calls(const Send& send);

  [[nodiscard]] std::string input_script() const;

  // Messages.
  [[nodiscard]] Json state() const;
  void send_change(const Made& update, const std::set<Feature>& features, const Json& tag,
                   const Send& send);

  MeshArguments args_;
  Input<D> input_;
  mesher::Mesher<D> mesher_;
  InputIndex<D> index_;
  EditJournal<D> journal_;
  Progress progress_;
  mesher::GroupNames names_;
  std::vector<Done> undo_, redo_;
  std::optional<Drag> drag_;
  Simplices last_came_;  // of what is kept, by the last update in the journal
  const std::uint64_t run_ = std::random_device()();  // tells this run from others of the journal
  std::unique_ptr<CallPicture> calls_;                // null: not wanted
  std::uint64_t calls_of_ = 0;                        // the revision of the picture
  bool takes_back_ = false;                           // what nobody may stop
  std::size_t kept_ = 0;
  std::uint64_t revision_ = 0;
  std::uint64_t started_ = 0;  // updates of the script with which the view begins, in the journal
};

template <int D>
void ModelOf<D>::require_showable(const Feature& feature) {
  if (std::abs(static_cast<double>(feature.number)) < static_cast<double>(kLargestId)) return;
  throw Error(ErrorCode::bad_option, text_of(feature) + ": ids beyond 2^53 cannot be viewed");
}

template <int D>
typename ModelOf<D>::Lines ModelOf<D>::texts_of(const Edits& edits) {
  Lines lines;
  for (const auto& edit : edits) lines.push_back(edit.text);
  return lines;
}

template <int D>
typename ModelOf<D>::Edits ModelOf<D>::edits_of(const Lines& lines) {
  auto script = mesher::EditScript<D>::of_text(script_of(lines), kPage);
  auto edits = script.next();
  if (!edits) throw refusal("nothing is edited");
  return std::move(*edits);
}

// The options with the limits of now, if the edits change limits.
template <int D>
std::optional<mesher::Options<D>> ModelOf<D>::limits_before(const Edits& edits) const {
  const bool any = std::any_of(edits.begin(), edits.end(), [](const Edit<D>& edit) {
    return edit.kind == mesher::EditKind::limit;
  });
  return any ? std::optional(mesher_.options()) : std::nullopt;
}

// What undoes an update: nothing if limits are to come back that no script can give.
template <int D>
std::optional<typename ModelOf<D>::Lines> ModelOf<D>::lines_back(
    Lines lines, const std::optional<mesher::Options<D>>& limits) {
  if (!limits) return lines;
  const auto again = limit_lines(*limits);
  if (!again) return std::nullopt;
  lines.insert(lines.end(), again->begin(), again->end());
  return lines;
}

template <int D>
std::set<Feature> ModelOf<D>::features_of(const Edits& edits) {
  std::set<Feature> features;
  for (const auto& edit : edits) {
    if (edit.kind != mesher::EditKind::limit) features.insert(edit.feature());
  }
  return features;
}

template <int D>
typename ModelOf<D>::Made ModelOf<D>::update(Edits edits) {
  try {
    input_.follow(edits);
    Watched watched(mesher_, progress_);
    return mesher::apply(std::move(edits), watched);
  } catch (const Error& error) {
    throw with_domain_hint<D>(error);
  }
}

template <int D>
void ModelOf<D>::replay() {
  while (auto found = journal_.next_found()) {
    const std::string& text = found->text;
    const bool of_start = text.starts_with(kStart);
    if (of_start) ++started_;
    const Why why = text.starts_with("# undo")   ? Why::undo
                    : text.starts_with("# redo") ? Why::redo
                                                 : Why::edit;
    follow_update(found->edits, why, !of_start && !text.starts_with("# folded"));
  }
}

// Makes an update that is in the journal, or that begins it.
template <int D>
void ModelOf<D>::follow_update(const Edits& edits, Why why, bool undoable) {
  const auto features = features_of(edits);
  for (const Feature& f : features) require_showable(f);
  const Graph<D> before = index_.part(features);
  const auto limits = limits_before(edits);
  auto made = locating(input_, [&] { return update(edits); });
  last_came_ = std::move(made.change.domain.kept_added);
  const Graph<D> after = index_.part(features);
  index_.take(after);
  const auto back = lines_back(graph_edits<D>(after, before), limits);
  if (undoable && back) return remember(why, texts_of(edits), *back);
  undo_.clear();
  redo_.clear();
}

template <int D>
void ModelOf<D>::make_updates_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  mesher::EditScript<D> script(path);
  std::uint64_t made = 0;
  while (const auto edits = script.next()) {
    if (edits->empty() || ++made <= started_) continue;
    follow_update(*edits, Why::edit, false);
    journal_.append(*edits, folder, kStart);
  }
}

template <int D>
void ModelOf<D>::remember(Why why, Lines again, Lines back) {
  if (why == Why::undo && !undo_.empty()) {
    redo_.push_back(std::move(undo_.back()));
    undo_.pop_back();
  } else if (why == Why::redo && !redo_.empty()) {
    undo_.push_back(std::move(redo_.back()));
    redo_.pop_back();
  } else {
    undo_.push_back({std::move(again), std::move(back)});
    redo_.clear();
  }
}

template <int D>
void ModelOf<D>::run_script(const std::string& text, const Json& tag, const Send& send) {
  // A background is a file, which a page has no business with.
  std::istringstream words(text);
  for (std::string word, before; words >> word; before = word) {
    if (before == "limit" && word == "sizes") throw refusal("a page cannot name a file of sizes");
  }
  auto script = mesher::EditScript<D>::of_text(text, kPage);
  std::vector<Lines> batches;
  while (const auto edits = script.next()) {
    if (!edits->empty()) batches.push_back(texts_of(*edits));
  }
  if (batches.empty()) throw refusal("nothing is edited");
  for (const Lines& batch : batches) change(batch, Why::edit, tag, send);
}

template <int D>
std::string ModelOf<D>::edit(const std::string& script, const Send& send) {
  settle(send);
  run_script(script, Json(), send);
  return state().dump();
}

template <int D>
Model::Work ModelOf<D>::command(ClientId client, const std::string& text, const Send& send,
                                bool runs_fresh) {
  Json tag;
  const auto answer = [&](const Json& json) { send({text_of_json(json), false, false}); };
  try {
    const Json command = Json::parse(text, nullptr, false);
    if (!command.is_object()) throw refusal("a command is a JSON object");
    const auto tagged = command.find("tag");
    if (tagged != command.end() && tagged->is_number()) tag = *tagged;
    const Json& what = field(command, "do");
    if (!what.is_string()) throw refusal("'do' is no text");
    const std::string name = what.get<std::string>();
    if (name == "drag") {
      drag(client, command, tag, send);
      return {};
    }
    settle(send);
    if (name == "undo" || name == "redo") {
      go_back(name == "redo", tag, send);
    } else if (name == "snapshot") {
      send({snapshot(), true, false});
    } else if (name == "fresh") {
      if (runs_fresh) throw refusal("a fresh run is under way");
      return fresh(tag);
    } else if (name == "calls") {
      watch_calls(command, tag, send);
    } else if (name == "script") {
      const Json& script = field(command, "text");
      if (!script.is_string()) throw refusal("'text' is no text");
      run_script(script.get<std::string>(), tag, send);
    } else if (name == "limit" || name == "unlimit") {
      change(limit_lines_of<D>(command, mesher_.options()), Why::edit, tag, send);
    } else if (name == "point" || name == "line" || name == "polygon" || name == "hole" ||
               name == "region" || name == "delete") {
      change(index_.lines_of(command), Why::edit, tag, send);
    } else {
      throw refusal("no command is called '" + name.substr(0, 40) + "'");
    }
  } catch (const Error& error) {
    answer(json_of_error(error, tag));
  } catch (const std::bad_alloc&) {
    answer(json_of_error(Error(ErrorCode::too_many, "out of memory"), tag));
  }
  return {};
}

// --- Updates ---------------------------------------------------------------------------------

// Puts an update that was made into journal and history. Throws: Error(cannot_write), and then it
// is to be taken back.
template <int D>
void ModelOf<D>::record(const Edits& edits, Why why, const std::optional<Lines>& back) {
  journal_.append(edits, "", why == Why::undo ? "# undo\n" : why == Why::redo ? "# redo\n" : "");
  if (back) return remember(why, texts_of(edits), *back);
  undo_.clear();
  redo_.clear();
}

template <int D>
void ModelOf<D>::change(const Lines& lines, Why why, const Json& tag, const Send& send) {
  Edits edits = edits_of(lines);
  const auto features = features_of(edits);
  for (const Feature& f : features) require_showable(f);
  if (journal_.is_long()) journal_.make_room(mesher_.input());
  const Graph<D> before = index_.part(features);
  const auto limits = limits_before(edits);
  auto made = update(edits);
  const Graph<D> after = index_.part(features);
  index_.take(after);
  const Lines features_back = graph_edits<D>(after, before);
  const auto back = lines_back(features_back, limits);
  try {
    record(edits, why, back);
  } catch (const Error&) {
    take_back(features_back, limits);
    kept_ = count_kept(mesher_);
    send({snapshot(), true, true});  // pages know neither the update nor the other
    throw;
  }
  send_change(made, features, tag, send);
  last_came_ = std::move(made.change.domain.kept_added);
  draw_calls(send);
}

template <int D>
typename ModelOf<D>::Made ModelOf<D>::take_back(Edits edits) {
  const Set whole(takes_back_, true);
  return update(std::move(edits));
}

template <int D>
void ModelOf<D>::take_back(const Lines& lines, const std::optional<mesher::Options<D>>& limits) {
  if (!lines.empty()) take_back(edits_of(lines));
  if (!limits) return;
  const Set whole(takes_back_, true);
  announce_limits(*limits, mesher_);
  Watched(mesher_, progress_).update();
}

// One that begins.
template <int D>
typename ModelOf<D>::Drag ModelOf<D>::drag_of(ClientId client, const Json& command) const {
  const Feature feature = command.contains("point") ? Feature(PointId{id_of(command["point"])})
                                                    : feature_of(field(command, "feature"));
  if (feature.seed()) throw refusal("holes and regions are not dragged");
  Drag drag{client, feature, {}, false, {}, {}};
  for (const PointId p : index_.points_of(feature)) drag.from[p] = mesher_.point(p)->at;
  if (drag.from.empty()) throw Error(ErrorCode::unknown_id, text_of(feature) + " is not there");
  return drag;
}

// Where the points are to be.
template <int D>
typename ModelOf<D>::Places ModelOf<D>::targets_of(const Json& command, const Places& from) {
  Places places = from;
  if (command.contains("point")) {
    places.begin()->second = position_of_json<D>(field(command, "at"));
    return places;
  }
  const auto by = position_of_json<D>(field(command, "by"));
  for (auto& [point, at] : places) {
    for (std::size_t i = 0; i < D; ++i) at[i] += by[i];
  }
  return places;
}

// Of the points that are not there.
template <int D>
typename ModelOf<D>::Lines ModelOf<D>::moves_to(const Places& places) const {
  Lines lines;
  for (const auto& [point, at] : places) {
    const auto now = mesher_.point(point);
    if (now && now->at != at) lines.push_back("move" + id_word(point) + place_words<D>(at));
  }
  return lines;
}

template <int D>
void ModelOf<D>::drag(ClientId client, const Json& command, const Json& tag, const Send& send) {
  const Drag next = drag_of(client, command);
  const bool drops = flag_of(command, "drop");
  const bool goes_on = drag_ && drag_->client == client && drag_->feature == next.feature;
  const Places to = targets_of(command, goes_on ? drag_->from : next.from);
  if (!goes_on) {
    settle(send);
    drag_ = next;
  }
  std::optional<Error> refused;
  if (const Lines moves = moves_to(to); !moves.empty()) {
    try {
      Edits edits = edits_of(moves);
      const auto features = features_of(edits);
      const auto made = update(std::move(edits));
      drag_->moved = true;
      drag_->follow(made.change.domain);
      send_change(made, features, tag, send);
    } catch (const Error& error) {
      refused = error;
    }
  } else if (!drops) {
    send({Json{{"kind", "still"}, {"tag", tag}}.dump(), false, false});
  }
  if (drops) {
    settle(send);
    send({Json{{"kind", "dropped"}, {"tag", tag}, {"state", state()}}.dump(), false, false});
  }
  if (refused) throw *refused;
}

// Ends a drag: what it did is one update.
template <int D>
void ModelOf<D>::settle(const Send& send) {
  if (!drag_) return;
  const Drag dragged = *drag_;
  drag_.reset();
  const Lines back = moves_to(dragged.from);
  if (!dragged.moved || back.empty()) return;
  const Edits undoing = edits_of(back);
  Lines moves;
  for (const Feature& f : features_of(undoing)) {
    moves.push_back("move" + id_word(*f.point()) + place_words<D>(mesher_.point(*f.point())->at));
  }
  const Edits edits = edits_of(moves);
  try {
    record(edits, Why::edit, back);
  } catch (const Error& error) {
    send_change(take_back(undoing), features_of(undoing), Json(), send);
    send({text_of_json(json_of_error(error, Json())), false, true});
    return;
  }
  last_came_.assign(dragged.came.begin(), dragged.came.end());
  send({Json{{"kind", "state"}, {"state", state()}}.dump(), false, true});
  draw_calls(send);
}

template <int D>
void ModelOf<D>::go_back(bool redo, const Json& tag, const Send& send) {
  const auto& from = redo ? redo_ : undo_;
  if (from.empty())
    throw refusal(redo ? "there is nothing to do again" : "there is nothing to undo");
  const Lines lines = redo ? from.back().again : from.back().back;
  if (!lines.empty()) return change(lines, redo ? Why::redo : Why::undo, tag, send);
  remember(redo ? Why::redo : Why::undo, {}, {});  // what it changed nothing of
  send({Json{{"kind", "state"}, {"state", state()}, {"tag", tag}}.dump(), false, true});
}

template <int D>
void ModelOf<D>::watch_calls(const Json& command, const Json& tag, const Send& send) {
  calls_.reset();
  calls_of_ = 0;
  if (flag_of(command, "on")) {
    if (mesher_.options().threads > 1) {
      throw refusal("calls are drawn of a mesh on one thread: start without --threads");
    }
    calls_ = std::make_unique<CallPicture>(mesher_.engine(), mesher_.stats().calls);
  }
  send({Json{{"kind", "state"}, {"state", state()}, {"tag", tag}}.dump(), false, true});
}

// After an update that is in the journal: those of a drag on its way are drawn as one.
template <int D>
void ModelOf<D>::draw_calls(const Send& send) {
  if (!calls_) return;
  try {
    calls_->follow(mesher_.engine(), mesher_.stats().calls);
    calls_of_ = revision_;
  } catch (const Error& error) {
    calls_.reset();
    send({text_of_json(json_of_error(error, Json())), false, true});
  }
  send({Json{{"kind", "state"}, {"state", state()}}.dump(), false, true});
}

template <int D>
Model::Work ModelOf<D>::fresh(const Json& tag) {
  auto options = mesher_.options();
  options.algorithm = mesher::Algorithm::gap_balls;
  auto graph = std::make_shared<const Graph<D>>(mesher_.input());
  auto mesh = std::make_shared<const mesher::MeshData<D>>(mesher_.mesh());
  const std::uint64_t revision = revision_, calls = mesher_.stats().calls;
  return [options, graph, mesh, revision, calls, tag](std::stop_token stop) -> std::string {
    try {
      const double start = mesher::now();
      const auto made = mesher::mesh(*graph, options, {.progress = {}, .stop = std::move(stop)});
      const double seconds = mesher::now() - start;
      const mesher::Mesh<D>&a = made.mesh, &b = *mesh;
      return Json{{"kind", "fresh"},
                  {"seconds", seconds},
                  {"vertices", made.report.stats.vertices},
                  {"simplices", made.report.stats.simplices},
                  {"calls", calls},
                  {"same", a == b},
                  {"revision", revision},
                  {"tag", tag}}
          .dump();
    } catch (const Error& error) {
      return text_of_json(json_of_error(error, tag));
    } catch (const std::bad_alloc&) {
      return json_of_error(Error(ErrorCode::too_many, "out of memory"), tag).dump();
    }
  };
}

// --- Messages --------------------------------------------------------------------------------

template <int D>
Json ModelOf<D>::state() const {
  const auto live = mesher_.live();
  return {{"revision", revision_},
          {"vertices", live.vertices()},
          {"simplices", live.simplex_count()},
          {"kept", kept_},
          {"undo", undo_.size()},
          {"redo", redo_.size()},
          {"updates", journal_.file().place().updates},
          {"calls", calls_ ? Json(calls_of_) : Json()},
          {"journal", journal_.file().path()}};
}

template <int D>
std::string ModelOf<D>::snapshot() {
  Message message;
  const auto& domain = mesher_.options().domain;
  message.head = {{"kind", "snapshot"},
                  {"dimension", D},
                  {"name", fs::path(args_.source).filename().string()},
                  {"rho", mesher_.options().rho},
                  {"lo", domain.lo},
                  {"hi", domain.hi},
                  {"state", state()},
                  {"run", run_},
                  {"seeds", json_of_seeds(mesher_, index_.seeds())},
                  {"limits", json_of_limits(mesher_.options())},
                  {"arrays", Json::array()}};
  add_mesh(mesher_, message);
  return message.bytes();
}

template <int D>
void ModelOf<D>::send_change(const Made& update, const std::set<Feature>& features, const Json& tag,
                             const Send& send) {
  const auto& change = update.change;
  const mesher::SlotChange& slots = change.slots;
  kept_ = kept_ + change.domain.kept_added.size() - change.domain.kept_removed.size();
  ++revision_;
  Message message;
  message.head = {{"kind", "change"},
                  {"seconds", update.seconds},
                  {"executed", change.calls.executed},
                  {"reused", change.calls.reused},
                  {"came", slots.simplices_added.size()},
                  {"went", slots.simplices_removed.size()},
                  {"vertices_came", slots.vertices_added.size()},
                  {"vertices_went", slots.vertices_removed.size()},
                  {"edit", update.text().substr(0, 200)},
                  {"state", state()},
                  {"tag", tag},
                  {"arrays", Json::array()}};
  const bool seeded = std::any_of(features.begin(), features.end(),
                                  [](const Feature& f) { return f.seed().has_value(); });
  // Lines that come or go may give a seed its region, or take it.
  const bool may_move =
      !index_.seeds().empty() && !(slots.edges_added.empty() && slots.edges_removed.empty());
  if (seeded || may_move) {
    message.head["seeds"] = json_of_seeds(mesher_, index_.seeds());
  }
  if (limits_before(update.edits)) message.head["limits"] = json_of_limits(mesher_.options());
  add_change(mesher_, change, message);
  std::vector<double> gone;
  for (const Feature& f : features) {
    if (f.point() && !mesher_.point(*f.point())) gone.push_back(static_cast<double>(f.number));
  }
  message.add("points_removed", gone);
  add_points(index_.part(features), message);
  send({message.bytes(), true, true});
}

// Edits that make the input of nothing; with its limits, unless there is a background among them.
template <int D>
std::string ModelOf<D>::input_script() const {
  Lines lines = graph_edits<D>({}, mesher_.input());
  const auto limits = limit_lines(mesher_.options());
  if (limits) lines.insert(lines.end(), limits->begin(), limits->end());
  return limits ? script_of(lines) : "# limits of a background are not here\n" + script_of(lines);
}

template <int D>
SavedFile ModelOf<D>::saved(const std::string& name, const Send& send) {
  settle(send);
  const std::string stem = fs::path(args_.source).stem().string();
  if (name == "edits.txt") return {stem + ".edits.txt", "text/plain", journal_.file().script()};
  if (name == "input.txt") return {stem + ".input.txt", "text/plain", input_script()};
  const ScratchFolder folder;
  if (name == "input.poly") {
    mesher::write_graph(mesher_.input(), (folder.path() / (stem + ".edited.poly")).string());
  } else {
    const std::string format = mesher::format_of(name);
    if (name != "mesh" + format) throw Error(ErrorCode::unknown_format, "no file is called so");
    Outputs<D> outputs;
    outputs.set_names(names_);
    mesher::WriteOptions options;
    if (args_.order == "2") options.order = 2;
    if (args_.msh_version == "2.2") options.msh = mesher::MshVersion::v2_2;
    outputs.open_mesh(
        (folder.path() / (stem + format)).string(),
        input_.has_features() ? mesher::MeshFiles::features : mesher::MeshFiles::plain, options);
    outputs.write(kept_of<D>(args_, mesher_), last_came_);
    outputs.commit();
  }
  auto files = files_in(folder.path());
  if (files.size() == 1) {
    return {files[0].name, "application/octet-stream", std::move(files[0].content)};
  }
  return {stem + ".node.tar", "application/x-tar", tar_of(files)};
}

}  // namespace

std::unique_ptr<Model> make_model(const MeshArguments& args, const JournalArguments& journal,
                                  const std::string& script) {
  if (dimension_of(args) == 3) return std::make_unique<ModelOf<3>>(args, journal, script);
  return std::make_unique<ModelOf<2>>(args, journal, script);
}

}  // namespace tool::view
