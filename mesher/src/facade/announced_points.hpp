// Edits of points that are announced between updates, and what is refused of them.
#pragma once

#include <vector>

#include "facade/edits.hpp"
#include "facade/known_points.hpp"
#include "facade/pending.hpp"

namespace mesher::detail {

/// `state`, in all functions: of the last update.
template <int D>
class AnnouncedPoints {
 public:
  using Place = typename Pending<D>::Place;
  using State = KnownPoints<D>;

  /// When a place that another point may have is looked at.
  enum class Judged : std::uint8_t { at_once, at_the_end };

  /// `box` must outlive it.
  AnnouncedPoints(const Box<D>& domain, const MeshBox<D>& box)
      : domain_(domain), box_(box), pending_(box) {}

  /// Throws: Error (repeated_id, outside_domain, not_finite, magnitude; at once: duplicate_point,
  /// too_close).
  void insert(const State& state, PointId id, const Point<D>& p, Judged when = Judged::at_once);
  /// Throws: Error(unknown_id).
  void remove(const State& state, PointId id);
  /// Throws: Error (unknown_id, outside_domain, not_finite, magnitude).
  void move(const State& state, PointId id, const Point<D>& p);
  /// As if insert() had not been called. Requires: it has, and `id` was not there before.
  void take_back(const State& state, PointId id) { pending_.set(id, state.place(id), {}); }
  void clear() noexcept;

  /// Where the point shall be.
  [[nodiscard]] Place place(const State& state, PointId id) const;
  /// Throws: Error (duplicate_point, too_close) if a place that was not looked at is not free.
  void require_apart(const State& state) const;
  /// The points that there shall be, as new ones.
  [[nodiscard]] PointEdits<D> all(const State& state) const;
  [[nodiscard]] const Pending<D>& pending() const noexcept { return pending_; }

 private:
  void require_known(const State& state, PointId id) const;
  void require_free(const State& state, PointId id, const Point<D>& p) const;

  Box<D> domain_;
  const MeshBox<D>& box_;
  Pending<D> pending_;
  bool moved_ = false;  // a place was taken that was not looked at
};

}  // namespace mesher::detail
