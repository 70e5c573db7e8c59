// What the last update left of points: what is asked when others are announced.
#pragma once

#include <optional>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
class KnownPoints {
 public:
  virtual ~KnownPoints() = default;
  /// Where the point is; nothing if it is not there.
  [[nodiscard]] virtual std::optional<Point<D>> place(PointId id) const = 0;
  /// The point in the same finest cell as `p`; nothing if there is none.
  struct Named {
    PointId id;
    Point<D> p;
  };
  [[nodiscard]] virtual std::optional<Named> obstacle(const Point<D>& p) const = 0;
  /// Ascending by id.
  [[nodiscard]] virtual std::vector<GraphPoint<D>> points() const = 0;
};

}  // namespace mesher::detail
