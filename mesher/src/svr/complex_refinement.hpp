// Traditional Delaunay refinement of a complex in space [Fig 2.1].
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/refine.hpp"
#include "svr/bucketed_queue.hpp"
#include "svr/conforming_mesh.hpp"

namespace mesher::detail {

class ComplexRefinement : public ConformingMesh {
  using Base = ConformingMesh;

 public:
  struct Settings : Base::Settings {
    RefineOrder order = RefineSettings{}.order;
  };

  ComplexRefinement(const MeshBox<3>& box, const Settings& settings)
      : Base(box, settings, 0), order_(settings.order) {}

  /// Throws: Error (too_many; too_close: rounding moves a new vertex too far), what watch() throws.
  void run();

  /// But for what is counted in the result.
  [[nodiscard]] RefineStats stats() const;

 private:
  struct Entry {
    std::uint32_t simplex, age;
  };

  void triangulate();
  void look_at(std::uint32_t s, const Shape& shape);
  void split(const Entry& poor);
  void fill(std::uint32_t v);

  RefineOrder order_;
  ComputedBuckets<Entry> queue_;
  std::vector<std::uint32_t> age_;  // by simplex
};

}  // namespace mesher::detail
