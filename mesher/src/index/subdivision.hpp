// The split cells of the quadtree, as a traceable data type.
//
//   split(s, cell)   the running call marks a cell as split   (effect)
//
// No call observes it: the results of searches do not depend on the subdivision.
#pragma once

#include "index/quadtree.hpp"
#include "sac/sac.hpp"

namespace mesher::detail {

template <class S, int D = 2>
class Subdivision;

template <int D>
class Subdivision<sac::PlainScope, D> {
 public:
  Subdivision(Quadtree<D>& tree, sac::PlainScope&) : tree_(tree) {}

  /// Requires: 0 <= cell.level < kLevels. Throws: std::bad_alloc.
  void split(sac::PlainScope&, const Cell<D>& cell) { tree_.mark(cell); }

 private:
  Quadtree<D>& tree_;
};

template <int D>
class Subdivision<sac::Scope, D> : public sac::Structure {
 public:
  Subdivision(Quadtree<D>& tree, sac::Engine& engine)
      : tree_(tree), id_(engine.add_structure(*this)) {}

  /// Requires: 0 <= cell.level < kLevels. Throws: std::bad_alloc.
  void split(sac::Scope& s, const Cell<D>& cell);

  void retract(sac::Call& call, sac::Edge& edge) noexcept override;

 private:
  static constexpr std::uint8_t kSplit = 0;
  using NodeIndex = typename Quadtree<D>::NodeIndex;
  struct SplitEdge : sac::Edge {
    static constexpr NodeIndex kNone = ~NodeIndex{0};
    NodeIndex node;
  };

  Quadtree<D>& tree_;
  std::uint8_t id_;
};

}  // namespace mesher::detail
