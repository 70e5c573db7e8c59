// The rare paths of the order-maintenance list: running out of labels.
#include "sac/timeline.hpp"

#include "sac/check.hpp"

namespace sac {

Timeline::Timeline(Arena& arena) : arena_(arena) {
  front_ = back_ = arena_.allocate(sizeof(TimeNode));
  *at(front_) = TimeNode{};
  groups_.push_back(Group{.label = std::uint64_t{1} << 62, .first = front_, .count = 1});
  size_ = 1;
}

void Timeline::erase(Handle node) noexcept {
  TimeNode& n = *at(node);
  const std::uint32_t group = n.group();
  at(n.prev)->next = n.next;
  (n.next != 0 ? at(n.next)->prev : back_) = n.prev;
  --size_;
  if (--groups_[group].count == 0) return drop_group(group);
  if (groups_[group].first == node) groups_[group].first = n.next;
}

void Timeline::erase_between(Handle from, Handle to) noexcept {
  for (Handle node = at(from)->next; node != to;) {
    const Handle next = at(node)->next;
    erase(node);
    node = next;
  }
}

// A full group at its end goes on in a new group; a small one is spread evenly; a large one is cut.
void Timeline::insert_crowded(Handle place, Handle node) {
  TimeNode& before = *at(place);
  const std::uint32_t group = before.group();
  const bool last = before.next == 0 || at(before.next)->group() != group;
  if (last && groups_[group].count >= kCut) return insert_in_new_group(place, node);
  if (groups_[group].count <= 2 * kCut) {
    spread(group);
  } else {
    cut(group);
  }
  insert_after(place, node);
}

void Timeline::insert_in_new_group(Handle place, Handle node) {
  TimeNode& before = *at(place);
  const std::uint32_t group = new_group_after(before.group());
  groups_[group].first = node;
  link(before, place, node, group, kAppendStep);
}

// Even labels over the whole range: gaps of at least 2^25 for at most 128 nodes.
void Timeline::spread(std::uint32_t group) noexcept {
  const std::uint32_t gap = kLastLabel / (groups_[group].count + 1);
  std::uint32_t label = 0;
  Handle node = groups_[group].first;
  for (std::uint32_t i = 0; i < groups_[group].count; ++i, node = at(node)->next) {
    at(node)->label = label += gap;
  }
}

// Cuts a group into groups of kCut nodes, from the back, so that a failure to allocate leaves a
// correct list.
void Timeline::cut(std::uint32_t group) {
  std::uint32_t rest = groups_[group].count;
  Handle node = groups_[group].first;
  for (std::uint32_t i = 1; i < rest; ++i) node = at(node)->next;
  while (rest > kCut) {
    const std::uint32_t piece = new_group_after(group);
    const std::uint32_t size = rest > 2 * kCut ? kCut : rest - kCut;
    for (std::uint32_t i = 0; i < size; ++i, node = at(node)->prev) {
      set_group(*at(node), piece);
      groups_[piece].first = node;
    }
    groups_[piece].count = size;
    groups_[group].count = rest -= size;
    spread(piece);
  }
  spread(group);
}

std::uint32_t Timeline::new_group_after(std::uint32_t group) {
  std::uint32_t fresh;
  if (free_groups_.empty()) {
    fresh = static_cast<std::uint32_t>(groups_.size());
    if (fresh == kNone) throw std::bad_alloc();
    groups_.emplace_back();
    free_groups_.reserve(groups_.capacity());  // so that drop_group cannot fail
  } else {
    fresh = free_groups_.back();
    free_groups_.pop_back();
  }
  make_group_room(group);
  const std::uint32_t next = groups_[group].next;
  const std::uint64_t low = groups_[group].label;
  const std::uint64_t label =
      next == kNone ? low + kGroupStep : low + (groups_[next].label - low) / 2;
  groups_[fresh] = Group{.label = label, .prev = group, .next = next};
  if (next != kNone) groups_[next].prev = fresh;
  groups_[group].next = fresh;
  return fresh;
}

void Timeline::drop_group(std::uint32_t group) noexcept {
  const Group& g = groups_[group];
  if (g.prev != kNone) groups_[g.prev].next = g.next;
  if (g.next != kNone) groups_[g.next].prev = g.prev;
  free_groups_.push_back(group);
}

// Opens a gap behind `group`: relabels the smallest enclosing range of 2^i labels that holds at
// most (4/3)^i groups [Bender et al. 2002], so that the work is amortised O(log) per new group and
// O(1) per node.
void Timeline::make_group_room(std::uint32_t group) noexcept {
  const std::uint64_t label = groups_[group].label;
  const std::uint32_t next = groups_[group].next;
  constexpr std::uint64_t kTop = ~std::uint64_t{0} - 2 * kGroupStep;
  if (next == kNone ? label < kTop : groups_[next].label - label >= 2) return;
  std::uint32_t first = group;
  std::uint32_t last = group;
  std::uint64_t count = 1;
  double limit = 1;
  for (int bits = 1; bits < 64; ++bits) {
    limit *= 4.0 / 3.0;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    const std::uint64_t low = label & ~mask;
    const std::uint64_t high = label | mask;
    for (; groups_[first].prev != kNone && groups_[groups_[first].prev].label >= low; ++count) {
      first = groups_[first].prev;
    }
    for (; groups_[last].next != kNone && groups_[groups_[last].next].label <= high; ++count) {
      last = groups_[last].next;
    }
    const std::uint64_t gap = mask / (count + 1);
    if (gap < 4 || (static_cast<double>(count) > limit && bits < 63)) continue;
    std::uint64_t fresh = low;
    for (std::uint32_t g = first;; g = groups_[g].next) {
      groups_[g].label = fresh += gap;
      if (g == last) return;
    }
  }
}

void Timeline::check_invariants() const {
  std::size_t count = 0;
  Handle previous = 0;
  std::uint32_t group = at(front_)->group();
  std::uint32_t in_group = 0;
  for (Handle node = front_; node != 0; node = at(node)->next) {
    const TimeNode& n = *at(node);
    SAC_INVARIANT(n.prev == previous);
    SAC_INVARIANT(previous == 0 || precedes(*at(previous), n));
    if (n.group() != group) {
      SAC_INVARIANT(groups_[group].count == in_group);
      SAC_INVARIANT(groups_[group].next == n.group() && groups_[n.group()].prev == group);
      SAC_INVARIANT(groups_[n.group()].first == node);
      group = n.group();
      in_group = 0;
    }
    ++in_group;
    ++count;
    previous = node;
  }
  SAC_INVARIANT(groups_[group].count == in_group);
  SAC_INVARIANT(previous == back_ && count == size_);
}

}  // namespace sac
