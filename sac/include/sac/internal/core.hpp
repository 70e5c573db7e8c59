// The core: executes calls, keeps their trace, reuses and discards, and propagates.
//
// The parts around it, and the members that they use:
//   Engine      derived from it: modes, counts, roll-back, introspection
//   Scope       operations of a running call: call_child, call_tail, recall, attach, guarded
//   structures  Engine's public part "For structures": precedes, invalidate, doubt, ...
//   Agenda      calls that are made before they run: "For work queues" below
//
// The loop is short: pop a call that must run again from the queue (the one that is invalid at the
// earliest place), run its body, reuse the children that it requests again, undo the effects that
// it did not repeat before each of them, and discard the children that it did not request.
// docs/propagate.md walks through one propagation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sac/arena.hpp"
#include "sac/check.hpp"
#include "sac/internal/memo_table.hpp"
#include "sac/internal/originals.hpp"
#include "sac/internal/propagation_queue.hpp"
#include "sac/internal/registry.hpp"
#include "sac/internal/same.hpp"
#include "sac/internal/timeline.hpp"
#include "sac/observer.hpp"
#include "sac/structure.hpp"

namespace sac {

class Engine;

/// The work of one run or propagation, including the edits before it.
struct Counts {
  std::uint64_t executed = 0;       ///< bodies run
  std::uint64_t reused = 0;         ///< calls requested again and kept without running
  std::uint64_t created = 0;        ///< calls that are new in the trace
  std::uint64_t discarded = 0;      ///< calls that left the trace
  std::uint64_t edges_made = 0;     ///< reads, writes, posts, ... recorded
  std::uint64_t edges_removed = 0;  ///< reads, writes, posts, ... undone
  std::uint64_t confirmed = 0;      ///< calls not run: they would read the same values
  std::uint64_t weight = 0;         ///< steps reported by Scope::weigh, if weights are recorded
};

/// The findings of the audit; both counts are 0 for a concise and monotone program.
struct AuditReport {
  std::uint64_t duplicates = 0;  ///< pairs of live calls with equal labels [Def 1.4.2]
  std::uint64_t reordered = 0;   ///< calls discarded and made anew in one propagation [Def 1.4.3]
  std::string first_duplicate;   ///< label of the first pair
  std::string first_reordered;   ///< label of the first such call
};

/// The argument of a progress callback, before a call runs.
struct Progress {
  std::uint64_t executed = 0;  // bodies run so far
  std::uint64_t queued = 0;    // calls waiting in the queue
};

/// A requested call. `arguments` is the tuple to be kept, valid during the request.
struct Asked {
  const Function& function;
  const void* arguments;
  std::uint32_t hash;
  void (*construct)(void* memory, const void* arguments, std::uint32_t hash);
};

/// What the client sets.
struct Settings {
  std::function<bool(const Progress&)> progress;
  std::uint64_t progress_every = 0;
  Observer* observer = nullptr;
  struct Environment {
    void* object = nullptr;
    const std::string_view* type = nullptr;  // its name, of which there is one object
  };
  Environment environment;
  std::size_t stack_limit = 0;
  bool audit = false;
  bool watching = false;
  std::map<Handle, std::string> names;  // of modifiables, by their handles
};

class Core {
 public:
  enum class Mode : std::uint8_t { idle, running, propagating, undoing };

  explicit Core(Engine& engine);
  Core(const Core&) = delete;
  Core& operator=(const Core&) = delete;

  // --- Around a run (Engine) -----------------------------------------------------------------

  [[nodiscard]] bool idle() const noexcept { return mode_ == Mode::idle; }
  /// True while a first run appends to the trace: every call there is precedes the running one.
  [[nodiscard]] bool appending() const noexcept { return mode_ == Mode::running; }
  [[nodiscard]] bool undoing() const noexcept { return mode_ == Mode::undoing; }
  /// Throws: UsageError if the engine runs.
  void require_idle(const char* what) const;
  /// Throws: UsageError unless what is in the trace is up to date.
  void require_settled(const char* what) const {
    if (current_ != nullptr || !(idle() || queue_.empty())) require_idle(what);
  }
  /// Requires: idle, and usable.
  void enter(Mode mode);
  /// Makes the call at the end of the trace, and runs it. Throws: what the program throws.
  void run_root(const Asked& asked);
  /// Takes back what a run that failed has made.
  void forget_run(Place before) noexcept;
  [[nodiscard]] Place last_stamp() const noexcept { return timeline_.back(); }
  /// Runs what is invalid. Throws: what the program throws.
  void propagate() { propagate_within(nullptr); }
  /// An exception has ended the propagation: what runs is no more; edits may be undone.
  void begin_undoing() noexcept;
  void set_broken() noexcept { broken_ = true; }
  [[nodiscard]] bool broken() const noexcept { return broken_; }
  /// Ends a run or propagation, failed or not. Returns its counts.
  Counts finish() noexcept;
  [[nodiscard]] const AuditReport& audit() const noexcept { return report_; }
  void check_audit() {
    if (appending()) memo_.settle();
    if (settings.audit) check_suspects();
  }
  void purge() noexcept;

  // --- For the running call (Scope) ----------------------------------------------------------

  [[nodiscard]] Engine& engine() noexcept { return engine_; }
  /// Throws: UsageError if no call runs.
  [[nodiscard]] Call& self() const { return *running().call; }
  /// Makes a child of the running call, or reuses one that is ahead of it in its interval.
  Ref<Call> call_child(const Asked& asked);
  /// The same for what continues the running call, when that has ended.
  Ref<Call> call_tail(const Asked& asked);
  /// Gives the running call a new edge. Throws: std::bad_alloc.
  Edge& attach(std::uint8_t structure, std::uint8_t kind, std::size_t bytes) {
    running_here();
    return attach_here(structure, kind, bytes);
  }
  /// The same, after place(), or after recall(), which have found no call in between.
  [[gnu::always_inline]] Edge& attach_here(std::uint8_t structure, std::uint8_t kind,
                                           std::size_t bytes) {
    Activation& a = *current_;
    const Ref<Edge> h(arena_.allocate(bytes));
    Edge& edge = at(h);
    edge = {
        .structure = structure,
        .kind = static_cast<std::uint8_t>(kind & 0x3f),
        .round = a.call->round,
        .granules = static_cast<std::uint16_t>((bytes + Arena::kGranule - 1) / Arena::kGranule)};
    append_edge(a, h);
    ++counts_.edges_made;
    return edge;
  }
  /// Whether the running call has edges of its last execution that it has not repeated yet.
  [[nodiscard]] bool may_recall() const noexcept { return current_->old_edges != nullptr; }
  /// The running call's place in time: that of its segment.
  [[nodiscard]] Place place() { return running_here().place; }
  /// Moves the first edge of last time, in the same segment, that `matches` into this execution.
  /// The search goes on where the last one ended, and ends after `most` edges.
  template <class Matches>
  Edge* recall(Matches&& matches, std::size_t most = ~std::size_t{0});
  /// Runs body(). An exception fails the running call, even if that goes on to catch it: it would
  /// not depend on what has failed.
  template <class Body>
  decltype(auto) guarded(Body&& body) {
    try {
      return body();
    } catch (...) {
      if (current_ != nullptr) current_->failed = true;
      throw;
    }
  }
  /// The running call returns something else than last time.
  void result_changed() noexcept { current_->returned = current_->self; }
  void add_weight(std::uint64_t n) noexcept { counts_.weight += n; }
  /// The environment, which is a T. Throws: UsageError if it is none.
  template <class T>
  [[nodiscard]] T& environment() const {
    if (settings.environment.type != &detail::kTypeName<std::remove_cv_t<T>>) [[unlikely]]
      require_environment(detail::kTypeName<std::remove_cv_t<T>>);
    return *static_cast<T*>(settings.environment.object);
  }
  void require_own(const void* object, const char* what) const {
    if (!arena_.contains(object)) [[unlikely]]
      fail_foreign(what);
  }
  [[noreturn]] void fail_foreign(const char* what) const;
  /// `what`, after the running call if there is one.
  [[nodiscard]] std::string context(const char* what) const;

  // --- For structures ------------------------------------------------------------------------

  std::uint8_t add_structure(Structure& structure);
  void remove_structure(std::uint8_t number) noexcept { structures_[number] = nullptr; }
  void invalidate(Place place, const Edge* seen = nullptr) noexcept {
    ask_again(call_at(place), place, Validity::invalid, seen, nullptr);
  }
  void invalidate(const Call& call, const Edge* seen = nullptr) noexcept {
    invalidate(Arena::ref(call), seen);
  }
  void doubt(Place place, ModRef source = {}) noexcept {
    ask_again(call_at(place), place, Validity::doubtful, nullptr, source);
  }
  void doubt(const Call& call, ModRef source = {}) noexcept { doubt(Arena::ref(call), source); }
  /// The call that has this place: the place is its own stamp, or that of a segment.
  [[nodiscard]] Call& call_at(Place place) const noexcept {
    return at(at(place).is_call() ? as<Call>(place) : at(as<Segment>(place)).call);
  }
  [[nodiscard]] bool precedes(const TimeNode& a, const TimeNode& b) const noexcept {
    return timeline_.precedes(a, b);
  }
  /// Whether what the running call does now comes before `call`, which is not running.
  [[nodiscard]] bool lies_ahead(const Call& call) const noexcept {
    return timeline_.precedes(at(now_), call);
  }
  template <class T>
  [[nodiscard]] T& at(Ref<T> ref) const noexcept {
    return arena_[ref];
  }
  /// The call, or the segment, that has this stamp. Requires: it is that of one.
  template <class T>
  [[nodiscard]] Ref<T> as(Place place) const noexcept {
    SAC_ENSURES(at(place).kind() == T::kKind);
    return Ref<T>(place.handle());
  }
  [[nodiscard]] Arena& arena() noexcept { return arena_; }
  [[nodiscard]] const Arena& arena() const noexcept { return arena_; }
  [[nodiscard]] const Structure& structure_of(const Edge& edge) const noexcept {
    return *structures_[edge.structure];
  }
  template <class Visit>
  void for_each_edge(const Call& call, Visit&& visit) const {
    for (Ref<Edge> e = call.edges; e != nullptr; e = at(e).next) {
      const Edge& edge = at(e);
      if (!edge.begins_segment) visit(edge);
    }
  }
  [[nodiscard]] const Call* running_call() const noexcept {
    return current_ != nullptr ? current_->call : nullptr;
  }
  /// The innermost call around `call`, for messages; `call` itself if there is none.
  /// Cost: O(calls between).
  [[nodiscard]] const Call& parent_of(const Call& call) const noexcept;
  /// Tells an observer, if there is one, what has happened, by the running call.
  void note(Event::Kind kind, const Call* call = nullptr, ModRef source = {}) noexcept {
    if (settings.observer == nullptr) [[likely]]
      return;
    settings.observer->on({.kind = kind, .call = call, .source = source, .by = running_call()});
  }
  [[nodiscard]] Originals& originals() noexcept { return originals_; }
  /// While a failed propagation is undone, gives `value`, which `call` writes to `mod`, the bits of
  /// the original if that is the same. Returns whether it has.
  template <class Same, class T>
  bool restore_original(const Call& call, ModRef mod, T& value) {
    const T* const original = undoing() ? originals_.find<T>(call, mod) : nullptr;
    if (original == nullptr || !detail::same<Same>(*original, value)) return false;
    value = *original;
    return true;
  }

  // --- For work queues -----------------------------------------------------------------------
  //
  // A posted call is made (Life::waiting), gets its place or is run at once, and is discarded when
  // its turn comes and nobody asks for it (Slot::posts). Call::work_queue says whose it is.

  /// The call of this label that `fits(call)`; null if there is none.
  template <class Fits>
  [[nodiscard]] Ref<Call> find_posted(const Asked& asked, Fits&& fits) {
    const std::uint16_t number = number_of(asked.function);
    return memo_.find(asked.hash, [&](const Call& c) {
      return c.function_number == number && !c.dead() && fits(c) &&
             asked.function.equal(c, asked.arguments);
    });
  }
  /// A call that waits. Throws: std::bad_alloc, and what copying arguments throws.
  Ref<Call> new_call(const Asked& asked);
  /// Gives a call that waits its place, right behind time stamp `after`, or now if that is not in
  /// the list yet, and puts it on the propagation queue.
  void place(Ref<Call> call, Place after);
  /// Gives a call that waits its place, now, and runs it as a child of the running call.
  void place_now(Ref<Call> call);
  void run_placed(Ref<Call> call);
  /// A call that waits leaves for good.
  void drop_call(Ref<Call> call) noexcept;
  /// A call that lost its place waits on.
  void set_waiting(Call& call) noexcept;
  void discard_subtree(Ref<Call> call) noexcept;
  /// A placed call that nobody posts any more goes when its turn comes.
  void enqueue(Call& call) noexcept { enqueue(call, arena_.ref(call)); }
  /// The running call will have children: it has an end.
  void need_end() { need_end(running()); }
  [[nodiscard]] Place end_of(Ref<Call> call) const noexcept {
    const Place end = at(call).end;
    return end != nullptr ? end : call;
  }
  /// Whether a call put right behind time stamp `stamp` would lie ahead. (The end stamp of a
  /// running call may have no place yet.)
  [[nodiscard]] bool is_ahead(Place stamp) const noexcept {
    return stamp == now_ || !linked(stamp) || timeline_.precedes(at(now_), at(stamp));
  }
  [[nodiscard]] std::uint16_t number_of(const Function& function) {
    const std::uint16_t number = functions_.number(function);
    arena_.header().functions = functions_.data();
    return number;
  }

  // --- What there is -------------------------------------------------------------------------

  struct Sizes {
    std::size_t time_stamps, memo_table, queue;
  };
  [[nodiscard]] Sizes sizes() const noexcept;
  [[nodiscard]] std::uint64_t live_calls() const noexcept { return live_calls_; }
  [[nodiscard]] std::uint64_t live_edges() const noexcept {
    return edges_before_ + counts_.edges_made - counts_.edges_removed;
  }
  [[nodiscard]] bool settled() const noexcept { return queue_.empty(); }
  [[nodiscard]] const Registry<Function>& functions() const noexcept { return functions_; }
  /// Whether a call that is in the trace has this place; anything may lie there.
  [[nodiscard]] bool is_live_place(Place place) const noexcept;
  /// Calls visit(call, depth) for every placed call in pre-order.
  template <class Visit>
  void walk(Visit&& visit) const;
  /// Calls visit(call) for every call.
  template <class Visit>
  void for_each_call(Visit&& visit) const {
    memo_.for_each(visit);
  }
  template <class Visit>
  void for_each_structure(Visit&& visit) const {
    for (Structure* s : structures_) {
      if (s != nullptr) visit(*s);
    }
  }
  /// Throws: UsageError if a call has it as an argument. Cost: O(calls) if a function takes
  /// agendas.
  void require_no_argument(const Agenda& agenda) const;
  void shrink();
  void check_invariants(std::uint64_t waiting) const;

  Settings settings;
  void forget_names(Handle from, std::size_t bytes) noexcept;

 private:
  // One execution on the native stack: a call and the tail calls that continue it.
  struct Activation {
    Call* call = nullptr;
    Ref<Call> self{};           // that call
    Place place{};              // of its segment
    Ref<Edge> old_edges{};      // what the call did last time and has not repeated yet
    Ref<Edge> cursor{};         // behind it the next old edge is looked for; null: the first
    Ref<Edge>* link = nullptr;  // where the next edge of this execution goes
    Place limit{};     // end of the interval in which calls may be reused; null: end of the trace
    Place end{};       // end stamp, once there are children
    Ref<Call> tail{};  // requested; a new one waits
    Ref<Call> returned{};      // the call that has returned something else than last time
    Ref<Call> failed_child{};  // whose exception passes through the call's body
    bool end_linked = false;
    bool failed = false;  // something that it asked for has thrown
    Activation* outer = nullptr;
  };

  [[nodiscard]] Activation& running() const {
    if (current_ != nullptr) [[likely]]
      return *current_;
    fail_not_running();
  }
  // What runs, in the segment in which it does the next thing.
  Activation& running_here() {
    Activation& a = running();
    if (now_ != a.place) [[unlikely]]
      begin_segment(a);
    return a;
  }
  template <class T>
  [[nodiscard]] bool is_stamped(Ref<T> stamped) const noexcept;
  [[noreturn]] void fail_not_running() const;
  void require_environment(std::string_view type) const;
  // An end stamp has no place until its call closes.
  [[nodiscard]] bool linked(Place stamp) const noexcept { return at(stamp).prev != nullptr; }
  void ask_again(Call& call, Place place, Validity validity, const Edge* seen,
                 ModRef source) noexcept;
  void enqueue(Call& call, Place place) noexcept;
  void note_failure(Event::Kind kind, const Call* call = nullptr) noexcept;

  // execute.cpp
  void execute(Ref<Call> call, Place limit);
  void run_body(Activation& a, Ref<Call> call);
  [[noreturn]] void fail_caught(const Activation& a) const;
  void begin_segment(Activation& a);
  void enter_segment(Activation& a);
  void settle(Activation& a) noexcept;
  void tell_caller(Ref<Call> call) noexcept;
  [[nodiscard]] bool has_new_tail(const Activation& a) const noexcept {
    return a.tail != nullptr && at(a.tail).waiting();
  }
  [[nodiscard]] Ref<Call> next_link(Activation& a);
  void close(Activation& a);
  void link_end(Activation& a);
  void abandon(Activation& a) noexcept;
  // A call gets its end stamp with its first child. It is linked when the call closes, because the
  // calls that it may still reuse lie between.
  void need_end(Activation& a) {
    if (a.end == nullptr) a.end = new_end();
    a.call->end = a.end;
  }
  [[nodiscard]] Place new_end();
  void report_progress();

  // propagate.cpp
  void propagate_within(Ref<Call> call);
  [[nodiscard]] bool next_is_within(Ref<Call> call) const noexcept;
  [[nodiscard]] static bool unposted(const Call& call) noexcept {
    return call.posted && Slot::of(call).posts == nullptr;
  }
  void run_from_queue(PropagationQueue::Entry entry);
  [[nodiscard]] bool confirmed(Call& call, Place place);
  [[nodiscard]] bool unchanged(Call& call, Edge& edge);
  void settle_child(Ref<Call> child);

  // interval.cpp
  // A call to be reused; null if there is none, nor anything ahead: a first run.
  [[nodiscard]] Ref<Call> find_reusable(const Asked& asked, bool tail) {
    return at(now_).next != current_->limit ? find_ahead(asked, tail) : nullptr;
  }
  [[nodiscard]] Ref<Call> find_ahead(const Asked& asked, bool tail);
  void reuse(Ref<Call> child) noexcept;
  void settle_before(Activation& a, const TimeNode& child) noexcept;
  void pass(const Segment& segment) noexcept;
  [[noreturn]] void fail_call(const Activation& caller, const Function& function) const;
  void insert_call(Ref<Call> call);
  void make_room(std::size_t calls);
  void give_place(Ref<Call> call, Place after);
  void check_suspects();
  void suspect(Ref<Call> fresh, const Asked& asked);
  void free_call(Ref<Call> call) noexcept;
  void discard_between(Place from, Place to) noexcept;
  void discard(Ref<Call> call) noexcept;
  [[nodiscard]] Ref<Edge> retract(Call& call, Ref<Edge> edges, const TimeNode* until) noexcept;
  void retract_all(Call& call, Ref<Edge> edges) noexcept {
    static_cast<void>(retract(call, edges, nullptr));
  }
  // Moves the old edge at `link` into this execution.
  Edge* take_old(Activation& a, Ref<Edge>* link) noexcept {
    const Ref<Edge> taken = *link;
    Edge& edge = at(taken);
    *link = edge.next;
    edge.next = nullptr;
    edge.round = a.call->round;
    append_edge(a, taken);
    return &edge;
  }
  void append_edge(Activation& a, Ref<Edge> edge) noexcept {
    *a.link = edge;
    a.link = &at(edge).next;
  }

  Engine& engine_;
  Arena arena_;
  Timeline timeline_;
  MemoTable memo_;
  PropagationQueue queue_;
  Registry<Function> functions_;
  std::vector<Structure*> structures_;
  Originals originals_;
  std::vector<Ref<Call>> graveyard_;
  std::size_t most_leaving_ = 0;  // so much of it has been in use
  std::size_t room_ = 0;          // for so many calls there is room in all three
  std::vector<std::pair<Ref<Call>, Ref<Call>>> suspects_;
  AuditReport report_;
  Activation* current_ = nullptr;
  std::uintptr_t stack_end_ = 0;  // no call is made when the native stack has grown down to here
  Place now_;                     // the last time stamp that is settled or running
  Mode mode_ = Mode::idle;
  bool broken_ = false;
  std::uint64_t progress_at_ = ~std::uint64_t{0};  // number of bodies run at the next report
  Counts counts_;
  std::uint64_t live_calls_ = 0;
  std::uint64_t edges_before_ = 0;  // the live ones when the counts were last set to nothing
};

/// A structure with calls of its own: what the core tells it of them.
class WorkQueue : public Structure {
 public:
  /// `call` has left the trace. If it is still asked for, it waits: the queue keeps it.
  virtual void left(Call& call, bool asked_for) noexcept = 0;
};

template <class Matches>
Edge* Core::recall(Matches&& matches, std::size_t most) {
  Activation& a = running_here();
  if (a.old_edges == nullptr) return nullptr;
  const auto search = [&](Ref<Edge> previous, Ref<Edge> end) -> Edge* {
    Ref<Edge>* link = previous != nullptr ? &at(previous).next : &a.old_edges;
    for (; *link != end && *link != nullptr && most > 0; previous = *link, link = &at(*link).next) {
      Edge& edge = at(*link);
      if (edge.begins_segment) break;
      --most;
      if (!matches(edge)) continue;
      a.cursor = previous;
      return take_old(a, link);
    }
    return nullptr;
  };
  const Ref<Edge> start = a.cursor;
  if (Edge* found = search(start, nullptr)) return found;
  // From the first one, up to and with the one where the search began.
  return start != nullptr ? search(nullptr, at(start).next) : nullptr;
}

template <class Visit>
void Core::walk(Visit&& visit) const {
  std::vector<Place> open;  // end stamps of the intervals around the current call
  for (Place p = at(timeline_.front()).next; p != nullptr; p = at(p).next) {
    if (!at(p).is_call()) {
      while (!open.empty() && open.back() == p) open.pop_back();
      continue;
    }
    const Call& c = at(as<Call>(p));
    visit(c, open.size());
    if (c.end != nullptr) open.push_back(c.end);
  }
}

}  // namespace sac
