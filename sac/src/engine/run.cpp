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

Engine::Engine() : core_(*this), mods_(std::make_unique<ModStructure>(*this)) {}

// Nothing is retracted: only what needs destroying is visited. Values go before the cells that
// hold them.
Engine::~Engine() {
  arena().header().ending = true;
  walk([&](const Call& c, std::size_t) { mods_->destroy_values(c); });
  core_.for_each_call([](Call& c) {
    if (c.function().destroy != nullptr) c.function().destroy(c);
  });
  for (const Handle h : outside_) {
    outside_types_[outside_head(h)->type].destroy(outside_head(h) + 1);
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
  core_.require_no_argument(agenda);
  std::erase_if(agendas_, [&](const auto& other) { return other.get() == &agenda; });
}

// --- Edits -----------------------------------------------------------------------------------

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
    core_.set_broken();
    throw;
  }
}

// --- Running and propagating -----------------------------------------------------------------

Counts Engine::run_root(const Asked& asked) {
  begin_edit("run");
  if (!core_.settled()) {
    if (!rollback_.empty()) throw UsageError("run: propagate the edits first");
    propagate();  // what undone edits have left
  }
  require_released_unused();
  core_.enter(Core::Mode::running);
  forget_edits();
  const Handle before = core_.last_stamp();
  try {
    core_.run_root(asked);
    require_released_unused();
    core_.check_audit();
    prepare_changes();
  } catch (...) {
    core_.forget_run(before);
    core_.finish();
    forget_changes();
    throw;
  }
  free_released();
  return finish_changes();
}

Counts Engine::propagate(const std::function<void()>& last) {
  begin_edit("propagate");
  try {
    core_.enter(Core::Mode::propagating);
  } catch (...) {  // no memory to begin with
    undo_edits_behind(0);
    forget_changes();
    throw;
  }
  try {
    core_.propagate();
    require_released_unused();
    core_.check_audit();
    prepare_changes();
    if (last) last();
  } catch (...) {
    roll_back();
    throw;
  }
  forget_edits();
  free_released();
  return finish_changes();
}

void Engine::roll_back() noexcept {
  core_.begin_undoing();
  if (core_.originals().lost()) core_.set_broken();
  try {
    const Unlimited unlimited(arena());
    for (auto undo = rollback_.rbegin(); undo != rollback_.rend(); ++undo) (*undo)();
    if (!core_.broken()) core_.propagate();
  } catch (...) {
    core_.set_broken();
  }
  forget_edits();
  core_.finish();
  forget_changes();
}

// They can no longer be taken back. Of very many, as before a first run, the memory goes, too.
void Engine::forget_edits() noexcept {
  constexpr std::size_t kKept = 1024;
  rollback_.clear();
  if (rollback_.capacity() > kKept) std::vector<detail::Undo>().swap(rollback_);
}

}  // namespace sac
