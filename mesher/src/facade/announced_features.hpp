// Edits of lines and polygons that are announced between updates, and what is refused of them.
#pragma once

#include "facade/announced_points.hpp"
#include "facade/edits.hpp"
#include "mesher/mesher.hpp"

namespace mesher::detail {

template <int D>
class AnnouncedFeatures {
 public:
  using State = KnownPoints<D>;

  /// `rule`: of the options. `points` must outlive it.
  AnnouncedFeatures(Rule rule, const AnnouncedPoints<D>& points) : rule_(rule), points_(points) {}

  /// `state`: that of the last update. Throws: Error (repeated_id, bad_option, zero_length; of a
  /// polygon also what require_loops() throws).
  void insert_line(const State& state, LineId id, const LinePoints& points);
  void insert_polygon(const State& state, const mesher::Polygon& polygon);
  /// Throws: Error(unknown_id).
  void remove_line(LineId id);
  void remove_polygon(PolygonId id);

  [[nodiscard]] const StagedLines& lines() const noexcept { return lines_; }
  [[nodiscard]] const StagedPolygons& polygons() const noexcept { return polygons_; }

  /// So that commit() needs no memory.
  void prepare() { lines_.prepare(), polygons_.prepare(); }
  void commit() noexcept { lines_.commit(), polygons_.commit(); }
  void discard() noexcept { lines_.discard(), polygons_.discard(); }

 private:
  Rule rule_;
  const AnnouncedPoints<D>& points_;
  StagedLines lines_;
  StagedPolygons polygons_;  // in space
};

/// The features that there will be, as new ones.
template <class Key, class Value>
[[nodiscard]] Staged<Key, Value> all_of(const Staged<Key, Value>& staged) {
  Staged<Key, Value> all;
  for (const auto& [id, value] : staged.committed()) all.set(id, value);
  staged.for_each_edit([&](const Key& id, const Value*, const Value* is) {
    all.set(id, is != nullptr ? std::optional(*is) : std::nullopt);
  });
  return all;
}

}  // namespace mesher::detail
