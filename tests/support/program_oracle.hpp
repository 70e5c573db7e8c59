// Runs a case and compares the engine with runs from scratch: after every propagation the values
// are those of a plain run and of a new engine, as are the calls and the number of edges; after one
// that fails everything is as before.
#pragma once

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <memory>
#include <new>
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
  void check_invariants() const {
    engine.check_invariants();
    world.check_invariants();
  }
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
  const int posted = first_posted + step.a % (world.program->size() - first_posted) +
                     16 * (step.b % (RandomProgram::kSides + 1));
  switch (step.kind) {
    case Step::set:
      engine.set(world.inputs[a % outside.inputs.size()], V(step.b % 8));
      outside.inputs[a % outside.inputs.size()] = step.b % 8;
      return;
    case Step::post:
      world.post_from_outside(posted);
      outside.posts.insert(posted);
      return;
    case Step::retract:
      if (const auto it = outside.posts.find(posted); it != outside.posts.end()) {
        world.retract_from_outside(posted);
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

/// What a plain run says.
struct Verdict {
  bool refused = false;     // a traced run must fail
  std::vector<int> values;  // what the program leaves, if it need not
};

/// Throws: TooLong if the run takes more than `calls`.
inline Verdict plain_verdict(const RandomProgram& program, const Outside& outside, int calls) {
  RandomWorld<sac::PlainScope> world;
  sac::PlainScope scope;
  world.calls_left = calls;
  bool threw = false;
  try {
    world.start(scope, program, outside);
    world.run(scope, outside);
  } catch (const sac::UsageError&) {
    threw = true;
  } catch (const Refusal&) {
    threw = true;
  }
  Verdict verdict{threw || world.judge.refused(), {}};
  if (!verdict.refused) verdict.values = world.values(scope);
  return verdict;
}

/// A message without the numbers of handles, which are not the same in every engine.
inline std::string without_handles(const std::string& message) {
  std::string text;
  for (std::size_t i = 0; i < message.size(); ++i) {
    text += message[i];
    if (message[i] != '@') continue;
    while (i + 1 < message.size() && std::isdigit(static_cast<unsigned char>(message[i + 1]))) ++i;
  }
  return text;
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

/// The part of a message that is the same in every engine: without the numbers of handles, without
/// what it says of the rest of the trace, which a run from scratch does not have yet, and without
/// callers, which need not run in a propagation.
inline std::string essence(const std::string& message) {
  std::string text = message;
  if (text.find("is drained twice") != std::string::npos) text.erase(0, text.find("agenda '"));
  for (const char* rest : {"; of the first drain", ", which is written only by the later call",
                           ", which nobody has written"}) {
    text = text.substr(0, text.find(rest));
  }
  return without_handles(text);
}

/// Whether `message` is a caller's that has caught what a call threw. In a propagation the call may
/// run alone: then its own exception leaves.
inline bool is_caught(const std::string& message) {
  return message.find("has caught") != std::string::npos;
}

/// Whether a propagation may refuse so what a run from scratch accepts: a key that changed under
/// its label is known to a propagation only, and the error may be caught.
inline bool is_changed_key(const std::string& refusal, const RandomProgram& program) {
  return refusal.find("is posted at two keys") != std::string::npos ||
         (is_caught(refusal) && program.has(Op::keyed));
}

/// Whether every execution of a node in a propagation must be one of a run from scratch as well:
/// a program is not to see what no run from scratch shows, not even for a while.
inline constexpr bool kWatchExecutions = true;

/// One case being run. V: the type of values.
template <class V>
class Session {
 public:
  explicit Session(const Case& c) : case_(c), t_(c.program, now_) {
    t_.engine.set_audit(c.audit);
    if (c.observe) t_.engine.set_observer(&tally_);
    t_.engine.template run<list_root<V>>();
    start();
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
  static constexpr int kStarts = 8;  // inputs that are tried until a program accepts

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
  enum class Outcome { done, failed, refused };

  // What runs from scratch say: a plain one, and one in a new engine.
  struct Scratch {
    std::unique_ptr<Traced<V>> fresh;  // none if it refuses
    std::string refusal;
    Verdict verdict;
  };

  [[noreturn]] static void wrong(const std::string& what) { throw std::logic_error(what); }

  Scratch from_scratch(const Outside& outside) const {
    Scratch scratch;
    scratch.verdict = plain_verdict(case_.program, outside, kMostCalls);
    scratch.fresh = std::make_unique<Traced<V>>(case_.program, outside);
    scratch.fresh->world.calls_left = 8 * kMostCalls;
    scratch.refusal = refusal_of([&] { scratch.fresh->run(outside); });
    const bool refused = !scratch.refusal.empty();
    if (refused != scratch.verdict.refused) {
      wrong(refused ? "a first run must not refuse: " + scratch.refusal
                    : "a first run accepts what it must refuse");
    }
    if (refused) scratch.fresh.reset();
    return scratch;
  }

  // What `act` says in refusing a program; empty if it does not.
  static std::string refusal_of(const std::function<void()>& act) {
    try {
      act();
    } catch (const Refusal& error) {
      return error.what();
    } catch (const sac::UsageError& error) {
      return error.what();
    }
    return "";
  }

  // A first run that is refused leaves nothing; with other inputs it may go well.
  void start() {
    const std::uint64_t edges = t_.engine.live_edges();
    for (int i = 0; i < kStarts; ++i) {
      t_.world.executions.clear();
      const Scratch scratch = from_scratch(now_);
      const std::string refusal = refusal_of([&] { t_.engine.template run<random_root<V>>(); });
      tally_.clear();
      require_equal(refusal, scratch.refusal);
      wanted_ = now_;
      if (refusal.empty()) return commit(scratch);
      t_.engine.check_invariants();
      if (t_.engine.live_edges() != edges) wrong("a run that was refused leaves something");
      t_.edit({Step::set, i, now_.inputs[static_cast<std::size_t>(i % 4)] + 1 + i / 4}, now_);
      t_.engine.propagate();
    }
    over_ = true;
  }

  void take(const Step& step) {
    switch (step.kind) {
      case Step::propagate:
        return flush();
      case Step::undo:
        return undo();
      case Step::run:
        return run_late(step.a % 32);
      case Step::shrink:
        if (attempt([&] { t_.engine.shrink(); }) != Outcome::done) t_.check_invariants();
        return;
      case Step::fuse:
        failures_.fuse = step.a;
        break;
      case Step::client:
        failures_.client = count_of(step);
        break;
      case Step::heap:
        failures_.heap = count_of(step);
        break;
      case Step::arena:
        failures_.arena = count_of(step);
        break;
      case Step::cancel:
        failures_.cancel = step.a;
        break;
      case Step::starve:
        failures_.starve = true;
        break;
      default:
        edited_ = true;
        if (attempt([&] { t_.edit(step, wanted_); }) != Outcome::done) recover();
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

  // How `act` ends, with what is armed; refusal_ says why if it is refused.
  Outcome attempt(const std::function<void()>& act) {
    std::string other;
    Outcome outcome = Outcome::failed;
    refusal_.clear();
    t_.world.executions.clear();
    arm();
    try {
      act();
      outcome = Outcome::done;
    } catch (const Failure&) {
    } catch (const ClientFailure&) {
    } catch (const sac::Cancelled&) {
    } catch (const std::bad_alloc&) {
    } catch (const Refusal& error) {
      stop_failing();
      refusal_ = error.what();
    } catch (const sac::UsageError& error) {
      stop_failing();
      refusal_ = error.what();
    } catch (const std::exception& error) {
      stop_failing();
      other = error.what();
    }
    disarm();
    if (!other.empty()) wrong(other);
    if (!refusal_.empty()) return Outcome::refused;
    if (outcome == Outcome::failed && failures_.armed == 0) wrong("a failure nobody asked for");
    return outcome;
  }
  static void stop_failing() {
    memory_is_out = false;
    allocation_fuse.left = 0;
    Fragile::fuse.left = 0;
  }

  // After a failure: the edits are taken back, or have been. More than one may break the engine.
  void recover() {
    const int failures = failures_.armed + (refusal_.empty() ? 0 : 1);
    const bool may_break = failures_.starve || failures > 1;
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
    t_.check_invariants();
    wanted_ = now_;
    t_.world.items = items_;
    edited_ = false;
    if (t_.state() != state_) wrong("after a failure:\n" + t_.state() + "\nbefore:\n" + state_);
  }

  // What was refused must be refused from scratch, with the same words, but for a changed key. (A
  // message is cut short if memory runs out in making it.)
  void require_refusal(const Scratch& scratch) const {
    const bool key_changed = is_changed_key(refusal_, case_.program);
    if (scratch.refusal.empty() && key_changed) return;
    if (scratch.refusal.empty()) wrong("refused, but not from scratch: " + refusal_);
    const bool same_words = failures_.armed == 0 && !key_changed && !is_caught(scratch.refusal);
    if (same_words) require_equal(refusal_, scratch.refusal);
  }
  static void require_equal(const std::string& refusal, const std::string& scratch) {
    if (essence(refusal) == essence(scratch)) return;
    const auto words = [](const std::string& text) { return text.empty() ? "nothing" : text; };
    wrong("refused with: " + words(refusal) + "\nfrom scratch: " + words(scratch));
  }

  void flush() {
    const Scratch scratch = from_scratch(wanted_);
    sac::Counts counts;
    switch (attempt([&] { counts = t_.engine.propagate(); })) {
      case Outcome::refused:
        require_refusal(scratch);
        [[fallthrough]];
      case Outcome::failed:
        return recover();
      case Outcome::done:
        break;
    }
    if (case_.observe && !tally_.agrees(counts)) wrong("events are not what was counted");
    tally_.clear();
    failures_ = {};
    t_.engine.arena().fail_after(0);
    commit(scratch);
  }

  void undo() {
    if (attempt([&] { t_.engine.undo_edits(); }) != Outcome::done) return require_broken();
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
    const Scratch scratch = from_scratch(more);
    switch (attempt([&] { t_.engine.template run<late<V>>(n); })) {
      case Outcome::refused:
        require_refusal(scratch);
        [[fallthrough]];
      case Outcome::failed:
        return recover();
      case Outcome::done:
        break;
    }
    failures_ = {};
    t_.engine.arena().fail_after(0);
    t_.engine.propagate();  // what an undone edit has left
    tally_.clear();
    wanted_ = more;
    commit(scratch);
  }

  // The engine has `wanted_`, and must be as if made with it.
  void commit(const Scratch& scratch) {
    if (!scratch.fresh) wrong("accepted, but not from scratch: " + scratch.refusal);
    t_.check_invariants();
    state_ = t_.state();
    if (t_.world.values(t_.engine) != scratch.verdict.values) {
      wrong("values are not those of a plain run");
    }
    for (const auto& seen : t_.world.executions) {
      if (!kWatchExecutions) break;
      if (scratch.fresh->world.executions.contains(seen)) continue;
      std::string text = "a node was shown what no run from scratch shows: ";
      for (const int number : seen) text += std::to_string(number) + ' ';
      wrong(text);
    }
    const std::string expected = scratch.fresh->state();
    if (state_ != expected) wrong(state_ + "\nfrom scratch:\n" + expected);
    now_ = wanted_;
    items_ = t_.world.items;
    edited_ = false;
  }

  const Case& case_;
  Outside now_;     // what was propagated last
  Outside wanted_;  // with the edits since then
  Tally tally_;
  Traced<V> t_;
  std::vector<Item<sac::Scope, V>*> items_;  // the world's, at `now_`
  std::string state_;
  std::string refusal_;
  Failures failures_;
  bool edited_ = false;
  bool over_ = false;  // the engine is broken, as it may be, or no program
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
