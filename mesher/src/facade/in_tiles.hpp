// What states in tiles have in common: when they are one's, how tiles are made, and how several
// processes make one edit, each in its state.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

#include "facade/any_state.hpp"
#include "tiles/on_threads.hpp"
#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

/// What is thrown where tiles have failed, or cannot tell: one thread does it, or says why not.
struct NotInTiles {};
/// The same where tiles are sooner done with a first run.
struct NotInTilesYet {};
/// Calls act(); what tiles say of errors `is_theirs`, and not what one thread would.
template <class Act>
void in_tiles(Act&& act, bool is_theirs = true) {
  try {
    act();
  } catch (const Error&) {
    if (!is_theirs) throw;
    throw NotInTiles();
  } catch (const TooManyLooks&) {
    throw NotInTiles();
  }
}

/// Whether slivers are split.
template <int D>
[[nodiscard]] bool bounds_dihedrals(const Options<D>& options) noexcept {
  if constexpr (D == 3) return options.min_dihedral != 0;
  return false;
}
/// Whether a mesher with these options, that begins with these edits, can have tiles at all.
template <int D>
[[nodiscard]] bool may_have_tiles(const Options<D>& options, const Edits<D>& edits) noexcept {
  return options.threads > 1 && options.rule == Rule::radius_edge && edits.points.size() > 1 &&
         !options.record_weights;
}
/// Finds how crowded each vertex of before refinement is, by parts of the pool, on so many threads.
template <int D>
void find_levels(World<sac::Scope, D>& world, int threads) {
  const auto parts = static_cast<std::size_t>(threads);
  on_threads(parts, [&](std::size_t part) {
    typename FeatureTree<D>::Path path;
    world.vertices.pool().for_each_in(part, parts, [&](Vertex<D>& v) {
      if (!v.boundary && world.features.has(v)) world.features.find_level(v, path);
    });
  });
}
/// Tiles that are cut by `places` of features, in any order, and those of lattices: so many in all
/// processes; 0: options.threads in each. Throws: std::bad_alloc.
template <int D>
[[nodiscard]] std::unique_ptr<TiledMesher<D>> make_tiles(
    std::vector<std::type_identity_t<Point<D>>> places, std::size_t wanted,
    const Options<D>& options, const MeshBox<D>& box, const LimitsOf<D>& limits, Peers& peers,
    const WholeInput<D>& whole);
/// What tiles ask while they run: of a first run of so many points; of an update. `control` must
/// outlive it.
[[nodiscard]] std::function<bool(Phase, std::uint64_t)> asks_first(const RunControl& control,
                                                                   std::size_t points);
[[nodiscard]] std::function<bool(Phase, std::uint64_t)> asks_update(const RunControl& control);
/// Whether limits of size are edited everywhere: to follow that takes several times a first run.
template <int D>
[[nodiscard]] bool changes_all_limits(const Edits<D>& edits) noexcept;

/// What several processes have of one mesh that they keep together, each with a state. Functions
/// that are said to be of all are called by all of them, in the same order.
template <int D>
class PartOfMesh {
 public:
  virtual ~PartOfMesh() = default;
  [[nodiscard]] virtual const TiledMesher<D>& tiles() const noexcept = 0;
  /// The simplices of this process, and their vertices.
  [[nodiscard]] virtual Mesh<D> own_mesh() const = 0;
  /// That of this process from nothing: its vertices, its simplices and what is on these.
  [[nodiscard]] virtual Change<D> whole() const = 0;
  /// Whether changes, as accept() and the caller see them, are those of all processes.
  [[nodiscard]] virtual bool tells_all() const noexcept { return false; }
  /// Whether there may be lines or polygons.
  [[nodiscard]] virtual bool has_features() const noexcept { return true; }
};

/// What of a change is this process's: each simplex, edge and face is of the process that has its
/// least corner. Angles, the guard's report and counts stay.
template <int D>
[[nodiscard]] Change<D> own_part(Change<D> change, const TiledMesher<D>& tiles);

/// What all processes do together inside an edit that each of them makes by itself. Who fails
/// before the others are there lets all fail.
class TogetherInside {
 public:
  explicit TogetherInside(Peers& peers) : peers_(peers) {}
  /// Calls act(), of this process, before begin().
  template <class Act>
  void before(Act&& act) {
    try {
      act();
    } catch (...) {
      std::rethrow_exception(failure());
    }
  }
  /// Of all. Throws: what one has failed by before.
  void begin() {
    began_ = true;
    if (!peers_.is_alone()) agree(peers_, nullptr);
    all_began_ = true;
  }
  /// In a handler: what is thrown; before begin() as agree() says it to all.
  [[nodiscard]] std::exception_ptr failure() noexcept {
    const std::exception_ptr own = std::current_exception();
    if (began_ || peers_.is_alone()) return own;
    try {
      agree(peers_, own);
    } catch (...) {
      return std::current_exception();
    }
    return own;
  }
  /// Whether begin() has come to its end, in all processes or in none.
  [[nodiscard]] bool has_begun() const noexcept { return all_began_; }

 private:
  Peers& peers_;
  bool began_ = false, all_began_ = false;
};

}  // namespace mesher::detail
