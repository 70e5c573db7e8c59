// Execution, re-execution, settling, discarding and roll-back.
#include "sac/engine.hpp"

#include <sstream>

#include "sac/agenda.hpp"
#include "sac/mod.hpp"
#include "sac/scope.hpp"

namespace sac {

Engine::Engine()
    : timeline_(arena_), memo_(arena_), queue_(arena_, timeline_),
      mods_(std::make_unique<ModStructure>(*this)) {
  now_ = timeline_.front();
}

// Nothing is retracted: only what needs destroying is visited. Values go before the cells that
// hold them.
Engine::~Engine() {
  agendas_.clear();
  for (Handle h = at<TimeNode>(timeline_.front())->next; h != 0; h = at<TimeNode>(h)->next) {
    if (at<TimeNode>(h)->marked()) continue;
    Call& c = *at<Call>(h);
    const auto destroy_versions = [&](Edge& edge) {
      auto& write = static_cast<detail::WriteEdge&>(edge);
      auto& version = *at<detail::Version>(write.version);
      if (version.written) write.ops->destroy(version);
      version.written = false;
    };
    for (Handle e = c.edges; e != 0; e = at<Edge>(e)->next) {
      if (at<Edge>(e)->structure == 0 && at<Edge>(e)->kind == ModStructure::kWrite) {
        destroy_versions(*at<Edge>(e));
      }
    }
  }
  memo_.for_each([](Call& c) {
    if (c.function->destroy != nullptr) c.function->destroy(c);
  });
  for (const auto& [head, destroy] : outside_mods_) destroy(*this, head);
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

std::size_t Engine::bytes() const noexcept {
  std::size_t total = arena_.bytes_used() + timeline_.bytes() + memo_.bytes();
  for (const auto& agenda : agendas_) total += agenda->bytes();
  return total;
}

std::string Engine::describe(const Call& call) {
  std::ostringstream out;
  out << call.function->name << '(';
  call.function->print(call, out);
  out << ')';
  return out.str();
}

void Engine::require_usable() const {
  if (broken_) throw UsageError("the engine is broken: a roll-back failed earlier");
}

void Engine::enter(Mode mode) {
  require_usable();
  if (mode_ != Mode::idle) throw UsageError("the engine is running: it cannot be entered again");
  mode_ = mode;
}

void Engine::begin_edit() {
  require_usable();
  if (mode_ != Mode::idle) throw UsageError("the engine is running: inputs cannot be edited");
}

void Engine::undo_edits() {
  begin_edit();
  for (auto undo = rollback_.rbegin(); undo != rollback_.rend(); ++undo) (*undo)();
  rollback_.clear();
}

// --- Running and propagating -----------------------------------------------------------------

Counts Engine::run_root(const Function& function, std::uint32_t hash, const void* args,
                        void (*construct)(void*, const void*)) {
  if (mode_ == Mode::idle && !rollback_.empty() && !queue_.empty()) {
    throw UsageError("run: propagate the edits first");
  }
  enter(Mode::running);
  rollback_.clear();
  now_ = timeline_.back();
  const Handle before = now_;
  try {
    const Handle root = new_call(function, hash, args, construct);
    insert_call(root);
    execute(root, 0);
    check_audit();
  } catch (...) {
    current_ = nullptr;
    discard_between(before, 0);
    finish();
    throw;
  }
  const Counts done = counts_;
  finish();
  return done;
}

Counts Engine::propagate() {
  enter(Mode::propagating);
  try {
    propagate_within(0);
    check_audit();
  } catch (...) {
    roll_back();
    throw;
  }
  rollback_.clear();
  const Counts done = counts_;
  finish();
  return done;
}

// Whether the earliest invalid call is `call` or a descendant. A posted call can die while it runs,
// when it passes over its last poster; it waits until what runs has ended.
bool Engine::next_is_within(Handle call) const noexcept {
  const Call& first = *at<Call>(queue_.front());
  if (queue_.front() == call) return !first.function->posted || first.posts() != 0;
  return precedes(*at<Call>(call), first) &&
         !timeline_.precedes(*at<TimeNode>(end_of(call)), first);
}

// Runs what is invalid in `call`'s interval; 0: everywhere.
void Engine::propagate_within(Handle call) {
  while (!queue_.empty() && (call == 0 || next_is_within(call))) {
    const Handle h = queue_.pop();
    Call& c = *at<Call>(h);
    if (c.function->posted && c.posts() == 0) {
      discard_subtree(h);
    } else if (c.has(Call::kInvalid)) {
      now_ = h;
      execute(h, c.end != 0 ? c.end : c.next);
    }
  }
}

void Engine::roll_back() {
  current_ = nullptr;
  suspects_.clear();
  try {
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
  for (const auto& agenda : agendas_) agenda->drop_unposted();
  purge();
  suspects_.clear();
  current_ = nullptr;
  mode_ = Mode::idle;
}

void Engine::purge() noexcept {
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
                        void (*construct)(void*, const void*)) {
  queue_.reserve(live_calls_ + 1);  // so that invalidating and discarding cannot fail
  if (graveyard_.capacity() < live_calls_ + graveyard_.size() + 1) {
    graveyard_.reserve(2 * (live_calls_ + graveyard_.size()) + 64);
  }
  const Handle h = arena_.allocate(function.frame_bytes);
  Call& c = *::new (at<void>(h)) Call;
  c.function = &function;
  c.hash = hash;
  c.state = Call::kInvalid;
  try {
    construct(&c, args);
  } catch (...) {
    arena_.release(h, function.frame_bytes);
    throw;
  }
  try {
    if (audit_) suspect(h, args);
    memo_.insert(h);
  } catch (...) {
    if (function.destroy != nullptr) function.destroy(c);
    arena_.release(h, function.frame_bytes);
    throw;
  }
  ++live_calls_;
  ++counts_.created;
  return h;
}

void Engine::free_call(Handle call) noexcept {
  Call& c = *at<Call>(call);
  memo_.erase(call);
  if (c.function->destroy != nullptr) c.function->destroy(c);
  arena_.release(call, c.function->frame_bytes);
}

// A call that got no place, or lost it, leaves for good.
void Engine::drop_call(Handle call) noexcept {
  at<Call>(call)->set(Call::kDead);
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

void Engine::suspect(Handle fresh, const void* args) {
  const Call& f = *at<Call>(fresh);
  const Handle other = memo_.find(f.hash, [&](Handle, const Call& c) {
    return c.function == f.function && c.function->equal(c, args);
  });
  if (other != 0) suspects_.emplace_back(fresh, other);
}

// A call whose end stamp is the limit itself can only be the tail of the call that ends there:
// as anything else it would leave no room before that end.
Handle Engine::find_reusable(const Function& function, std::uint32_t hash, const void* args,
                             bool tail) const {
  const Handle limit = current_->limit;
  if (at<TimeNode>(now_)->next == limit) return 0;  // nothing ahead: a first run
  const bool may_share_end = tail && current_->end == limit;
  return memo_.find(hash, [&](Handle, const Call& c) {
    constexpr std::uint32_t kUnfit = Call::kDead | Call::kRunning | Call::kPending;
    return c.function == &function && !c.has(kUnfit) && !function.posted &&
           lies_ahead(c) && (limit == 0 || timeline_.precedes(c, *at<TimeNode>(limit))) &&
           (c.end == 0 || c.end != limit || may_share_end) && function.equal(c, args);
  });
}

Handle Engine::call_child(const Function& function, std::uint32_t hash, const void* args,
                          void (*construct)(void*, const void*)) {
  if (current_ == nullptr) throw UsageError("call: only a running function can call");
  if (current_->tail != 0) throw UsageError("call: a tail call must be the last thing done");
  need_end(*current_);
  Handle child = find_reusable(function, hash, args, false);
  if (child != 0) {
    discard_between(now_, child);
    now_ = end_of(child);
    ++counts_.reused;
  } else {
    child = new_call(function, hash, args, construct);
    insert_call(child);
    execute(child, current_->limit);
  }
  settle_child(child);
  return child;
}

// Runs what is invalid in a child that was reused, or in what the child reused: whatever precedes
// the running call is settled.
void Engine::settle_child(Handle child) {
  if (mode_ != Mode::propagating || queue_.empty()) return;
  try {
    propagate_within(child);
  } catch (...) {
    now_ = end_of(child);
    throw;
  }
  now_ = end_of(child);
}

void Engine::call_tail(const Function& function, std::uint32_t hash, const void* args,
                       void (*construct)(void*, const void*)) {
  if (current_ == nullptr) throw UsageError("tail: only a running function can call");
  if (current_->tail != 0) throw UsageError("tail: a tail call must be the last thing done");
  need_end(*current_);
  const Handle old = find_reusable(function, hash, args, true);
  current_->tail_reused = old != 0;
  current_->tail = old != 0 ? old : new_call(function, hash, args, construct);
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
    while (a.tail != 0 && !a.tail_reused) {
      const Handle next = std::exchange(a.tail, 0);
      insert_call(next);
      at<Call>(next)->end = a.end;
      run_body(a, next);
    }
    close(a);
  } catch (...) {
    abandon(a);
    throw;
  }
  current_ = a.outer;
}

void Engine::run_body(Activation& a, Handle call) {
  Call& c = *at<Call>(call);
  a.call = &c;
  a.old_edges = std::exchange(c.edges, 0);
  a.last_edge = 0;
  c.clear(Call::kInvalid);
  c.set(Call::kRunning);
  ++counts_.executed;
  Scope scope(*this);
  c.function->execute(scope, c);
  settle(a);
}

// The call has said all it has to say: what it did not repeat is taken back. It has not seen that
// in this execution, so it is not invalidated by it.
void Engine::settle(Activation& a) noexcept {
  retract_all(*a.call, std::exchange(a.old_edges, 0));
  a.call->clear(Call::kRunning | Call::kInvalid);
}

// Ends the interval: a reused tail ends it, what was not reused is discarded.
void Engine::close(Activation& a) {
  if (a.tail != 0) {
    discard_between(now_, a.tail);
    now_ = end_of(a.tail);
    a.tail = 0;
    ++counts_.reused;
  }
  if (a.end == 0 || now_ == a.end) return;  // a reused tail may share the end
  if (a.end_linked) {
    discard_between(now_, a.end);
  } else {
    timeline_.insert_after(now_, a.end);
  }
  now_ = a.end;
}

// Client code threw: the call stays, as one that must run again.
void Engine::abandon(Activation& a) noexcept {
  if (a.tail != 0 && !a.tail_reused) drop_call(std::exchange(a.tail, 0));
  settle(a);
  if (a.end != 0 && !a.end_linked) {
    // Cannot fail in the middle of a group with room; a failure leaves the call a leaf.
    try {
      timeline_.insert_after(now_, a.end);
      now_ = a.end;
    } catch (...) {
      broken_ = true;
    }
  }
  invalidate(*a.call);
  current_ = a.outer;
}

void Engine::discard_between(Handle from, Handle to) noexcept {
  for (Handle h = at<TimeNode>(from)->next; h != to;) {
    const Handle next = at<TimeNode>(h)->next;
    if (at<TimeNode>(h)->marked()) {
      timeline_.erase(h);
      arena_.release(h, sizeof(TimeNode));
    } else {
      discard(h);
    }
    h = next;
  }
}

// A posted call that is still asked for goes back to its agenda: only the drain that ran it left.
void Engine::discard(Handle call) noexcept {
  Call& c = *at<Call>(call);
  const bool asked_for = c.posts() != 0;
  c.set(asked_for ? Call::kPending : Call::kDead);
  if (c.queue != 0) queue_.erase(c);
  retract_all(c, std::exchange(c.edges, 0));
  if (c.function->posted) Agenda::forget(*this, c);
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
  const Handle h = arena_.allocate(bytes);
  Edge& edge = *at<Edge>(h);
  edge.next = 0;
  edge.structure = structure;
  edge.granules = static_cast<std::uint16_t>((bytes + Arena::kGranule - 1) / Arena::kGranule);
  edge.kind = kind;
  Activation& a = *current_;
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
  queue_.check_invariants();
  std::uint64_t calls = 0;
  std::uint64_t edges = 0;
  walk([&](const Call& c, std::size_t) {
    ++calls;
    SAC_INVARIANT(!c.has(Call::kDead | Call::kRunning | Call::kPending));
    SAC_INVARIANT(c.end == 0 || precedes(c, *at<Call>(c.end)));
    SAC_INVARIANT(c.function->hash != nullptr);
    const Handle self = arena_.handle_of(&c);
    SAC_INVARIANT(memo_.find(c.hash, [&](Handle h, const Call&) { return h == self; }) == self);
    for (Handle e = c.edges; e != 0; e = at<Edge>(e)->next) {
      ++edges;
      SAC_INVARIANT(at<Edge>(e)->structure < structures_.size());
    }
    if (queue_.empty()) mods_->check_writes(c);
  });
  if (queue_.empty()) {
    for (const auto& [head, destroy] : outside_mods_) mods_->check_invariants(head);
  }
  for (const auto& agenda : agendas_) calls += agenda->pending_calls();
  SAC_INVARIANT(calls == live_calls_ && edges == live_edges_);
  SAC_INVARIANT(memo_.size() == live_calls_);
  for (const auto& agenda : agendas_) agenda->check_invariants();
}

}  // namespace sac
