// Runs a case and compares the engine with runs from scratch: after every propagation the values
// are those of a plain run and of a new engine, as are the calls and the number of edges; after one
// that fails everything is as before.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "failing_new.hpp"
#include "fragile.hpp"
#include "program_case.hpp"
#include "random_program.hpp"

namespace support {

/// A program in an engine.
template <class V>
struct Traced {
  RandomWorld<sac::Scope, V> world;
  sac::Engine engine;

  Traced(const RandomProgram& program, const Outside& outside) {
    world.start(engine, program, outside);
  }
  void run(const Outside& outside) { world.run(engine, outside); }

  /// Does an edit, to the engine and to `outside`, which has what the world has.
  void edit(const Step& step, Outside& outside);

  /// What can be seen: values, calls in order, number of edges.
  [[nodiscard]] std::string state() const {
    std::ostringstream out;
    for (const int v : world.values(engine)) out << v << ' ';
    engine.walk([&](const sac::Call& c, std::size_t depth) {
      out << depth << c.function().name;
      const bool shows_place = c.function().name == "pass" || c.function().name == "map item";
      if (!shows_place) c.function().print(c, out);
      out << ' ';
    });
    out << engine.live_calls() << ' ' << engine.live_edges();
    return out.str();
  }
};

template <class V>
void Traced<V>::edit(const Step& step, Outside& outside) {
  const auto a = static_cast<std::size_t>(step.a);
  const auto size = outside.items.size();
  const auto at = static_cast<std::ptrdiff_t>(size > 0 ? a % size : 0);
  const auto first_posted = RandomProgram::kLeastNodes - 1;
  const int posted =
      first_posted + step.a % (static_cast<int>(world.program->nodes.size()) - first_posted);
  switch (step.kind) {
    case Step::set:
      engine.set(world.inputs[a % outside.inputs.size()], V(step.b % 8));
      outside.inputs[a % outside.inputs.size()] = step.b % 8;
      return;
    case Step::post:
      world.post(posted);
      outside.posts.insert(posted);
      return;
    case Step::retract:
      if (const auto it = outside.posts.find(posted); it != outside.posts.end()) {
        world.agenda_of(posted).template retract_from_outside<node<V>>(
            posted, V(world.kPostedArgument));
        outside.posts.erase(it);
      }
      return;
    case Step::insert:
      if (size == 8) return;
      world.insert_item(engine, a % (size + 1), step.b % 5);
      outside.items.insert(outside.items.begin() + static_cast<std::ptrdiff_t>(a % (size + 1)),
                           step.b % 5);
      return;
    case Step::remove:
      if (size == 0) return;
      engine.set(world.link_to(a % size), engine.get(world.items[a % size]->next));
      engine.release(*world.items[a % size]);
      world.items.erase(world.items.begin() + at);
      outside.items.erase(outside.items.begin() + at);
      return;
    case Step::weigh:
      if (size == 0) return;
      engine.set(world.items[a % size]->weight, V(step.b % 5));
      outside.items[a % size] = step.b % 5;
      return;
    default:
      throw std::invalid_argument("not an edit");
  }
}

/// What a plain run leaves. Throws: TooLong if that takes more than `calls`.
inline std::vector<int> plain_values(const RandomProgram& program, const Outside& outside,
                                     int calls) {
  RandomWorld<sac::PlainScope> world;
  sac::PlainScope scope;
  world.calls_left = calls;
  world.start(scope, program, outside);
  world.run(scope, outside);
  return world.values(scope);
}

/// Counts events; they must be as many as the engine says.
class Tally final : public sac::Observer {
 public:
  void on(const sac::Event& event) noexcept override {
    using Kind = sac::Event::Kind;
    if (event.kind == Kind::executed) ++seen_.executed;
    if (event.kind == Kind::reused) ++seen_.reused;
    if (event.kind == Kind::created) ++seen_.created;
  }
  void clear() noexcept { seen_ = {}; }
  [[nodiscard]] bool agrees(const sac::Counts& counts) const noexcept {
    return seen_.executed == counts.executed && seen_.reused == counts.reused &&
           seen_.created == counts.created;
  }

 private:
  sac::Counts seen_;
};

/// One case being run. V: the type of values.
template <class V>
class Session {
 public:
  explicit Session(const Case& c)
      : case_(c), first_(plain_values(c.program, now_, kMostCalls)), t_(c.program, now_) {
    t_.engine.set_audit(c.audit);
    if (c.observe) t_.engine.set_observer(&tally_);
    t_.run(now_);
    tally_.clear();
    commit(first_);
  }

  /// Throws: std::logic_error that says what is wrong; TooLong.
  void run() {
    for (const Step& step : case_.steps) {
      if (!over_) take(step);
    }
    if (!over_) flush();
  }

 private:
  static constexpr int kMostCalls = 600;  // of a run from scratch
  static constexpr std::size_t kMostRuns = 6;

  // What shall fail.
  struct Failures {
    int fuse = -1;
    std::uint64_t client = 0;
    std::uint64_t heap = 0;
    std::uint64_t arena = 0;
    int cancel = -1;
    bool starve = false;
    int armed = 0;  // how many of these
  };

  [[noreturn]] static void wrong(const std::string& what) { throw std::logic_error(what); }

  void take(const Step& step) {
    switch (step.kind) {
      case Step::propagate: return flush();
      case Step::undo: return undo();
      case Step::run: return run_late(step.a % 16);
      case Step::shrink:
        if (fails([&] { t_.engine.shrink(); })) t_.engine.check_invariants();
        return;
      case Step::fuse: failures_.fuse = step.a; break;
      case Step::client: failures_.client = count_of(step); break;
      case Step::heap: failures_.heap = count_of(step); break;
      case Step::arena: failures_.arena = count_of(step); break;
      case Step::cancel: failures_.cancel = step.a; break;
      case Step::starve: failures_.starve = true; break;
      default:
        edited_ = true;
        if (fails([&] { t_.edit(step, wanted_); })) recover();
        return;
    }
    ++failures_.armed;
  }
  static std::uint64_t count_of(const Step& step) {
    return 1 + static_cast<std::uint64_t>(step.a) + 256 * static_cast<std::uint64_t>(step.b % 8);
  }

  void arm() {
    t_.world.fuse = failures_.fuse;
    if (failures_.cancel >= 0) {
      t_.engine.set_progress([this](const sac::Progress&) { return failures_.cancel-- != 0; }, 1);
    }
    t_.engine.arena().fail_after(failures_.arena);
    if (failures_.starve) t_.engine.set_memory_limit(0);
    Fragile::fuse.left = failures_.client;
    allocation_fuse.left = failures_.heap;
    memory_is_out = failures_.starve;
  }
  // What has not happened yet may still.
  void disarm() {
    memory_is_out = false;
    failures_.heap = std::exchange(allocation_fuse.left, 0);
    failures_.client = std::exchange(Fragile::fuse.left, 0);
    t_.engine.set_memory_limit(sac::Arena::kReserve);
    t_.engine.set_progress(nullptr);
    failures_.fuse = std::exchange(t_.world.fuse, -1);
  }

  // Whether `act` fails, with what is armed.
  bool fails(const std::function<void()>& act) {
    std::string other;
    bool failed = true;
    arm();
    try {
      act();
      failed = false;
    } catch (const Failure&) {
    } catch (const ClientFailure&) {
    } catch (const sac::Cancelled&) {
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& error) {
      memory_is_out = false;
      allocation_fuse.left = 0;
      other = error.what();
    }
    disarm();
    if (!other.empty()) wrong(other);
    if (failed && failures_.armed == 0) wrong("a failure that nobody asked for");
    return failed;
  }

  // After a failure: the edits are taken back, or have been. More than one may break the engine.
  void recover() {
    const bool may_break = failures_.starve || failures_.armed > 1;
    failures_ = {};
    t_.engine.arena().fail_after(0);
    try {
      t_.engine.undo_edits();
    } catch (const sac::UsageError&) {
      if (!may_break) throw;
      over_ = true;
      return;
    }
    t_.engine.propagate();
    tally_.clear();
    t_.engine.check_invariants();
    wanted_ = now_;
    t_.world.items = items_;
    edited_ = false;
    if (t_.state() != state_) wrong("after a failure:\n" + t_.state() + "\nbefore:\n" + state_);
  }

  void flush() {
    const std::vector<int> plain = plain_values(case_.program, wanted_, kMostCalls);
    sac::Counts counts;
    if (fails([&] { counts = t_.engine.propagate(); })) return recover();
    if (case_.observe && !tally_.agrees(counts)) wrong("events are not what was counted");
    tally_.clear();
    failures_ = {};
    t_.engine.arena().fail_after(0);
    commit(plain);
  }

  void undo() {
    if (fails([&] { t_.engine.undo_edits(); })) return require_broken();
    wanted_ = now_;
    t_.world.items = items_;
    edited_ = false;
  }

  // What cannot be undone breaks the engine.
  void require_broken() {
    over_ = true;
    try {
      t_.engine.propagate();
    } catch (const sac::UsageError&) {
      return;
    }
    wrong("the engine should be broken");
  }

  void run_late(int n) {
    if (wanted_.late.size() == kMostRuns) return;
    if (edited_) flush();
    if (over_) return;
    Outside more = wanted_;
    more.late.push_back(n);
    const std::vector<int> plain = plain_values(case_.program, more, kMostCalls);
    if (fails([&] { t_.engine.template run<late<V>>(n); })) return recover();
    failures_ = {};
    t_.engine.arena().fail_after(0);
    t_.engine.propagate();  // what an undone edit has left
    tally_.clear();
    wanted_ = more;
    commit(plain);
  }

  // The engine has `wanted_`, and must be as if made with it.
  void commit(const std::vector<int>& plain) {
    t_.engine.check_invariants();
    state_ = t_.state();
    Traced<V> fresh(case_.program, wanted_);
    fresh.run(wanted_);
    if (t_.world.values(t_.engine) != plain) wrong("values are not those of a plain run");
    if (state_ != fresh.state()) wrong(state_ + "\nfrom scratch:\n" + fresh.state());
    now_ = wanted_;
    items_ = t_.world.items;
    edited_ = false;
  }

  const Case& case_;
  Outside now_;     // what was propagated last
  Outside wanted_;  // with the edits since then
  std::vector<int> first_;
  Tally tally_;
  Traced<V> t_;
  std::vector<Item<sac::Scope, V>*> items_;  // the world's, at `now_`
  std::string state_;
  Failures failures_;
  bool edited_ = false;
  bool over_ = false;  // the engine is broken, as it may be
};

/// What is wrong with the engine in this case; empty if nothing.
inline std::string fault_of(const Case& c) {
  try {
    c.fragile ? Session<Fragile>(c).run() : Session<int>(c).run();
  } catch (const TooLong&) {
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace support
