// Points are given to tiles, tiles run and are compared, and what they output is joined.
#include "facade/out_of_core.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

#include "facade/mesh_statically.hpp"
#include "facade/settled.hpp"
#include "geometry/box.hpp"
#include "geometry/input_point.hpp"
#include "geometry/place_hash.hpp"
#include "mesh/canonical.hpp"
#include "mesher/predicates.hpp"
#include "program/meter.hpp"
#include "rules/mesh_box.hpp"
#include "sizes/limits_of.hpp"
#include "tiles/halo_certificate.hpp"
#include "tiles/halo_store.hpp"
#include "tiles/on_threads.hpp"

namespace mesher::detail {

namespace {

// Thrown where another thread has failed: it says why.
struct Abandoned {};

// Whether the run goes on is asked on the caller's thread; others are told.
class TilingWatch {
 public:
  explicit TilingWatch(const RunControl& control)
      : control_(control), caller_(std::this_thread::get_id()) {}
  // So many calls have run since. Throws: Error(cancelled), what control.progress throws,
  // Abandoned.
  void step(std::uint64_t more) {
    const std::uint64_t calls = calls_ += more;
    if (abandoned_) throw Abandoned();
    const bool goes_on = std::this_thread::get_id() == caller_
                             ? report(control_, {.phase = Phase::steiner, .done = calls, .of = 0})
                             : !control_.stop.stop_requested();
    if (!goes_on) fail_cancelled();
  }
  void abandon() noexcept { abandoned_ = true; }

 private:
  const RunControl& control_;
  std::thread::id caller_;
  std::atomic<std::uint64_t> calls_ = 0;
  std::atomic<bool> abandoned_ = false;
};

template <int D>
class Tiling {
 public:
  // `points` are forgotten when the tiles have them.
  Tiling(std::vector<Point<D>>& points, const Options<D>& options, const OutOfCore& how,
         double width, const std::vector<PointId>& ids, OutOfCoreReport& report,
         const RunControl& control)
      : options_(options),
        how_(how),
        report_(report),
        box_(mesh_box(options)),
        tiles_(bounding_box<D>(points), sample(points, how.tiles), how.tiles),
        of_a_tile_(without_limit(options)),
        input_{of_a_tile_, box_, tiles_,
               [&ids](std::uint64_t number) {
                 return ids.empty() ? PointId{static_cast<std::int64_t>(number + 1)}
                                    : ids[static_cast<std::size_t>(number)];
               }},
        watch_(control),
        widths_(tiles_.size(), width),
        farthest_(tiles_.size(), 0) {
    report_.tiles = tiles_.size();
    open_store(points);
    deal(points);
    std::vector<Point<D>>().swap(points);
  }

  void run() {
    std::vector<std::size_t> todo = all_tiles();
    std::erase_if(todo, [&](std::size_t tile) { return store_->has_run(tile); });
    report_.tiles_found = tiles_.size() - todo.size();
    while (true) {
      run_tiles(todo);
      todo = disagreeing();
      ++report_.rounds;
      if (todo.empty()) break;
      for (const std::size_t tile : todo) widths_[tile] *= 2;
    }
    require_no_fault();
  }

  [[nodiscard]] Mesh<D> mesh() {
    std::vector<Point<D>> places;
    std::vector<VertexKind> kinds;
    std::vector<std::size_t> begin(tiles_.size() + 1, 0);
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
      const auto own = store_->vertices(tile);
      places.insert(places.end(), own->places.begin(), own->places.end());
      kinds.insert(kinds.end(), own->kinds.begin(), own->kinds.end());
      begin[tile + 1] = places.size();
    }
    if (options_.max_vertices != 0 && places.size() > options_.max_vertices) fail_too_many();
    SAC_ENSURES(places.size() < ~std::uint32_t{0});
    const auto number_of = [&](const Point<D>& p) {
      const std::size_t tile = tiles_.owner(p);
      const auto at = [&](std::size_t i) {
        return places.begin() + static_cast<std::ptrdiff_t>(i);
      };
      const auto it = std::lower_bound(at(begin[tile]), at(begin[tile + 1]), p);
      SAC_ENSURES(it != at(begin[tile + 1]) && *it == p);
      return static_cast<std::uint32_t>(it - places.begin());
    };
    return canonical<D>(places, kinds, 0, {}, [&](auto&& visit) {
      for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
        const auto out = store_->simplices(tile);
        const auto own = static_cast<std::uint32_t>(begin[tile + 1] - begin[tile]);
        std::vector<std::uint32_t> foreign;
        for (const Point<D>& p : out->foreign) foreign.push_back(number_of(p));
        for (std::array<std::uint32_t, D + 1> corners : out->simplices) {
          for (std::uint32_t& c : corners) {
            c = c < own ? static_cast<std::uint32_t>(begin[tile]) + c : foreign[c - own];
          }
          visit(corners);
        }
      }
    });
  }
  void forget() noexcept {
    if (folder_ != nullptr) folder_->remove();
  }

 private:
  using Points = std::vector<SpacedPoint<D>>;

  // A tile may have more vertices than the mesh, where its halo ends.
  static Options<D> without_limit(Options<D> options) {
    constexpr std::size_t kMore = 10000;
    if (options.max_vertices != 0) options.max_vertices = 2 * options.max_vertices + kMore;
    return options;
  }

  // The cuts are good enough by some of the points.
  static std::vector<Point<D>> sample(const std::vector<Point<D>>& points, std::size_t tiles) {
    constexpr std::size_t kEach = 4096;
    const std::size_t step =
        std::max(points.size() / std::max(tiles * kEach, std::size_t{1}), std::size_t{1});
    std::vector<Point<D>> some;
    for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
    return some;
  }

  void open_store(const std::vector<Point<D>>& points) {
    if (how_.folder.empty()) {
      store_ = std::make_unique<MemoryStore<D>>(tiles_.size());
      return;
    }
    std::uint64_t job = sac::mix(D * 0x100 + tiles_.size());
    const auto add = [&](double x) { job = sac::mix(job + std::bit_cast<std::uint64_t>(x)); };
    for (const double x : options_.domain.lo) add(x);
    for (const double x : options_.domain.hi) add(x);
    add(options_.rho);
    for (const Point<D>& p : points) job = sac::mix(job + place_hash(p));
    auto folder = std::make_unique<FolderStore<D>>(how_.folder, tiles_.size(), job);
    folder_ = folder.get();
    store_ = std::move(folder);
  }

  // Each tile gets its points, in parts of the input: what all have together must not be in memory
  // a second time. Their spacings are those of the tile's points alone: at its border too large.
  void deal(const std::vector<Point<D>>& points) {
    std::vector<std::uint64_t> begin(tiles_.size() + 1, 0);
    std::vector<std::uint32_t> owner(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      owner[i] = static_cast<std::uint32_t>(tiles_.owner(points[i]));
      ++begin[owner[i] + std::size_t{1}];
    }
    std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint64_t> order(points.size()), next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      order[static_cast<std::size_t>(next[owner[i]]++)] = i;
    }
    for_each_of(all_tiles(), [&](std::size_t tile) {
      Points own;
      for (std::uint64_t i = begin[tile]; i < begin[tile + 1]; ++i) {
        const std::uint64_t number = order[static_cast<std::size_t>(i)];
        own.push_back({{points[static_cast<std::size_t>(number)], number}, 0});
      }
      measure(own);
      for (const SpacedPoint<D>& one : own) {
        farthest_[tile] = std::max(farthest_[tile], one.spacing);
      }
      store_->put_points(tile, std::move(own));
    });
  }
  // By cells that have kTogether points: those that are very near another one are no measure.
  void measure(Points& own) const {
    std::vector<Point<D>> places;
    places.reserve(own.size());
    for (const SpacedPoint<D>& one : own) places.push_back(one.point.p);
    const std::vector<std::size_t> order = morton_order(places, box_);
    std::vector<Fixed<D>> sorted;
    sorted.reserve(order.size());
    for (const std::size_t i : order) sorted.push_back(box_.fixed(places[i]));
    const std::size_t n = sorted.size(), together = std::min(n, kTogether<D>);
    const auto level_from = [&](std::size_t first) {
      return MeshBox<D>::common_level(sorted[first], sorted[first + together - 1]);
    };
    for (std::size_t i = 0; i < n; ++i) {
      int deepest = 0;
      const std::size_t last = std::min(i, n - together);
      for (std::size_t k = i + 1 > together ? i + 1 - together : 0; k <= last; ++k) {
        deepest = std::max(deepest, level_from(k));
      }
      own[order[i]].spacing =
          box_.cell_side(deepest) / std::pow(static_cast<double>(kTogether<D>), 1.0 / D);
    }
  }

  [[nodiscard]] std::vector<std::size_t> all_tiles() const {
    std::vector<std::size_t> all(tiles_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  // Calls act(tile) for these, on several threads.
  template <class Act>
  void for_each_of(const std::vector<std::size_t>& which, Act&& act) {
    std::atomic<std::size_t> next = 0;
    const auto threads = std::min(which.size(), static_cast<std::size_t>(how_.threads));
    on_threads(threads, [&](std::size_t) {
      try {
        for (std::size_t i = next++; i < which.size(); i = next++) {
          watch_.step(0);
          act(which[i]);
        }
      } catch (const Abandoned&) {
      } catch (...) {
        watch_.abandon();
        throw;
      }
    });
  }

  void run_tiles(const std::vector<std::size_t>& which) {
    std::atomic<std::uint64_t> calls = 0, all = 0, most = 0;
    for_each_of(which, [&](std::size_t tile) {
      const std::vector<HaloPoint<D>> points = points_around(tile);
      HaloRun<D> run =
          run_for_tile(input_, tile, points, [&] { watch_.step(RunControl::kCallsBetween); });
      calls += run.calls;
      all += points.size();
      std::uint64_t before = most;
      while (before < points.size() && !most.compare_exchange_weak(before, points.size())) {
      }
      store_->put_run(tile, std::move(run));
    });
    report_.runs += which.size();
    report_.calls += calls;
    report_.all_points += static_cast<std::size_t>(all.load());
    report_.most_points = std::max(report_.most_points, static_cast<std::size_t>(most.load()));
  }
  [[nodiscard]] std::vector<HaloPoint<D>> points_around(std::size_t tile) const {
    std::vector<HaloPoint<D>> points;
    for (std::size_t other = 0; other < tiles_.size(); ++other) {
      if (tiles_.distance_between(tile, other) > widths_[tile] * farthest_[other]) continue;
      const auto some = store_->points(other);
      for (const SpacedPoint<D>& one : *some) {
        if (other == tile || tiles_.distance(tile, one.point.p) <= widths_[tile] * one.spacing) {
          points.push_back(one.point);
        }
      }
    }
    return points;
  }

  // Those whose halo is too narrow. The first call that is wrong, of all, is one of a tile that has
  // seen something else of another than is there; or it sees in its own tile a birth by another's
  // call that the other does not know.
  [[nodiscard]] std::vector<std::size_t> disagreeing() {
    std::vector<std::atomic<bool>> disagrees(tiles_.size());
    std::vector<std::shared_ptr<const HaloView<D>>> views(tiles_.size());
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) views[tile] = store_->view(tile);
    for_each_of(all_tiles(), [&](std::size_t tile) {
      const auto vertices = store_->vertices(tile);
      std::vector<typename HaloStore<D>::Looks> all;
      std::vector<std::span<const HaloLook<D>>> looks;
      for (std::size_t other = 0; other < tiles_.size(); ++other) {
        all.push_back(store_->looks(other, tile));
        looks.push_back(all.back().looks);
      }
      const HaloWitness<D> witness(tiles_, tile, *vertices, looks);
      for (std::size_t other = 0; other < tiles_.size(); ++other) {
        if (!witness.confirms(looks[other])) disagrees[other] = true;
        if (!agree_on_births(*views[other], other, *views[tile], tile)) disagrees[tile] = true;
      }
    });
    std::vector<std::size_t> which;
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
      if (disagrees[tile]) which.push_back(tile);
    }
    return which;
  }

  void require_no_fault() const {
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
      const auto view = store_->view(tile);
      if (view->fault) throw *view->fault;
    }
  }
  [[noreturn]] void fail_too_many() const {
    throw Error(ErrorCode::too_many,
                "more than " + std::to_string(options_.max_vertices) + " vertices are needed");
  }

  const Options<D>& options_;
  const OutOfCore& how_;
  OutOfCoreReport& report_;
  MeshBox<D> box_;
  HaloTiles<D> tiles_;
  Options<D> of_a_tile_;
  HaloInput<D> input_;
  TilingWatch watch_;
  std::vector<double> widths_;    // of halos
  std::vector<double> farthest_;  // by tile: the largest spacing of its points
  std::unique_ptr<HaloStore<D>> store_;
  FolderStore<D>* folder_ = nullptr;
};

// Throws: Error(bad_option).
template <int D>
void require_tileable(const Options<D>& options, const OutOfCore& how) {
  bool is_plain = options.rule == Rule::radius_edge && options.growth == 0 &&
                  !LimitsOf<D>(options, mesh_box(options)).any();
  if constexpr (D == 3) is_plain = is_plain && options.min_dihedral == 0;
  if (!is_plain) {
    throw Error(ErrorCode::bad_option,
                "out of core there are no limits of size, no growth, no min_dihedral and no rule "
                "but radius-edge");
  }
  if (options.algorithm != Algorithm::automatic && options.algorithm != Algorithm::gap_balls) {
    throw Error(ErrorCode::bad_option, "out of core the algorithm is gap-balls");
  }
  if (how.threads < 1 || how.threads > kMostThreads) {
    throw Error(ErrorCode::bad_option, "threads must be from 1 to 256");
  }
}

}  // namespace

template <int D>
Mesh<D> mesh_in_tiles(std::vector<Point<D>> points, const Options<D>& options, const OutOfCore& how,
                      double width, const std::vector<PointId>& ids, OutOfCoreReport& report,
                      const RunControl& control) {
  SAC_EXPECTS(how.tiles > 0 && how.threads > 0 && points.size() > 1);
  Tiling<D> tiling(points, options, how, width, ids, report, control);
  tiling.run();
  Mesh<D> mesh = tiling.mesh();
  tiling.forget();
  return mesh;
}

}  // namespace mesher::detail

namespace mesher {

template <int D>
Mesh<D> box_mesh_out_of_core(std::vector<Point<D>> points, const Options<D>& options,
                             const OutOfCore& how, const std::vector<PointId>& ids,
                             OutOfCoreReport* report, const RunControl& control) {
  SAC_EXPECTS(ids.empty() || ids.size() == points.size());
  predicates::self_test();
  detail::require_unstopped(control);
  Options<D> settled = detail::settled(options);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointId id = ids.empty() ? PointId{static_cast<std::int64_t>(i + 1)} : ids[i];
    detail::check_coordinates(points[i], id);
    if (options.domain != Box<D>{}) detail::check_point(points[i], options.domain, id);
  }
  if (settled.domain == Box<D>{}) settled.domain = snapped_domain<D>(points);
  detail::require_tileable(settled, how);
  OutOfCoreReport made;
  OutOfCore plan = how;
  constexpr std::size_t kMost = OutOfCore::kPointsOfTile<D>;
  if (plan.tiles == 0) plan.tiles = (points.size() + kMost - 1) / kMost;
  Mesh<D> mesh = points.size() < 2
                     ? mesh_statically<D>(points, settled, ids, nullptr, control)
                     : detail::mesh_in_tiles<D>(std::move(points), settled, plan,
                                                detail::kHaloWidth<D>, ids, made, control);
  if (report != nullptr) *report = made;
  return mesh;
}

template Mesh<2> box_mesh_out_of_core<2>(std::vector<Point<2>>, const Options<2>&, const OutOfCore&,
                                         const std::vector<PointId>&, OutOfCoreReport*,
                                         const RunControl&);
template Mesh<2> detail::mesh_in_tiles<2>(std::vector<Point<2>>, const Options<2>&,
                                          const OutOfCore&, double, const std::vector<PointId>&,
                                          OutOfCoreReport&, const RunControl&);
#ifndef MESHER_PLANE_ONLY
template Mesh<3> box_mesh_out_of_core<3>(std::vector<Point<3>>, const Options<3>&, const OutOfCore&,
                                         const std::vector<PointId>&, OutOfCoreReport*,
                                         const RunControl&);
template Mesh<3> detail::mesh_in_tiles<3>(std::vector<Point<3>>, const Options<3>&,
                                          const OutOfCore&, double, const std::vector<PointId>&,
                                          OutOfCoreReport&, const RunControl&);
#endif

}  // namespace mesher
