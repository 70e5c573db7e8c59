// Runs, propagations, and taking them back.
#include "engine/weights.hpp"
#include "sac/agenda.hpp"
#include "sac/engine.hpp"
#include "sac/mod.hpp"
#include "sac/query.hpp"

namespace sac {

namespace {

// Lifts the arena's limit while it lives.
class Unlimited {
 public:
  explicit Unlimited(Arena& arena) noexcept : arena_(arena), limit_(arena.limit()) {
    arena_.set_limit(Arena::kReserve);
  }
  ~Unlimited() { arena_.set_limit(limit_); }
  Unlimited(const Unlimited&) = delete;
  Unlimited& operator=(const Unlimited&) = delete;

 private:
  Arena& arena_;
  std::size_t limit_;
};

}  // namespace

Engine::Engine()
    : Core(*this),
      mods_(std::make_unique<ModStructure>(*this)),
      watches_(std::make_unique<detail::Watches>(*mods_)) {}

// Nothing is retracted: only what needs destroying is visited. Values go before the cells that
// hold them.
Engine::~Engine() {
  arena().header().ending = true;
  walk([&](const Call& c, std::size_t) { mods_->destroy_values(c); });
  for_each_call([](Call& c) {
    if (c.function().destroy != nullptr) c.function().destroy(c);
  });
  for (const Ref<OutsideHead> object : outside_) {
    OutsideHead& head = arena()[object];
    outside_types_[head.type].destroy(&head + 1);
  }
}

void Engine::make_queries() { queries_ = std::make_unique<Queries>(*this); }

Agenda& Engine::make_agenda(std::string name, const KeyWidths& widths) {
  begin_edit("make_agenda");
  agendas_.push_back(nullptr);
  try {
    agendas_.back() = std::make_unique<Agenda>(*this, std::move(name), widths);
  } catch (...) {
    agendas_.pop_back();
    throw;
  }
  return *agendas_.back();
}

void Engine::release(Agenda& agenda) {
  begin_edit("release");
  agenda.require_unused();
  require_no_argument(agenda);
  std::erase_if(agendas_, [&](const auto& other) { return other.get() == &agenda; });
}

// --- Edits -----------------------------------------------------------------------------------

void Engine::begin_edit(const char* what) const {
  if (broken()) throw UsageError("the engine is broken: a roll-back failed earlier");
  require_idle(what);
}

void Engine::undo_edits() {
  begin_edit("undo_edits");
  undo_edits_behind(0);
}

// Undoes the newest edits, until so many are left. Undoing may fail only where the client's part in
// it does.
void Engine::undo_edits_behind(std::size_t edits) {
  try {
    const Unlimited unlimited(arena());
    for (; rollback_.size() > edits; rollback_.pop_back()) rollback_.back()();
  } catch (...) {
    set_broken();
    throw;
  }
}

// --- Running and propagating -----------------------------------------------------------------

Counts Engine::run_root(const Asked& asked) {
  begin_edit("run");
  if (!settled()) {
    if (!rollback_.empty()) throw UsageError("run: propagate the edits first");
    propagate();  // what undone edits have left
  }
  require_released_unused();
  enter(Core::Mode::running);
  forget_edits();
  const Place before = last_stamp();
  try {
    Core::run_root(asked);
    conclude();
  } catch (...) {
    forget_run(before);
    finish();
    watches_->clear();
    throw;
  }
  return finish_all();
}

Counts Engine::propagate(const std::function<void()>& last) {
  begin_edit("propagate");
  try {
    enter(Core::Mode::propagating);
  } catch (...) {  // no memory to begin with
    undo_edits_behind(0);
    watches_->clear();
    throw;
  }
  try {
    Core::propagate();
    conclude();
    if (last) last();
  } catch (...) {
    roll_back();
    throw;
  }
  forget_edits();
  return finish_all();
}

// What is left to do when the program has run, and may still fail.
void Engine::conclude() {
  require_released_unused();
  check_audit();
  if (settings.watching) watches_->prepare();
}

// Everything is done; who wants to know is told.
Counts Engine::finish_all() {
  free_released();
  const Counts work = finish();
  if (settings.watching) {
    watches_->commit();
    watches_->call();
  }
  return work;
}

void Engine::roll_back() noexcept {
  begin_undoing();
  if (Core::originals().lost()) set_broken();
  try {
    const Unlimited unlimited(arena());
    for (auto undo = rollback_.rbegin(); undo != rollback_.rend(); ++undo) (*undo)();
    if (!broken()) Core::propagate();
  } catch (...) {
    set_broken();
  }
  forget_edits();
  finish();
  watches_->clear();
}

// They can no longer be taken back. Of very many, as before a first run, the memory goes, too.
void Engine::forget_edits() noexcept {
  constexpr std::size_t kKept = 1024;
  rollback_.clear();
  if (rollback_.capacity() > kKept) std::vector<detail::Undo>().swap(rollback_);
}

}  // namespace sac
