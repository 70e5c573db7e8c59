// What a mesher's updates work on: in one piece, or in tiles.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "facade/edits.hpp"
#include "facade/known_points.hpp"
#include "geometry/grid.hpp"
#include "mesher/mesher.hpp"
#include "sac/engine.hpp"

namespace mesher::detail {

template <int D>
class AnyState : public KnownPoints<D> {
 public:
  using typename KnownPoints<D>::Named;
  /// A last word on a change, which may add to it; what it throws takes the update back.
  using Accept = std::function<void(Change<D>&)>;

  /// Inserts the features and runs the program. Requires: no run yet; edits insert, and leave
  /// limits as they are.
  virtual Change<D> first_run(Edits<D> edits, const RunControl& control, const Accept& accept) = 0;
  /// Whether propagate() can make these edits. If not, a first run of all can.
  [[nodiscard]] virtual bool takes(const Edits<D>& edits) const noexcept = 0;
  /// Whether a first run of all is known to take less time than propagate() would.
  [[nodiscard]] virtual bool is_sooner_anew(const Edits<D>&) const noexcept { return false; }
  /// Makes the edits and propagates them. Requires: a run; takes(edits).
  /// `accept`: asked when all can still be undone.
  virtual Change<D> propagate(const Edits<D>& edits, const RunControl& control,
                              const Accept& accept) = 0;

  [[nodiscard]] virtual bool ran() const noexcept = 0;
  [[nodiscard]] virtual Mesh<D> mesh() const = 0;
  [[nodiscard]] virtual MeshStats stats() const = 0;
  /// Of the first tile, if there are several.
  [[nodiscard]] virtual const sac::Engine& engine() const noexcept = 0;

  [[nodiscard]] virtual std::size_t size() const noexcept = 0;

  /// Of a change by a first run that goes from another mesh to this one: says in it what is to be
  /// said of simplices that are new. Beyond space, and in the plane, nothing.
  virtual void judge_new(Change<D>&) const {}

  virtual void check_invariants() const = 0;
};

}  // namespace mesher::detail
