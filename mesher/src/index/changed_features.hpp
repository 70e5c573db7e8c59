// Who knows which edges and polygons have come or gone since the last update.
#pragma once

#include <span>

#include "mesher/mesh.hpp"

namespace mesher::detail {

struct PlaceBall {
  Point<3> middle{};
  double radius = 0;
};

class ChangedFeatures {
 public:
  /// Whether one of them meets `whole`, and one of `parts`. Throws: std::bad_alloc.
  [[nodiscard]] virtual bool any_meets(const PlaceBall& whole,
                                       std::span<const PlaceBall> parts) = 0;

 protected:
  ~ChangedFeatures() = default;
};

}  // namespace mesher::detail
