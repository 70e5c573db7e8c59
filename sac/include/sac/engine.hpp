// The engine: runs programs, keeps their traces, and updates the traces after edits.
//
// Three primitives are the basis of everything changeable (modifiables, agendas, users' own types;
// structure.hpp):
//   observe     the running call depends on something      Scope::observe
//   effect      the running call did something             Scope::effect
//   invalidate  a call's observation may have changed      Engine::invalidate
//
// Guarantees:
// (1) After propagate(), everything observable is as after a run from scratch.
// (2) Invalidated calls run in trace order; everything that precedes the running call is settled.
// (3) A call that runs again reuses children with equal labels that lie ahead in its own interval,
//     with their subtrees, without running them; it discards the children that it passes over.
//     Invalid calls in a reused subtree run before the new parent goes on. (A tail call that ends
//     the interval can be reused only by a tail call: its end stamp is that of the interval.)
// (4) A propagation refuses whatever a first run refuses. If client code throws in propagate(), the
//     edits of the batch are undone and propagated, and every value is as before; if that fails
//     too, the engine refuses all further work.
// (5) The memory of discarded calls is freed at the end of the propagation, not before.
//
// One thread at a time may use an engine; engines share no state. While an engine runs it refuses
// the operations for use from outside: a traced function reads and writes through its scope.
//
// Limits: 32 GiB of calls and edges; 255 structures, including agendas; 65535 functions and types
// of values. An engine reserves 32 GiB of address space; a process has room for about 4000 of them.
// Where address space is limited (ulimit -v) it reserves less, down to 64 MiB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <ranges>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/check.hpp"
#include "sac/internal/core.hpp"
#include "sac/internal/parameters.hpp"
#include "sac/internal/undo.hpp"
#include "sac/key.hpp"
#include "sac/label.hpp"
#include "sac/structure.hpp"

namespace sac {

template <class T, class Same = std::equal_to<>>
class Mod;
template <class T, class Same = std::equal_to<>>
class Cell;
class Agenda;
class ModStructure;
class Queries;
class Weights;
namespace detail {
class Watches;
template <class T, class Same>
class TypedWatch;
}  // namespace detail

/// Memory of an engine in bytes. `live` is in use; `held` is all memory that the engine has taken
/// from the system, including freed blocks kept for reuse.
struct Memory {
  std::size_t calls_and_edges_live = 0;
  std::size_t calls_and_edges_held = 0;
  std::size_t time_stamps = 0;  // groups; the stamps themselves are part of the calls
  std::size_t memo_table = 0;
  std::size_t queue = 0;  // and other memory of a propagation
  std::size_t agendas = 0;
  std::size_t versions = 0;  // order of modifiables that are written more than once
  std::size_t queries = 0;   // their table
  std::size_t outside = 0;   // list of the objects made from outside, and the undo records of edits
  [[nodiscard]] std::size_t live() const noexcept {
    return calls_and_edges_live + time_stamps + memo_table + queue + agendas + versions + queries +
           outside;
  }
  [[nodiscard]] std::size_t held() const noexcept {
    return live() - calls_and_edges_live + calls_and_edges_held;
  }
};

/// The number of calls of one function, and the bytes of their frames and edges.
struct FunctionProfile {
  std::string_view name;
  std::uint64_t calls = 0;
  std::uint64_t bytes = 0;
  std::uint64_t edges = 0;
  std::uint64_t edge_bytes = 0;
};

/// Runs a program and keeps its trace up to date under edits. It is the core, with the functions
/// for clients; those of the core that structures need are named here, and written there.
class Engine : Core {
 public:
  Engine();
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // --- The client's side -------------------------------------------------------------------

  /// Makes a modifiable with a value, which set() changes.
  template <class T, class Same = std::equal_to<>>
  [[nodiscard]] Mod<T, Same> input(T value);
  /// Makes a modifiable that the program writes.
  template <class T, class Same = std::equal_to<>>
  [[nodiscard]] Mod<T, Same> cell();
  /// Makes an object from outside, with cells as members that set() may turn into inputs: for
  /// example, a node of an input list.
  template <class T>
  [[nodiscard]] T& make();
  /// Frees a result of input(), cell() or make() at the end of the next propagation or run; this is
  /// an edit. That propagation or run fails with UsageError if a call still reads or writes a
  /// modifiable in the object. No call may use the object in another way, nor wait on an agenda to
  /// do so.
  template <class T>
  void release(T& object);
  template <class T, class Same>
  void release(Mod<T, Same> mod);

  /// Sets an input to a value, or turns an unwritten cell into an input. The same value as before
  /// changes nothing. Throws: UsageError if the program writes the modifiable. Cost: O(readers).
  template <class T, class Same>
  void set(Mod<T, Same> mod, std::type_identity_t<T> value);
  template <class T, class Same>
  void set(const Cell<T, Same>& cell, std::type_identity_t<T> value);
  /// The value at the end of the trace. Throws: UsageError if unwritten.
  template <class T, class Same>
  [[nodiscard]] const T& get(Mod<T, Same> mod) const;
  template <class T, class Same>
  [[nodiscard]] const T& get(const Cell<T, Same>& cell) const;

  /// Whether the modifiable has a value at the end of the trace.
  template <class T, class Same>
  [[nodiscard]] bool has_value(Mod<T, Same> mod) const;

  /// Sets the name of a modifiable in messages.
  template <class T, class Same>
  void name(Mod<T, Same> mod, std::string name) {
    settings.names[mod.head().handle()] = std::move(name);
  }
  /// Names modifiables `name[0]`, `name[1]`, ...
  template <std::ranges::input_range R>
  void name(const R& mods, const std::string& name) {
    std::size_t i = 0;
    for (const auto& mod : mods) this->name(mod, name + '[' + std::to_string(i++) + ']');
  }

  /// From now on changed(mod) tells, after each run and propagation, whether that has given the
  /// modifiable another value, or taken its value away. Throws: UsageError if the engine runs,
  /// or edits wait for a propagation; std::bad_alloc; what copying the value throws (here, and in
  /// the run or propagation, which then fails). Cost: O(log of those watched) for each change.
  template <class T, class Same>
  void watch(Mod<T, Same> mod);
  /// Watches the modifiable, and calls f(value) after each run and propagation that has given it
  /// another value, when everything is done: f may read, edit, propagate, watch and unwatch. What
  /// f throws, the run or propagation throws, although it has been done; the functions behind are
  /// then not called. If f propagates and the value changes again, they are told of the new one
  /// only. The order is that of on_change(), and of the handles of several modifiables.
  template <class T, class Same>
  void on_change(Mod<T, Same> mod, std::type_identity_t<std::function<void(const T&)>> f);
  /// Calls none of its functions any more.
  template <class T, class Same>
  void unwatch(Mod<T, Same> mod) noexcept;
  /// Whether the last run or propagation has changed a modifiable that is watched; one that failed
  /// has changed nothing.
  template <class T, class Same>
  [[nodiscard]] bool changed(Mod<T, Same> mod) const noexcept;

  /// Runs f(scope, args...) at the end of the trace. Edits made before can no longer be undone.
  /// Throws: exceptions of the program, after undoing all of its effects.
  template <auto F, class... Args>
  Counts run(Args&&... args);

  /// Updates the trace after the edits since the last call.
  /// Throws: exceptions of the program, and Cancelled; the edits are then undone.
  /// Cost: the calls that run again, plus O(log of the queue) for each.
  Counts propagate() { return propagate(nullptr); }
  /// The same, but calls last() when everything is up to date and can still be undone. If last()
  /// throws, the edits are undone as if the program had thrown.
  Counts propagate(const std::function<void()>& last);

  /// Makes a work queue, owned by the engine. `widths` limits the keys of its calls. Throws:
  /// UsageError if the widths are not possible.
  [[nodiscard]] Agenda& make_agenda(std::string name, const KeyWidths& widths = {});
  /// Frees a work queue. Throws: UsageError if a call drains it or a call is posted on it.
  void release(Agenda& agenda);

  /// Sets the object that calls reach through Scope::environment, which asks for the same type. It
  /// must stay the same for the life of the trace, and is not itself a dependence: its changeable
  /// parts must be modifiables or structures.
  template <class T>
  void set_environment(T* environment) noexcept {
    settings.environment = {
        const_cast<std::remove_const_t<T>*>(environment),
        environment != nullptr ? &detail::kTypeName<std::remove_const_t<T>> : nullptr};
  }

  /// Calls `report` before the first of every `every` calls that run; if it returns false, the run
  /// or propagation ends with Cancelled, and the engine is as before it. Null: no reports. Not
  /// called while edits are undone.
  void set_progress(std::function<bool(const Progress&)> report, std::uint64_t every = 1024);

  /// Reports all events to `observer`; null: to none. See EventLog.
  void set_observer(Observer* observer) noexcept { settings.observer = observer; }
  [[nodiscard]] Observer* observer() const noexcept { return settings.observer; }

  /// Limits the native stack of nested calls, in bytes, counted from run() or propagate(); calls
  /// beyond the limit throw UsageError. The default is 3/4 of the process's limit (RLIMIT_STACK; 2
  /// MiB if there is none). Set it for threads with less stack, and if the client's own frames need
  /// more. A roll-back may use an eighth more.
  void set_stack_limit(std::size_t bytes) noexcept { settings.stack_limit = bytes; }

  /// Turns on the audit, which detects calls that break conciseness or monotonicity. Cost: a table
  /// look-up for each call.
  void set_audit(bool on) noexcept { settings.audit = on; }
  using Core::audit;

  /// Records the weights that calls report by Scope::weigh from now on; 16 bytes for each report.
  /// Call it before the first run: existing calls have no weight until they run again.
  void record_weights();
  [[nodiscard]] bool records_weights() const noexcept { return weights_ != nullptr; }
  /// The sum of the weights that `call` reported by Scope::weigh. Cost: O(its edges).
  [[nodiscard]] std::uint64_t weight_of(const Call& call) const noexcept;

  using Core::live_calls;
  using Core::live_edges;
  /// The memory that the trace uses: memory().live(). Cost: O(modifiables with several writers).
  [[nodiscard]] std::size_t bytes() const noexcept { return memory().live(); }
  [[nodiscard]] Memory memory() const noexcept;
  /// Calls and bytes by function, the largest first. Cost: O(trace).
  [[nodiscard]] std::vector<FunctionProfile> profile() const;
  /// Returns unused memory to the system. Throws: UsageError if the engine runs. Cost: O(free
  /// blocks) and the size of the tables.
  void shrink();
  /// Limits the bytes of calls and edges that the trace may hold; beyond the limit it throws
  /// std::bad_alloc. Undoing edits is not limited.
  void set_memory_limit(std::size_t bytes) noexcept { arena().set_limit(bytes); }
  using Core::idle;

  /// walk(visit) calls visit(call, depth) for every placed call, in pre-order.
  using Core::walk;

  /// `name(arguments)`.
  [[nodiscard]] static std::string describe(const Call& call);
  /// The name of a modifiable in messages: `modifiable 'price' (@7)`.
  [[nodiscard]] std::string describe_mod(ModRef mod) const;

  /// Checks the trace, and every structure. Throws: InvariantError. Cost: O(trace).
  void check_invariants() const;

  // --- For structures ----------------------------------------------------------------------
  // Modifiables and agendas use only these functions and Scope, and your own types need no
  // others (docs/traceable_types.md).

  /// Registers a structure and returns the number that its edges carry. The structure must outlive
  /// the trace, or live until remove_structure(). Throws: UsageError beyond 255.
  using Core::add_structure;
  /// Unregisters a structure. Requires: no call has an edge of it.
  using Core::remove_structure;

  /// Call it before an edit from outside. Throws: UsageError if the engine runs or is broken.
  /// `what` names the edit.
  void begin_edit(const char* what = "edit") const;
  /// Registers how to undo an edit if the next propagation fails; cleared when it succeeds. `undo`:
  /// a function without arguments. Throws: std::bad_alloc.
  void on_rollback(auto undo) { rollback_.emplace_back(std::move(undo)); }
  /// Runs body(), which makes edits; if it throws, none of them remains.
  template <class Body>
  void edit_together(Body&& body);
  /// Undoes all edits since the last propagation, newest first. Throws: exceptions of the client's
  /// comparisons of arguments; the engine is then broken.
  void undo_edits();

  /// invalidate(place, seen): the observation of a call at this place (Scope::place) may have
  /// changed: the call will run again. `seen` names the observation for observers: its edge; null:
  /// none. With a call instead of a place: one whose observations all precede its children.
  using Core::invalidate;
  /// doubt(place, source) puts a call in doubt: it will run again if, when its turn comes,
  /// Structure::unchanged returns false for one of its edges from this place on. `source` names the
  /// modifiable for observers; null: none. Also with a call.
  using Core::doubt;
  /// The call that has this place, and the place as a time stamp.
  using Core::call_at;
  [[nodiscard]] const TimeNode& time(Place place) const noexcept { return at(place); }
  using Core::precedes;
  /// Whether `call` lies ahead: behind everything that the running call has done.
  using Core::lies_ahead;
  [[nodiscard]] Call& call(Ref<Call> call) const noexcept { return at(call); }
  [[nodiscard]] Ref<Call> handle_of(const Call& call) const noexcept { return Arena::ref(call); }
  /// True while a first run appends to the trace: every existing call precedes the running one.
  using Core::appending;
  /// True while a failed propagation is undone.
  using Core::undoing;
  /// True if no call waits to run again.
  using Core::settled;
  /// note(kind, call, source) reports an event, caused by the running call, to the observer if
  /// there is one.
  using Core::note;
  /// The store for values that a propagation replaces and that recomputing would not restore; null:
  /// not needed.
  [[nodiscard]] Originals* originals() noexcept {
    return idle() || appending() ? nullptr : &Core::originals();
  }
  /// The structure that `edge` belongs to.
  using Core::structure_of;
  /// for_each_edge(call, visit) calls visit(edge) for the effects and observations of the call, in
  /// their order.
  using Core::for_each_edge;
  /// Whether a call in the trace has this place; any handle is allowed.
  using Core::is_live_place;
  /// The memory of calls, edges and values; structures may use it.
  using Core::arena;
  /// The call whose body runs; null: none.
  using Core::running_call;
  /// context(what) is the beginning of a message: the running call, if there is one, then `what`.
  using Core::context;

  // --- Internal: for the library's own headers -----------------------------------------------

  void touched(ModRef mod) noexcept;  // a watched modifiable
  void forget_watches(Handle from, std::size_t bytes) noexcept;

  [[nodiscard]] Core& core() noexcept { return *this; }
  [[nodiscard]] ModStructure& mods() noexcept { return *mods_; }
  [[nodiscard]] Queries& queries() {
    if (queries_ == nullptr) [[unlikely]]
      make_queries();
    return *queries_;
  }
  /// As set(), and back to no value, without a record of how to undo it. Requires: a set() of the
  /// same type has gone before.
  template <class T, class Same>
  void set_unrecorded(const Cell<T, Same>& cell, std::type_identity_t<T> value);
  template <class T, class Same>
  void unset_unrecorded(const Cell<T, Same>& cell) noexcept;
  /// Makes an object in the engine's memory, also while the engine runs, and frees it.
  template <class T, class... Args>
  [[nodiscard]] T& make_inside(Args&&... args);
  template <class T>
  void free_inside(T& object) noexcept {
    free_outside(Arena::ref(reinterpret_cast<OutsideHead*>(&object)[-1]));
  }
  void add_weight(Scope& s, std::uint64_t n);

 private:
  // An object made from outside in memory: head, object.
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
  [[nodiscard]] Ref<OutsideHead> new_outside(const OutsideType& type);
  void release_outside(void* object, const char* kind);
  void require_released_unused() const {
    if (!released_.empty()) require_unused();
  }
  void require_unused() const;
  void free_released() noexcept;
  void free_outside(Ref<OutsideHead> object) noexcept;
  void make_queries();
  template <class T, class Same>
  [[nodiscard]] detail::TypedWatch<T, Same>& watch_of(Mod<T, Same> mod);
  void conclude();
  Counts finish_all();
  void undo_edits_behind(std::size_t edits);
  void roll_back() noexcept;
  void forget_edits() noexcept;
  Counts run_root(const Asked& asked);

  std::unique_ptr<ModStructure> mods_;
  std::unique_ptr<detail::Watches> watches_;
  std::unique_ptr<Queries> queries_;  // null: no call has asked for one
  std::unique_ptr<Weights> weights_;  // null: not recorded
  std::vector<std::unique_ptr<Agenda>> agendas_;
  Registry<OutsideType> outside_types_;
  std::vector<Ref<OutsideHead>> outside_;   // objects made from outside
  std::vector<Ref<OutsideHead>> released_;  // those to be freed when the edits are final
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
