// The edits announced since the last update: for each point, where it was and where it shall be.
//
// Only the difference is kept: a point that goes and comes back to its place is not in it. So a
// batch has no order, and is judged by where its points end.
#pragma once

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
class Pending {
 public:
  using Place = std::optional<Point<D>>;  // nothing: the point is not there
  struct Edit {
    PointId id{};
    Place was, to;
  };

  explicit Pending(const MeshBox<D>& box) : box_(box) {}

  /// The edit of `id`; null if it stays where it was. Valid until the next change.
  [[nodiscard]] const Edit* find(PointId id) const;

  /// `id`, which the last update left at `was`, shall be at `to`. Throws: bad_alloc, and then has
  /// changed nothing; never to take the last change of `id` back. Cost: O(1).
  void set(PointId id, const Place& was, const Place& to);

  /// A point other than `id` that shall be in the finest cell around `p`, with its place.
  [[nodiscard]] const Edit* arrival_near(const Point<D>& p, PointId id) const;

  /// All edits in Morton order of where the points shall be, those of points that go first.
  [[nodiscard]] std::vector<Edit> sorted() const;

  /// Points that come, less those that go.
  [[nodiscard]] std::ptrdiff_t growth() const noexcept { return growth_; }
  /// Forgets all edits, and gives their memory back.
  void clear() noexcept;
  /// How many buckets the tables have: what it takes to clear them.
  [[nodiscard]] std::size_t buckets() const noexcept {
    return edits_.bucket_count() + arrivals_.bucket_count();
  }

 private:
  struct CellHash {
    std::size_t operator()(const Fixed<D>& cell) const noexcept {
      std::uint64_t h = 0;
      for (const std::uint64_t x : cell) h = sac::mix(h) + x;
      return sac::mix(h);
    }
  };
  void erase_arrival(const Point<D>& p, PointId id) noexcept;

  const MeshBox<D>& box_;
  std::unordered_map<PointId, Edit> edits_;
  std::unordered_multimap<Fixed<D>, PointId, CellHash> arrivals_;  // by the cell of `to`
  std::ptrdiff_t growth_ = 0;
};

}  // namespace mesher::detail
