// Random edits of the mesher's input, and figures of the input.
#include "mesh_subject.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesher/error.hpp"
#include "traces/recorder.hpp"

namespace tool {
namespace {

using mesher::Point;
using mesher::PointId;

template <int D>
double distance2(const Point<D>& a, const Point<D>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// Squared, of two different points. Cost: O(n log n) for points that are not all in a column; in
// space O(n^(5/3)) for uniform ones.
template <int D>
double least_distance2(std::vector<Point<D>> points) {
  std::sort(points.begin(), points.end());
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const double x = points[j][0] - points[i][0];
      if (x * x >= least) break;
      least = std::min(least, distance2<D>(points[i], points[j]));
    }
  }
  return least;
}

// Points are put next to others at distances from 2^-3 down to 2^-43 of the domain's side: with
// doubles near 1 there are still 10 bits for where the vertices between them are.
constexpr int kFirstScale = 3;
constexpr std::uint64_t kScales = 40;

std::vector<PointId> first_ids(std::size_t count) {
  std::vector<PointId> ids;
  for (std::size_t i = 1; i <= count; ++i) ids.push_back(PointId{static_cast<std::int64_t>(i)});
  return ids;
}

}  // namespace

template <int D>
MeshSubject<D>::MeshSubject(const mesher::Options<D>& options, std::vector<Point<D>> points,
                            std::uint64_t seed)
    : options_(options),
      points_(std::move(points)),
      ids_(first_ids(points_.size())),
      next_id_(static_cast<std::int64_t>(points_.size()) + 1),
      random_(seed),
      mesher_(meshed(options_, points_, ids_)) {}

template <int D>
mesher::Mesher<D> MeshSubject<D>::meshed(const mesher::Options<D>& options,
                                         const std::vector<Point<D>>& points,
                                         const std::vector<PointId>& ids) {
  mesher::Options<D> of_box = options;
  of_box.extent = mesher::Extent::box;
  mesher::Mesher<D> mesher(of_box);
  for (std::size_t i = 0; i < ids.size(); ++i) mesher.insert(ids[i], points[i]);
  mesher.update();
  return mesher;
}

template <int D>
traces::Trace MeshSubject<D>::trace() const {
  return traces::Recorder(mesher_.engine()).trace();
}

template <int D>
traces::Trace MeshSubject<D>::fresh_trace() const {
  const mesher::Mesher<D> fresh = meshed(options_, points_, ids_);
  return traces::Recorder(fresh.engine()).trace();
}

template <int D>
double MeshSubject<D>::side() const {
  const auto& [lo, hi] = options_.domain;
  double side = 0;
  for (std::size_t i = 0; i < D; ++i) side = std::max(side, hi[i] - lo[i]);
  return side;
}

template <int D>
Point<D> MeshSubject<D>::somewhere() {
  const auto& [lo, hi] = options_.domain;
  Point<D> p;
  if (points_.empty() || random_.below(2) == 0) {
    for (int i = 0; i < D; ++i) p[i] = lo[i] + (hi[i] - lo[i]) * random_.unit();
    return p;
  }
  const Point<D> near = points_[random_.below(points_.size())];
  const double reach = std::ldexp(side(), -kFirstScale - static_cast<int>(random_.below(kScales)));
  const double each = reach * std::sqrt(2.0 / D);  // offsets of length 0.7 to 1 of reach
  for (int i = 0; i < D; ++i) {
    const double offset = each * (0.5 + random_.unit() / 5);
    p[i] = std::clamp(near[i] + (random_.below(2) == 0 ? offset : -offset), lo[i], hi[i]);
  }
  return p;
}

// Where the mesher refuses a point (it is there already, or too near to another), another is tried.
template <int D>
Point<D> MeshSubject<D>::insert() {
  for (;;) {
    const Point<D> p = somewhere();
    try {
      mesher_.insert(PointId{next_id_}, p);
    } catch (const mesher::Error&) {
      continue;
    }
    ids_.push_back(PointId{next_id_++});
    points_.push_back(p);
    return p;
  }
}

template <int D>
Point<D> MeshSubject<D>::remove() {
  const std::size_t i = random_.below(points_.size());
  mesher_.remove(ids_[i]);
  std::swap(ids_[i], ids_.back());
  std::swap(points_[i], points_.back());
  const Point<D> p = points_.back();
  ids_.pop_back();
  points_.pop_back();
  return p;
}

template <int D>
traces::Subject::Edit MeshSubject<D>::edit() {
  Edit result;
  const bool inserts = points_.size() <= 2 || random_.below(2) == 0;
  const auto before = points_;
  const Point<D> edited = inserts ? insert() : remove();
  const std::size_t m = mesher_.stats().vertices;
  const mesher::CallCounts calls = mesher_.update().calls;
  result.work.executed = calls.executed;
  result.work.reused = calls.reused;
  result.work.created = calls.created;
  result.work.discarded = calls.discarded;
  result.work.weight = calls.weight;
  const auto& larger = inserts ? points_ : before;
  double d2 = HUGE_VAL;
  for (const Point<D>& p : larger) {
    if (p != edited) d2 = std::min(d2, distance2<D>(p, edited));
  }
  result.figures = {{"n", static_cast<double>(larger.size())},
                    {"m", static_cast<double>(std::max(m, mesher_.stats().vertices))},
                    {"lg_L_s", std::log2(side() / std::sqrt(least_distance2<D>(larger)))},
                    {"lg_L_d", std::log2(side() / std::sqrt(d2))}};
  return result;
}

template class MeshSubject<2>;
template class MeshSubject<3>;

}  // namespace tool
