// Modes of the core: entering, finishing, undoing; audit, sizes, invariants.
#include <algorithm>

#include "sac/engine.hpp"
#include "sac/internal/core.hpp"
#include "sac/internal/platform.hpp"

namespace sac {

Core::Core(Engine& engine)
    : engine_(engine),
      timeline_(arena_),
      memo_(arena_, timeline_),
      queue_(arena_, timeline_),
      now_(timeline_.front()) {
  // A quarter is left for what the client has on the stack already, and for the last call's own.
  settings.stack_limit = platform::stack_bytes() / 4 * 3;
}

std::uint8_t Core::add_structure(Structure& structure) {
  auto free = std::find(structures_.begin(), structures_.end(), nullptr);
  if (free == structures_.end()) {
    if (structures_.size() == 0xff) {
      throw UsageError("an engine has room for 255 structures, agendas included");
    }
    free = structures_.insert(free, nullptr);
  }
  *free = &structure;
  return static_cast<std::uint8_t>(free - structures_.begin());
}

// --- Entering --------------------------------------------------------------------------------

void Core::require_idle(const char* what) const {
  if (idle()) return;
  std::string text = std::string(what) + ": the engine is running";
  if (current_ != nullptr) {
    text += ' ' + Engine::describe(*current_->call);
    current_->failed = true;  // even if it goes on to catch this
  }
  throw UsageError(text);
}

std::string Core::context(const char* what) const {
  return current_ != nullptr ? Engine::describe(*current_->call) + ": " + what : what;
}

void Core::fail_not_running() const {
  throw UsageError("a scope is used while no traced function runs: it was kept for too long");
}

// Shared libraries may each have a name of a type of their own.
void Core::require_environment(std::string_view type) const {
  if (settings.environment.object == nullptr) {
    throw UsageError(context("there is no environment: Engine::set_environment gives one"));
  }
  if (*settings.environment.type == type) return;
  throw UsageError(context(("the environment is of type " +
                            std::string(*settings.environment.type) + ", not " + std::string(type))
                               .c_str()));
}

void Core::fail_foreign(const char* what) const {
  throw UsageError(context((std::string(what) + " is not in memory of this engine").c_str()));
}

void Core::enter(Mode mode) {
  if (room_ < live_calls_) make_room(live_calls_);
  mode_ = mode;
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  stack_end_ = here > settings.stack_limit ? here - settings.stack_limit : 0;
  note(mode == Mode::running ? Event::Kind::run_started : Event::Kind::propagation_started);
  progress_at_ = settings.progress ? counts_.executed : ~std::uint64_t{0};
}

void Core::run_root(const Asked& asked) {
  now_ = timeline_.back();
  const Ref<Call> root = new_call(asked);
  insert_call(root);
  execute(root, nullptr);
}

// --- Leaving ---------------------------------------------------------------------------------

void Core::forget_run(Place before) noexcept {
  current_ = nullptr;
  note_failure(Event::Kind::roll_back_started);
  discard_between(before, nullptr);
  memo_.forget_waiting();  // only what this run made waits
}

void Core::begin_undoing() noexcept {
  current_ = nullptr;
  suspects_.clear();
  mode_ = Mode::undoing;
  note_failure(Event::Kind::roll_back_started);
  progress_at_ = ~std::uint64_t{0};
  stack_end_ -=
      std::min(stack_end_, settings.stack_limit / 8);  // to come as deep as what failed, and on
}

Counts Core::finish() noexcept {
  edges_before_ = live_edges();
  const Counts done = std::exchange(counts_, {});
  current_ = nullptr;
  for_each_structure([](Structure& s) { s.finished(); });
  note(Event::Kind::finished);
  originals_.clear();
  purge();
  suspects_.clear();
  mode_ = Mode::idle;
  return done;
}

void Core::purge() noexcept {
  most_leaving_ = std::max(most_leaving_, graveyard_.size());
  for (const Ref<Call> call : graveyard_) free_call(call);
  graveyard_.clear();
}

// The handles will be those of other modifiables.
void Core::forget_names(Handle from, std::size_t bytes) noexcept {
  const auto first = settings.names.lower_bound(from);
  auto last = first;
  while (last != settings.names.end() && (last->first - from) * Arena::kGranule < bytes) ++last;
  settings.names.erase(first, last);
  if (settings.watching) engine_.forget_watches(from, bytes);
}

// A pair of equal labels counts if both are alive at the end; a discarded call that was made again
// counts at once.
void Core::check_suspects() {
  for (const auto& [fresh, other] : suspects_) {
    const Call& f = at(fresh);
    if (f.dead()) continue;
    if (at(other).dead()) {
      if (report_.reordered++ == 0) report_.first_reordered = Engine::describe(f);
    } else {
      if (report_.duplicates++ == 0) report_.first_duplicate = Engine::describe(f);
    }
  }
}

// --- What there is ---------------------------------------------------------------------------

Core::Sizes Core::sizes() const noexcept {
  return {timeline_.bytes(), memo_.bytes(), queue_.bytes() + most_leaving_ * sizeof(graveyard_[0])};
}

// What is linked from both of its sides is in the list: what has left has no links.
template <class T>
bool Core::is_stamped(Ref<T> stamped) const noexcept {
  if (!arena_.contains(stamped)) return false;
  const Place place = stamped;
  const TimeNode& node = at(place);
  return node.kind() == T::kKind && arena_.contains(node.prev) && at(node.prev).next == place &&
         (arena_.contains(node.next) ? at(node.next).prev == place : place == timeline_.back());
}

bool Core::is_live_place(Place place) const noexcept {
  if (is_stamped(Ref<Call>(place.handle()))) return true;
  const Ref<Segment> segment(place.handle());
  return is_stamped(segment) && is_stamped(at(segment).call);
}

const Call& Core::parent_of(const Call& call) const noexcept {
  for (Place p = call.prev; p != timeline_.front(); p = at(p).prev) {
    if (!at(p).is_call()) continue;
    const Call& c = at(as<Call>(p));
    const bool open = c.end != nullptr && (!linked(c.end) || precedes(call, at(c.end)));
    if (open) return c;
  }
  return call;
}

void Core::require_no_argument(const Agenda& agenda) const {
  bool any = false;
  for (std::size_t i = 0; i < functions_.size(); ++i) {
    any = any || functions_[static_cast<std::uint16_t>(i)].has_agenda != nullptr;
  }
  if (!any) return;
  for_each_call([&](const Call& c) {
    const Function& f = c.function();
    if (c.dead() || f.has_agenda == nullptr || !f.has_agenda(c, agenda)) return;
    throw UsageError("release: the agenda is an argument of " + Engine::describe(c));
  });
}

void Core::shrink() {
  arena_.shrink();
  memo_.shrink();
  timeline_.shrink();
  queue_.shrink(live_calls_);
  std::vector<Ref<Call>> graveyard;
  graveyard.reserve(live_calls_);
  graveyard_.swap(graveyard);
  most_leaving_ = graveyard_.capacity();  // taken from memory used before
  room_ = 0;
}

void Core::check_invariants(std::uint64_t waiting) const {
  SAC_INVARIANT(idle() && current_ == nullptr && graveyard_.empty());
  arena_.check_invariants();
  timeline_.check_invariants();
  memo_.check_invariants();
  queue_.check_invariants();
  std::uint64_t calls = waiting;
  std::uint64_t edges = 0;
  walk([&](const Call& c, std::size_t) {
    ++calls;
    SAC_INVARIANT(c.life == Life::placed);
    SAC_INVARIANT(c.validity == Validity::valid || c.queue != 0);
    SAC_INVARIANT(c.end == nullptr || precedes(c, at(c.end)));
    SAC_INVARIANT(memo_.contains(arena_.ref(c), c.function().hash(c)));
    const TimeNode* before = &c;
    for (Ref<Edge> e = c.edges; e != nullptr; e = at(e).next) {
      SAC_INVARIANT(at(e).round == c.round);
      if (at(e).begins_segment) {
        const Segment& segment = Segment::of(at(e));
        SAC_INVARIANT(segment.call == arena_.ref(c) && precedes(*before, segment));
        SAC_INVARIANT(c.end != nullptr && precedes(segment, at(c.end)));
        before = &segment;
        continue;
      }
      ++edges;
      SAC_INVARIANT(at(e).structure < structures_.size());
    }
  });
  SAC_INVARIANT(calls == live_calls_ && edges == live_edges());
  SAC_INVARIANT(memo_.size() == live_calls_);
}

}  // namespace sac
