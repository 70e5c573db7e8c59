// Parts of changes, and tiles of places.
#include "facade/in_tiles.hpp"

#include <algorithm>

#include "geometry/box.hpp"
#include "program/meter.hpp"
#include "sizes/fill_places.hpp"

namespace mesher::detail {

template <int D>
bool changes_all_limits(const Edits<D>& edits) noexcept {
  if (!edits.limits) return false;
  const Box<D>& domain = edits.limits->options.domain;
  const auto& where = edits.limits->where;
  return std::any_of(where.begin(), where.end(),
                     [&](const Box<D>& box) { return contains(box, domain); });
}

template <int D>
Change<D> own_part(Change<D> change, const TiledMesher<D>& tiles) {
  const auto keep = [&](auto& all, auto&& place_of) {
    std::erase_if(all, [&](const auto& one) { return !tiles.own_tile(place_of(one)); });
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < change.vertices_added.size(); ++i) {
    if (!tiles.own_tile(change.vertices_added[i])) continue;
    change.vertices_added[kept] = change.vertices_added[i];
    change.kinds_added[kept++] = change.kinds_added[i];
  }
  change.vertices_added.resize(kept), change.kinds_added.resize(kept);
  keep(change.vertices_removed, [](const Point<D>& p) { return p; });
  keep(change.kinds_changed, [](const auto& k) { return k.vertex; });
  const auto least = [](const auto& corners) {
    return *std::min_element(corners.begin(), corners.end());
  };
  keep(change.simplices_added, least), keep(change.simplices_removed, least);
  const auto low = [](const auto& e) { return e.low; };
  keep(change.edges_added, low), keep(change.edges_removed, low);
  const auto least_of = [&](const auto& f) { return least(f.corners); };
  keep(change.faces_added, least_of), keep(change.faces_removed, least_of);
  return change;
}

template <int D>
std::unique_ptr<TiledMesher<D>> make_tiles(std::vector<std::type_identity_t<Point<D>>> places,
                                           std::size_t wanted, const Options<D>& options,
                                           const MeshBox<D>& box, const LimitsOf<D>& limits,
                                           Peers& peers, const WholeInput<D>& whole) {
  const auto threads = static_cast<std::size_t>(options.threads);
  // Handles, in whose order places come, may differ between processes.
  if (!peers.is_alone()) std::sort(places.begin(), places.end());
  places = places_of_work(std::move(places), limits, box, options.domain);
  if (wanted == 0) wanted = threads * peers.size();
  return std::make_unique<TiledMesher<D>>(options, box, places, wanted, threads, peers, whole);
}

std::function<bool(Phase, std::uint64_t)> asks_first(const RunControl& control,
                                                     std::size_t points) {
  return [&control, points](Phase phase, std::uint64_t calls) {
    const std::uint64_t of = phase == Phase::quadtree ? std::max<std::uint64_t>(points, calls) : 0;
    return report(control, {phase, calls, of});
  };
}
std::function<bool(Phase, std::uint64_t)> asks_update(const RunControl& control) {
  return [&control](Phase phase, std::uint64_t calls) {
    return report(control, {phase, calls, 0});
  };
}

template bool changes_all_limits(const Edits<2>&) noexcept;
template Change<2> own_part(Change<2>, const TiledMesher<2>&);
template std::unique_ptr<TiledMesher<2>> make_tiles(std::vector<Point<2>>, std::size_t,
                                                    const Options<2>&, const MeshBox<2>&,
                                                    const LimitsOf<2>&, Peers&,
                                                    const WholeInput<2>&);
#ifndef MESHER_PLANE_ONLY
template bool changes_all_limits(const Edits<3>&) noexcept;
template Change<3> own_part(Change<3>, const TiledMesher<3>&);
template std::unique_ptr<TiledMesher<3>> make_tiles(std::vector<Point<3>>, std::size_t,
                                                    const Options<3>&, const MeshBox<3>&,
                                                    const LimitsOf<3>&, Peers&,
                                                    const WholeInput<3>&);
#endif

}  // namespace mesher::detail
