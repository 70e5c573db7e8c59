// The fragments that a change leaves of one region: its survivors, divided where they are no longer
// connected.
//
// Words: *survivors* and *frontier* as in tiles.hpp. A *cluster* is a set of triangles of the
// frontier and new ones that reach each other among themselves. A *fragment* of a region is a set
// of its survivors that reach each other through survivors of that region, and through clusters.
//
// A change parts a region only if one of its cuts has survivors in several clusters. From each of
// those a search starts; all go on in turn, a triangle each, and two that meet become one. When at
// most one is left that has more to do, the others have found their fragments whole. So a fragment
// costs as many steps as it has triangles, times the searches, except the last one, which is not
// looked at farther. If the clusters are joined after all, the cost is that of meeting: at most all
// survivors of the region.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "domain/components.hpp"
#include "sets/union_find.hpp"

namespace mesher::detail {

/// A triangle of the frontier with its region and cluster.
struct Member {
  std::uint32_t component;
  std::uint32_t cluster;
  Slot slot;
  friend auto operator<=>(const Member&, const Member&) = default;
};

/// The frontier and the new triangles, in clusters.
template <int D>
class Clusters {
 public:
  /// Cost: O(c log c).
  Clusters(const TilesOf<D>& tiles, const SeamsOf<D>& seams);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(nodes_.size()); }
  /// The triangles, ascending; their clusters are numbered 0 .. count() - 1, not all used.
  [[nodiscard]] std::span<const Slot> nodes() const { return nodes_; }
  /// kNone for a triangle that is in no cluster.
  [[nodiscard]] std::uint32_t of(Slot s) const;
  /// The frontier, ascending.
  [[nodiscard]] std::span<const Member> members() const { return members_; }
  /// Those of one region, or of one region in one cluster.
  [[nodiscard]] std::span<const Member> members(std::uint32_t component) const;
  [[nodiscard]] std::span<const Member> members(std::uint32_t component,
                                                std::uint32_t cluster) const;

 private:
  std::vector<Slot> nodes_;
  std::vector<std::uint32_t> cluster_;  // one per node
  std::vector<Member> members_;
};

struct Fragment {
  std::uint32_t component = kNone;
  std::uint32_t size = 0;
  bool listed = false;      // else it is the one that was not looked at to its end
  std::vector<Slot> tiles;  // if listed
};

/// Parts one region. Marks hold what it has found until they are used again.
template <int D>
class Parting {
 public:
  /// `starts`: the clusters to start from, each with a member of the region.
  Parting(const TilesOf<D>& tiles, const Clusters<D>& clusters, Marks& marks,
          std::uint32_t component, std::span<const std::uint32_t> starts);

  void run();

  /// After run(): the fragments that are listed. At least one fragment is not.
  [[nodiscard]] std::vector<Fragment> listed();
  /// The index of a survivor's fragment in listed(); kNone for the one that is not listed.
  [[nodiscard]] std::uint32_t listed_with(Slot s);
  [[nodiscard]] std::uint64_t visited() const { return visited_; }

 private:
  struct Group {
    std::vector<Slot> done, pending;
    std::size_t head = 0;  // of `pending`
    std::uint32_t listed = kNone;
    [[nodiscard]] bool exhausted() const { return head == pending.size(); }
    [[nodiscard]] std::size_t size() const { return done.size() + pending.size() - head; }
  };

  [[nodiscard]] bool is_marked(Slot s) const { return marks_[s] - base_ < groups_.size(); }
  void mark(Slot s, std::uint32_t group);
  void reach(Slot s, std::uint32_t group);
  void meet(std::uint32_t a, std::uint32_t b);
  void step(std::uint32_t group);
  void choose();

  const TilesOf<D>& tiles_;
  const Clusters<D>& clusters_;
  Marks& marks_;
  std::uint32_t component_;
  std::uint32_t base_;  // the mark of group 0
  std::vector<Group> groups_;
  UnionFind met_;
  std::vector<std::uint32_t> finished_;  // groups that are listed
  std::uint64_t visited_ = 0;
};

}  // namespace mesher::detail
