// Sizes on triangles, each linear between its corners: a background, or the regions of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "sizes/facet.hpp"

namespace mesher::detail {

/// Where several triangles meet, the least of their sizes; where there is none, no limit.
class FacetSizes : public SizeField<2> {
 public:
  /// Facets that cover all places that will be asked about.
  explicit FacetSizes(std::vector<Facet> facets) : FacetSizes(std::move(facets), {}, true) {}
  /// `plateaus`: all sizes of the facets.
  FacetSizes(std::vector<Facet> facets, std::vector<double> plateaus)
      : FacetSizes(std::move(facets), std::move(plateaus), false) {}

  /// Cost: O(log n), where facets are not long and thin.
  [[nodiscard]] double at(const Point<2>& p) const override;
  [[nodiscard]] SizeRange range(const Box<2>& box) const override;
  [[nodiscard]] std::vector<double> plateaus() const override { return plateaus_; }

 private:
  // Its left child follows; a leaf has none.
  struct Node {
    Box<2> box;
    SizeRange range;
    std::size_t begin = 0, end = 0;  // of facets_
    std::size_t right = 0;           // 0: a leaf
  };
  FacetSizes(std::vector<Facet> facets, std::vector<double> plateaus, bool covering);
  void build(std::size_t begin, std::size_t end);
  template <class Enter, class Visit>
  void visit(Enter&& enter, Visit&& visit_facet) const;

  std::vector<Facet> facets_;
  std::vector<Node> nodes_;
  std::vector<double> plateaus_;
  bool covering_;
};

}  // namespace mesher::detail
