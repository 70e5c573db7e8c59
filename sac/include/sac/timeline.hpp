// Order-maintenance list: who comes first in the trace, in constant time.
//
// A node is four 32-bit words at the head of the object it stamps. Nodes sit in groups; a node's
// label orders it within its group, a group's 64-bit label orders the groups [Dietz, Sleator 1987;
// Bender et al. 2002]. A group is split only when the labels around an insertion run out, never
// for its size alone.
//
// Guarantees:
// (1) precedes(a, b) is O(1): one comparison within a group, two loads more across groups.
// (2) insert_after and erase are amortised O(1).
// (3) Relabelling never changes the order of live nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sac/arena.hpp"

namespace sac {

/// The stamp itself, to be put at offset 0 of an arena object.
struct TimeNode {
  Handle prev = 0;
  Handle next = 0;
  std::uint32_t group_and_mark = 0;  // bit 31: the client's mark
  std::uint32_t label = 0;

  [[nodiscard]] std::uint32_t group() const noexcept { return group_and_mark & 0x7fffffffu; }
  /// One bit for the client; survives relabelling.
  [[nodiscard]] bool marked() const noexcept { return (group_and_mark >> 31) != 0; }
  void mark() noexcept { group_and_mark |= 0x80000000u; }
};

class Timeline {
 public:
  /// Nodes live in `arena`, which must outlive the list.
  explicit Timeline(Arena& arena);

  /// The first node; always there, never erased.
  [[nodiscard]] Handle front() const noexcept { return front_; }
  [[nodiscard]] Handle back() const noexcept { return back_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return groups_.capacity() * sizeof(Group) + free_groups_.capacity() * sizeof(std::uint32_t);
  }

  /// Puts `node` right after `place`. Throws: std::bad_alloc, and then changes nothing.
  void insert_after(Handle place, Handle node) {
    TimeNode& before = *at(place);
    const std::uint32_t group = before.group();
    if (before.next != 0 && at(before.next)->group() == group) {
      const std::uint32_t gap = at(before.next)->label - before.label;
      if (gap >= 2) return link(before, place, node, group, before.label + gap / 2);
    } else if (before.label < kLastLabel - kAppendStep) {
      return link(before, place, node, group, before.label + kAppendStep);
    }
    insert_crowded(place, node);
  }

  /// Takes `node` out. Requires: node != front().
  void erase(Handle node) noexcept;

  /// Takes out all nodes strictly between `from` and `to`; to == 0 is the end of the list.
  void erase_between(Handle from, Handle to) noexcept;

  [[nodiscard]] bool precedes(const TimeNode& a, const TimeNode& b) const noexcept {
    const std::uint32_t ga = a.group();
    const std::uint32_t gb = b.group();
    if (ga == gb) return a.label < b.label;
    return groups_[ga].label < groups_[gb].label;
  }

  void check_invariants() const;

 private:
  struct Group {
    std::uint64_t label = 0;
    std::uint32_t prev = kNone;
    std::uint32_t next = kNone;
    Handle first = 0;
    std::uint32_t count = 0;
  };
  static constexpr std::uint32_t kNone = 0x7fffffffu;
  static constexpr std::uint32_t kLastLabel = 0xffffffffu;
  // Appending leaves gaps of 2^22: a group takes 1023 appended nodes, and each gap then 22
  // insertions at one place before anything is relabelled.
  static constexpr std::uint32_t kAppendStep = std::uint32_t{1} << 22;
  // A crowded group above 128 nodes is cut into groups of 64, whose gaps are 2^26.
  static constexpr std::uint32_t kCut = 64;
  static constexpr std::uint64_t kGroupStep = std::uint64_t{1} << 36;

  [[nodiscard]] TimeNode* at(Handle h) const noexcept { return arena_.at<TimeNode>(h); }

  void link(TimeNode& before, Handle place, Handle node, std::uint32_t group,
            std::uint32_t label) noexcept {
    TimeNode& n = *at(node);
    n.prev = place;
    n.next = before.next;
    n.group_and_mark = (n.group_and_mark & 0x80000000u) | group;
    n.label = label;
    (before.next != 0 ? at(before.next)->prev : back_) = node;
    before.next = node;
    ++groups_[group].count;
    ++size_;
  }

  void insert_crowded(Handle place, Handle node);
  void insert_in_new_group(Handle place, Handle node);
  void spread(std::uint32_t group) noexcept;
  void cut(std::uint32_t group);
  [[nodiscard]] std::uint32_t new_group_after(std::uint32_t group);
  void drop_group(std::uint32_t group) noexcept;
  void make_group_room(std::uint32_t group) noexcept;
  void set_group(TimeNode& n, std::uint32_t group) noexcept {
    n.group_and_mark = (n.group_and_mark & 0x80000000u) | group;
  }

  Arena& arena_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> free_groups_;
  Handle front_ = 0;
  Handle back_ = 0;
  std::size_t size_ = 0;
};

}  // namespace sac
