// Where limits of size count, and those of regions, by the triangles of a mesh: a value.
//
// Triangles that are changed give another value, which shares all else with the one before: so an
// update that is taken back has both.
//
// The triangles are in a quadtree, each in the cell around its middle that is two to four times as
// wide: what is in a cell lies within a quarter of its side around it. Nodes are copied when they
// are written and another value has them, too.
//
// What is said of places and boxes is a function of the areas that triangles of one limit cover,
// not of the triangles: all tests are exact.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/domain.hpp"
#include "sizes/facet.hpp"

namespace mesher {

class RegionLimits {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  using Corners = std::array<Point<2>, 3>;

  /// What is said of a triangle.
  struct Limit {
    bool counts = false;              ///< limits do here
    double area = kNone;              ///< the region's; kNone without one
    std::optional<FeatureId> region;  ///< whose area that is
    friend bool operator==(const Limit&, const Limit&) = default;
    /// Whether as much is allowed.
    [[nodiscard]] bool as(const Limit& other) const noexcept {
      return counts == other.counts && (!counts || area == other.area);
    }
  };
  /// What is said of several: of the areas where limits count.
  struct Range {
    double least = kNone, most = 0;
    bool some = false;  ///< limits count somewhere
    bool all = true;    ///< they count everywhere
    friend bool operator==(const Range&, const Range&) = default;
  };

  explicit RegionLimits(const detail::MeshBox<2>& box) : box_(box) {}

  /// Throws: std::bad_alloc, and is good for nothing then. Cost: O(log L/s).
  void insert(const Corners& triangle, const Limit& limit);
  /// Requires: it is there. Returns what was said of it.
  Limit erase(const Corners& triangle);
  /// Sets the largest areas that there may be.
  void set_areas(std::vector<double> areas) { areas_ = std::move(areas); }

  [[nodiscard]] const std::vector<double>& areas() const noexcept { return areas_; }
  /// At a place; on an edge they count if they do on a side, and the least area does.
  /// Cost: O(log L/s).
  [[nodiscard]] Limit at(const Point<2>& p) const;
  [[nodiscard]] Range range(const Box<2>& box) const;
  /// Memory, with what other values have as well. Cost: O(triangles).
  [[nodiscard]] std::size_t bytes() const;
  /// Calls visit(corners, limit) for all triangles.
  template <class Visit>
  void for_each(Visit&& visit) const {
    if (root_ != nullptr) for_each_below(*root_, visit);
  }

 private:
  struct Entry {
    detail::Facet facet;
    Limit limit;
  };
  struct Node {
    std::array<std::shared_ptr<Node>, 4> child;
    std::vector<Entry> entries;
    Range range;
  };
  using Link = std::shared_ptr<Node>;

  static void take(Range& all, const Limit& limit);
  static void take(Range& all, const Range& more);
  static Node& own(Link& link);
  static void summarise(Link& link);
  [[nodiscard]] detail::Cell<2> cell_of(const Corners& triangle) const;
  template <class Edit>
  static void edit_at(Link& link, const detail::Cell<2>& cell, int level, Edit& edit);
  [[nodiscard]] static std::size_t bytes_below(const Node& node);
  template <class Enter, class Visit>
  void visit(const Node& node, const Point<2>& lo, double side, Enter& enter,
             Visit& visit_entry) const;
  template <class Visit>
  static void for_each_below(const Node& node, Visit& visit) {
    for (const Entry& e : node.entries) visit(e.facet.corners(), e.limit);
    for (const Link& child : node.child) {
      if (child != nullptr) for_each_below(*child, visit);
    }
  }

  detail::MeshBox<2> box_;
  Link root_;
  std::vector<double> areas_;
};

}  // namespace mesher
