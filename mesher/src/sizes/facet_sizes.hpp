// Sizes on simplices, each linear between its corners: a background.
#pragma once

#include <cstddef>
#include <vector>

#include "sizes/facet.hpp"

namespace mesher::detail {

/// Where several simplices meet, the least of their sizes.
template <int D>
class FacetSizes : public SizeField<D> {
 public:
  /// Facets that cover all places that will be asked about.
  explicit FacetSizes(std::vector<Facet<D>> facets);

  /// Cost: O(log n), where facets are not long and thin.
  [[nodiscard]] double at(const Point<D>& p) const override;
  /// Bounds to the last bit. A function of the facets, in whatever order they came.
  [[nodiscard]] SizeRange range(const Box<D>& box) const override;

 private:
  // Its left child follows; a leaf has none.
  struct Node {
    Box<D> box;
    SizeRange range;
    std::size_t begin = 0, end = 0;  // of facets_
    std::size_t right = 0;           // 0: a leaf
  };
  void build(std::size_t begin, std::size_t end);
  template <class Enter, class Visit>
  void visit(Enter&& enter, Visit&& visit_facet) const;

  std::vector<Facet<D>> facets_;
  std::vector<Node> nodes_;
};

}  // namespace mesher::detail
