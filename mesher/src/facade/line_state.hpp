// The state with lines between its points, as far as the plane and space agree on them: which
// segments go and come, and what they are called.
//
// An update takes all that goes or has a point that moves, then points, then adds what comes and
// what was taken for a point alone. A class derived from this says what else is taken and added,
// and judges whether what has come fits to what is there.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

#include "facade/point_state.hpp"
#include "facade/segment_names.hpp"
#include "plane/planarity.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

/// Throws: Error(point_in_use). `what` it is of the user: "an end of"; `places`: where it is.
[[noreturn]] void fail_in_use(PointId point, const std::string& what, const mesher::Feature& user,
                              std::vector<Position> places);

template <int D>
using NamesOf = std::conditional_t<D == 2, Names, SpaceNames>;

template <int D>
class LineState : public PointState<D>, protected NamesOf<D> {
  using Base = PointState<D>;

 public:
  using Base::Base;

 protected:
  using Base::ids_, Base::names_, Base::world_;

  // --- What an update does to lines, and whatever else there is
  /// Takes what goes, and notes what comes.
  virtual void take_edited(const Edits<D>& edits);
  /// Takes what is at a point that moves, to be added again.
  virtual void take_at(VertexHandle v, const Edits<D>& edits);
  /// Throws: Error(point_in_use) if something that stays is at a point that goes.
  virtual void require_unused(PointId id, VertexHandle v) const;
  /// Adds what take_edited() and take_at() have noted.
  virtual void add_noted();
  /// Throws: Error if what has come does not fit to what is there.
  virtual void require_fit() = 0;

  // --- The turns of PointState
  void add_features_first(const Edits<D>& edits) final;
  void make_edits(const Edits<D>& edits) final;
  void prepare_names() override { segment_names_.prepare(); }
  void commit_names() noexcept override { segment_names_.commit(); }
  void discard_news() noexcept override;

  [[nodiscard]] PointId point(VertexHandle v) const final { return this->name(v); }
  /// The segments that there are now.
  [[nodiscard]] const SegmentStoreOf<D>& segments() const noexcept;

  SegmentNames segment_names_;

 private:
  // A segment of a line, by its ends.
  struct Part {
    LineId line{};
    PointId from{}, to{};
  };

  void take_segment(const SegmentOf<D>& s);
  void add_segment(const Part& part);

  std::vector<Part> noted_;
};

/// The edge between two places, as a Change has it.
template <std::size_t D>
[[nodiscard]] mesher::LineEdge<static_cast<int>(D)> edge_between(const std::array<double, D>& p,
                                                                 const std::array<double, D>& q,
                                                                 const mesher::Feature& feature) {
  const auto& [low, high] = std::minmax(p, q);
  return {low, high, feature};
}

}  // namespace mesher::detail
