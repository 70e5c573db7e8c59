// The area where limits of size count, and the limits of regions, given by the simplices of a mesh:
// a value type.
//
// Changed simplices give another value, which shares everything else with the one before: so both
// exist while an update can be undone.
//
// The simplices are in a quadtree (octree), each in the cell around its middle that is two to four
// times as wide: what is in a cell lies within a quarter of its side around it. Nodes are copied
// when they are written and another value has them, too.
//
// What is said of places and boxes is a function of what simplices of one limit cover, not of the
// simplices: all tests are exact.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/domain.hpp"
#include "sizes/tile.hpp"

namespace mesher {

template <int D>
class RegionLimits {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  using Corners = detail::CornersOf<D>;

  /// What is said of a simplex.
  struct Limit {
    bool counts = false;           ///< limits do here
    double measure = kNone;        ///< the largest of the region; kNone without one
    std::optional<SeedId> region;  ///< whose that is
    friend bool operator==(const Limit&, const Limit&) = default;
    /// Whether as much is allowed.
    [[nodiscard]] bool as(const Limit& other) const noexcept {
      return counts == other.counts && (!counts || measure == other.measure);
    }
  };
  /// What is said of several, where limits count.
  struct Range {
    double least = kNone, most = 0;
    bool some = false;  ///< limits count somewhere
    bool all = true;    ///< they count everywhere
    friend bool operator==(const Range&, const Range&) = default;
  };

  explicit RegionLimits(const detail::MeshBox<D>& box) : box_(box) {}

  /// Throws: std::bad_alloc, and is good for nothing then. Cost: O(log L/s).
  void insert(const Corners& simplex, const Limit& limit);
  /// Requires: it is there. Returns what was said of it.
  Limit erase(const Corners& simplex);
  /// Sets the largest measures that there may be.
  void set_measures(std::vector<double> measures) { measures_ = std::move(measures); }

  [[nodiscard]] const std::vector<double>& measures() const noexcept { return measures_; }
  /// At a place; on a border they count if they do on a side, and the least measure does.
  /// Cost: O(log L/s).
  [[nodiscard]] Limit at(const Point<D>& p) const;
  [[nodiscard]] Range range(const Box<D>& box) const;
  /// Memory, with what other values have as well. Cost: O(simplices).
  [[nodiscard]] std::size_t bytes() const;
  /// Calls visit(corners, limit) for all simplices.
  template <class Visit>
  void for_each(Visit&& visit) const {
    if (root_ != nullptr) for_each_below(*root_, visit);
  }

 private:
  struct Entry {
    detail::Tile<D> tile;
    Limit limit;
  };
  struct Node {
    std::array<std::shared_ptr<Node>, std::size_t{1} << D> child;
    std::vector<Entry> entries;
    Range range;
  };
  using Link = std::shared_ptr<Node>;

  static void take(Range& all, const Limit& limit);
  static void take(Range& all, const Range& more);
  static Node& own(Link& link);
  static void summarise(Link& link);
  [[nodiscard]] detail::Cell<D> cell_of(const Corners& simplex) const;
  template <class Edit>
  static void edit_at(Link& link, const detail::Cell<D>& cell, int level, Edit& edit);
  [[nodiscard]] static std::size_t bytes_below(const Node& node);
  template <class Enter, class Visit>
  void visit(const Node& node, const Point<D>& lo, double side, Enter& enter,
             Visit& visit_entry) const;
  template <class Visit>
  static void for_each_below(const Node& node, Visit& visit) {
    for (const Entry& e : node.entries) visit(e.tile.corners(), e.limit);
    for (const Link& child : node.child) {
      if (child != nullptr) for_each_below(*child, visit);
    }
  }

  detail::MeshBox<D> box_;
  Link root_;
  std::vector<double> measures_;
};

}  // namespace mesher
