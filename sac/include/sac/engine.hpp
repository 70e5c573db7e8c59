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
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/arena.hpp"
#include "sac/check.hpp"
#include "sac/label.hpp"
#include "sac/memo_table.hpp"
#include "sac/propagation_queue.hpp"
#include "sac/timeline.hpp"
#include "sac/trace.hpp"

namespace sac {

template <class T>
class Mod;
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
};

/// What the detectors saw; both empty for a program that is concise and monotone.
struct AuditReport {
  std::uint64_t duplicates = 0;  ///< pairs of live calls with equal labels [Def 1.4.2]
  std::uint64_t reordered = 0;   ///< calls discarded and made anew in one propagation [Def 1.4.3]
  std::string first_duplicate;   ///< label of the first pair
  std::string first_reordered;   ///< label of the first such call
};

class Engine {
 public:
  Engine();
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // --- The client's side -------------------------------------------------------------------

  /// A new modifiable with a value, to be changed by set().
  template <class T>
  [[nodiscard]] Mod<T> input(T value);
  /// A new modifiable for the program to write.
  template <class T>
  [[nodiscard]] Mod<T> cell();
  /// Changes an input; an equal value changes nothing. Cost: O(readers).
  template <class T>
  void set(Mod<T> mod, T value);
  /// The value at the end of the trace. Throws: UsageError if unwritten.
  template <class T>
  [[nodiscard]] const T& get(Mod<T> mod) const;

  /// Runs f(scope, args...) at the end of the trace. Edits made before can no longer be undone.
  /// Throws: what the program throws, with everything it did taken back.
  template <auto F, class... Args>
  Counts run(Args... args);

  /// Brings the trace up to date with the edits since the last call.
  /// Throws: what the program throws, with the edits undone.
  /// Cost: calls run again, plus O(log) of the queue for each.
  Counts propagate();

  /// A new work queue, owned by the engine.
  [[nodiscard]] Agenda& make_agenda(std::string name);

  /// An object that the program's calls reach through Scope::environment: the same for the life of
  /// the trace, and not itself a dependence (what in it changes must be a mod or a structure).
  void set_environment(void* environment) noexcept { environment_ = environment; }

  /// Watches for calls that break conciseness or monotonicity; costs a table look-up a call.
  void set_audit(bool on) noexcept { audit_ = on; }
  [[nodiscard]] const AuditReport& audit() const noexcept { return report_; }

  [[nodiscard]] std::uint64_t live_calls() const noexcept { return live_calls_; }
  [[nodiscard]] std::uint64_t live_edges() const noexcept { return live_edges_; }
  /// Memory held by the trace: calls, edges, time stamps, tables.
  [[nodiscard]] std::size_t bytes() const noexcept;
  [[nodiscard]] bool idle() const noexcept { return mode_ == Mode::idle; }

  /// Calls visit(call, depth) for every live call in pre-order.
  template <class Visit>
  void walk(Visit&& visit) const;

  /// Prints `name(arguments)`.
  [[nodiscard]] static std::string describe(const Call& call);

  /// Throws: InvariantError. Cost: O(trace).
  void check_invariants() const;

  // --- For structures ----------------------------------------------------------------------

  /// Gives a structure the number that its edges carry. The structure outlives the trace.
  std::uint8_t add_structure(Structure& structure);

  /// Before an outside edit: refuses if the engine runs or is broken.
  void begin_edit();
  /// How to take the edit back if the next propagation fails. Cleared when it succeeds.
  void on_rollback(std::function<void()> undo) { rollback_.push_back(std::move(undo)); }
  /// Forgets all edits since the last propagation by undoing them, newest first.
  void undo_edits();

  /// The call's observation may have changed: it will run again.
  void invalidate(Call& call) noexcept {
    call.set(Call::kInvalid);
    if (call.queue == 0 && !call.has(Call::kRunning | Call::kPending | Call::kDead)) enqueue(call);
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
  [[nodiscard]] Arena& arena() noexcept { return arena_; }
  [[nodiscard]] const Arena& arena() const noexcept { return arena_; }

 private:
  friend class Scope;
  friend class Agenda;
  friend class ModStructure;

  enum class Mode : std::uint8_t { idle, running, propagating };

  // One execution on the native stack: a call and the tail calls that continue it.
  struct Activation {
    Call* call = nullptr;
    Handle old_edges = 0;  // what the call did last time and has not repeated yet
    Handle last_edge = 0;
    Handle limit = 0;  // end of the interval in which calls may be reused; 0: end of the trace
    Handle end = 0;    // end stamp, once there are children
    bool end_linked = false;
    bool tail_reused = false;
    Handle tail = 0;
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

  void enter(Mode mode);
  void require_usable() const;
  Counts run_root(const Function& function, std::uint32_t hash, const void* args,
                  void (*construct)(void*, const void*));
  [[nodiscard]] bool next_is_within(Handle call) const noexcept;
  void propagate_within(Handle call);
  void roll_back();
  void finish() noexcept;
  void purge() noexcept;
  void check_audit();

  Handle new_call(const Function& function, std::uint32_t hash, const void* args,
                  void (*construct)(void*, const void*));
  void free_call(Handle call) noexcept;
  void drop_call(Handle call) noexcept;
  void insert_call(Handle call);
  Handle find_reusable(const Function& function, std::uint32_t hash, const void* args,
                       bool tail) const;
  void suspect(Handle fresh, const void* args);
  Handle call_child(const Function& function, std::uint32_t hash, const void* args,
                    void (*construct)(void*, const void*));
  void call_tail(const Function& function, std::uint32_t hash, const void* args,
                 void (*construct)(void*, const void*));
  void need_end(Activation& a);
  void settle_child(Handle child);
  void execute(Handle call, Handle limit);
  void run_body(Activation& a, Handle call);
  void settle(Activation& a) noexcept;
  void close(Activation& a);
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
  std::vector<std::pair<Handle, void (*)(Engine&, Handle)>> outside_mods_;
  std::vector<std::function<void()>> rollback_;
  std::vector<Handle> graveyard_;
  std::vector<std::pair<Handle, Handle>> suspects_;
  void* environment_ = nullptr;
  Activation* current_ = nullptr;
  Handle now_ = 0;  // the last time stamp that is settled or running
  Mode mode_ = Mode::idle;
  bool audit_ = false;
  bool broken_ = false;
  Counts counts_;
  AuditReport report_;
  std::uint64_t live_calls_ = 0;
  std::uint64_t live_edges_ = 0;
};

template <class Matches>
Edge* Engine::recall(Matches&& matches) {
  Activation& a = *current_;
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

}  // namespace sac
