// Reads the arrays of the caller.
#include "inputs.hpp"

#include <algorithm>
#include <cmath>

#include "structs.hpp"

namespace lm {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Feature;

namespace {

constexpr std::int64_t kLastId = std::numeric_limits<std::int64_t>::max();

}  // namespace

NewIds::NewIds(std::size_t n, const std::int64_t* ids, std::int64_t next)
    : n_(n), ids_(ids), next_(next), after_(next) {
  require_count(n, "an array of features");
  if (ids_ == nullptr) {
    if (static_cast<std::uint64_t>(kLastId - next_) < n) {
      throw Failure(LM_BAD_ARGUMENT, "no ids are left to be chosen; give ids");
    }
    after_ = next_ + static_cast<std::int64_t>(n);
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (ids_[i] >= after_) after_ = ids_[i] == kLastId ? kLastId : ids_[i] + 1;
  }
}

void NewIds::settle(std::int64_t& next, std::int64_t* first) const noexcept {
  if (first != nullptr && n_ > 0) *first = (*this)[0];
  next = after_;
}

template <int D>
void require_coordinates(const mesher::Point<D>& p, const Feature& feature) {
  for (const double x : p) {
    if (!std::isfinite(x)) {
      throw Error(ErrorCode::not_finite, text_of(feature) + " has a coordinate that is not finite",
                  {}, {feature});
    }
    if (x != 0 && (std::abs(x) < 0x1p-100 || std::abs(x) > 0x1p100)) {
      throw Error(ErrorCode::magnitude,
                  text_of(feature) +
                      " has a coordinate that is neither 0 nor of magnitude 2^-100 "
                      "to 2^100",
                  {}, {feature}, {mesher::position_of(p)});
    }
  }
}
template void require_coordinates<2>(const mesher::Point<2>&, const Feature&);
template void require_coordinates<3>(const mesher::Point<3>&, const Feature&);

template <int D>
std::vector<mesher::GraphPoint<D>> read_points(std::size_t n, const double* at, const NewIds& ids,
                                               const std::int64_t* markers) {
  require_array(at, n, "at");
  std::vector<mesher::GraphPoint<D>> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = {mesher::PointId{ids[i]}, point_at<D>(at, i), marker_at(markers, i)};
    require_coordinates<D>(points[i].at, points[i].id);
  }
  return points;
}
template std::vector<mesher::GraphPoint<2>> read_points(std::size_t, const double*, const NewIds&,
                                                        const std::int64_t*);
template std::vector<mesher::GraphPoint<3>> read_points(std::size_t, const double*, const NewIds&,
                                                        const std::int64_t*);

std::vector<mesher::Segment> read_segments(std::size_t n, const std::int64_t* ends,
                                           const NewIds& ids, const std::int64_t* markers) {
  require_array(ends, n, "ends");
  std::vector<mesher::Segment> segments(n);
  for (std::size_t i = 0; i < n; ++i) {
    segments[i] = {mesher::LineId{ids[i]}, mesher::PointId{ends[2 * i]},
                   mesher::PointId{ends[2 * i + 1]}, marker_at(markers, i)};
  }
  return segments;
}

std::vector<mesher::PointId> read_ids(std::size_t n, const std::int64_t* points) {
  require_array(points, n, "points");
  std::vector<mesher::PointId> ids(n);
  std::transform(points, points + n, ids.begin(),
                 [](std::int64_t i) { return mesher::PointId{i}; });
  return ids;
}

mesher::Polygon read_polygon(const lm_polygon* user, std::int64_t id) {
  const lm_polygon given = read_struct(user, "polygon");
  require_array(given.loop_sizes, given.loops, "polygon->loop_sizes");
  mesher::Polygon polygon{.id = mesher::PolygonId{id}, .marker = given.marker};
  std::size_t done = 0;
  for (std::size_t k = 0; k < given.loops; ++k) {
    const std::size_t size = given.loop_sizes[k];
    if (size < 3) throw Failure(LM_BAD_ARGUMENT, "a loop of a polygon has fewer than 3 points");
    require_array(given.points, size, "polygon->points");
    polygon.loops.push_back(read_ids(size, given.points + done));
    done += size;
  }
  if (given.loops == 0) throw Failure(LM_BAD_ARGUMENT, "a polygon has no loop");
  require_array(given.edges, given.inner_edges, "polygon->edges");
  for (std::size_t k = 0; k < given.inner_edges; ++k) {
    polygon.edges.push_back(
        {mesher::PointId{given.edges[2 * k]}, mesher::PointId{given.edges[2 * k + 1]}});
  }
  polygon.points = read_ids(given.inner_points, given.loose_points);
  return polygon;
}

template <int D>
std::vector<mesher::Seed<D>> read_holes(std::size_t n, const double* at, const NewIds& ids) {
  require_array(at, n, "at");
  std::vector<mesher::Seed<D>> seeds(n);
  for (std::size_t i = 0; i < n; ++i) {
    seeds[i] = mesher::hole_seed<D>(ids[i], point_at<D>(at, i));
    require_coordinates<D>(seeds[i].at, seeds[i].id);
  }
  return seeds;
}
template std::vector<mesher::Seed<2>> read_holes(std::size_t, const double*, const NewIds&);
template std::vector<mesher::Seed<3>> read_holes(std::size_t, const double*, const NewIds&);

template <int D>
std::vector<mesher::Seed<D>> read_regions(std::size_t n, const double* at, const double* attributes,
                                          const double* limits, const NewIds& ids) {
  require_array(at, n, "at");
  std::vector<mesher::Seed<D>> seeds(n);
  for (std::size_t i = 0; i < n; ++i) {
    mesher::Seed<D>& seed = seeds[i];
    seed = mesher::region_seed<D>(ids[i], point_at<D>(at, i),
                                  attributes == nullptr ? 0 : attributes[i]);
    require_coordinates<D>(seed.at, seed.id);
    if (!std::isfinite(seed.attribute)) {
      throw Error(ErrorCode::bad_number, text_of(seed.id) + " has an attribute that is not finite",
                  {}, {seed.id}, {mesher::position_of(seed.at)});
    }
    if (limits == nullptr || limits[i] == 0) continue;
    if (!(limits[i] > 0)) {
      throw Error(ErrorCode::bad_number, text_of(seed.id) + " has a limit that is not above 0", {},
                  {seed.id}, {mesher::position_of(seed.at)});
    }
    seed.max_measure = limits[i];
  }
  return seeds;
}
template std::vector<mesher::Seed<2>> read_regions(std::size_t, const double*, const double*,
                                                   const double*, const NewIds&);
template std::vector<mesher::Seed<3>> read_regions(std::size_t, const double*, const double*,
                                                   const double*, const NewIds&);

void fail_dimension(std::int32_t dimension) {
  throw Failure(LM_BAD_ARGUMENT, "the dimension is " + std::to_string(dimension) + ", not 2 or 3");
}
void require_space(int dimension) {
  if (dimension != 3) throw Failure(LM_BAD_ARGUMENT, "this is for space alone");
}

}  // namespace lm
