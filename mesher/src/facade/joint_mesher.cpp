// Edits of all processes become those of each; parts become changes and meshes.
#include "facade/joint_mesher.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>

#include "facade/settled.hpp"
#include "facade/state.hpp"
#include "facade/tiled_plane_state.hpp"
#ifndef MESHER_PLANE_ONLY
#include "facade/tiled_space_state.hpp"
#endif
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
  if (may_be_tiled(several, edits)) return options;
  throw Error(ErrorCode::bad_option,
              "on several processes there are no recorded weights and no rule but radius-edge");
}

// What is said of limits, and of what keeps angles from their bounds, needs all points.
template <int D>
bool may_have_divided_points(const Options<D>& options) {
  return !LimitsOf<D>(options, mesh_box(options)).any() && !bounds_dihedrals(options);
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

template <int D>
void pack(const Mesh<D>& mesh, Packer& to) {
  to.put_all(mesh.vertices), to.put_all(mesh.kinds), to.put_all(mesh.simplices);
  to.put_all(mesh.edges), to.put_all(mesh.faces);
}

// Vertices may be in several parts, simplices are not, nor what is on features.
template <int D>
Mesh<D> joined_mesh(const std::vector<Bytes>& parts) {
  using Simplex = typename Mesh<D>::Simplex;
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  std::vector<Simplex> simplices;
  OnFeatures on;
  for (const Bytes& bytes : parts) {
    Unpacker part(bytes);
    const auto first = static_cast<std::uint32_t>(places.size());
    append(places, part.take_all<Point<D>>());
    append(kinds, part.take_all<VertexKind>());
    for (Simplex s : part.take_all<Simplex>()) {
      for (std::uint32_t& corner : s) corner += first;
      simplices.push_back(s);
    }
    for (const auto& e : part.template take_all<typename Mesh<D>::Edge>()) {
      on.edges.push_back({first + e.low, first + e.high, e.feature});
    }
    for (const auto& f : part.template take_all<typename Mesh<D>::Face>()) {
      const auto& [a, b, c] = f.corners;
      on.faces.push_back({{first + a, first + b, first + c}, f.polygon});
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
  for (auto& e : on.edges) e.from = name[e.from], e.to = name[e.to];
  for (auto& f : on.faces) {
    for (std::uint32_t& corner : f.corners) corner = name[corner];
  }
  return canonical<D>(places_once, kinds_once, 0, on, [&](auto&& visit) {
    for (const Simplex& s : simplices) visit(s);
  });
}

void pack(const mesher::Polygon& polygon, Packer& to) {
  to.put(std::uint64_t{polygon.loops.size()});
  for (const auto& loop : polygon.loops) to.put_all(loop);
  to.put_all(polygon.edges), to.put_all(polygon.points), to.put(polygon.marker);
}
mesher::Polygon unpack_polygon(PolygonId id, Unpacker& from) {
  mesher::Polygon polygon{id, {}};
  for (auto loops = from.take<std::uint64_t>(); loops > 0; --loops) {
    polygon.loops.push_back(from.take_all<PointId>());
  }
  polygon.edges = from.take_all<std::array<PointId, 2>>();
  polygon.points = from.take_all<PointId>();
  polygon.marker = from.take<std::int64_t>();
  return polygon;
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
    : peers_(std::move(peers)),
      options_(options),
      edits_(options.domain, box_),
      features_(options.rule, edits_) {
  together(*peers_, [&] {
    predicates::self_test();
    options_ = settled(options);
    box_ = mesh_box(options_);
    const bool divides = !peers_->is_alone() && may_have_divided_points(options_);
    if (divides) directory_ = std::make_unique<PointDirectory<D>>(*peers_);
    Joint first = state_for(tileable(options_), false, 0,
                            divides ? PointsOf::this_process : PointsOf::all_processes);
    state_ = std::move(first.state);
    part_ = first.part;
  });
  require_equal_options();
}

template <int D>
void JointMesher<D>::require_equal_options() {
  Packer mine;
  together(*peers_, [&] {
    mine.put(options_.domain), mine.put(options_.rho), mine.put(options_.threads);
    mine.put(std::uint64_t{options_.max_vertices});
    if constexpr (D == 3) mine.put(options_.min_dihedral);
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

template <int D>
void JointMesher<D>::announce(LineEdit edit) {
  busy_.require_idle();
  announced_lines_.push_back(std::move(edit));
}
template <int D>
void JointMesher<D>::announce(PolygonEdit edit) {
  busy_.require_idle();
  announced_polygons_.push_back(std::move(edit));
}

template <int D>
const KnownPoints<D>& JointMesher<D>::known() const noexcept {
  if (all_points_ != nullptr) return *all_points_;
  if (directory_ != nullptr) return *directory_;
  return *state_;
}

template <int D>
void JointMesher<D>::know_all_points() {
  std::vector<GraphPoint<D>> all = told_points(peers_->size());
  together(*peers_, [&] { all_points_ = std::make_unique<AllPoints<D>>(std::move(all), box_); });
}

// Points stay divided while there is nothing else.
template <int D>
void JointMesher<D>::collect(const RunControl& control) {
  if (directory_ == nullptr) return collect_all(control);
  std::uint64_t are_points =
      announced_lines_.empty() && announced_polygons_.empty() && announced_limits_.is_empty();
  peers_->least({&are_points, 1});
  if (are_points == 0) {
    know_all_points();
    return collect_all(control);
  }
  together(*peers_, [&] {
    if (control.stop.stop_requested()) throw sac::Cancelled();
  });
  directory_->collect(announced_, edits_);
  together(*peers_, [&] { directory_->prepare(edits_.pending()); });
}

// Those of all processes, made in all.
template <int D>
void JointMesher<D>::collect_all(const RunControl& control) {
  Packer mine;
  together(*peers_, [&] {
    if (control.stop.stop_requested()) throw sac::Cancelled();
    mine.put_all(announced_);
    mine.put(std::uint64_t{announced_lines_.size()});
    for (const LineEdit& edit : announced_lines_) {
      mine.put(edit.id), mine.put(edit.to.has_value());
      if (edit.to) mine.put_all(*edit.to);
    }
    mine.put(std::uint64_t{announced_polygons_.size()});
    for (const PolygonEdit& edit : announced_polygons_) {
      mine.put(edit.id), mine.put(edit.to.has_value());
      if (edit.to) pack(*edit.to, mine);
    }
    announced_limits_.pack(options_.domain, mine);
  });
  const std::vector<Bytes> all = peers_->gather(mine.bytes());
  std::vector<AnnouncedLimits<D>> limits;
  together(*peers_, [&] {
    std::vector<Unpacker> rest(all.begin(), all.end());
    for (Unpacker& some : rest) {
      for (const Announcement& edit : some.template take_all<Announcement>()) {
        edit.make(known(), edits_);
      }
    }
    edits_.require_apart(known());
    collect_features(rest);
    limits = announced_limits_.joined(rest, peers_->self());
  });
  limit_all(limits);
}

// Lines of all processes, then polygons.
template <int D>
void JointMesher<D>::collect_features(std::vector<Unpacker>& rest) {
  std::vector<PolygonEdit> polygons;
  for (Unpacker& some : rest) {
    for (auto lines = some.template take<std::uint64_t>(); lines > 0; --lines) {
      const auto id = some.template take<LineId>();
      if (some.template take<bool>()) {
        features_.insert_line(known(), id, some.template take_all<PointId>());
      } else {
        features_.remove_line(id);
      }
    }
    for (auto count = some.template take<std::uint64_t>(); count > 0; --count) {
      PolygonEdit& edit = polygons.emplace_back();
      edit.id = some.template take<PolygonId>();
      if (some.template take<bool>()) edit.to = unpack_polygon(edit.id, some);
    }
  }
  for (const PolygonEdit& edit : polygons) {
    edit.to ? features_.insert_polygon(known(), *edit.to) : features_.remove_polygon(edit.id);
  }
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
  features_.discard();
  limits_.clear();
  all_points_.reset();
}

// --- Updates ---------------------------------------------------------------------------------

template <int D>
Change<D> JointMesher<D>::update(const RunControl& control, Told told) {
  const ReentryGuard::Run running(busy_);
  try {
    collect(control);
    together(*peers_, [&] { features_.prepare(); });
    Change<D> change = run_or_alone(control, told);
    limits_.commit(options_);
    features_.commit();
    if (directory_ != nullptr) directory_->commit();
    clear_collected();
    std::uint64_t points = directory_ != nullptr ? directory_->size() : state_->size();
    if (directory_ != nullptr) peers_->sum({&points, 1});
    size_ = static_cast<std::size_t>(points);
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
  if (!state_->ran() || all_points_ != nullptr) return run_anew(control, told, 0);
  std::optional<Edits<D>> edits;
  together(*peers_, [&] {
    edits.emplace(Edits<D>{edits_.pending().sorted(), features_.lines(), features_.polygons(),
                           limits_.edit(options_)});
  });
  if (!state_->takes(*edits)) return run_anew(control, told, 0);
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
    change = part_->tells_all() ? told_of_all(std::move(change), told)
                                : told_of({std::move(change), {}}, told);
  });
}

template <int D>
Change<D> JointMesher<D>::run_or_alone(const RunControl& control, Told told) {
  std::exception_ptr other;
  bool is_given_up = false;
  const auto attempt = [&](auto&& run_it) -> std::optional<Change<D>> {
    is_given_up = false;
    try {
      return run_it();
    } catch (const NotInTiles&) {
    } catch (const NotInTilesYet&) {
      is_given_up = true;
    } catch (...) {
      other = std::current_exception();
    }
    require_none(other);
    return std::nullopt;
  };
  if (auto change = attempt([&] { return run(control, told); })) return std::move(*change);
  if (is_given_up) {
    if (auto change = attempt([&] { return run_anew(control, told, 0); })) {
      return std::move(*change);
    }
  }
  SAC_ENSURES(!shares_points());  // tiles of points alone refuse what one process would
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

template <int D>
auto JointMesher<D>::state_for(const Options<D>& options, bool has_features, std::size_t tiles,
                               PointsOf which) -> Joint {
  const auto make = [&]<class State>(std::type_identity<State>, auto... more) {
    auto state = std::make_unique<State>(options, *peers_, tiles, more...);
    const PartOfMesh<D>* part = state.get();
    return Joint{std::move(state), part};
  };
  if constexpr (D == 2) {
    if (has_features) return make(std::type_identity<TiledPlaneState>());
  }
#ifndef MESHER_PLANE_ONLY
  if constexpr (D == 3) {
    if (has_features) return make(std::type_identity<TiledSpaceState>());
  }
#endif
  return make(std::type_identity<TiledState<D>>(), which);
}

// All that there shall be, as new ones; where points are divided, those of directory_.
template <int D>
PointEdits<D> JointMesher<D>::points_to_be() const {
  return size_ != 0 ? edits_.all(known()) : edits_.pending().sorted();
}

// A state from the start, of all that there is.
template <int D>
Change<D> JointMesher<D>::run_anew(const RunControl& control, Told told, std::size_t tiles) {
  const PointsOf which = shares_points() ? PointsOf::this_process : PointsOf::all_processes;
  PointEdits<D> points;
  StagedLines lines;
  StagedPolygons polygons;
  Joint fresh;
  typename AnyState<D>::Accept accept;
  together(*peers_, [&] {
    points = points_to_be();
    lines = all_of(features_.lines()), polygons = all_of(features_.polygons());
    fresh = state_for(limits_.applied_to(options_), lines.has_edits() || polygons.has_edits(),
                      tiles, which);
    accept = [&](Change<D>& whole) { whole = told_anew(std::move(whole), fresh, told); };
  });
  Edits<D> edits{std::move(points), lines, polygons};
  Change<D> change = fresh.state->first_run(std::move(edits), control, accept);
  state_ = std::move(fresh.state);
  part_ = fresh.part;
  if (which == PointsOf::all_processes) directory_.reset();
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
    const StagedLines lines = all_of(features_.lines());
    const StagedPolygons polygons = all_of(features_.polygons());
    const Edits<D> edits{points_to_be(), lines, polygons};
    static_cast<void>(alone.first_run(edits, control, [](Change<D>&) {}));
  });
}

// --- Changes ---------------------------------------------------------------------------------

// By the change from nothing.
template <int D>
auto JointMesher<D>::part_from_last(Change<D>& whole) const -> Part {
  Part part{std::move(whole), {}};
  if (!state_->ran()) return part;
  const Change<D> was = part_->whole();
  count_from(was, part.change);
  const auto& before = was.vertices_added;
  for (const Point<D>& p : part.change.vertices_removed) {
    const auto at = std::lower_bound(before.begin(), before.end(), p) - before.begin();
    part.kinds_removed.push_back(was.kinds_added[static_cast<std::size_t>(at)]);
  }
  return part;
}

template <int D>
void JointMesher<D>::pack_part(const Part& part, Packer& to) {
  const Change<D>& change = part.change;
  to.put_all(change.vertices_added);
  to.put_all(change.kinds_added);
  to.put_all(change.vertices_removed);
  to.put_all(part.kinds_removed);
  to.put_all(change.kinds_changed);
  to.put_all(change.simplices_added);
  to.put_all(change.simplices_removed);
  to.put_all(change.edges_added), to.put_all(change.edges_removed);
  to.put_all(change.faces_added), to.put_all(change.faces_removed);
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
    append(all.edges_added, part.take_all<mesher::LineEdge<D>>());
    append(lost.edges_added, part.take_all<mesher::LineEdge<D>>());
    append(all.faces_added, part.take_all<mesher::PolygonFace<D>>());
    append(lost.faces_added, part.take_all<mesher::PolygonFace<D>>());
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
  together(*peers_, [&] { pack_part(part, mine); });
  const std::size_t to = told == Told::first ? 0 : peers_->size();
  const std::vector<Bytes> parts = tell_to(*peers_, to, mine.bytes());
  Change<D> change;
  together(*peers_, [&] {
    if (told == Told::first && peers_->self() != 0) return;
    change = joined(parts);
    change.angles = std::move(part.change.angles);
    change.guard = std::move(part.change.guard);
  });
  return change;
}

// Of a change that all have.
template <int D>
Change<D> JointMesher<D>::told_of_all(Change<D> change, Told told) const {
  peers_->sum({&change.calls.executed, 1});
  Change<D> all;
  together(*peers_, [&] {
    if (told == Told::own) all = own_part(std::move(change), tiles());
    if (told == Told::all || (told == Told::first && peers_->self() == 0)) all = std::move(change);
  });
  return all;
}

// Of the change from nothing by which `fresh` begins; angles and the guard are judged by what is
// new in the whole mesh.
template <int D>
Change<D> JointMesher<D>::told_anew(Change<D> whole, const Joint& fresh, Told told) const {
  Part part;
  together(*peers_, [&] {
    if (fresh.part->tells_all()) whole = own_part(std::move(whole), fresh.part->tiles());
    part = part_from_last(whole);
  });
  if (!state_->ran() || !fresh.part->has_features()) return told_of(std::move(part), told);
  Part same;
  together(*peers_, [&] { same = part; });
  Change<D> all = told_of(std::move(same), Told::all);
  fresh.state->judge_new(all);
  if (told == Told::all) return all;
  part.change.angles = std::move(all.angles), part.change.guard = std::move(all.guard);
  return told_of(std::move(part), told);
}

// --- Reading ---------------------------------------------------------------------------------

template <int D>
Mesh<D> JointMesher<D>::own_mesh() const {
  busy_.require_idle();
  return state_->ran() ? part_->own_mesh() : Mesh<D>();
}

template <int D>
std::vector<Polyline> JointMesher<D>::lines() const {
  std::vector<Polyline> all;
  for (const auto& [id, points] : features_.lines().committed()) all.push_back({id, points});
  return all;
}
template <int D>
std::vector<mesher::Polygon> JointMesher<D>::polygons() const {
  std::vector<mesher::Polygon> all;
  for (const auto& [id, polygon] : features_.polygons().committed()) all.push_back(polygon);
  return all;
}

template <int D>
std::vector<GraphPoint<D>> JointMesher<D>::gather_points(std::size_t to) const {
  std::vector<GraphPoint<D>> points;
  together(*peers_, [&] {
    SAC_EXPECTS(to < peers_->size());
    if (directory_ == nullptr && peers_->self() == to) points = state_->points();
  });
  return directory_ == nullptr ? points : told_points(to);
}

// Where points are divided: to one process, or to all if it is nobody's number.
template <int D>
std::vector<GraphPoint<D>> JointMesher<D>::told_points(std::size_t to) const {
  Packer mine;
  together(*peers_, [&] { mine.put_all(directory_->points()); });
  const std::vector<Bytes> parts = tell_to(*peers_, to, mine.bytes());
  std::vector<GraphPoint<D>> points;
  together(*peers_, [&] {
    if (peers_->self() != to && to < peers_->size()) return;
    for (const Bytes& part : parts) append(points, Unpacker(part).take_all<GraphPoint<D>>());
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.id < b.id; });
  });
  return points;
}

template <int D>
JointNumbers<D> JointMesher<D>::numbers(const Mesh<D>& own) const {
  return state_->ran() ? joint_numbers(own, tiles(), *peers_) : JointNumbers<D>();
}

template <int D>
Mesh<D> JointMesher<D>::gather(std::size_t to) const {
  Packer mine;
  Mesh<D> whole;
  together(*peers_, [&] {
    SAC_EXPECTS(to < peers_->size());
    whole = own_mesh();
    if (peers_->is_alone()) return;
    pack(whole, mine);
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
  if (!state_->ran() || !part_->tells_all()) {
    s.vertices = static_cast<std::size_t>(sums[0]);
    s.simplices = static_cast<std::size_t>(sums[1]);
  }
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
  if (!state_->ran()) return;
  state_->check_invariants();
  if (directory_ == nullptr) return;
  std::array<std::uint64_t, 2> known{directory_->size(), state_->size()};
  peers_->sum(known);
  SAC_INVARIANT(known[0] == known[1] && known[0] == size_);
}

template class JointMesher<2>;
#ifndef MESHER_PLANE_ONLY
template class JointMesher<3>;
#endif

}  // namespace mesher::detail
