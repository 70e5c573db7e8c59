// Edits of all processes become those of each; parts become changes and meshes.
#include "facade/joint_mesher.hpp"

#include <algorithm>
#include <numeric>

#include "facade/settled.hpp"
#include "mesh/canonical.hpp"
#include "mesher/predicates.hpp"
#include "program/meter.hpp"
#include "rules/mesh_box.hpp"

namespace mesher::detail {

namespace {

template <int D>
const Options<D>& tileable(const Options<D>& options) {
  Options<D> several = options;
  several.threads = std::max(several.threads, 2);
  const StagedLines lines;
  const StagedPolygons polygons;
  Edits<D> edits{PointEdits<D>(2), lines, polygons};
  const bool limited = bounds_dihedrals(options) || LimitsOf<D>(options, mesh_box(options)).any();
  if (!limited && may_be_tiled(several, edits)) return options;
  throw Error(ErrorCode::bad_option,
              "on several processes there are no limits of size, no min_dihedral and no rule but "
              "radius-edge");
}

template <int D>
void pack(const Change<D>& change, Packer& to) {
  to.put_all(change.vertices_added);
  to.put_all(change.kinds_added);
  to.put_all(change.vertices_removed);
  to.put_all(change.kinds_changed);
  to.put_all(change.simplices_added);
  to.put_all(change.simplices_removed);
  to.put(change.calls);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

// The parts have nothing in common.
template <int D>
Change<D> joined(const std::vector<Bytes>& parts) {
  Change<D> all;
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  for (const Bytes& bytes : parts) {
    Unpacker part(bytes);
    append(places, part.take_all<Point<D>>());
    append(kinds, part.take_all<VertexKind>());
    append(all.vertices_removed, part.take_all<Point<D>>());
    append(all.kinds_changed, part.take_all<KindChange<D>>());
    append(all.simplices_added, part.take_all<std::array<Point<D>, D + 1>>());
    append(all.simplices_removed, part.take_all<std::array<Point<D>, D + 1>>());
    const auto calls = part.take<CallCounts>();
    all.calls.executed += calls.executed;
  }
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
  for (const std::size_t i : order) {
    all.vertices_added.push_back(places[i]);
    all.kinds_added.push_back(kinds[i]);
  }
  std::sort(all.vertices_removed.begin(), all.vertices_removed.end());
  std::sort(all.kinds_changed.begin(), all.kinds_changed.end(),
            [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  std::sort(all.simplices_added.begin(), all.simplices_added.end());
  std::sort(all.simplices_removed.begin(), all.simplices_removed.end());
  return all;
}

// Vertices may be in several parts, simplices are not.
template <int D>
Mesh<D> joined_mesh(const std::vector<Bytes>& parts) {
  using Simplex = typename Mesh<D>::Simplex;
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  std::vector<Simplex> simplices;
  for (const Bytes& bytes : parts) {
    Unpacker part(bytes);
    const auto first = static_cast<std::uint32_t>(places.size());
    append(places, part.take_all<Point<D>>());
    append(kinds, part.take_all<VertexKind>());
    for (Simplex s : part.take_all<Simplex>()) {
      for (std::uint32_t& corner : s) corner += first;
      simplices.push_back(s);
    }
  }
  std::vector<std::uint32_t> order(places.size()), name(places.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return places[a] < places[b]; });
  std::vector<Point<D>> places_once;
  std::vector<VertexKind> kinds_once;
  for (const std::uint32_t i : order) {
    if (places_once.empty() || places_once.back() != places[i]) {
      places_once.push_back(places[i]);
      kinds_once.push_back(kinds[i]);
    }
    name[i] = static_cast<std::uint32_t>(places_once.size() - 1);
  }
  for (Simplex& s : simplices) {
    for (std::uint32_t& corner : s) corner = name[corner];
  }
  return canonical<D>(places_once, kinds_once, 0, {}, [&](auto&& visit) {
    for (const Simplex& s : simplices) visit(s);
  });
}

// What only the process `to` is told; all, if it is nobody's number.
std::vector<Bytes> tell_to(Peers& peers, std::size_t to, const Bytes& mine) {
  Peers::Views views;
  together(peers, [&] {
    views.resize(peers.size());
    for (std::size_t k = 0; k < views.size(); ++k) {
      if (k == to || to >= views.size()) views[k] = mine;
    }
  });
  return peers.exchange(views);
}

}  // namespace

template <int D>
JointMesher<D>::JointMesher(std::unique_ptr<Peers> peers, const Options<D>& options)
    : peers_(std::move(peers)), options_(options), edits_(options.domain, box_) {
  together(*peers_, [&] {
    predicates::self_test();
    options_ = settled(options);
    box_ = mesh_box(options_);
    state_ = std::make_unique<TiledState<D>>(tileable(options_), *peers_);
  });
  require_equal_options();
}

template <int D>
void JointMesher<D>::require_equal_options() {
  Packer mine;
  together(*peers_, [&] {
    mine.put(options_.domain), mine.put(options_.rho), mine.put(options_.threads);
    mine.put(std::uint64_t{options_.max_vertices});
  });
  const std::vector<Bytes> all = peers_->gather(mine.bytes());
  for (const Bytes& one : all) {
    if (one == all.front()) continue;
    throw Error(ErrorCode::bad_option, "the options differ between processes");
  }
}

// --- Edits -----------------------------------------------------------------------------------

template <int D>
void JointMesher<D>::announce(const Announcement& edit) {
  busy_.require_idle();
  announced_.push_back(edit);
}

// Those of all processes, made in all.
template <int D>
void JointMesher<D>::collect(const RunControl& control) {
  Packer mine;
  together(*peers_, [&] {
    if (control.stop.stop_requested()) throw sac::Cancelled();
    mine.put_all(announced_);
  });
  const std::vector<Bytes> all = peers_->gather(mine.bytes());
  together(*peers_, [&] {
    using Judged = typename AnnouncedPoints<D>::Judged;
    for (const Bytes& some : all) {
      for (const Announcement& edit : Unpacker(some).take_all<Announcement>()) {
        if (edit.kind == Kind::insert) edits_.insert(*state_, edit.id, edit.p, Judged::at_the_end);
        if (edit.kind == Kind::remove) edits_.remove(*state_, edit.id);
        if (edit.kind == Kind::move) edits_.move(*state_, edit.id, edit.p);
      }
    }
    edits_.require_apart(*state_);
  });
}

// --- Updates ---------------------------------------------------------------------------------

template <int D>
Change<D> JointMesher<D>::update(const RunControl& control, Told told) {
  const ReentryGuard::Run running(busy_);
  try {
    collect(control);
    Change<D> change = run(control, told);
    edits_.clear();
    announced_.clear();
    return change;
  } catch (const sac::Cancelled&) {
    edits_.clear();
    fail_cancelled();
  } catch (...) {
    edits_.clear();
    announced_.clear();
    throw;
  }
}

template <int D>
Change<D> JointMesher<D>::run(const RunControl& control, Told told) {
  PointEdits<D> points;
  std::unique_ptr<TiledState<D>> fresh;
  together(*peers_, [&] {
    points = edits_.pending().sorted();
    if (!state_->ran()) fresh = std::make_unique<TiledState<D>>(options_, *peers_);
  });
  Edits<D> edits{std::move(points), no_lines_, no_polygons_};
  const auto accept = [&](Change<D>& change) { tell(change, told); };
  if (state_->ran()) return state_->propagate(edits, control, accept);
  Change<D> change = fresh->first_run(std::move(edits), control, accept);
  state_ = std::move(fresh);
  return change;
}

template <int D>
void JointMesher<D>::tell(Change<D>& change, Told told) const {
  if (told == Told::own || peers_->is_alone()) return;
  Packer mine;
  together(*peers_, [&] { pack(change, mine); });
  const std::size_t to = told == Told::first ? 0 : peers_->size();
  const std::vector<Bytes> parts = tell_to(*peers_, to, mine.bytes());
  together(*peers_, [&] {
    const bool is_told = told == Told::all || peers_->self() == 0;
    change = is_told ? joined<D>(parts) : Change<D>();
  });
}

// --- Reading ---------------------------------------------------------------------------------

template <int D>
Mesh<D> JointMesher<D>::own_mesh() const {
  busy_.require_idle();
  return state_->ran() ? state_->mesh() : Mesh<D>();
}

template <int D>
Mesh<D> JointMesher<D>::gather(std::size_t to) const {
  Packer mine;
  Mesh<D> whole;
  together(*peers_, [&] {
    SAC_EXPECTS(to < peers_->size());
    whole = own_mesh();
    if (peers_->is_alone()) return;
    mine.put_all(whole.vertices);
    mine.put_all(whole.kinds);
    mine.put_all(whole.simplices);
    whole = {};
  });
  if (peers_->is_alone()) return whole;
  const std::vector<Bytes> parts = tell_to(*peers_, to, mine.bytes());
  together(*peers_, [&] {
    if (peers_->self() == to) whole = joined_mesh<D>(parts);
  });
  return whole;
}

template <int D>
MeshStats JointMesher<D>::stats() const {
  MeshStats s = state_->stats();
  std::array<std::uint64_t, 5> sums{s.vertices, s.simplices, s.calls, s.edges, s.trace_bytes};
  peers_->sum(sums);
  s.vertices = static_cast<std::size_t>(sums[0]);
  s.simplices = static_cast<std::size_t>(sums[1]);
  s.calls = sums[2], s.edges = sums[3], s.trace_bytes = sums[4];
  for (double* seconds : {&s.seconds_quadtree, &s.seconds_steiner, &s.seconds_triangulate}) {
    constexpr double kTicks = 1e9;
    std::uint64_t rest = ~static_cast<std::uint64_t>(*seconds * kTicks);
    peers_->least({&rest, 1});
    *seconds = static_cast<double>(~rest) / kTicks;
  }
  return s;
}

template <int D>
JointCounts JointMesher<D>::counts() const {
  JointCounts all;
  all.exchanges = tiles().exchanges();
  for (std::size_t t = 0; t < tiles().size(); ++t) all.seen += tiles()[t].counts().seen;
  const std::uint64_t own = tiles().vertices();
  auto& e = all.exchanges;
  std::array<std::uint64_t, 5> sums{e.messages, e.messages_out, e.bytes_out, all.seen, own};
  peers_->sum(sums);
  e.messages = sums[0], e.messages_out = sums[1], e.bytes_out = sums[2];
  all.seen = sums[3], all.vertices = sums[4];
  std::array<std::uint64_t, 3> least{own, ~own, ~e.most_bytes_out};
  peers_->least(least);
  all.least_vertices = least[0], all.most_vertices = ~least[1], e.most_bytes_out = ~least[2];
  return all;
}

template <int D>
void JointMesher<D>::check_invariants() const {
  if (state_->ran()) state_->check_invariants();
}

template class JointMesher<2>;
#ifndef MESHER_PLANE_ONLY
template class JointMesher<3>;
#endif

}  // namespace mesher::detail
