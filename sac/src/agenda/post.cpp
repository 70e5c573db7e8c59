// Posting, and taking posts back.
#include "sac/agenda.hpp"

namespace sac {

namespace {

using Unposted = detail::Chain<TimeNode, &TimeNode::prev, &TimeNode::next>;

// Of a call that waits in a class. It has no time stamp, and thus no use for the stamp's label.
std::uint32_t& place_in_class(Call& call) noexcept { return call.label; }

}  // namespace

Agenda::Agenda(Engine& engine, std::string name, const KeyWidths& widths)
    : engine_(engine), core_(engine.core()), name_(std::move(name)), widths_(widths) {
  widths.require_possible(name_);
  id_ = engine.add_structure(*this);
}

void Agenda::fail_irreflexive(const std::string& call) {
  throw UsageError("an argument of " + call +
                   " does not equal itself (a NaN?): a posted call with it has no place in the "
                   "order");
}

void Agenda::post_call(Scope& s, const Entry& turn, const Asked& asked) {
  const Call& poster = s.self();
  const auto repeats = [&](const PostEdge& edge) {
    const Call& c = core_.at(edge.target);
    return &c.function() == &asked.function && asked.function.equal(c, asked.arguments) &&
           (!core_.undoing() || has_turn(c, turn));
  };
  // Not found among so many, it is made anew: the old one goes with the others.
  PostEdge* edge = s.recall<PostEdge>(id_, kPost, repeats, Scope::kMostRecalled);
  const bool known = edge != nullptr && !core_.at(edge->target).dead();
  const Ref<Call> call = posted_call(known ? edge->target : find_posted(turn, asked), turn, asked,
                                     [&](const Call& posted) { require_future(poster, posted); });
  if (known && counts(*edge)) return;
  if (edge == nullptr) {
    edge = &s.effect<PostEdge>(id_, kPost);
    edge->place = s.place();
  }
  add_post(*edge, call);
}

// The call that is posted: `known`, or, if that is null, a new one. It may be refused by `check`.
template <class Check>
Ref<Call> Agenda::posted_call(Ref<Call> known, const Entry& turn, const Asked& asked,
                              Check&& check) {
  const bool is_new = known == nullptr;
  const Ref<Call> call = is_new ? create(turn, asked) : known;
  try {
    if (!is_new) require_turn(core_.at(call), turn);
    check(core_.at(call));
    if (is_new) state_ == State::drained ? place(call) : add_waiting(call);
  } catch (...) {
    if (is_new) drop_waiting(call);
    throw;
  }
  return call;
}

// The call of this label; in a roll-back only if it has this turn: what the failed propagation has
// posted at another one is there until those who posted it are gone.
Ref<Call> Agenda::find_posted(const Entry& turn, const Asked& asked) {
  return core_.find_posted(asked, [&](const Call& c) {
    return c.work_queue == id_ && (!core_.undoing() || has_turn(c, turn));
  });
}

bool Agenda::has_turn(const Call& call, const Entry& turn) noexcept {
  const Slot& slot = Slot::of(call);
  return slot.rank == turn.rank && slot.order == turn.order;
}

Ref<Call> Agenda::create(const Entry& turn, const Asked& asked) {
  const Ref<Call> fresh = core_.new_call(asked);
  Call& call = core_.at(fresh);
  Slot::of(call) = {.order = turn.order, .rank = turn.rank};
  call.work_queue = id_;
  ++waiting_calls_;
  chain_unposted(call);
  return fresh;
}

void Agenda::add_waiting(Ref<Call> call) {
  Call& c = core_.at(call);
  const Entry entry = entry_of(c);
  if (state_ == State::draining && entry.rank == Slot::of(core_.at(running_)).rank) {
    return put(entry);
  }
  std::vector<Entry>& entries = classes_[entry.rank];
  entries.push_back(entry);
  place_in_class(c) = static_cast<std::uint32_t>(entries.size() - 1);
}

// --- What is refused -------------------------------------------------------------------------

void Agenda::require_turn(const Call& call, const Entry& turn) const {
  if (has_turn(call, turn)) return;
  throw UsageError("agenda '" + name_ + "': " + Engine::describe(call) +
                   " is posted at two keys: a key must be a function of the call's function and "
                   "arguments");
}

// Whether the turn of `posted` is still to come.
bool Agenda::in_future(const Call& posted) const {
  switch (state_) {
    case State::open:
      return true;
    case State::draining:
      return running_ != nullptr && before(core_.at(running_), posted);
    case State::drained:
      break;
  }
  if (core_.lies_ahead(core_.at(drain_call_))) return true;
  return posted.waiting() ? core_.is_ahead(stamp_before(posted)) : core_.lies_ahead(posted);
}

void Agenda::require_future(const Call& poster, const Call& posted) const {
  if (in_future(posted)) return;
  throw UsageError("posting into the past: " + Engine::describe(poster) + " posts " +
                   Engine::describe(posted) + " on agenda '" + name_ + "'");
}

void Agenda::require_unused() const {
  if (waiting_calls_ == 0 && calls_.empty() && drain_call_ == nullptr) return;
  throw UsageError("release: agenda '" + name_ +
                   "' is in use: calls are posted on it, or one drains it");
}

// --- The outside -----------------------------------------------------------------------------

// Returns the post, which is in no call's list.
Ref<PostEdge> Agenda::outside_post(const Entry& turn, const Asked& asked) {
  const Ref<PostEdge> post = engine_.arena().make<PostEdge>();
  try {
    const Ref<Call> known = find_posted(turn, asked);
    add_post(core_.at(post), posted_call(known, turn, asked, [](const Call&) {}));
  } catch (...) {
    if (engine_.idle()) core_.purge();
    engine_.arena().release(post);
    throw;
  }
  return post;
}

void Agenda::drop_outside(Ref<PostEdge> post) noexcept {
  drop_post(core_.at(post));
  engine_.arena().release(post);
}

// One of the outside's posts of the call.
Ref<PostEdge> Agenda::require_posted(const Asked& asked) const {
  const Ref<Call> call =
      core_.find_posted(asked, [&](const Call& c) { return c.work_queue == id_; });
  Ref<PostEdge> post = call != nullptr ? Slot::of(core_.at(call)).posts : nullptr;
  while (post != nullptr && core_.at(post).place != nullptr) post = core_.at(post).next_post;
  if (post != nullptr) return post;
  throw UsageError("retract_from_outside: no call " + std::string(asked.function.name) +
                   " with these arguments is posted on agenda '" + name_ + "'");
}

// --- Taking back -----------------------------------------------------------------------------

// A post counts from now on.
void Agenda::add_post(PostEdge& post, Ref<Call> target) noexcept {
  Call& call = core_.at(target);
  engine_.note(Event::Kind::posted, &call);
  post.target = target;
  if (Slot::of(call).posts == nullptr && call.waiting()) unchain(call);
  Posts::push(core_.arena(), Slot::of(call).posts, post);
}

// A post counts no longer, for now or for good. Requires: it counts.
void Agenda::drop_post(PostEdge& post) noexcept {
  Call& call = core_.at(post.target);
  if (engine_.observer() != nullptr) [[unlikely]] {
    const Call* poster = post.place != nullptr ? &core_.call_at(post.place) : nullptr;
    engine_.observer()->on({.kind = Event::Kind::unposted, .call = &call, .by = poster});
  }
  Posts::remove(core_.arena(), Slot::of(call).posts, post);
  post.previous_post = Arena::ref(post);
  if (Slot::of(call).posts != nullptr || call.dead()) return;
  call.waiting() ? chain_unposted(call) : core_.enqueue(call);
}

void Agenda::retract(Call& call, Edge& edge) noexcept {
  if (edge.kind == kPost) {
    auto& post = static_cast<PostEdge&>(edge);
    if (counts(post)) drop_post(post);
  } else if (drain_call_ == engine_.handle_of(call)) {  // else another one has taken its place
    state_ = State::open;
    drain_call_ = nullptr;
  }
}

// A call that waits and that nobody posts may be posted again; else it leaves when the propagation
// ends, or when its turn comes. It has no time stamp: the links of that chain it.
void Agenda::chain_unposted(Call& call) noexcept { Unposted::push(core_.arena(), unposted_, call); }

void Agenda::unchain(Call& call) noexcept {
  Unposted::remove(core_.arena(), unposted_, call);
  call.prev = call.next = nullptr;
}

// Requires: nobody posts the call, and it is neither in calls_ nor in a class.
void Agenda::drop_waiting(Ref<Call> call) noexcept {
  Call& c = core_.at(call);
  unchain(c);
  --waiting_calls_;
  engine_.note(Event::Kind::dying, &c);
  core_.drop_call(call);
}

void Agenda::drop_unposted() noexcept {
  while (unposted_ != nullptr) {
    const Ref<Call> last = core_.as<Call>(unposted_);
    Call& call = core_.at(last);
    if (!take_from_class(call)) take_from_index(call);
    drop_waiting(last);
  }
}

// Takes a call that waits out of its class. Returns false if it is in calls_ instead.
bool Agenda::take_from_class(Call& call) noexcept {
  const auto found = classes_.find(Slot::of(call).rank);
  if (found == classes_.end()) return false;
  std::vector<Entry>& entries = found->second;
  const std::uint32_t i = place_in_class(call);
  if (i >= entries.size() || entries[i].call != engine_.handle_of(call)) return false;
  entries[i] = entries.back();
  place_in_class(core_.at(entries[i].call)) = i;
  entries.pop_back();
  if (entries.empty()) classes_.erase(found);
  return true;
}

}  // namespace sac
