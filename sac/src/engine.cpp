// Execution, re-execution, settling, discarding and roll-back.
#include "sac/engine.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <sstream>

#include "sac/agenda.hpp"
#include "sac/mod.hpp"
#include "sac/scope.hpp"

namespace sac {

namespace {

// A quarter is left for what the client has on the stack already, and for the last call's own.
std::size_t default_stack_limit() {
  constexpr rlim_t kUnknown = rlim_t{2} << 20;
  rlimit limit{};
  const bool known = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return static_cast<std::size_t>((known ? limit.rlim_cur : kUnknown) / 4 * 3);
}

std::vector<Handle> room_for(std::size_t count) {
  std::vector<Handle> empty;
  empty.reserve(count);
  return empty;
}

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
    : timeline_(arena_), memo_(arena_), queue_(arena_, timeline_),
      mods_(std::make_unique<ModStructure>(*this)), stack_limit_(default_stack_limit()) {
  now_ = timeline_.front();
}

// Nothing is retracted: only what needs destroying is visited. Values go before the cells that
// hold them.
Engine::~Engine() {
  arena_.header().ending = true;
  agendas_.clear();
  for (Handle h = at<TimeNode>(timeline_.front())->next; h != 0; h = at<TimeNode>(h)->next) {
    if (!at<TimeNode>(h)->marked()) mods_->destroy_values(*at<Call>(h));
  }
  memo_.for_each([](Call& c) {
    if (c.function().destroy != nullptr) c.function().destroy(c);
  });
  for (const Handle h : outside_) {
    outside_types_[at<OutsideHead>(h)->type].destroy(at<OutsideHead>(h) + 1);
  }
}

std::uint8_t Engine::add_structure(Structure& structure) {
  SAC_EXPECTS(structures_.size() < 0xff);
  structures_.push_back(&structure);
  return static_cast<std::uint8_t>(structures_.size() - 1);
}

Agenda& Engine::make_agenda(std::string name) {
  require_usable();
  agendas_.push_back(std::make_unique<Agenda>(*this, std::move(name)));
  return *agendas_.back();
}

std::string Engine::describe(const Call& call) {
  std::ostringstream out;
  out << call.function().name << '(';
  call.function().print(call, out);
  out << ')';
  return out.str();
}

std::string Engine::describe_mod(Handle head) const {
  if (head == 0) return "a modifiable that is null";
  const std::string handle = '@' + std::to_string(head);
  const auto name = names_.find(head);
  return name == names_.end() ? "modifiable " + handle
                              : "modifiable '" + name->second + "' (" + handle + ')';
}

// --- Objects of the outside ------------------------------------------------------------------

Handle Engine::new_outside(const OutsideType& type) {
  if (outside_.size() == outside_.capacity()) outside_.reserve(2 * outside_.size() + 16);
  const std::uint16_t number = outside_types_.number(type);
  const Handle head = arena_.allocate(type.bytes);
  ::new (at<void>(head)) OutsideHead{static_cast<std::uint32_t>(outside_.size()), number, false};
  outside_.push_back(head);
  return head;
}

void Engine::release_outside(void* object, const char* kind) {
  begin_edit("release");
  const Handle head = arena_.handle_of(static_cast<OutsideHead*>(object) - 1);
  const bool known = arena_.contains(object) && at<OutsideHead>(head)->position < outside_.size() &&
                     outside_[at<OutsideHead>(head)->position] == head;
  if (!known) throw UsageError(std::string("release: the outside has not made this ") + kind);
  if (at<OutsideHead>(head)->released) {
    const Handle handle = arena_.handle_of(object);
    const std::string name = names_.contains(handle)
                                 ? describe_mod(handle)
                                 : std::string(kind) + " @" + std::to_string(handle);
    throw UsageError("release: " + name + " has been released already");
  }
  if (released_.size() == released_.capacity()) released_.reserve(2 * released_.size() + 16);
  on_rollback([this] {
    at<OutsideHead>(released_.back())->released = false;
    released_.pop_back();
  });
  at<OutsideHead>(head)->released = true;
  released_.push_back(head);
}

void Engine::require_released_unused() const {
  constexpr Handle kHead = sizeof(OutsideHead) / Arena::kGranule;
  for (const Handle h : released_) {
    const std::size_t bytes = outside_types_[at<OutsideHead>(h)->type].bytes;
    const ModStructure::Use use = mods_->use_within(h + kHead, bytes - sizeof(OutsideHead));
    if (use.call == nullptr) continue;
    throw UsageError("release: " + describe(*use.call) + (use.writes ? " writes " : " reads ") +
                     describe_mod(use.head) + ", which has been released");
  }
}

// What is linked from both of its sides is in the list: what has left has no links.
bool Engine::is_live_call(Handle h) const noexcept {
  const auto is_stamp = [&](Handle s) { return arena_.contains(s, sizeof(TimeNode)); };
  if (!arena_.contains(h, sizeof(Call))) return false;
  const TimeNode& node = *at<TimeNode>(h);
  return !node.marked() && is_stamp(node.prev) && at<TimeNode>(node.prev)->next == h &&
         (is_stamp(node.next) ? at<TimeNode>(node.next)->prev == h : h == timeline_.back());
}

void Engine::free_released() noexcept {
  for (const Handle h : released_) {
    OutsideHead& head = *at<OutsideHead>(h);
    const OutsideType& type = outside_types_[head.type];
    outside_[head.position] = outside_.back();
    at<OutsideHead>(outside_.back())->position = head.position;
    outside_.pop_back();
    type.destroy(&head + 1);
    forget_names(h, type.bytes);
    arena_.release(h, type.bytes);
  }
  released_.clear();
}

// The handles will be those of other modifiables.
void Engine::forget_names(Handle from, std::size_t bytes) noexcept {
  const auto first = names_.lower_bound(from);
  auto last = first;
  while (last != names_.end() && (last->first - from) * Arena::kGranule < bytes) ++last;
  names_.erase(first, last);
}

void Engine::require_unwritten(Handle head) const {
  const auto& version = *at<detail::Version>(head);
  if (!version.written && version.history == 0) return;
  throw UsageError("set: " + describe_mod(head) + " is written by the program, in " +
                   describe(*at<Call>(mods_->last(head).writer)));
}

// --- What the client is told -----------------------------------------------------------------

Memory Engine::memory() const noexcept {
  Memory m;
  m.calls_and_edges_live = arena_.bytes_used();
  m.calls_and_edges_held = arena_.bytes_held();
  m.time_stamps = timeline_.bytes();
  m.memo_table = memo_.bytes();
  m.queue = queue_.bytes() + most_leaving_ * sizeof(Handle);
  for (const auto& agenda : agendas_) m.agendas += agenda->bytes();
  m.versions = mods_->bytes();
  m.outside = (outside_.capacity() + released_.capacity()) * sizeof(Handle) +
              rollback_.capacity() * sizeof(rollback_[0]);
  return m;
}

std::vector<FunctionProfile> Engine::profile() const {
  std::vector<FunctionProfile> functions(functions_.size());
  walk([&](const Call& c, std::size_t) {
    FunctionProfile& f = functions[c.function_number];
    ++f.calls;
    f.bytes += c.function().frame_bytes;
    for_each_edge(c, [&](const Edge& edge) {
      ++f.edges;
      f.edge_bytes += edge.granules * Arena::kGranule;
    });
  });
  for (std::size_t i = 0; i < functions.size(); ++i) {
    functions[i].name = functions_[static_cast<std::uint16_t>(i)].name;
  }
  std::erase_if(functions, [](const FunctionProfile& f) { return f.calls == 0; });
  std::stable_sort(functions.begin(), functions.end(), [](const auto& a, const auto& b) {
    return a.bytes + a.edge_bytes > b.bytes + b.edge_bytes;
  });
  return functions;
}

void Engine::shrink() {
  require_usable();
  require_idle("shrink");
  arena_.shrink();
  memo_.shrink();
  mods_->shrink();
  timeline_.shrink();
  queue_.shrink(live_calls_);
  for (const auto& agenda : agendas_) agenda->shrink();
  graveyard_ = room_for(live_calls_);
  if (aside_.capacity() > live_calls_) aside_ = room_for(live_calls_);
  most_leaving_ = graveyard_.capacity() + aside_.capacity();  // taken from memory used before
  outside_.shrink_to_fit();
  released_.shrink_to_fit();
  rollback_.shrink_to_fit();
}

void Engine::set_progress(std::function<bool(const Progress&)> report, std::uint64_t every) {
  require_idle("set_progress");
  SAC_EXPECTS(every > 0);
  progress_ = std::move(report);
  progress_every_ = every;
}

void Engine::report_progress() {
  progress_at_ += progress_every_;
  if (!progress_({.executed = counts_.executed, .queued = queue_.size()})) throw Cancelled();
}

// --- Entering --------------------------------------------------------------------------------

void Engine::require_usable() const {
  if (broken_) throw UsageError("the engine is broken: a roll-back failed earlier");
}

void Engine::require_idle(const char* what) const {
  if (mode_ == Mode::idle) return;
  std::string text = std::string(what) + ": the engine is running";
  if (current_ != nullptr && current_->call != nullptr) text += ' ' + describe(*current_->call);
  throw UsageError(text);
}

void Engine::fail_not_running() const {
  throw UsageError("a scope is used while no traced function runs: it was kept for too long");
}

void Engine::fail_no_environment() const {
  std::string text = "there is no environment: Engine::set_environment gives one";
  if (current_ != nullptr) text = describe(*current_->call) + ": " + text;
  throw UsageError(text);
}

void Engine::fail_foreign(const char* what) const {
  std::string text = std::string(what) + " is not in memory of this engine";
  if (current_ != nullptr) text = describe(*current_->call) + ": " + text;
  throw UsageError(text);
}

void Engine::enter(Mode mode) {
  require_usable();
  require_idle(mode == Mode::running ? "run" : "propagate");
  mode_ = mode;
  const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  stack_end_ = here > stack_limit_ ? here - stack_limit_ : 0;
  if (observer_ != nullptr) [[unlikely]] {
    note(mode == Mode::running ? Event::Kind::run_started : Event::Kind::propagation_started);
  }
  progress_at_ = progress_ ? counts_.executed : ~std::uint64_t{0};
}

void Engine::begin_edit(const char* what) {
  require_usable();
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
    const Unlimited unlimited(arena_);
    for (; rollback_.size() > edits; rollback_.pop_back()) rollback_.back()();
  } catch (...) {
    broken_ = true;
    throw;
  }
}

// --- Running and propagating -----------------------------------------------------------------

Counts Engine::run_root(const Function& function, std::uint32_t hash, const void* args,
                        void (*construct)(void*, const void*)) {
  begin_edit("run");
  if (!rollback_.empty() && !queue_.empty()) throw UsageError("run: propagate the edits first");
  require_released_unused();
  enter(Mode::running);
  rollback_.clear();
  now_ = timeline_.back();
  const Handle before = now_;
  try {
    const Handle root = new_call(function, hash, args, construct);
    insert_call(root);
    execute(root, 0);
    require_released_unused();
    memo_.settle();
    check_audit();
  } catch (...) {
    current_ = nullptr;
    if (observer_ != nullptr) [[unlikely]] note_failure(Event::Kind::roll_back_started);
    discard_between(before, 0);
    memo_.forget_waiting();  // only what this run made waits
    finish();
    throw;
  }
  free_released();
  const Counts done = counts_;
  finish();
  return done;
}

Counts Engine::propagate(const std::function<void()>& last) {
  enter(Mode::propagating);
  try {
    propagate_within(0);
    require_released_unused();
    check_audit();
    if (last) last();
  } catch (...) {
    roll_back();
    throw;
  }
  rollback_.clear();
  free_released();
  const Counts done = counts_;
  finish();
  return done;
}

bool Engine::unposted(const Call& call) const noexcept {
  return call.has(Call::kPosted) && Agenda::slot(call).posts() == 0;
}

// Whether the earliest call that waits is `call` or behind it, up to `end`.
bool Engine::next_is_up_to(Handle call, Handle end) const noexcept {
  const Call& first = *at<Call>(queue_.front());
  if (queue_.front() == call) return !unposted(first);
  return precedes(*at<Call>(call), first) && !timeline_.precedes(*at<TimeNode>(end), first);
}

// A posted call can lose its last poster when it has run or runs already. It may not go before what
// runs has ended, and not stand in the way of others in the queue.
bool Engine::set_dying_aside(Handle call) noexcept {
  const Handle first = queue_.front();
  Call& c = *at<Call>(first);
  if (!unposted(c) || (first != call && precedes(*at<Call>(call), c))) return false;
  static_cast<void>(queue_.pop());
  if (!c.has(Call::kAside)) aside_.push_back(first);
  c.set(Call::kAside);
  return true;
}

void Engine::take_dying_back() noexcept {
  for (const Handle h : aside_) {
    Call& c = *at<Call>(h);
    c.clear(Call::kAside);
    if (c.queue == 0 && !c.has(Call::kDead | Call::kPending)) enqueue(c);
  }
  aside_.clear();
}

// Runs what is invalid in `call`'s interval; 0: everywhere.
void Engine::propagate_within(Handle call) {
  if (call == 0) queue_.sort();
  while (true) {
    if (call == 0) take_dying_back();
    if (queue_.empty()) return;
    if (call != 0 && !next_is_up_to(call, end_of(call))) {
      if (set_dying_aside(call)) continue;
      return;
    }
    run_from_queue(queue_.pop());
  }
}

void Engine::run_from_queue(Handle call) {
  Call& c = *at<Call>(call);
  if (unposted(c)) {
    if (observer_ != nullptr) [[unlikely]] note(Event::Kind::dying, &c);
    discard_subtree(call);
    return;
  }
  now_ = call;
  if (!c.has(Call::kInvalid) && reads_the_same(c)) {
    if (observer_ != nullptr) [[unlikely]] note(Event::Kind::confirmed, &c);
    ++counts_.confirmed;
    return c.clear(Call::kDoubtful);
  }
  execute(call, c.end != 0 ? c.end : c.next);
}

// Client code compares, and may fail.
bool Engine::reads_the_same(Call& call) {
  try {
    return mods_->reads_the_same(call);
  } catch (...) {
    if (observer_ != nullptr) [[unlikely]] note_failure(Event::Kind::failed, &call);
    if (current_ != nullptr) current_->failed_child = handle_of(call);
    invalidate(call);
    throw;
  }
}

void Engine::note_failure(Event::Kind kind, const Call* call) noexcept {
  Event event{.kind = kind, .call = call, .by = running_call()};
  try {
    throw;
  } catch (const std::exception& error) {
    event.message = error.what();
    observer_->on(event);
  } catch (...) {
    observer_->on(event);
  }
}

void Engine::roll_back() {
  current_ = nullptr;
  suspects_.clear();
  mode_ = Mode::undoing;
  if (observer_ != nullptr) [[unlikely]] note_failure(Event::Kind::roll_back_started);
  progress_at_ = ~std::uint64_t{0};
  try {
    const Unlimited unlimited(arena_);
    for (auto undo = rollback_.rbegin(); undo != rollback_.rend(); ++undo) (*undo)();
    if (!broken_) propagate_within(0);
  } catch (...) {
    broken_ = true;
  }
  rollback_.clear();
  finish();
}

void Engine::finish() noexcept {
  counts_ = {};
  current_ = nullptr;
  for (const auto& agenda : agendas_) agenda->drop_unposted();
  if (observer_ != nullptr) [[unlikely]] note(Event::Kind::finished);
  aside_.clear();
  purge();
  suspects_.clear();
  mode_ = Mode::idle;
}

void Engine::purge() noexcept {
  most_leaving_ = std::max(most_leaving_, graveyard_.size());
  for (const Handle h : graveyard_) free_call(h);
  graveyard_.clear();
}

// A pair of equal labels counts if both are alive at the end; a discarded call that was made again
// counts at once.
void Engine::check_audit() {
  for (const auto& [fresh, other] : suspects_) {
    const Call& f = *at<Call>(fresh);
    const Call& o = *at<Call>(other);
    if (f.has(Call::kDead)) continue;
    if (o.has(Call::kDead)) {
      if (report_.reordered++ == 0) report_.first_reordered = describe(f);
    } else {
      if (report_.duplicates++ == 0) report_.first_duplicate = describe(f);
    }
  }
}

// --- Calls -----------------------------------------------------------------------------------

Handle Engine::new_call(const Function& function, std::uint32_t hash, const void* args,
                        Construct construct) {
  queue_.reserve(live_calls_ + 1);  // so that invalidating and discarding cannot fail
  if (function.posted && aside_.capacity() <= live_calls_) aside_.reserve(2 * live_calls_ + 64);
  if (graveyard_.capacity() < live_calls_ + graveyard_.size() + 1) {
    graveyard_.reserve(2 * (live_calls_ + graveyard_.size()) + 64);
  }
  const std::uint16_t number = number_of(function);
  const Handle h = arena_.allocate(function.frame_bytes);
  Call& c = *::new (at<void>(h)) Call;
  c.function_number = number;
  c.state = function.execute != nullptr ? Call::kInvalid : 0;
  if (function.posted) c.set(Call::kPosted);
  try {
    construct(&c, args);
  } catch (...) {
    arena_.release(h, function.frame_bytes);
    throw;
  }
  try {
    if (audit_) suspect(h, hash, args);
    appending() ? memo_.insert_soon(h, hash) : memo_.insert(h, hash);
  } catch (...) {
    if (function.destroy != nullptr) function.destroy(c);
    arena_.release(h, function.frame_bytes);
    throw;
  }
  ++live_calls_;
  ++counts_.created;
  if (observer_ != nullptr) [[unlikely]] note(Event::Kind::created, &c);
  return h;
}

void Engine::free_call(Handle call) noexcept {
  Call& c = *at<Call>(call);
  const Function& function = c.function();
  memo_.erase(call, function.hash(c));
  if (function.destroy != nullptr) function.destroy(c);
  if (function.object_offset != 0 && !names_.empty()) forget_names(call, function.frame_bytes);
  arena_.release(call, function.frame_bytes);
}

// A call that got no place, or lost it, leaves for good.
void Engine::drop_call(Handle call) noexcept {
  Call& c = *at<Call>(call);
  if (observer_ != nullptr && !c.has(Call::kDead)) [[unlikely]] note(Event::Kind::discarded, &c);
  c.set(Call::kDead);
  graveyard_.push_back(call);
  --live_calls_;
}

// Gives a new call its place: now.
void Engine::insert_call(Handle call) {
  try {
    timeline_.insert_after(now_, call);
  } catch (...) {
    drop_call(call);
    throw;
  }
  now_ = call;
}

void Engine::suspect(Handle fresh, std::uint32_t hash, const void* args) {
  const Call& f = *at<Call>(fresh);
  const Handle other = memo_.find(hash, [&](Handle, const Call& c) {
    return c.function_number == f.function_number && f.function().equal(c, args);
  });
  if (other != 0) suspects_.emplace_back(fresh, other);
}

// A call whose end stamp is the limit itself can only be the tail of the call that ends there:
// as anything else it would leave no room before that end. Calls are mostly repeated in order: the
// next one is looked at first, which spares a look into the memo table.
Handle Engine::find_reusable(const Function& function, std::uint32_t hash, const void* args,
                             bool tail) {
  const Handle limit = current_->limit;
  const Handle next = at<TimeNode>(now_)->next;
  if (next == limit) return 0;  // nothing ahead: a first run
  const bool may_share_end = tail && current_->end == limit;
  const std::uint16_t number = number_of(function);
  const auto fits = [&](const Call& c) {
    constexpr std::uint16_t kUnfit =
        Call::kDead | Call::kRunning | Call::kPending | Call::kPosted;
    return c.function_number == number && !c.has(kUnfit) &&
           (c.end == 0 || c.end != limit || may_share_end);
  };
  if (!at<TimeNode>(next)->marked()) {
    const Call& c = *at<Call>(next);
    if (fits(c) && function.equal(c, args)) return next;
  }
  return memo_.find(hash, [&](Handle, const Call& c) {
    return fits(c) && lies_ahead(c) &&
           (limit == 0 || timeline_.precedes(c, *at<TimeNode>(limit))) && function.equal(c, args);
  });
}

Handle Engine::call_child(const Function& function, std::uint32_t hash, const void* args,
                          Construct construct) {
  Activation& caller = running();
  require_no_tail(caller, function);
  require_stack(caller, function);
  hide_unconfirmed(caller);
  need_end(caller);
  Handle child = find_reusable(function, hash, args, false);
  if (child != 0) {
    discard_between(now_, child);
    now_ = end_of(child);
    ++counts_.reused;
    if (observer_ != nullptr) [[unlikely]] note(Event::Kind::reused, at<Call>(child));
    if (function.has_result) depend_on_result(child);
  } else {
    child = new_call(function, hash, args, construct);
    insert_call(child);
    if (function.has_result) depend_on_result(child);
    if (function.execute == nullptr) return child;
    execute(child, caller.limit);
  }
  settle_child(child);
  SAC_ENSURES(!at<Call>(child)->has(Call::kInvalid | Call::kDoubtful));
  return child;
}

// What a running call has not repeated before its first child is no more for its children, nor for
// theirs, even if they are reused: what in its old interval has seen it is in doubt. A tail call
// runs when its caller has settled.
void Engine::hide_unconfirmed(Activation& a) noexcept {
  if (a.old_edges == 0 || a.hidden) return;
  a.hidden = true;
  if (a.end_linked) mods_->hide_unconfirmed(*a.call, a.end, a.old_edges);
}

void Engine::require_no_tail(const Activation& caller, const Function& function) const {
  if (caller.tail == 0) return;
  throw UsageError(describe(*caller.call) + " calls " + std::string(function.name) +
                   " behind its tail call " + describe(*at<Call>(caller.tail)) +
                   ", which must be the last");
}

// A call that has failed must run again: nobody may go on as if it had not.
void Engine::fail_caught(const Activation& caller) const {
  throw UsageError(describe(*caller.call) + " has caught what " +
                   describe(*at<Call>(caller.failed_child)) +
                   " threw: exceptions of calls must pass");
}

void Engine::require_stack(const Activation& caller, const Function& function) const {
  if (reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) >= stack_end_) [[likely]] return;
  throw UsageError(describe(*caller.call) + " calls " + std::string(function.name) +
                   " too deep: calls inside of calls have taken " + std::to_string(stack_limit_) +
                   " bytes of the native stack; use tail calls, or divide");
}

// The last call that asked for it depends on its result.
void Engine::depend_on_result(Handle child) noexcept {
  reinterpret_cast<ResultHead*>(at<Call>(child) + 1)->caller = handle_of(*current_->call);
}

void Engine::result_changed(Handle caller) noexcept {
  Call& c = *at<Call>(caller);
  if (observer_ != nullptr && !c.has(Call::kRunning)) [[unlikely]] note(Event::Kind::returned, &c);
  invalidate(c);
}

// Runs what is invalid in a child that was reused, or in what the child reused: whatever precedes
// the running call is settled.
void Engine::settle_child(Handle child) {
  if (mode_ == Mode::running || queue_.empty()) return;
  try {
    propagate_within(child);
  } catch (...) {
    now_ = end_of(child);
    throw;
  }
  now_ = end_of(child);
}

Handle Engine::call_tail(const Function& function, std::uint32_t hash, const void* args,
                         Construct construct) {
  Activation& caller = running();
  require_no_tail(caller, function);
  need_end(caller);
  const Handle old = find_reusable(function, hash, args, true);
  caller.tail_reused = old != 0;
  caller.tail = old;
  if (old == 0) {
    caller.tail = new_call(function, hash, args, construct);
    at<Call>(caller.tail)->set(Call::kPending);
  }
  return caller.tail;
}

// A call gets its end stamp with its first child. It is linked when the call closes, because the
// calls that it may still reuse lie between.
void Engine::need_end(Activation& a) {
  if (a.end == 0) {
    a.end = arena_.allocate(sizeof(TimeNode));
    ::new (at<void>(a.end)) TimeNode;
    at<TimeNode>(a.end)->mark();
  }
  a.call->end = a.end;
}

void Engine::execute(Handle call, Handle limit) {
  Activation a;
  a.outer = current_;
  a.limit = limit;
  a.end = at<Call>(call)->end;
  a.end_linked = a.end != 0;
  current_ = &a;
  try {
    run_body(a, call);
    for (Handle link = call; settle_link(a, link);) {
      link = std::exchange(a.tail, 0);
      at<Call>(link)->clear(Call::kPending);
      insert_call(link);
      at<Call>(link)->end = a.end;
      run_body(a, link);
    }
    close(a);
  } catch (...) {
    abandon(a);
    throw;
  }
  current_ = a.outer;
}

// Whether a new tail call follows `link`, which has just run: then what `link` took back when it
// settled, and its children may have seen, is brought up to date before. If a result changes by
// that, the link runs again.
bool Engine::settle_link(Activation& a, Handle link) {
  while (a.tail != 0 && !a.tail_reused) {
    if (mode_ == Mode::running) return true;
    const Handle reached = now_;
    if (queue_.empty() || (!next_is_up_to(link, reached) && !set_dying_aside(link))) return true;
    if (queue_.empty() || !next_is_up_to(link, reached)) continue;
    const Handle h = queue_.pop();
    if (h == link) {
      drop_call(std::exchange(a.tail, 0));
      if (!a.end_linked) link_end(a);  // what it does not repeat lies before
      now_ = link;
      run_body(a, link);
    } else {
      try {
        run_from_queue(h);
      } catch (...) {
        now_ = h == reached ? end_of(h) : reached;
        throw;
      }
      now_ = h == reached ? end_of(h) : reached;
    }
  }
  return false;
}

void Engine::run_body(Activation& a, Handle call) {
  Call& c = *at<Call>(call);
  a.call = &c;
  a.old_edges = std::exchange(c.edges, 0);
  a.last_edge = 0;
  a.hidden = false;
  a.failed_child = 0;
  c.clear(Call::kInvalid | Call::kDoubtful);
  c.set(Call::kRunning);
  if (counts_.executed >= progress_at_) [[unlikely]] report_progress();
  ++counts_.executed;
  if (observer_ != nullptr) [[unlikely]] note(Event::Kind::executed, &c);
  Scope scope(*this);
  c.function().execute(scope, c);
  if (a.failed_child != 0) [[unlikely]] fail_caught(a);
  settle(a);
}

// The call has said all it has to say: what it did not repeat is taken back. It has not seen that
// in this execution, so it is not invalidated by it.
void Engine::settle(Activation& a) noexcept {
  retract_all(*a.call, std::exchange(a.old_edges, 0));
  a.call->clear(Call::kRunning | Call::kInvalid | Call::kDoubtful);
}

// Ends the interval: a reused tail ends it, what was not reused is discarded.
void Engine::close(Activation& a) {
  if (a.tail != 0) {
    discard_between(now_, a.tail);
    now_ = end_of(a.tail);
    ++counts_.reused;
    if (observer_ != nullptr) [[unlikely]] note(Event::Kind::reused, at<Call>(a.tail));
    a.tail = 0;
  }
  if (a.end == 0 || now_ == a.end) return;  // a reused tail may share the end
  if (a.end_linked) {
    discard_between(now_, a.end);
  } else {
    link_end(a);
  }
  now_ = a.end;
}

void Engine::link_end(Activation& a) {
  timeline_.insert_after(now_, a.end);
  a.end_linked = true;
}

// Client code threw: the call stays, as one that must run again.
void Engine::abandon(Activation& a) noexcept {
  if (observer_ != nullptr) [[unlikely]] note_failure(Event::Kind::failed, a.call);
  if (a.tail != 0 && !a.tail_reused) drop_call(std::exchange(a.tail, 0));
  settle(a);
  if (a.end != 0 && !a.end_linked) {
    // Cannot fail in the middle of a group with room; a failure leaves the call a leaf.
    try {
      link_end(a);
      now_ = a.end;
    } catch (...) {
      broken_ = true;
    }
  }
  invalidate(*a.call);
  if (a.outer != nullptr) a.outer->failed_child = handle_of(*a.call);
  current_ = a.outer;
}

void Engine::discard_between(Handle from, Handle to) noexcept {
  for (Handle h = at<TimeNode>(from)->next; h != to;) {
    const Handle next = at<TimeNode>(h)->next;
    if (at<TimeNode>(h)->marked()) {
      timeline_.erase(h);
      if (current_ != nullptr && h == current_->end) {  // to be put behind what it does instead
        at<TimeNode>(h)->prev = 0;
        current_->end_linked = false;
      } else {
        arena_.release(h, sizeof(TimeNode));
      }
    } else {
      discard(h);
    }
    h = next;
  }
}

// A posted call that is still asked for goes back to its agenda: only the drain that ran it left.
void Engine::discard(Handle call) noexcept {
  Call& c = *at<Call>(call);
  const bool asked_for = c.has(Call::kPosted) && Agenda::slot(c).posts() != 0;
  if (observer_ != nullptr) [[unlikely]] {
    note(asked_for ? Event::Kind::detached : Event::Kind::discarded, &c);
  }
  c.set(asked_for ? Call::kPending : Call::kDead);
  if (c.queue != 0) queue_.erase(c);
  retract_all(c, std::exchange(c.edges, 0));
  if (c.has(Call::kPosted)) Agenda::forget(*this, c);
  timeline_.erase(call);
  if (asked_for) return Agenda::detach(*this, c);
  drop_call(call);
  ++counts_.discarded;
}

void Engine::discard_subtree(Handle call) noexcept {
  if (const Handle end = at<Call>(call)->end; end != 0) {
    discard_between(call, end);
    timeline_.erase(end);
    arena_.release(end, sizeof(TimeNode));
  }
  discard(call);
}

// --- Edges -----------------------------------------------------------------------------------

Edge& Engine::attach(std::uint8_t structure, std::uint8_t kind, std::size_t bytes) {
  Activation& a = running();
  const Handle h = arena_.allocate(bytes);
  Edge& edge = *at<Edge>(h);
  edge.next = 0;
  edge.structure = structure;
  edge.granules = static_cast<std::uint16_t>((bytes + Arena::kGranule - 1) / Arena::kGranule);
  edge.kind = kind;
  (a.last_edge != 0 ? at<Edge>(a.last_edge)->next : a.call->edges) = h;
  a.last_edge = h;
  ++live_edges_;
  ++counts_.edges_made;
  return edge;
}

void Engine::free_edge(Edge& edge) noexcept {
  --live_edges_;
  ++counts_.edges_removed;
  arena_.release(arena_.handle_of(&edge), edge.granules * Arena::kGranule);
}

void Engine::retract_all(Call& call, Handle edges) noexcept {
  while (edges != 0) {
    Edge& edge = *at<Edge>(edges);
    edges = edge.next;
    structures_[edge.structure]->retract(call, edge);
    free_edge(edge);
  }
}

// --- Invariants ------------------------------------------------------------------------------

void Engine::check_invariants() const {
  SAC_INVARIANT(mode_ == Mode::idle && current_ == nullptr && graveyard_.empty());
  arena_.check_invariants();
  timeline_.check_invariants();
  memo_.check_invariants();
  queue_.check_invariants();
  std::uint64_t calls = 0;
  std::uint64_t edges = 0;
  walk([&](const Call& c, std::size_t) {
    ++calls;
    SAC_INVARIANT(!c.has(Call::kDead | Call::kRunning | Call::kPending));
    SAC_INVARIANT(c.end == 0 || precedes(c, *at<Call>(c.end)));
    const Handle self = arena_.handle_of(&c);
    SAC_INVARIANT(memo_.contains(self, c.function().hash(c)));
    for (Handle e = c.edges; e != 0; e = at<Edge>(e)->next) {
      ++edges;
      SAC_INVARIANT(at<Edge>(e)->structure < structures_.size());
    }
    if (queue_.empty()) mods_->check_writes(c);
  });
  for (std::size_t i = 0; i < outside_.size(); ++i) {
    SAC_INVARIANT(at<OutsideHead>(outside_[i])->position == i);
  }
  for (const auto& agenda : agendas_) calls += agenda->pending_calls();
  SAC_INVARIANT(calls == live_calls_ && edges == live_edges_);
  SAC_INVARIANT(memo_.size() == live_calls_);
  for (const auto& agenda : agendas_) agenda->check_invariants();
}

}  // namespace sac
