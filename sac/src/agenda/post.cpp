// Posting, and taking posts back.
#include "sac/agenda.hpp"

namespace sac {

Agenda::Agenda(Engine& engine, std::string name)
    : engine_(engine),
      core_(engine.core()),
      name_(std::move(name)),
      id_(engine.add_structure(*this)) {}

void Agenda::fail_irreflexive(const Function& function) {
  throw UsageError(
      "an argument of " + std::string(function.name) +
      " does not equal itself (a NaN?): a posted call with it has no place in the order");
}

void Agenda::post_call(Scope& s, const Key& key, const Asked& asked) {
  const Call& poster = s.self();
  const std::uint16_t number = core_.number_of(asked.function);
  const auto repeats = [&](const PostEdge& edge) {
    const Call& c = *core_.at<Call>(edge.target);
    return c.function_number == number && asked.function.equal(c, asked.arguments) &&
           (!core_.undoing() || has_key(c, key));
  };
  // Not found among so many, it is made anew: the old one goes with the others.
  constexpr std::size_t kMost = 64;
  PostEdge* edge = s.recall<PostEdge>(id_, kPost, repeats, kMost);
  const bool known = edge != nullptr && !core_.at<Call>(edge->target)->dead();
  Handle h = known ? edge->target : find_posted(key, asked);
  const bool fresh = h == 0;
  if (fresh) h = create(key, asked);
  Call& posted = *core_.at<Call>(h);
  try {
    require_key(posted, key);
    require_future(poster, posted);
    if (fresh) state_ == State::drained ? place(h) : add_waiting(h);
  } catch (...) {
    if (fresh) drop_waiting(h);
    throw;
  }
  if (known && counts(*edge)) return;
  if (edge == nullptr) {
    try {
      edge = &s.effect<PostEdge>(id_, kPost);
      edge->place = s.place();
    } catch (...) {
      lost_posts(posted);  // a call that waits and that nobody posts leaves at the end
      throw;
    }
  }
  add_post(*edge, h);
}

// The call of this label; in a roll-back only if it has this key: what the failed propagation has
// posted at another one is there until those who posted it are gone.
Handle Agenda::find_posted(const Key& key, const Asked& asked) {
  return core_.find_posted(asked, [&](const Call& c) {
    return c.work_queue == id_ && (!core_.undoing() || has_key(c, key));
  });
}

bool Agenda::has_key(const Call& call, const Key& key) {
  const Slot& slot = Slot::of(call);
  return slot.rank == key.rank() && slot.order == key.order;
}

Handle Agenda::create(const Key& key, const Asked& asked) {
  const std::uint32_t rank = key.rank();
  const Handle h = core_.new_call(asked);
  Slot::of(*core_.at<Call>(h)) = {.order = key.order, .rank = rank};
  core_.at<Call>(h)->work_queue = id_;
  ++waiting_calls_;
  return h;
}

void Agenda::add_waiting(Handle call) {
  const Entry entry = entry_of(*core_.at<Call>(call));
  if (state_ == State::draining && entry.rank == Slot::of(*core_.at<Call>(running_)).rank) {
    return due_.add(entry, order());
  }
  std::vector<Entry>& entries = waiting_[entry.rank];
  entries.push_back(entry);
  core_.at<Call>(call)->place_in_class = static_cast<std::uint32_t>(entries.size() - 1);
}

// --- What is refused -------------------------------------------------------------------------

void Agenda::require_key(const Call& call, const Key& key) const {
  if (has_key(call, key)) return;
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
      return running_ != 0 && before(*core_.at<Call>(running_), posted);
    case State::drained:
      break;
  }
  if (core_.lies_ahead(*core_.at<Call>(drain_call_))) return true;
  return posted.waiting() ? core_.is_ahead(stamp_before(posted)) : core_.lies_ahead(posted);
}

void Agenda::require_future(const Call& poster, const Call& posted) const {
  if (in_future(posted)) return;
  throw UsageError("posting into the past: " + Engine::describe(poster) + " posts " +
                   Engine::describe(posted) + " on agenda '" + name_ + "'");
}

void Agenda::require_unused() const {
  if (waiting_calls_ == 0 && placed_.empty() && drain_call_ == 0) return;
  throw UsageError("release: agenda '" + name_ +
                   "' is in use: calls are posted on it, or one drains it");
}

// --- The outside -----------------------------------------------------------------------------

// Returns the post, which is in no call's list.
Handle Agenda::outside_post(const Key& key, const Asked& asked) {
  Handle h = find_posted(key, asked);
  if (h != 0) require_key(*core_.at<Call>(h), key);
  const Handle post = engine_.arena().allocate(sizeof(PostEdge));
  ::new (core_.at<void>(post)) PostEdge();
  try {
    const bool fresh = h == 0;
    if (fresh) h = create(key, asked);
    try {
      if (fresh) state_ == State::drained ? place(h) : add_waiting(h);
    } catch (...) {
      drop_waiting(h);
      if (engine_.idle()) core_.purge();
      throw;
    }
  } catch (...) {
    engine_.arena().release(post, sizeof(PostEdge));
    throw;
  }
  add_post(post_at(post), h);
  return post;
}

void Agenda::drop_outside(Handle post) noexcept {
  drop_post(post_at(post));
  engine_.arena().release(post, sizeof(PostEdge));
}

// One of the outside's posts of the call.
Handle Agenda::require_posted(const Asked& asked) const {
  const Handle h = core_.find_posted(asked, [&](const Call& c) { return c.work_queue == id_; });
  Handle post = h != 0 ? Slot::of(*core_.at<Call>(h)).posts : 0;
  while (post != 0 && post_at(post).place != 0) post = post_at(post).next_post;
  if (post != 0) return post;
  throw UsageError("retract_from_outside: no call " + std::string(asked.function.name) +
                   " with these arguments is posted on agenda '" + name_ + "'");
}

Key Agenda::key_of(Handle post) const noexcept {
  const Slot& slot = Slot::of(*core_.at<Call>(post_at(post).target));
  return Key::of(slot.rank, slot.order);
}

// --- Taking back -----------------------------------------------------------------------------

// A post counts from now on.
void Agenda::add_post(PostEdge& post, Handle target) noexcept {
  Call& call = *core_.at<Call>(target);
  engine_.note(Event::Kind::posted, &call);
  Handle& first = Slot::of(call).posts;
  const Handle self = engine_.arena().handle_of(&post);
  post.target = target;
  post.previous_post = 0;
  post.next_post = first;
  if (first != 0) post_at(first).previous_post = self;
  first = self;
}

// A post counts no longer, for now or for good. Requires: it counts.
void Agenda::drop_post(PostEdge& post) noexcept {
  Call& call = *core_.at<Call>(post.target);
  if (engine_.observer() != nullptr) [[unlikely]] {
    const Call* poster = post.place != 0 ? &core_.call_at(post.place) : nullptr;
    engine_.observer()->on({.kind = Event::Kind::unposted, .call = &call, .by = poster});
  }
  if (post.next_post != 0) post_at(post.next_post).previous_post = post.previous_post;
  (post.previous_post != 0 ? post_at(post.previous_post).next_post : Slot::of(call).posts) =
      post.next_post;
  post.previous_post = engine_.arena().handle_of(&post);
  if (call.waiting()) {
    lost_posts(call);
  } else if (Slot::of(call).posts == 0 && !call.dead()) {
    core_.enqueue(call);
  }
}

void Agenda::retract(Call& call, Edge& edge) noexcept {
  if (edge.kind == kPost) {
    auto& post = static_cast<PostEdge&>(edge);
    if (counts(post)) drop_post(post);
  } else if (drain_call_ == engine_.handle_of(call)) {  // else another one has taken its place
    state_ = State::open;
    drain_call_ = 0;
  }
}

// Requires: the call is in no list.
void Agenda::drop_waiting(Handle call) noexcept {
  --waiting_calls_;
  engine_.note(Event::Kind::dying, core_.at<Call>(call));
  core_.drop_call(call);
}

// `call`, which waits, has lost a post: perhaps nobody posts it any more.
void Agenda::lost_posts(const Call& call) noexcept {
  try {
    unposted_.push_back(engine_.handle_of(call));
  } catch (const std::bad_alloc&) {
    unposted_unknown_ = true;
  }
}

// Waiting calls that nobody posts leave.
void Agenda::drop_unposted() noexcept {
  bool any_chained = unposted_unknown_;
  if (std::exchange(unposted_unknown_, false)) drop_unposted_of_all();
  for (const Handle h : unposted_) {
    const Call& call = *core_.at<Call>(h);
    if (!call.waiting() || Slot::of(call).posts != 0) continue;
    if (take_from_class(call)) {
      drop_waiting(h);
    } else {
      any_chained = true;
    }
  }
  unposted_.clear();
  if (any_chained) drop_chained_unposted();
  if (state_ != State::open) return;
  try {
    adopt_chained();  // so that each is found at once when nobody posts it any more
  } catch (...) {     // they stay chained
  }
}

// Takes a call that waits out of its class. Returns false if it is chained instead.
bool Agenda::take_from_class(const Call& call) noexcept {
  const auto found = waiting_.find(Slot::of(call).rank);
  if (found == waiting_.end()) return false;
  std::vector<Entry>& entries = found->second;
  const std::uint32_t i = call.place_in_class;
  if (i >= entries.size() || entries[i].call != engine_.handle_of(call)) return false;
  entries[i] = entries.back();
  core_.at<Call>(entries[i].call)->place_in_class = i;
  entries.pop_back();
  if (entries.empty()) waiting_.erase(found);
  return true;
}

void Agenda::drop_unposted_of_all() noexcept {
  for (auto next = waiting_.begin(); next != waiting_.end();) {
    const auto& entries = (next++)->second;
    for (std::size_t i = entries.size(); i > 0; --i) {
      const Handle h = entries[i - 1].call;
      if (Slot::of(*core_.at<Call>(h)).posts != 0) continue;
      const bool is_last = entries.size() == 1;
      take_from_class(*core_.at<Call>(h));
      drop_waiting(h);
      if (is_last) break;  // the class is gone
    }
  }
}

void Agenda::drop_chained_unposted() noexcept {
  for (Handle* link = &chained_; *link != 0;) {
    const Handle h = *link;
    Call& c = *core_.at<Call>(h);
    if (Slot::of(c).posts != 0) {
      link = &c.next_waiting;
      continue;
    }
    *link = std::exchange(c.next_waiting, 0);
    drop_waiting(h);
  }
}

}  // namespace sac
