// The rare paths of the order-maintenance list: running out of labels, and groups that go.
//
// Why (2) holds. Relabelling leaves gaps of 2^21 or more, so a gap is full again after 21
// insertions by halves at the least. A group of at most kSmall nodes is then spread: kSmall writes.
// A larger one loses its smaller side to a new group, which moves a node at most log2(kFar) times
// before it sits in a small group; so that this is a constant, a group that has grown beyond kFar
// on both sides is chopped into pieces of kPiece, one write for each of the insertions that made it
// so large. A new group costs O(log) relabelled groups [Bender et al. 2002].
#include "sac/internal/timeline.hpp"

#include <algorithm>
#include <new>

#include "sac/check.hpp"

namespace sac {

namespace {

constexpr std::uint32_t kSmall = 64;
constexpr std::uint32_t kFar = 512;
constexpr std::uint32_t kPiece = 128;
// A node of a group in the making: 1000 of them leave the last one room for appending.
constexpr std::uint32_t kFull = 1000;
constexpr std::uint64_t kGroupStep = std::uint64_t{1} << 36;
constexpr std::uint64_t kMiddle = std::uint64_t{1} << 62;

}  // namespace

Timeline::Timeline(Arena& arena) : arena_(arena) {
  groups_.push_back(Group{.label = kMiddle});
  front_ = back_ = arena_.make<TimeNode>();
  size_ = 1;
}

void Timeline::insert_between(Place place, Place node) {
  TimeNode& before = at(place);
  const Place next = before.next;
  const std::uint32_t group = before.group();
  if (next != nullptr && at(next).group() == group) {
    const std::uint32_t gap = at(next).label - before.label;
    if (gap >= 2) return link(before, place, node, group, before.label + part(gap, place, next));
  } else if (const std::uint32_t room = kLastLabel - before.label; room > 2 * kAppendStep) {
    const bool run = next == nullptr || place == latest_;
    const std::uint32_t step = run ? kAppendStep : room / 2;
    return link(before, place, node, group, before.label + step);
  }
  make_room_after(place);
  insert_after(place, node);
}

void Timeline::erase(Place node) noexcept {
  const TimeNode n = at(node);
  const std::uint32_t group = n.group();
  at(node).prev = at(node).next = nullptr;
  at(n.prev).next = n.next;
  (n.next != nullptr ? at(n.next).prev : back_) = n.prev;
  --size_;
  if (in_group(n.prev, group) || in_group(n.next, group)) return;
  join_groups(groups_[group].prev, groups_[group].next);
  free_group(group);
}

// Nodes of one group on both sides of a gap, walked from there in step.
struct Timeline::Surroundings {
  Place first;
  Place last;
  std::uint32_t left = 1;   // nodes from first to the one before the gap
  std::uint32_t right = 0;  // nodes from the one behind the gap to last
  bool left_ends = false;   // the group has no more on this side
  bool right_ends = false;
};

// As far as one has to walk to know all of a small group, or the smaller side of a large one.
Timeline::Surroundings Timeline::look_around(Place place) const noexcept {
  Surroundings s{.first = place, .last = place};
  const std::uint32_t group = at(place).group();
  const auto done = [&] {
    if (s.left + s.right <= kSmall) return s.left_ends && s.right_ends;
    return s.left_ends || s.right_ends || s.left >= kFar;
  };
  do {
    if (const Place next = at(s.last).next; in_group(next, group)) {
      s.last = next;
      ++s.right;
    } else {
      s.right_ends = true;
    }
    if (const Place prev = at(s.first).prev; in_group(prev, group)) {
      s.first = prev;
      ++s.left;
    } else {
      s.left_ends = true;
    }
  } while (!done());
  return s;
}

// A small group is stamped anew, with most labels behind `place`. Of a larger one the smaller side
// moves out, so that `place` is the last of its group; if that leaves it no room either, it moves
// out alone the next time round. Where many nodes go to one place, it moves out with them at once,
// to be alone on the smaller side from then on.
void Timeline::make_room_after(Place place) {
  const Surroundings s = look_around(place);
  const std::uint32_t group = at(place).group();
  if (s.left_ends && s.right_ends) return spread(s.first, group, s.left, s.right);
  if (s.left_ends) return spread(s.first, new_group(groups_[group].prev, group), s.left, 0);
  if (!s.right_ends) return chop(s.last);
  const std::uint32_t behind = new_group(group, groups_[group].next);
  const Place next = at(place).next;
  if (s.right == 0 || next == latest_) return spread(place, behind, 1, s.right);
  spread(next, behind, s.right, 0);
}

// Stamps `left` nodes for the low end of a group, and the `right` nodes that follow for its high
// end. Each side takes a quarter of the labels at most.
void Timeline::spread(Place first, std::uint32_t group, std::uint32_t left,
                      std::uint32_t right) noexcept {
  constexpr std::uint32_t kQuarter = std::uint32_t{1} << 30;
  const std::uint32_t left_gap = std::min(kAppendStep, kQuarter / left);
  const std::uint32_t right_gap = std::min(kAppendStep, kQuarter / std::max(right, 1u));
  Place node = first;
  for (std::uint32_t i = 1; i <= left; ++i, node = at(node).next) {
    stamp(at(node), group, i * left_gap);
  }
  for (std::uint32_t i = right; i > 0; --i, node = at(node).next) {
    stamp(at(node), group, kLastLabel - i * right_gap);
  }
}

// Cuts the group of `node` into pieces, from the back, so that a failure to allocate leaves a
// correct list.
void Timeline::chop(Place node) {
  constexpr std::uint32_t kGap = kLastLabel / (kPiece + 1);
  const std::uint32_t group = at(node).group();
  while (in_group(at(node).next, group)) node = at(node).next;
  while (in_group(node, group)) {
    const std::uint32_t piece = new_group(group, groups_[group].next);
    for (std::uint32_t i = kPiece; i > 0 && in_group(node, group); --i, node = at(node).prev) {
      stamp(at(node), piece, i * kGap);
    }
  }
  join_groups(groups_[group].prev, groups_[group].next);
  free_group(group);
}

std::uint32_t Timeline::new_group(std::uint32_t prev, std::uint32_t next) {
  std::uint32_t fresh = free_groups_;
  if (fresh != kNone) {
    free_groups_ = groups_[fresh].next;
  } else {
    fresh = static_cast<std::uint32_t>(groups_.size());
    if (fresh == kNone) throw std::bad_alloc();
    groups_.emplace_back();
  }
  if (room_between(prev, next) < 2) relabel_groups_around(prev != kNone ? prev : next);
  const std::uint64_t half = room_between(prev, next) / 2;
  const std::uint64_t step = std::min(kGroupStep, half);
  groups_[fresh].label = prev == kNone   ? groups_[next].label - step
                         : next == kNone ? groups_[prev].label + step
                                         : groups_[prev].label + half;
  join_groups(prev, fresh);
  join_groups(fresh, next);
  return fresh;
}

void Timeline::free_group(std::uint32_t group) noexcept {
  groups_[group].next = free_groups_;
  free_groups_ = group;
}

void Timeline::join_groups(std::uint32_t prev, std::uint32_t next) noexcept {
  if (prev != kNone) groups_[prev].next = next;
  if (next != kNone) groups_[next].prev = prev;
}

std::uint64_t Timeline::room_between(std::uint32_t prev, std::uint32_t next) const noexcept {
  const std::uint64_t low = prev == kNone ? 0 : groups_[prev].label;
  const std::uint64_t high = next == kNone ? ~std::uint64_t{0} : groups_[next].label;
  return high - low;
}

// Opens gaps on both sides of `group`: relabels the smallest enclosing range of 2^i labels that
// holds at most (4/3)^i groups [Bender et al. 2002].
void Timeline::relabel_groups_around(std::uint32_t group) noexcept {
  const std::uint64_t label = groups_[group].label;
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

void Timeline::shrink() {
  const std::size_t count = (size_ + kFull - 1) / kFull;
  std::vector<Group> fresh(count);
  for (std::uint32_t g = 0; g < count; ++g) {
    fresh[g].label = kMiddle + g * kGroupStep;
    if (g > 0) fresh[g].prev = g - 1;
    if (g + 1 < count) fresh[g].next = g + 1;
  }
  groups_.swap(fresh);
  free_groups_ = kNone;
  std::size_t i = 0;
  for (Place node = front_; node != nullptr; node = at(node).next, ++i) {
    stamp(at(node), static_cast<std::uint32_t>(i / kFull),
          static_cast<std::uint32_t>(i % kFull + 1) * kAppendStep);
  }
}

void Timeline::check_invariants() const {
  std::size_t count = 0;
  std::size_t groups = 1;
  Place previous;
  std::uint32_t group = at(front_).group();
  SAC_INVARIANT(groups_[group].prev == kNone);
  for (Place node = front_; node != nullptr; node = at(node).next) {
    const TimeNode& n = at(node);
    SAC_INVARIANT(n.prev == previous);
    SAC_INVARIANT(previous == nullptr || precedes(at(previous), n));
    if (n.group() != group) {
      SAC_INVARIANT(groups_[group].next == n.group() && groups_[n.group()].prev == group);
      group = n.group();
      ++groups;
    }
    ++count;
    previous = node;
  }
  SAC_INVARIANT(groups_[group].next == kNone);
  SAC_INVARIANT(previous == back_ && count == size_);
  for (std::uint32_t g = free_groups_; g != kNone; g = groups_[g].next) {
    SAC_INVARIANT(++groups <= groups_.size());
  }
  SAC_INVARIANT(groups == groups_.size());
}

}  // namespace sac
