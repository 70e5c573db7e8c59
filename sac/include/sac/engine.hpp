// The engine: runs programs, keeps their traces, and brings the traces up to date.
//
// Three primitives carry everything changeable (mods, agendas, users' own types; structure.hpp):
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
// (4) What a first run refuses, a propagation refuses. If client code throws in propagate(), the
//     edits of the batch are undone and propagated, and every value is what it was; if that fails
//     too, the engine refuses all further work.
// (5) Memory of discarded calls is freed when the propagation ends, not before.
//
// An engine is used by one thread at a time; engines share nothing. The outside's operations are
// refused while it runs: a traced function reads and writes through its scope.
//
// Limits: 32 GiB of calls and edges; 255 structures, agendas included; 65535 functions and types of
// values. An engine takes 32 GiB of address space, which a process has for
// some 4000 of them; where that is limited (ulimit -v), it makes do with less, down to 64 MiB.
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

#include "sac/check.hpp"
#include "sac/internal/core.hpp"
#include "sac/internal/parameters.hpp"
#include "sac/internal/undo.hpp"
#include "sac/label.hpp"
#include "sac/structure.hpp"

namespace sac {

template <class T, class Same = std::equal_to<>>
class Mod;
template <class T, class Same = std::equal_to<>>
class Cell;
class Agenda;
class ModStructure;
class Weights;

/// Memory of an engine in bytes. `live` is in use; `held` is what the engine has taken from the
/// system, freed blocks that wait to be used again included.
struct Memory {
  std::size_t calls_and_edges_live = 0;
  std::size_t calls_and_edges_held = 0;
  std::size_t time_stamps = 0;  // groups; the stamps themselves lie in the calls
  std::size_t memo_table = 0;
  std::size_t queue = 0;  // and what else a propagation needs
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
    core_.names_[mod.head()] = std::move(name);
  }

  /// Runs f(scope, args...) at the end of the trace. Edits made before can no longer be undone.
  /// Throws: what the program throws, with everything it did taken back.
  template <auto F, class... Args>
  Counts run(Args... args);

  /// Brings the trace up to date with the edits since the last call.
  /// Throws: what the program throws, and Cancelled, with the edits undone.
  /// Cost: calls run again, plus O(log) of the queue for each.
  Counts propagate() { return propagate(nullptr); }
  /// The same; when all is up to date, and while it can still be undone, last() looks at the
  /// result. If it throws, the edits are undone as if the program had thrown.
  Counts propagate(const std::function<void()>& last);

  /// A new work queue, owned by the engine.
  [[nodiscard]] Agenda& make_agenda(std::string name);
  /// Ends a work queue. Throws: UsageError if a call drains it or something is posted on it.
  void release(Agenda& agenda);

  /// An object that the program's calls reach through Scope::environment: the same for the life of
  /// the trace, and not itself a dependence (what in it changes must be a mod or a structure).
  void set_environment(void* environment) noexcept { core_.environment_ = environment; }

  /// Calls `report` before the first of every `every` calls that run; if it returns false, the run
  /// or propagation ends with Cancelled, and the engine is as before it. Null: nobody is told.
  /// Not called while edits are undone.
  void set_progress(std::function<bool(const Progress&)> report, std::uint64_t every = 1024);

  /// Tells `observer` of all that happens; null: nobody. See EventLog.
  void set_observer(Observer* observer) noexcept { core_.observer_ = observer; }
  [[nodiscard]] Observer* observer() const noexcept { return core_.observer_; }

  /// How much native stack calls inside of calls may take, in bytes, counted from run() or
  /// propagate(); beyond, UsageError. At first 3/4 of the process's limit (RLIMIT_STACK; 2 MiB if
  /// it has none): to be set for threads that have less, and if the client's own frames need more.
  /// A roll-back may take an eighth more.
  void set_stack_limit(std::size_t bytes) noexcept { core_.stack_limit_ = bytes; }

  /// Watches for calls that break conciseness or monotonicity; costs a table look-up a call.
  void set_audit(bool on) noexcept { core_.audit_ = on; }
  [[nodiscard]] const AuditReport& audit() const noexcept { return core_.report_; }

  /// From now on the trace holds what calls say by Scope::weigh: 16 bytes each time. To be asked
  /// for before the first run: calls that are there have no weight until they run again.
  void record_weights();
  [[nodiscard]] bool records_weights() const noexcept { return weights_ != nullptr; }
  /// What `call` has said by Scope::weigh, in all. Cost: O(its edges).
  [[nodiscard]] std::uint64_t weight_of(const Call& call) const noexcept;

  [[nodiscard]] std::uint64_t live_calls() const noexcept { return core_.live_calls(); }
  [[nodiscard]] std::uint64_t live_edges() const noexcept { return core_.live_edges(); }
  /// Memory that the trace uses: memory().live(). Cost: O(modifiables with several writers).
  [[nodiscard]] std::size_t bytes() const noexcept { return memory().live(); }
  [[nodiscard]] Memory memory() const noexcept;
  /// Calls and bytes by function, the largest first. Cost: O(trace).
  [[nodiscard]] std::vector<FunctionProfile> profile() const;
  /// Gives memory that is not in use back to the system. Throws: UsageError if the engine runs.
  /// Cost: O(free blocks) and the size of the tables.
  void shrink();
  /// From now on the trace may hold so many bytes of calls and edges; beyond, std::bad_alloc.
  /// Edits are undone without a limit.
  void set_memory_limit(std::size_t bytes) noexcept { arena().set_limit(bytes); }
  [[nodiscard]] bool idle() const noexcept { return core_.idle(); }

  /// Calls visit(call, depth) for every call that has a place, in pre-order.
  template <class Visit>
  void walk(Visit&& visit) const {
    core_.walk(std::forward<Visit>(visit));
  }

  /// `name(arguments)`.
  [[nodiscard]] static std::string describe(const Call& call);
  /// What messages call a modifiable: `modifiable 'price' (@7)`.
  [[nodiscard]] std::string describe_mod(Handle head) const;

  /// Checks the trace, and every structure. Throws: InvariantError. Cost: O(trace).
  void check_invariants() const;

  // --- For structures ----------------------------------------------------------------------
  //
  // This and Scope are all that modifiables and agendas use, and all that a type of one's own needs
  // (docs/traceable_types.md).

  /// Gives a structure the number that its edges carry. The structure outlives the trace, or until
  /// remove_structure(). Throws: UsageError beyond 255.
  std::uint8_t add_structure(Structure& structure) { return core_.add_structure(structure); }
  /// Requires: no call has an edge of the structure.
  void remove_structure(std::uint8_t number) noexcept { core_.remove_structure(number); }

  /// Before an outside edit: refuses if the engine runs or is broken. `what` names it.
  void begin_edit(const char* what = "edit") const {
    core_.require_usable();
    core_.require_idle(what);
  }
  /// How to take the edit back if the next propagation fails. Cleared when it succeeds.
  /// `undo`: to be called without arguments. Throws: std::bad_alloc.
  void on_rollback(auto undo) { rollback_.emplace_back(std::move(undo)); }
  /// Makes the edits of body(): all of them, or none if it throws.
  template <class Body>
  void edit_together(Body&& body);
  /// Forgets all edits since the last propagation by undoing them, newest first.
  /// Throws: what the client's arguments throw when compared; the engine is broken then.
  void undo_edits();

  /// The call's observation may have changed: it will run again. `seen` tells observers which: the
  /// edge that says what it saw.
  void invalidate(Call& call, const Edge* seen = nullptr) noexcept { core_.invalidate(call, seen); }
  /// It will run again if, when its turn comes, Structure::unchanged says no of one of its edges.
  /// `source` tells observers which modifiable it is about; 0: none.
  void doubt(Call& call, Handle source = 0) noexcept { core_.doubt(call, source); }
  /// `outer` did something behind children of its own (Edge::behind) that `inner`, which is new to
  /// it, should have seen or not: if it has settled and `inner` lies in its interval, it runs
  /// again, so that this is refused or not as in a first run.
  void rerun_if_around(Call& outer, const Call& inner) noexcept {
    core_.rerun_if_around(outer, inner);
  }
  [[nodiscard]] bool precedes(const TimeNode& a, const TimeNode& b) const noexcept {
    return core_.precedes(a, b);
  }
  /// Whether `call` lies behind `from` and before the time stamp `end` (0: the end of the trace).
  [[nodiscard]] bool lies_between(const Call& from, const Call& call, Handle end) const noexcept {
    return core_.lies_between(from, call, end);
  }
  /// Whether `call` is still to come: it lies behind all that the running call has done.
  [[nodiscard]] bool lies_ahead(const Call& call) const noexcept { return core_.lies_ahead(call); }
  /// Whether the running call has had children in this execution.
  [[nodiscard]] bool has_had_children() const noexcept { return core_.has_had_children(); }
  [[nodiscard]] Call& call(Handle handle) const noexcept { return *core_.at<Call>(handle); }
  [[nodiscard]] Handle handle_of(const Call& call) const noexcept {
    return arena().handle_of(&call);
  }
  /// True while a first run appends to the trace: every call there is precedes the running one.
  [[nodiscard]] bool appending() const noexcept { return core_.appending(); }
  /// True while a propagation that failed is taken back.
  [[nodiscard]] bool undoing() const noexcept { return core_.undoing(); }
  /// True if no call waits to run again.
  [[nodiscard]] bool settled() const noexcept { return core_.settled(); }
  /// Tells an observer, if there is one, what has happened, by the running call.
  void note(Event::Kind kind, const Call* call = nullptr, Handle source = 0) noexcept {
    core_.note(kind, call, source);
  }
  /// Where to keep what a propagation replaces and recomputing would not bring back; null: there
  /// is no need.
  [[nodiscard]] Originals* originals() noexcept {
    return idle() || appending() ? nullptr : &core_.originals();
  }
  /// The structure that `edge` belongs to.
  [[nodiscard]] const Structure& structure_of(const Edge& edge) const noexcept {
    return core_.structure(edge.structure);
  }
  /// Calls visit(edge) for what `call` did and saw, in its order.
  template <class Visit>
  void for_each_edge(const Call& call, Visit&& visit) const {
    for (Handle e = call.edges; e != 0; e = core_.at<Edge>(e)->next) {
      visit(static_cast<const Edge&>(*core_.at<Edge>(e)));
    }
  }
  /// Whether a call that has a place lies at `h`, where anything may lie.
  [[nodiscard]] bool is_live_call(Handle h) const noexcept { return core_.is_live_call(h); }
  [[nodiscard]] Arena& arena() noexcept { return core_.arena(); }
  [[nodiscard]] const Arena& arena() const noexcept { return core_.arena(); }
  /// The call whose body runs; null: none.
  [[nodiscard]] const Call* running_call() const noexcept { return core_.running_call(); }
  /// `what`, after the running call if there is one: the beginning of a message.
  [[nodiscard]] std::string context(const char* what) const { return core_.context(what); }

  // --- Internal: for the library's own headers -----------------------------------------------

  [[nodiscard]] Core& core() noexcept { return core_; }
  [[nodiscard]] ModStructure& mods() noexcept { return *mods_; }
  void add_weight(Scope& s, std::uint64_t n);

 private:
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
  [[nodiscard]] OutsideHead* outside_head(Handle h) const noexcept {
    return core_.at<OutsideHead>(h);
  }
  [[nodiscard]] Handle new_outside(const OutsideType& type);
  void release_outside(void* object, const char* kind);
  void require_released_unused() const;
  void free_released() noexcept;
  void undo_edits_behind(std::size_t edits);
  void roll_back() noexcept;
  void forget_edits() noexcept;
  Counts run_root(const Asked& asked);
  template <auto F, class... P, class... Args>
  Counts run_as(detail::Types<P...>, Args&&... args);

  Core core_;
  std::unique_ptr<ModStructure> mods_;
  std::unique_ptr<Weights> weights_;  // null: not recorded
  std::vector<std::unique_ptr<Agenda>> agendas_;
  Registry<OutsideType> outside_types_;
  std::vector<Handle> outside_;   // objects of the outside, by their heads
  std::vector<Handle> released_;  // those to be freed when the edits are final
  std::vector<detail::Undo> rollback_;
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

}  // namespace sac
