// Features as the caller gives them, checked before anything is done with them.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "errors.hpp"
#include "mesher/graph.hpp"

namespace lm {

/// The ids to be chosen next, one after the highest of each kind.
struct NextIds {
  std::int64_t point = 0, line = 0, polygon = 0, hole = 0, region = 0;
};

/// The ids of some new features: given, or chosen.
class NewIds {
 public:
  /// `ids`: n, or null. Throws: Failure(LM_BAD_ARGUMENT) if no ids are left.
  NewIds(std::size_t n, const std::int64_t* ids, std::int64_t next);

  [[nodiscard]] std::int64_t operator[](std::size_t i) const noexcept {
    return ids_ != nullptr ? ids_[i] : next_ + static_cast<std::int64_t>(i);
  }
  /// The features are there: `next` goes behind them, and the caller gets the first id.
  void settle(std::int64_t& next, std::int64_t* first) const noexcept;

 private:
  std::size_t n_;
  const std::int64_t* ids_;
  std::int64_t next_, after_;
};

[[nodiscard]] inline std::int64_t marker_at(const std::int64_t* markers, std::size_t i) noexcept {
  return markers == nullptr ? 0 : markers[i];
}

/// The i-th row of coordinates.
template <int D>
[[nodiscard]] mesher::Point<D> point_at(const double* at, std::size_t i) noexcept {
  mesher::Point<D> p;
  for (std::size_t k = 0; k < D; ++k) p[k] = at[i * D + k];
  return p;
}

/// Throws: Error (not_finite, magnitude), as for every input point.
template <int D>
void require_coordinates(const mesher::Point<D>& p, const mesher::Feature& feature);

/// Throws: Failure (LM_NULL_POINTER, LM_BAD_ARGUMENT), Error (not_finite, magnitude).
template <int D>
[[nodiscard]] std::vector<mesher::GraphPoint<D>> read_points(std::size_t n, const double* at,
                                                             const NewIds& ids,
                                                             const std::int64_t* markers);
[[nodiscard]] std::vector<mesher::Segment> read_segments(std::size_t n, const std::int64_t* ends,
                                                         const NewIds& ids,
                                                         const std::int64_t* markers);
[[nodiscard]] std::vector<mesher::PointId> read_ids(std::size_t n, const std::int64_t* points);
/// Throws: Failure (LM_NULL_POINTER, LM_BAD_SIZE, LM_BAD_ARGUMENT).
[[nodiscard]] mesher::Polygon read_polygon(const lm_polygon* polygon, std::int64_t id);
template <int D>
[[nodiscard]] std::vector<mesher::Seed<D>> read_holes(std::size_t n, const double* at,
                                                      const NewIds& ids);
/// Throws: Failure(LM_NULL_POINTER), Error (not_finite, magnitude, bad_number).
template <int D>
[[nodiscard]] std::vector<mesher::Seed<D>> read_regions(std::size_t n, const double* at,
                                                        const double* attributes,
                                                        const double* limits, const NewIds& ids);

/// Throws: Failure(LM_BAD_ARGUMENT).
[[noreturn]] void fail_dimension(std::int32_t dimension);
void require_space(int dimension);

}  // namespace lm
