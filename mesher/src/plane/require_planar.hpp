// Checks in the plane that new features fit the existing ones.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "plane/conflict_sweep.hpp"
#include "plane/planarity.hpp"

namespace mesher::detail {

/// What has come: segments, then points.
struct Arrivals {
  const std::vector<SegmentHandle>& segments;
  const std::vector<VertexHandle>& points;
};

/// Looks at all that has come, one after the other, by conflict_of(). That takes what is near, and
/// beside long segments nearly all is; so after as many steps as a sweep takes it sweeps instead.
/// Throws: Error as of the first in this order that is in conflict; what `ask` throws, which is
/// called at least every millisecond or so.
/// Cost: O(k log L/s) for k that have come and have few others near; never above O(n log n), and
/// searches for what is in conflict with O(suspects) segments.
template <class S>
class PlanarityCheck {
 public:
  PlanarityCheck(SegmentStore& segments, const VertexPool<2>& points, const Features<S>& features,
                 const std::function<void()>& ask)
      : segments_(segments), points_(points), features_(features), ask_(ask) {}

  void require(const Arrivals& come, const Names& names) const {
    if (const auto conflict = first_of(come)) fail(*conflict, names);
  }

 private:
  // What a search looks at, against what a sweep does with a segment or point: places in a tree.
  static constexpr std::uint64_t kSweep = 64;
  static constexpr std::size_t kBetween = 64;

  [[nodiscard]] std::optional<Conflict> first_of(const Arrivals& come) const {
    const std::uint64_t most = segments_.looked_at() + kSweep * (segments_.live() + points_.size());
    std::size_t count = 0;
    const auto goes_on = [&] {
      if (count++ % kBetween == 0 || segments_.looked_at() - last_ > kBetween * kSweep) {
        last_ = segments_.looked_at();
        ask_();
      }
      return segments_.looked_at() <= most;
    };
    for (const SegmentHandle h : come.segments) {
      if (!goes_on()) return first_by_sweep(come);
      if (const auto conflict = of(h)) return conflict;
    }
    for (const VertexHandle h : come.points) {
      if (!goes_on()) return first_by_sweep(come);
      if (const auto conflict = conflict_of(points_[h], segments_)) return conflict;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Conflict> of(SegmentHandle h) const {
    return conflict_of(segments_.pool()[h], segments_, features_);
  }

  // The first is a suspect, or in conflict with one.
  [[nodiscard]] std::optional<Conflict> first_by_sweep(const Arrivals& come) const {
    std::unordered_map<SegmentHandle, std::size_t> segment_at;
    std::unordered_map<VertexHandle, std::size_t> point_at;
    for (const SegmentHandle h : come.segments) segment_at.emplace(h, segment_at.size());
    for (const VertexHandle h : come.points) point_at.emplace(h, point_at.size());
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::size_t segment = kNone, point = kNone;
    const auto keep_least = [](std::size_t& least, const auto& places, auto handle) {
      const auto found = places.find(handle);
      if (found != places.end()) least = std::min(least, found->second);
    };
    for (const Segment* s : suspects()) {
      ask_();
      keep_least(segment, segment_at, s->self);
      segments_.visit_near(s->place_a, s->place_b, 0, [&](const Segment& t) {
        if (t.self != s->self && planarity::conflict_with(*s, t)) {
          keep_least(segment, segment_at, t.self);
        }
        return false;
      });
      for (const auto& [v, place] : point_at) {
        if (place < point && planarity::conflict_with(*s, points_[v])) point = place;
      }
    }
    if (segment != kNone) return of(come.segments[segment]);
    if (point != kNone) return conflict_of(points_[come.points[point]], segments_);
    return std::nullopt;
  }

  [[nodiscard]] std::vector<const Segment*> suspects() const {
    std::vector<const Segment*> live;
    segments_.pool().for_each([&](const Segment& s) {
      if (s.alive) live.push_back(&s);
    });
    std::vector<const Vertex<2>*> points;
    points_.for_each([&](const Vertex<2>& v) {
      if (v.input) points.push_back(&v);
    });
    return suspects_among(live, points, ask_);
  }

  SegmentStore& segments_;
  const VertexPool<2>& points_;
  const Features<S>& features_;
  const std::function<void()>& ask_;
  mutable std::uint64_t last_ = 0;
};

}  // namespace mesher::detail
