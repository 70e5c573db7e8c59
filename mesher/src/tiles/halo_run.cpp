// A world with a border; what it leaves is sorted into the tile's own and what is others'.
#include "tiles/halo_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/input_point.hpp"
#include "geometry/place_hash.hpp"
#include "mesher/meshing.hpp"
#include "program/world_impl.hpp"

namespace mesher::detail {

namespace {

class HaloNames final : public Names {
 public:
  explicit HaloNames(const std::function<PointId(std::uint64_t)>& id_of) : id_of_(id_of) {}
  void name(VertexHandle v, std::uint64_t number) {
    if (v >= numbers_.size()) numbers_.resize(std::size_t{v} + 1);
    numbers_[v] = number;
  }
  [[nodiscard]] PointId point(VertexHandle v) const override { return id_of_(numbers_[v]); }
  [[nodiscard]] LineId line(SegmentHandle) const override { return LineId{}; }

 private:
  const std::function<PointId(std::uint64_t)>& id_of_;
  std::vector<std::uint64_t> numbers_;
};

template <int D>
class Run {
 public:
  using W = World<sac::PlainScope, D>;

  Run(const HaloInput<D>& input, std::size_t tile)
      : input_(input),
        tile_(tile),
        border_(input.tiles, tile),
        world_(input.options, input.box, scope_),
        names_(input.id_of) {
    world_.halo = &border_;
    world_.names = &names_;
  }

  void refine(const std::vector<HaloPoint<D>>& points, const std::function<void()>& step) {
    add(points);
    world_.plain.next_report = 1;
    world_.plain.report = [&step](PlainOutput<D>& plain) {
      step();
      plain.next_report = plain.calls + RunControl::kCallsBetween;
    };
    scope_.template run<detail::refine<D>>();
  }
  [[nodiscard]] HaloRun<D> result() {
    sort_vertices();
    HaloRun<D> run;
    run.vertices = vertices();
    run.simplices = simplices();
    run.calls = world_.plain.calls;
    note_blocks();
    note_stars();
    run.looks = looks();
    run.view = view();
    return run;
  }

 private:
  void add(const std::vector<HaloPoint<D>>& points) {
    std::vector<Point<D>> places;
    places.reserve(points.size());
    for (const HaloPoint<D>& point : points) places.push_back(point.p);
    for (const std::size_t i : morton_order(places, input_.box)) {
      const PointId id = input_.id_of(points[i].number);
      check_point(points[i].p, input_.options.domain, id);
      Vertex<D>& v = world_.vertices.add_input(points[i].p, true);
      names_.name(v.self, points[i].number);
      if (const auto* other = world_.features.tree().insert_unless(v)) {
        fail_too_near(points[i].p, id, other->p, names_.point(other->self));
      }
      inputs_.push_back(v.self);
      world_.quadtree.template post_from_outside<locate>(locate_key(world_.box.fixed(v.p)),
                                                         VertexRef<D>{&v});
    }
  }

  [[nodiscard]] const VertexPool<D>& pool() const { return world_.vertices.pool(); }

  void sort_vertices() {
    pool().for_each(
        [&](const Vertex<D>& v) { (border_.owns(v.p) ? own_ : others_).push_back(v.self); });
    std::sort(own_.begin(), own_.end(), in_order());
  }
  [[nodiscard]] auto in_order() const {
    return [this](VertexHandle a, VertexHandle b) { return pool()[a].p < pool()[b].p; };
  }

  [[nodiscard]] HaloVertices<D> vertices() const {
    HaloVertices<D> own;
    for (const VertexHandle h : own_) {
      own.places.push_back(pool()[h].p);
      own.kinds.push_back(pool()[h].kind());
      own.born.push_back(border_.birth(h));
    }
    return own;
  }

  [[nodiscard]] HaloSimplices<D> simplices() const {
    HaloSimplices<D> out;
    std::vector<std::uint32_t> number(pool().end_of_handles(), kNoNumber);
    std::uint32_t next = 0;
    for (const VertexHandle h : own_) number[h] = next++;
    std::vector<VertexHandle> foreign;
    world_.for_each_simplex([&](const std::array<VertexHandle, D + 1>& corners) {
      if (!is_output(corners)) return;
      out.simplices.push_back(corners);
      for (const VertexHandle h : corners) {
        if (number[h] != kNoNumber) continue;
        number[h] = 0;  // until they are sorted
        foreign.push_back(h);
      }
    });
    std::sort(foreign.begin(), foreign.end(), in_order());
    for (const VertexHandle h : foreign) {
      number[h] = next++;
      out.foreign.push_back(pool()[h].p);
    }
    for (auto& simplex : out.simplices) {
      for (std::uint32_t& corner : simplex) corner = number[corner];
    }
    return out;
  }
  [[nodiscard]] bool is_output(const std::array<VertexHandle, D + 1>& corners) const {
    return border_.owns(pool()[*std::min_element(corners.begin(), corners.end(), in_order())].p);
  }

  // How crowded a point is says which points are in the block of 3^D cells around it at the next
  // level; the ball has the block in it.
  void note_blocks() {
    for (const VertexHandle h : inputs_) {
      const Vertex<D>& v = pool()[h];
      const double reach = std::sqrt(double{D}) * world_.box.cell_side(v.level);
      border_.begin({Stage::steiner, 0, 0, v.p});
      border_.looked({v.p, {}, reach * (1 + 0x1p-40)});
    }
  }
  void note_stars() {
    for (const VertexHandle h : own_) {
      Vertex<D>& v = pool()[h];
      border_.begin({Stage::stars, 0, 0, v.p});
      const double far = input_.tiles.distance_to_end(tile_, v.p) * (0.5 - 0x1p-40);
      if (far > 0 && world_.vertices.is_settled({&v}, far)) continue;
      border_.looked_at_cell(*world_.vertices.star(scope_, {&v}));
    }
  }

  [[nodiscard]] HaloView<D> view() const {
    HaloView<D> view;
    for (const VertexHandle h : own_) add_received(pool()[h], border_.birth(h), view.receives);
    for (const VertexHandle h : others_) add_given(pool()[h], border_.birth(h), view.gives);
    std::sort(view.gives.begin(), view.gives.end());
    std::sort(view.receives.begin(), view.receives.end());
    view.fault = border_.first_fault();
    return view;
  }
  void add_received(const Vertex<D>& v, const Born<D>& born, std::vector<HaloBirth<D>>& to) const {
    if (born.turn.stage == Stage::quadtree || border_.owns(born.turn.p)) return;
    to.push_back({input_.tiles.owner(born.turn.p), v.p, born});
  }
  void add_given(const Vertex<D>& v, const Born<D>& born, std::vector<HaloBirth<D>>& to) const {
    if (born.turn.stage == Stage::quadtree || !border_.owns(born.turn.p)) return;
    to.push_back({input_.tiles.owner(v.p), v.p, born});
  }
  [[nodiscard]] std::vector<HaloLook<D>> looks() {
    std::vector<Point<D>> places;
    std::vector<std::size_t> owners;
    places.reserve(others_.size());
    owners.reserve(others_.size());
    for (const VertexHandle h : others_) {
      places.push_back(pool()[h].p);
      owners.push_back(input_.tiles.owner(places.back()));
    }
    const PlaceTree<D> around(places);
    std::vector<HaloLook<D>> looks;
    for (const auto& look : border_.take_looks()) {
      const auto first = static_cast<std::ptrdiff_t>(looks.size());
      input_.tiles.for_each_met(look.ball, [&](std::size_t tile) {
        if (tile != tile_) looks.push_back({tile, look.turn, look.ball, 0});
      });
      around.for_each_in(look.ball, [&](std::uint32_t i) {
        const Born<D> born = border_.birth(others_[i]);
        if (!(born.turn < look.turn)) return;
        for (auto it = looks.begin() + first; it != looks.end(); ++it) {
          if (it->tile == owners[i]) it->seen += digest<D>(places[i], born);
        }
      });
    }
    std::stable_sort(looks.begin(), looks.end(),
                     [](const auto& a, const auto& b) { return a.tile < b.tile; });
    return looks;
  }

  static constexpr std::uint32_t kNoNumber = ~std::uint32_t{0};

  const HaloInput<D>& input_;
  std::size_t tile_;
  HaloBorder<D> border_;
  sac::PlainScope scope_;
  W world_;
  HaloNames names_;
  std::vector<VertexHandle> inputs_, own_, others_;
};

}  // namespace

template <int D>
std::uint64_t digest(const Point<D>& p, const Born<D>& born) {
  std::uint64_t h = sac::mix(place_hash(p) + static_cast<std::uint64_t>(born.turn.stage));
  h = sac::mix(h + born.turn.rank);
  h = sac::mix(h + born.turn.order);
  h = sac::mix(h + place_hash(born.turn.p));
  return sac::mix(h + static_cast<std::uint64_t>(static_cast<std::int64_t>(born.bucket)));
}

template <int D>
HaloRun<D> run_for_tile(const HaloInput<D>& input, std::size_t tile,
                        const std::vector<HaloPoint<D>>& points,
                        const std::function<void()>& step) {
  Run<D> run(input, tile);
  run.refine(points, step);
  return run.result();
}

template std::uint64_t digest<2>(const Point<2>&, const Born<2>&);
template HaloRun<2> run_for_tile(const HaloInput<2>&, std::size_t, const std::vector<HaloPoint<2>>&,
                                 const std::function<void()>&);
#ifndef MESHER_PLANE_ONLY
template std::uint64_t digest<3>(const Point<3>&, const Born<3>&);
template HaloRun<3> run_for_tile(const HaloInput<3>&, std::size_t, const std::vector<HaloPoint<3>>&,
                                 const std::function<void()>&);
#endif

}  // namespace mesher::detail
