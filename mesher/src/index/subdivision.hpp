// Which cells of the quadtree are split, as a traceable data type.
//
//   split(s, cell)   the running call marks a cell as split   (effect)
//
// Nobody observes it: what searches answer does not depend on the subdivision.
#pragma once

#include "index/quadtree.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

template <class S>
class Subdivision;

template <>
class Subdivision<sac::PlainScope> {
 public:
  Subdivision(Quadtree<2>& tree, sac::PlainScope&) : tree_(tree) {}

  /// Requires: 0 <= cell.level < kLevels. Throws: std::bad_alloc.
  void split(sac::PlainScope&, const Cell<2>& cell) { tree_.mark(cell); }

 private:
  Quadtree<2>& tree_;
};

template <>
class Subdivision<sac::Scope> : public sac::Structure {
 public:
  Subdivision(Quadtree<2>& tree, sac::Engine& engine)
      : tree_(tree), id_(engine.add_structure(*this)) {}

  /// Requires: 0 <= cell.level < kLevels. Throws: std::bad_alloc.
  void split(sac::Scope& s, const Cell<2>& cell);

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;

 private:
  static constexpr std::uint8_t kSplit = 0;
  struct SplitEdge : sac::Edge {
    static constexpr Quadtree<2>::NodeIndex kNone = ~Quadtree<2>::NodeIndex{0};
    Quadtree<2>::NodeIndex node;
  };

  Quadtree<2>& tree_;
  std::uint8_t id_;
};

}  // namespace mesher::detail
