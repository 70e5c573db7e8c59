// Order-maintenance list: compares positions in the trace in constant time.
//
// A node is four 32-bit words at the head of the object it stamps. Nodes sit in groups; a node's
// label orders it within its group, a group's 64-bit label orders the groups [Dietz, Sleator 1987;
// Bender et al. 2002]. A group is as large as its labels allow, it is never split for its size
// alone, and an insertion does not touch its record: neither size nor ends are kept there. Where
// labels have run out, the group is walked from that place and its smaller side moves out.
//
// An insertion costs its cache misses: the place, its successor (whose `prev` changes), the new
// node. Labels are chosen so that little else is left to do: a new node takes the middle of its
// gap; in a run (each node after the last one), and at one place over and over, a small part of it.
//
// Guarantees:
// (1) precedes(a, b) is O(1): one comparison within a group, two loads more across groups.
// (2) insert_after and erase are amortised O(1).
// (3) Relabelling never changes the order of live nodes.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sac/arena.hpp"

namespace sac {

struct TimeNode;

/// A place in the trace: a time stamp, by its handle. It is that of a call, of the end of one, or
/// of a segment (trace.hpp).
using Place = Ref<TimeNode>;

/// The stamp itself, to be put at offset 0 of an arena object.
struct TimeNode {
  Place prev;
  Place next;
  std::uint32_t group_and_kind = 0;
  std::uint32_t label = 0;

  /// What carries the stamp; survives relabelling.
  enum class Kind : std::uint32_t { call = 0, end = 1u << 30, segment = 2u << 30 };
  static constexpr std::uint32_t kKinds = 3u << 30;

  [[nodiscard]] std::uint32_t group() const noexcept { return group_and_kind & ~kKinds; }
  [[nodiscard]] Kind kind() const noexcept { return static_cast<Kind>(group_and_kind & kKinds); }
  [[nodiscard]] bool is_call() const noexcept { return kind() == Kind::call; }
  void set_kind(Kind kind) noexcept {
    group_and_kind = (group_and_kind & ~kKinds) | static_cast<std::uint32_t>(kind);
  }
};

class Timeline {
 public:
  /// Nodes live in `arena`, which must outlive the list.
  explicit Timeline(Arena& arena);

  /// The first node; always there, never erased.
  [[nodiscard]] Place front() const noexcept { return front_; }
  [[nodiscard]] Place back() const noexcept { return back_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Memory for the groups; the nodes are the arena's.
  [[nodiscard]] std::size_t bytes() const noexcept { return groups_.capacity() * sizeof(Group); }

  /// Puts `node` right after `place`. Throws: std::bad_alloc, and then changes nothing.
  /// Cost: amortised O(1).
  void insert_after(Place place, Place node) {
    TimeNode& before = at(place);
    if (before.next == nullptr && kLastLabel - before.label > 2 * kAppendStep) {
      append(before, place, node);
    } else {
      insert_between(place, node);
    }
  }

  /// Takes `node` out, and clears its links. Requires: node != front(). Cost: O(1).
  void erase(Place node) noexcept;

  [[nodiscard]] bool precedes(const TimeNode& a, const TimeNode& b) const noexcept {
    const std::uint32_t ga = a.group();
    const std::uint32_t gb = b.group();
    if (ga == gb) return a.label < b.label;
    return groups_[ga].label < groups_[gb].label;
  }

  /// Where a node is, as numbers, for sorting: good until nodes are inserted.
  struct Position {
    std::uint64_t group = 0;
    std::uint32_t label = 0;
    friend auto operator<=>(const Position&, const Position&) = default;
  };
  [[nodiscard]] Position position(const TimeNode& n) const noexcept {
    return {groups_[n.group()].label, n.label};
  }

  /// Numbers and labels everything anew, in full groups, and gives back the memory of those that
  /// are no more. Throws: std::bad_alloc, and then changes nothing. Cost: O(size()).
  void shrink();

  void check_invariants() const;

 private:
  struct Group {
    std::uint64_t label = 0;
    std::uint32_t prev = kNone;
    std::uint32_t next = kNone;  // of a free group: the next free one
  };
  static constexpr std::uint32_t kNone = 0x3fffffffu;
  static constexpr std::uint32_t kLastLabel = 0xffffffffu;
  // Appending leaves gaps of 2^22: a group takes 1021 appended nodes, and each gap then 22
  // insertions by halves before anything is relabelled.
  static constexpr std::uint32_t kAppendStep = std::uint32_t{1} << 22;
  // A run takes 1/64 of the gap each time, so that a gap of 2^22 holds 500 of its nodes with a gap
  // of at least 2^4 for each. An insertion right before the latest one takes 1/16: it may be the
  // second of many at one place, or the first of a run up to a node that was put there before.
  // In gaps below 2^10 such parts would leave nothing: halves.
  static constexpr int kRunPart = 6;
  static constexpr int kHotPart = 4;
  static constexpr std::uint32_t kNarrow = std::uint32_t{1} << 10;

  [[nodiscard]] TimeNode& at(Place place) const noexcept { return arena_[place]; }

  /// Where in the gap between `place` and `next`, 0 < part < gap. Requires: gap >= 2.
  [[nodiscard]] std::uint32_t part(std::uint32_t gap, Place place, Place next) const noexcept {
    if (gap < kNarrow) return gap / 2;
    if (place == latest_) return gap >> kRunPart;
    return next == latest_ ? gap - (gap >> kHotPart) : gap / 2;
  }

  void link(TimeNode& before, Place place, Place node, std::uint32_t group,
            std::uint32_t label) noexcept {
    TimeNode& n = at(node);
    const Place next = before.next;
    n.prev = place;
    n.next = next;
    stamp(n, group, label);
    (next != nullptr ? at(next).prev : back_) = node;
    before.next = node;
    latest_ = node;
    ++size_;
  }
  void append(TimeNode& last, Place place, Place node) noexcept {
    TimeNode& n = at(node);
    n.prev = place;
    n.next = nullptr;
    stamp(n, last.group(), last.label + kAppendStep);
    last.next = back_ = latest_ = node;
    ++size_;
  }
  static void stamp(TimeNode& n, std::uint32_t group, std::uint32_t label) noexcept {
    n.group_and_kind = (n.group_and_kind & TimeNode::kKinds) | group;
    n.label = label;
  }

  void insert_between(Place place, Place node);
  struct Surroundings;
  [[nodiscard]] Surroundings look_around(Place place) const noexcept;
  [[nodiscard]] bool in_group(Place node, std::uint32_t group) const noexcept {
    return node != nullptr && at(node).group() == group;
  }
  void make_room_after(Place place);
  void spread(Place first, std::uint32_t group, std::uint32_t left, std::uint32_t right) noexcept;
  void chop(Place place);
  [[nodiscard]] std::uint32_t new_group(std::uint32_t prev, std::uint32_t next);
  void free_group(std::uint32_t group) noexcept;
  void join_groups(std::uint32_t prev, std::uint32_t next) noexcept;
  [[nodiscard]] std::uint64_t room_between(std::uint32_t prev, std::uint32_t next) const noexcept;
  void relabel_groups_around(std::uint32_t group) noexcept;

  Arena& arena_;
  std::vector<Group> groups_;
  std::uint32_t free_groups_ = kNone;
  Place front_;
  Place back_;
  Place latest_;  // the last node that was inserted: a hint, it may be gone
  std::size_t size_ = 0;
};

}  // namespace sac
