// The engine: runs programs, keeps their traces, and brings the traces up to date.
//
// Three primitives carry everything changeable (DESIGN: mods, agendas, users' own types):
//   observe     the running call depends on something      Scope::observe
//   effect      the running call did something             Scope::effect
//   invalidate  a call's observation may have changed      Engine::invalidate
//
// Guarantees:
// (1) After propagate() everything observable is what a run from scratch would leave.
// (2) Invalidated calls run in trace order; whatever precedes the running call is settled.
// (3) A call that runs again reuses children with equal labels that lie ahead of it in its own
//     interval, subtrees included, without running them; what it passes over is discarded. What
//     is invalid in a reused subtree runs before its new parent goes on. (A tail call that ends
//     the interval is reused by a tail call only: its end stamp is the interval's.)
// (4) If client code throws in propagate(), the edits of the batch are undone and propagated; if
//     that fails too, the engine refuses all further work.
// (5) Memory of discarded calls is freed when the propagation ends, not before.
//
// An engine is used by one thread at a time; engines share nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/internal/arena.hpp"
#include "sac/check.hpp"
#include "sac/label.hpp"
#include "sac/internal/memo_table.hpp"
#include "sac/observer.hpp"
#include "sac/internal/parameters.hpp"
#include "sac/internal/propagation_queue.hpp"
#include "sac/internal/registry.hpp"
#include "sac/internal/timeline.hpp"
#include "sac/trace.hpp"

namespace sac {

template <class T, class Same = std::equal_to<>>
class Mod;
template <class T, class Same = std::equal_to<>>
class Cell;
class Agenda;
class ModStructure;

/// The work of one run or propagation, with that of the edits before it.
struct Counts {
  std::uint64_t executed = 0;       ///< bodies run
  std::uint64_t reused = 0;         ///< calls asked for again and kept without running
  std::uint64_t created = 0;        ///< calls that are new in the trace
  std::uint64_t discarded = 0;      ///< calls that left the trace
  std::uint64_t edges_made = 0;     ///< reads, writes, posts, ... recorded
  std::uint64_t edges_removed = 0;  ///< reads, writes, posts, ... taken back
  std::uint64_t confirmed = 0;      ///< calls not run: they would read what they have read
};

/// What the detectors saw; both empty for a program that is concise and monotone.
struct AuditReport {
  std::uint64_t duplicates = 0;  ///< pairs of live calls with equal labels [Def 1.4.2]
  std::uint64_t reordered = 0;   ///< calls discarded and made anew in one propagation [Def 1.4.3]
  std::string first_duplicate;   ///< label of the first pair
  std::string first_reordered;   ///< label of the first such call
};

/// Memory of an engine in bytes. `live` is in use; `held` is what the engine has taken from the
/// system, freed blocks that wait to be used again included.
struct Memory {
  std::size_t calls_and_edges_live = 0;
  std::size_t calls_and_edges_held = 0;
  std::size_t time_stamps = 0;  // groups; the stamps themselves lie in the calls
  std::size_t memo_table = 0;
  std::size_t queue = 0;    // and what else a propagation needs
  std::size_t agendas = 0;
  std::size_t versions = 0;  // order of modifiables that are written more than once
  std::size_t outside = 0;   // list of the outside's objects, and how to take edits back
  [[nodiscard]] std::size_t live() const noexcept {
    return calls_and_edges_live + time_stamps + memo_table + queue + agendas + versions + outside;
  }
  [[nodiscard]] std::size_t held() const noexcept {
    return live() - calls_and_edges_live + calls_and_edges_held;
  }
};

/// The calls of one function: how many, and the bytes of their frames and edges.
struct FunctionProfile {
  std::string_view name;
  std::uint64_t calls = 0;
  std::uint64_t bytes = 0;
  std::uint64_t edges = 0;
  std::uint64_t edge_bytes = 0;
};

/// What a progress callback is told, at a call that is about to run.
struct Progress {
  std::uint64_t executed = 0;  // bodies run so far
  std::uint64_t queued = 0;    // calls known to wait
};

class Engine {
 public:
  Engine();
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // --- The client's side -------------------------------------------------------------------

  /// A new modifiable with a value, to be changed by set().
  template <class T, class Same = std::equal_to<>>
  [[nodiscard]] Mod<T, Same> input(T value);
  /// A new modifiable for the program to write.
  template <class T, class Same = std::equal_to<>>
  [[nodiscard]] Mod<T, Same> cell();
  /// A new object of the outside, with cells as members that set() may make inputs: a node of an
  /// input list, say.
  template <class T>
  [[nodiscard]] T& make();
  /// Frees what input(), cell() or make() gave, at the end of the next propagation or run: an edit.
  /// That fails with UsageError if a call still reads or writes a modifiable in it; no call may use
  /// it in another way, nor wait on an agenda to do so.
  template <class T>
  void release(T& object);
  template <class T, class Same>
  void release(Mod<T, Same> mod);

  /// Changes an input, or makes one of a cell that nobody has written. A value that is the same
  /// changes nothing. Throws: UsageError if the program writes it. Cost: O(readers).
  template <class T, class Same>
  void set(Mod<T, Same> mod, std::type_identity_t<T> value);
  template <class T, class Same>
  void set(const Cell<T, Same>& cell, std::type_identity_t<T> value);
  /// The value at the end of the trace. Throws: UsageError if unwritten.
  template <class T, class Same>
  [[nodiscard]] const T& get(Mod<T, Same> mod) const;
  template <class T, class Same>
  [[nodiscard]] const T& get(const Cell<T, Same>& cell) const;

  /// What messages shall call a modifiable.
  template <class T, class Same>
  void name(Mod<T, Same> mod, std::string name) {
    names_[mod.head()] = std::move(name);
  }

  /// Runs f(scope, args...) at the end of the trace. Edits made before can no longer be undone.
  /// Throws: what the program throws, with everything it did taken back.
  template <auto F, class... Args>
  Counts run(Args... args);

  /// Brings the trace up to date with the edits since the last call.
  /// Throws: what the program throws, and Cancelled, with the edits undone.
  /// Cost: calls run again, plus O(log) of the queue for each.
  Counts propagate() { return propagate(nullptr); }
  /// The same; when all is up to date, and while it can still be undone, last() looks at the result.
  /// If it throws, the edits are undone as if the program had thrown.
  Counts propagate(const std::function<void()>& last);

  /// A new work queue, owned by the engine.
  [[nodiscard]] Agenda& make_agenda(std::string name);

  /// An object that the program's calls reach through Scope::environment: the same for the life of
  /// the trace, and not itself a dependence (what in it changes must be a mod or a structure).
  void set_environment(void* environment) noexcept { environment_ = environment; }

  /// Calls `report` before the first of every `every` calls that run; if it returns false, the run
  /// or propagation ends with Cancelled, and the engine is as before it. Null: nobody is told.
  /// Not called while edits are undone.
  void set_progress(std::function<bool(const Progress&)> report, std::uint64_t every = 1024);

  /// Tells `observer` of all that happens; null: nobody. See EventLog.
  void set_observer(Observer* observer) noexcept { observer_ = observer; }
  [[nodiscard]] Observer* observer() const noexcept { return observer_; }

  /// How much native stack calls inside of calls may take, in bytes, counted from run() or
  /// propagate(); beyond, UsageError. At first 3/4 of the process's limit (RLIMIT_STACK; 2 MiB if
  /// it has none): to be set for threads that have less, and if the client's own frames need more.
  void set_stack_limit(std::size_t bytes) noexcept { stack_limit_ = bytes; }

  /// Watches for calls that break conciseness or monotonicity; costs a table look-up a call.
  void set_audit(bool on) noexcept { audit_ = on; }
  [[nodiscard]] const AuditReport& audit() const noexcept { return report_; }

  [[nodiscard]] std::uint64_t live_calls() const noexcept { return live_calls_; }
  [[nodiscard]] std::uint64_t live_edges() const noexcept { return live_edges_; }
  /// Memory that the trace uses: memory().live().
  [[nodiscard]] std::size_t bytes() const noexcept { return memory().live(); }
  [[nodiscard]] Memory memory() const noexcept;
  /// Calls and bytes by function, the largest first. Cost: O(trace).
  [[nodiscard]] std::vector<FunctionProfile> profile() const;
  /// Gives memory that is not in use back to the system. Throws: UsageError if the engine runs.
  /// Cost: O(free blocks) and the size of the tables.
  void shrink();
  /// From now on the trace may hold so many bytes of calls and edges; beyond, std::bad_alloc.
  /// Edits are undone without a limit.
  void set_memory_limit(std::size_t bytes) noexcept { arena_.set_limit(bytes); }
  [[nodiscard]] bool idle() const noexcept { return mode_ == Mode::idle; }

  /// Calls visit(call, depth) for every live call in pre-order.
  template <class Visit>
  void walk(Visit&& visit) const;

  /// `name(arguments)`.
  [[nodiscard]] static std::string describe(const Call& call);
  /// What messages call a modifiable: `modifiable 'price' (@7)`.
  [[nodiscard]] std::string describe_mod(Handle head) const;

  /// Throws: InvariantError. Cost: O(trace).
  void check_invariants() const;

  // --- For structures ----------------------------------------------------------------------

  /// Gives a structure the number that its edges carry. The structure outlives the trace.
  std::uint8_t add_structure(Structure& structure);

  /// Before an outside edit: refuses if the engine runs or is broken. `what` names it.
  void begin_edit(const char* what = "edit");
  /// How to take the edit back if the next propagation fails. Cleared when it succeeds.
  void on_rollback(std::function<void()> undo) { rollback_.push_back(std::move(undo)); }
  /// Makes the edits of body(): all of them, or none if it throws.
  template <class Body>
  void edit_together(Body&& body);
  /// Forgets all edits since the last propagation by undoing them, newest first.
  /// Throws: what the client's arguments throw when compared; the engine is broken then.
  void undo_edits();

  /// The call's observation may have changed: it will run again. `seen` tells observers which: the
  /// edge that says what it saw.
  void invalidate(Call& call, const Edge* seen = nullptr) noexcept {
    ask_again(call, Call::kInvalid, seen, 0);
  }
  /// A modifiable that the call has read may have another value: it will run again if that is so
  /// when its turn comes. `source` tells observers which; 0: not known.
  void doubt(Call& call, Handle source = 0) noexcept {
    ask_again(call, Call::kDoubtful, nullptr, source);
  }
  [[nodiscard]] bool precedes(const Call& a, const Call& b) const noexcept {
    return timeline_.precedes(a, b);
  }
  [[nodiscard]] Call& call(Handle handle) const noexcept { return *arena_.at<Call>(handle); }
  [[nodiscard]] Handle handle_of(const Call& call) const noexcept {
    return arena_.handle_of(&call);
  }
  /// True while a first run appends to the trace: every call there is precedes the running one.
  [[nodiscard]] bool appending() const noexcept { return mode_ == Mode::running; }
  /// The structure that `edge` belongs to.
  [[nodiscard]] const Structure& structure_of(const Edge& edge) const noexcept {
    return *structures_[edge.structure];
  }
  /// Calls visit(edge) for what `call` did and saw, in its order.
  template <class Visit>
  void for_each_edge(const Call& call, Visit&& visit) const {
    for (Handle e = call.edges; e != 0; e = at<Edge>(e)->next) {
      visit(static_cast<const Edge&>(*at<Edge>(e)));
    }
  }
  [[nodiscard]] Arena& arena() noexcept { return arena_; }
  [[nodiscard]] const Arena& arena() const noexcept { return arena_; }

 private:
  friend class Scope;
  friend class Agenda;
  friend class ModStructure;

  enum class Mode : std::uint8_t { idle, running, propagating, undoing };

  // An object of the outside in memory: head, object.
  struct OutsideHead {
    std::uint32_t position;  // in outside_
    std::uint16_t type;
    bool released;
  };
  struct OutsideType {
    std::uint32_t bytes;  // with the head
    void (*destroy)(void*);
  };
  template <class T>
  static constexpr OutsideType kOutsideType{sizeof(OutsideHead) + sizeof(T),
                                            [](void* object) { static_cast<T*>(object)->~T(); }};
  using Construct = void (*)(void*, const void*);

  // One execution on the native stack: a call and the tail calls that continue it.
  struct Activation {
    Call* call = nullptr;
    Handle old_edges = 0;  // what the call did last time and has not repeated yet
    Handle last_edge = 0;
    Handle limit = 0;  // end of the interval in which calls may be reused; 0: end of the trace
    Handle end = 0;    // end stamp, once there are children
    bool end_linked = false;
    bool tail_reused = false;
    bool hidden = false;  // what it has not repeated is hidden from its children
    Handle tail = 0;
    Handle failed_child = 0;  // whose exception passes through the call's body
    Activation* outer = nullptr;
  };

  template <class T>
  [[nodiscard]] T* at(Handle h) const noexcept {
    return arena_.at<T>(h);
  }
  [[nodiscard]] bool lies_ahead(const Call& c) const noexcept {
    return timeline_.precedes(*at<TimeNode>(now_), c);
  }
  [[nodiscard]] Handle end_of(Handle call) const noexcept {
    const Handle end = at<Call>(call)->end;
    return end != 0 ? end : call;
  }
  // An end stamp has no place until its call closes.
  [[nodiscard]] bool linked(Handle stamp) const noexcept { return at<TimeNode>(stamp)->prev != 0; }
  void enqueue(Call& call) noexcept { queue_.push(handle_of(call)); }
  void ask_again(Call& call, std::uint16_t why, const Edge* seen, Handle source) noexcept {
    call.set(why);
    if (call.has(Call::kRunning | Call::kPending | Call::kDead)) return;
    if (observer_ != nullptr) [[unlikely]] {
      observer_->on({.kind = Event::Kind::invalidated,
                     .call = &call,
                     .source = source,
                     .seen = seen,
                     .by = running_call()});
    }
    if (call.queue == 0) enqueue(call);
  }
  // Whether a call that is in the trace lies at `h`, where anything may lie.
  [[nodiscard]] bool is_live_call(Handle h) const noexcept;
  [[nodiscard]] const Call* running_call() const noexcept {
    return current_ != nullptr ? current_->call : nullptr;
  }
  void note(Event::Kind kind, const Call* call = nullptr, Handle source = 0) noexcept {
    observer_->on({.kind = kind, .call = call, .source = source, .by = running_call()});
  }
  // Requires: an exception is being handled.
  void note_failure(Event::Kind kind, const Call* call = nullptr) noexcept;

  // Calls find their function by its number through the arena's header.
  [[nodiscard]] std::uint16_t number_of(const Function& function) {
    const std::uint16_t number = functions_.number(function);
    arena_.header().functions = functions_.data();
    return number;
  }
  void enter(Mode mode);
  void undo_edits_behind(std::size_t edits);
  void report_progress();
  [[nodiscard]] bool unposted(const Call& call) const noexcept;
  void result_changed(Handle caller) noexcept;
  [[nodiscard]] Handle new_outside(const OutsideType& type);
  void release_outside(void* object, const char* kind);
  void forget_names(Handle from, std::size_t bytes) noexcept;
  void require_unwritten(Handle head) const;
  void require_released_unused() const;
  void free_released() noexcept;
  void require_idle(const char* what) const;
  template <auto F, class... P, class... Args>
  Counts run_as(detail::Types<P...>, Args&&... args);
  void require_no_tail(const Activation& caller, const Function& function) const;
  void require_stack(const Activation& caller, const Function& function) const;
  void require_own(const void* object, const char* what) const {
    if (!arena_.contains(object)) [[unlikely]] fail_foreign(what);
  }
  [[noreturn]] void fail_foreign(const char* what) const;
  void depend_on_result(Handle child) noexcept;
  [[nodiscard]] Activation& running() const {
    if (current_ != nullptr) [[likely]] return *current_;
    fail_not_running();
  }
  [[noreturn]] void fail_not_running() const;
  [[noreturn]] void fail_no_environment() const;
  void require_usable() const;
  Counts run_root(const Function& function, std::uint32_t hash, const void* args,
                  Construct construct);
  [[nodiscard]] bool next_is_up_to(Handle call, Handle end) const noexcept;
  void run_from_queue(Handle call);
  [[nodiscard]] bool reads_the_same(Call& call);
  bool settle_link(Activation& a, Handle link);
  bool set_dying_aside(Handle call) noexcept;
  void take_dying_back() noexcept;
  void propagate_within(Handle call);
  void roll_back();
  void finish() noexcept;
  void purge() noexcept;
  void check_audit();

  Handle new_call(const Function& function, std::uint32_t hash, const void* args,
                  Construct construct);
  void free_call(Handle call) noexcept;
  void drop_call(Handle call) noexcept;
  void insert_call(Handle call);
  Handle find_reusable(const Function& function, std::uint32_t hash, const void* args, bool tail);
  void suspect(Handle fresh, std::uint32_t hash, const void* args);
  Handle call_child(const Function& function, std::uint32_t hash, const void* args,
                    Construct construct);
  Handle call_tail(const Function& function, std::uint32_t hash, const void* args,
                   Construct construct);
  [[noreturn]] void fail_caught(const Activation& caller) const;
  void hide_unconfirmed(Activation& a) noexcept;
  // Takes back what the running calls did last time for which `which(edge)`, and have not repeated.
  template <class Which>
  void retract_unrepeated(Which&& which) noexcept;
  void need_end(Activation& a);
  void settle_child(Handle child);
  void execute(Handle call, Handle limit);
  void run_body(Activation& a, Handle call);
  void settle(Activation& a) noexcept;
  void close(Activation& a);
  void link_end(Activation& a);
  void abandon(Activation& a) noexcept;
  void discard_between(Handle from, Handle to) noexcept;
  void discard(Handle call) noexcept;
  void discard_subtree(Handle call) noexcept;

  Edge& attach(std::uint8_t structure, std::uint8_t kind, std::size_t bytes);
  void free_edge(Edge& edge) noexcept;
  void retract_all(Call& call, Handle edges) noexcept;
  // Moves the first edge of last time that `matches` into this execution's list.
  template <class Matches>
  Edge* recall(Matches&& matches);

  Arena arena_;
  Timeline timeline_;
  MemoTable memo_;
  PropagationQueue queue_;
  std::vector<Structure*> structures_;
  std::unique_ptr<ModStructure> mods_;
  std::vector<std::unique_ptr<Agenda>> agendas_;
  Registry<Function> functions_;
  Registry<OutsideType> outside_types_;
  std::vector<Handle> outside_;  // objects of the outside, by their heads
  std::vector<Handle> released_;  // those to be freed when the edits are final
  std::map<Handle, std::string> names_;
  std::function<bool(const Progress&)> progress_;
  std::uint64_t progress_every_ = 0;
  std::uint64_t progress_at_ = ~std::uint64_t{0};  // number of bodies run at the next report
  Observer* observer_ = nullptr;
  std::vector<std::function<void()>> rollback_;
  std::vector<Handle> aside_;  // calls that nobody posts any more and that may not go yet
  std::vector<Handle> graveyard_;
  std::size_t most_leaving_ = 0;  // so much of the two above has been in use
  std::vector<std::pair<Handle, Handle>> suspects_;
  void* environment_ = nullptr;
  Activation* current_ = nullptr;
  std::size_t stack_limit_;
  std::uintptr_t stack_end_ = 0;  // no call is made when the native stack has grown down to here
  Handle now_ = 0;  // the last time stamp that is settled or running
  Mode mode_ = Mode::idle;
  bool audit_ = false;
  bool broken_ = false;
  Counts counts_;
  AuditReport report_;
  std::uint64_t live_calls_ = 0;
  std::uint64_t live_edges_ = 0;
};

template <class Body>
void Engine::edit_together(Body&& body) {
  begin_edit();
  const std::size_t before = rollback_.size();
  try {
    body();
  } catch (...) {
    undo_edits_behind(before);
    throw;
  }
}

template <class Matches>
Edge* Engine::recall(Matches&& matches) {
  Activation& a = running();
  for (Handle* link = &a.old_edges; *link != 0; link = &at<Edge>(*link)->next) {
    Edge& edge = *at<Edge>(*link);
    if (!matches(edge)) continue;
    const Handle handle = *link;
    *link = edge.next;
    edge.next = 0;
    (a.last_edge != 0 ? at<Edge>(a.last_edge)->next : a.call->edges) = handle;
    a.last_edge = handle;
    return &edge;
  }
  return nullptr;
}

template <class Visit>
void Engine::walk(Visit&& visit) const {
  std::vector<Handle> open;  // end stamps of the intervals around the current call
  for (Handle h = at<TimeNode>(timeline_.front())->next; h != 0; h = at<TimeNode>(h)->next) {
    if (at<TimeNode>(h)->marked()) {
      while (!open.empty() && open.back() == h) open.pop_back();
      continue;
    }
    const Call& c = *at<Call>(h);
    visit(c, open.size());
    if (c.end != 0) open.push_back(c.end);
  }
}

template <class Which>
void Engine::retract_unrepeated(Which&& which) noexcept {
  for (Activation* a = current_; a != nullptr; a = a->outer) {
    for (Handle* link = &a->old_edges; *link != 0;) {
      Edge& edge = *at<Edge>(*link);
      if (!which(edge)) {
        link = &edge.next;
        continue;
      }
      *link = edge.next;
      structures_[edge.structure]->retract(*a->call, edge);
      free_edge(edge);
    }
  }
}

}  // namespace sac
