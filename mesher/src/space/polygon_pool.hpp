// Polygons at fixed addresses, addressed by handles; freed ones are used again.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "space/feature.hpp"

namespace mesher::detail {

class PolygonPool {
 public:
  PolygonPool() : records_(1) {}

  [[nodiscard]] Polygon& operator[](PolygonHandle h) const noexcept { return *records_[h]; }
  /// No record has a handle above this.
  [[nodiscard]] PolygonHandle last() const noexcept {
    return static_cast<PolygonHandle>(records_.size() - 1);
  }
  /// The polygon as a record. Throws: std::bad_alloc, and then changes nothing.
  [[nodiscard]] Polygon& create(Polygon&& f) {
    if (free_ == 0) {
      records_.push_back(nullptr);
      try {
        records_.back() = std::make_unique<Polygon>();
      } catch (...) {
        records_.pop_back();
        throw;
      }
      release(*records_.back(), static_cast<PolygonHandle>(records_.size() - 1));
    }
    const PolygonHandle h = free_;
    Polygon& record = *records_[h];
    free_ = record.self;
    record = std::move(f);
    record.self = h;
    return record;
  }
  /// Requires: nobody refers to f any more.
  void release(Polygon& f) noexcept { release(f, f.self); }
  /// Calls visit(polygon) for every record in use, in the order of handles.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (PolygonHandle h = 1; h < records_.size(); ++h) {
      if (records_[h]->self == h) visit(*records_[h]);
    }
  }
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  void release(Polygon& f, PolygonHandle h) noexcept {
    f = Polygon{};
    f.self = std::exchange(free_, h);
  }

  std::vector<std::unique_ptr<Polygon>> records_;
  PolygonHandle free_ = 0;
};

inline std::size_t PolygonPool::bytes() const noexcept {
  std::size_t bytes = records_.capacity() * sizeof(records_[0]);
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  for (PolygonHandle h = 1; h < records_.size(); ++h) {
    const Polygon& f = *records_[h];
    bytes += sizeof f + of(f.corners) + of(f.loop_end) + of(f.places) + of(f.outline) +
             of(f.edges) + of(f.inner_edges) + of(f.inner_points) + of(f.inside) + of(f.points) +
             of(f.all_edges) + of(f.corner_of) + f.outline_tree.bytes() + f.inner_tree.bytes();
  }
  return bytes;
}

}  // namespace mesher::detail
