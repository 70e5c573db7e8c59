// Which points there are, where processes have points of their own: of each id one process knows.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "facade/announced_points.hpp"
#include "facade/divided_points.hpp"

namespace mesher::detail {

/// The part of this process. Functions that are said to be of all are called by all processes.
template <int D>
class PointDirectory final : public KnownPoints<D> {
 public:
  enum class Kind : std::int64_t { insert, remove, move };  // as wide as the others: no gap
  struct Announcement {
    Kind kind;
    PointId id;
    Point<D> p;
    /// In `edits`. Throws: as that.
    void make(const KnownPoints<D>& known, AnnouncedPoints<D>& edits) const;
  };

  explicit PointDirectory(Peers& peers) : peers_(peers) {}

  [[nodiscard]] std::optional<Point<D>> place(PointId id) const override;
  /// Nobody knows here: who has the place judges.
  [[nodiscard]] std::optional<typename KnownPoints<D>::Named> obstacle(
      const Point<D>&) const override {
    return std::nullopt;
  }
  [[nodiscard]] std::vector<GraphPoint<D>> points() const override;
  [[nodiscard]] std::size_t size() const noexcept { return places_.size(); }

  /// Of all: gives `edits` those that all processes announce, of which this one knows the points;
  /// of each point those of the first process first. Throws: as AnnouncedPoints, the first of all.
  void collect(const std::vector<Announcement>& announced, AnnouncedPoints<D>& edits);
  /// For commit().
  void prepare(const Pending<D>& edits);
  void commit() noexcept;

 private:
  [[nodiscard]] std::size_t process_of(PointId id) const noexcept;

  Peers& peers_;
  using Places = std::unordered_map<PointId, Point<D>>;
  Places places_;
  std::vector<typename Pending<D>::Edit> prepared_;
  Places coming_;
};

/// All points, where each process has had those of others told.
template <int D>
class AllPoints final : public KnownPoints<D> {
 public:
  AllPoints(std::vector<GraphPoint<D>> points, const MeshBox<D>& box);
  [[nodiscard]] std::optional<Point<D>> place(PointId id) const override;
  [[nodiscard]] std::optional<typename KnownPoints<D>::Named> obstacle(
      const Point<D>& p) const override;
  [[nodiscard]] std::vector<GraphPoint<D>> points() const override { return points_; }

 private:
  const MeshBox<D>& box_;
  std::vector<GraphPoint<D>> points_;                        // by id
  std::vector<std::pair<Fixed<D>, std::uint32_t>> by_cell_;  // and their index
};

}  // namespace mesher::detail
