// Edits of all processes become those of each; parts become changes and meshes.
#include "facade/joint_mesher.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>

#include "facade/settled.hpp"
#include "facade/state.hpp"
#include "facade/whole_change.hpp"
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
  const Edits<D> edits{PointEdits<D>(2), lines, polygons};
  bool has_slivers = false;  // which threads may have in tiles, and processes not
  if constexpr (D == 3) has_slivers = options.min_dihedral != 0;
  if (!has_slivers && may_be_tiled(several, edits)) return options;
  throw Error(ErrorCode::bad_option,
              "on several processes there is no min_dihedral and no rule but radius-edge");
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
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
    pack_limits(options_, mine);
  });
  require_equal(mine, "the options differ between processes");
}

template <int D>
void JointMesher<D>::require_equal(const Packer& mine, const char* what) {
  const std::vector<Bytes> all = peers_->gather(mine.bytes());
  for (const Bytes& one : all) {
    if (one != all.front()) throw Error(ErrorCode::bad_option, what);
  }
}

// --- Edits -----------------------------------------------------------------------------------

template <int D>
void JointMesher<D>::announce(const Announcement& edit) {
  busy_.require_idle();
  announced_.push_back(edit);
}
template <int D>
void JointMesher<D>::announce(AnnouncedLimits<D> limits) {
  busy_.require_idle();
  announced_limits_.announce(std::move(limits));
}

// Those of all processes, made in all.
template <int D>
void JointMesher<D>::collect(const RunControl& control) {
  Packer mine;
  together(*peers_, [&] {
    if (control.stop.stop_requested()) throw sac::Cancelled();
    mine.put_all(announced_);
    announced_limits_.pack(options_.domain, mine);
  });
  const std::vector<Bytes> all = peers_->gather(mine.bytes());
  std::vector<AnnouncedLimits<D>> limits;
  together(*peers_, [&] {
    using Judged = typename AnnouncedPoints<D>::Judged;
    std::vector<Unpacker> rest(all.begin(), all.end());
    for (Unpacker& some : rest) {
      for (const Announcement& edit : some.template take_all<Announcement>()) {
        if (edit.kind == Kind::insert) edits_.insert(*state_, edit.id, edit.p, Judged::at_the_end);
        if (edit.kind == Kind::remove) edits_.remove(*state_, edit.id);
        if (edit.kind == Kind::move) edits_.move(*state_, edit.id, edit.p);
      }
    }
    edits_.require_apart(*state_);
    limits = announced_limits_.joined(rest, peers_->self());
  });
  limit_all(limits);
}

// Boxes are forgotten where fields are one object: this must be so in all.
template <int D>
void JointMesher<D>::limit_all(const std::vector<AnnouncedLimits<D>>& limits) {
  if (limits.empty()) return;
  Packer mine;
  together(*peers_, [&] {
    for (const auto& [box, is] : limits) {
      AllLimits<D> all = limits_.as_pending(options_);
      box ? all.set_within(*box, is) : static_cast<void>(all = {is, {}, all.regions});
      limits_.set(std::move(all), {box.value_or(options_.domain)}, options_, box_);
    }
    if (const auto edit = limits_.edit(options_)) mine.put_all(edit->where);
    pack_limits(limits_.applied_to(options_), mine);
  });
  require_equal(mine, "limits of size differ between processes");
}

template <int D>
void JointMesher<D>::clear_collected() noexcept {
  edits_.clear();
  limits_.clear();
}

// --- Updates ---------------------------------------------------------------------------------

template <int D>
Change<D> JointMesher<D>::update(const RunControl& control, Told told) {
  const ReentryGuard::Run running(busy_);
  try {
    collect(control);
    Change<D> change = run_or_alone(control, told);
    limits_.commit(options_);
    clear_collected();
    discard_edits();
    return change;
  } catch (const sac::Cancelled&) {
    clear_collected();
    fail_cancelled();
  } catch (...) {
    clear_collected();
    discard_edits();
    throw;
  }
}

template <int D>
Change<D> JointMesher<D>::run(const RunControl& control, Told told) {
  if (!state_->ran()) return run_anew(control, told, 0);
  std::optional<Edits<D>> edits;
  together(*peers_, [&] {
    edits.emplace(
        Edits<D>{edits_.pending().sorted(), no_lines_, no_polygons_, limits_.edit(options_)});
  });
  if (state_->is_sooner_anew(*edits)) {
    std::exception_ptr other;
    try {
      return run_anew(control, told, 0);
    } catch (const Error&) {  // it is said in the words of an update
    } catch (...) {
      other = std::current_exception();
    }
    require_none(other);
  }
  return state_->propagate(*edits, control, [&](Change<D>& change) {
    change = told_of({change, {}}, told);
  });
}

template <int D>
Change<D> JointMesher<D>::run_or_alone(const RunControl& control, Told told) {
  std::exception_ptr other;
  try {
    return run(control, told);
  } catch (const NotInTiles&) {
  } catch (...) {
    other = std::current_exception();
  }
  require_none(other);
  refuse_alone(control);
  return run_anew(control, told, 1);  // whose calls are those of one process
}

// All have failed. One of them may have had no memory to throw what the others have: then none goes
// on. Throws: `other`, or std::bad_alloc, if it is something in one of them.
template <int D>
void JointMesher<D>::require_none(const std::exception_ptr& other) {
  std::uint64_t is_none = other ? 0 : 1;
  peers_->least({&is_none, 1});
  if (other) std::rethrow_exception(other);
  if (is_none == 0) throw std::bad_alloc();
}

// A state from the start, of all points.
template <int D>
Change<D> JointMesher<D>::run_anew(const RunControl& control, Told told, std::size_t tiles) {
  PointEdits<D> points;
  std::unique_ptr<TiledState<D>> fresh;
  together(*peers_, [&] {
    points = state_->ran() ? edits_.all(*state_) : edits_.pending().sorted();
    fresh = std::make_unique<TiledState<D>>(limits_.applied_to(options_), *peers_, tiles);
  });
  Edits<D> edits{std::move(points), no_lines_, no_polygons_};
  Change<D> change = fresh->first_run(std::move(edits), control, [&](Change<D>& whole) {
    Part part;
    together(*peers_, [&] { part = part_from_last(whole); });
    whole = told_of(std::move(part), told);
  });
  state_ = std::move(fresh);
  return change;
}

// What tiles have refused: the first process says why, if it is not to be had at all.
template <int D>
void JointMesher<D>::refuse_alone(const RunControl& control) {
  together(*peers_, [&] {
    if (peers_->self() != 0) return;
    Options<D> now = limits_.applied_to(options_);
    now.threads = 1;
    State<D> alone(now);
    const Edits<D> edits{edits_.all(*state_), no_lines_, no_polygons_};
    static_cast<void>(alone.first_run(edits, control, [](Change<D>&) {}));
  });
}

// --- Changes ---------------------------------------------------------------------------------

// By the change from nothing.
template <int D>
auto JointMesher<D>::part_from_last(Change<D>& whole) const -> Part {
  Part part{std::move(whole), {}};
  if (!state_->ran()) return part;
  const Change<D> was = state_->whole();
  count_from(was, part.change);
  const auto& before = was.vertices_added;
  for (const Point<D>& p : part.change.vertices_removed) {
    const auto at = std::lower_bound(before.begin(), before.end(), p) - before.begin();
    part.kinds_removed.push_back(was.kinds_added[static_cast<std::size_t>(at)]);
  }
  return part;
}

template <int D>
void JointMesher<D>::pack(const Part& part, Packer& to) {
  const Change<D>& change = part.change;
  to.put_all(change.vertices_added);
  to.put_all(change.kinds_added);
  to.put_all(change.vertices_removed);
  to.put_all(part.kinds_removed);
  to.put_all(change.kinds_changed);
  to.put_all(change.simplices_added);
  to.put_all(change.simplices_removed);
  to.put(change.calls);
}

// Parts have nothing in common, but that one may have lost what another has got.
template <int D>
Change<D> JointMesher<D>::joined(const std::vector<Bytes>& parts) {
  using Simplices = std::vector<std::array<Point<D>, D + 1>>;
  Change<D> all, lost;
  std::vector<std::pair<Point<D>, VertexKind>> come, gone;
  const auto take_vertices = [](Unpacker& part, auto& to) {
    const auto places = part.take_all<Point<D>>();
    const auto kinds = part.take_all<VertexKind>();
    for (std::size_t i = 0; i < places.size(); ++i) {
      to.emplace_back(places[i], i < kinds.size() ? kinds[i] : VertexKind());
    }
  };
  Simplices removed;
  for (const Bytes& bytes : parts) {
    Unpacker part(bytes);
    take_vertices(part, come);
    take_vertices(part, gone);
    append(all.kinds_changed, part.take_all<KindChange<D>>());
    append(all.simplices_added, part.take_all<std::array<Point<D>, D + 1>>());
    append(removed, part.take_all<std::array<Point<D>, D + 1>>());
    all.calls.executed += part.take<CallCounts>().executed;
  }
  std::sort(come.begin(), come.end());
  std::sort(gone.begin(), gone.end());
  const auto list = [](const auto& some, Change<D>& in) {
    for (const auto& [place, kind] : some) {
      in.vertices_added.push_back(place);
      in.kinds_added.push_back(kind);
    }
  };
  list(come, all), list(gone, lost);
  std::sort(all.simplices_added.begin(), all.simplices_added.end());
  std::sort(removed.begin(), removed.end());
  lost.simplices_added = std::move(removed);
  count_from(std::move(lost), all);
  std::sort(all.kinds_changed.begin(), all.kinds_changed.end(),
            [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  return all;
}

template <int D>
Change<D> JointMesher<D>::told_of(Part part, Told told) const {
  if (told == Told::own || peers_->is_alone()) return std::move(part.change);
  Packer mine;
  together(*peers_, [&] { pack(part, mine); });
  const std::size_t to = told == Told::first ? 0 : peers_->size();
  const std::vector<Bytes> parts = tell_to(*peers_, to, mine.bytes());
  Change<D> change;
  together(*peers_, [&] {
    if (told == Told::all || peers_->self() == 0) change = joined(parts);
  });
  return change;
}

// --- Reading ---------------------------------------------------------------------------------

template <int D>
Mesh<D> JointMesher<D>::own_mesh() const {
  busy_.require_idle();
  return state_->ran() ? state_->mesh() : Mesh<D>();
}

template <int D>
JointNumbers JointMesher<D>::numbers(const Mesh<D>& own) const {
  return state_->ran() ? joint_numbers(own, tiles(), *peers_) : JointNumbers();
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
std::string JointMesher<D>::certificate() const {
  return state_->ran() ? tiles().certificate() : std::string();
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
