// Stars cut by lines and planes, and places for vertices where they are.
#include "space/star_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "geometry/input_point.hpp"
#include "mesher/error.hpp"
#include "sets/make_set.hpp"
#include "space/encroachment.hpp"
#include "space/polygon_shape.hpp"
#include "space/yielding.hpp"

namespace mesher::detail {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// A copy is made if no vertex is nearer to it than this times what it is a copy of.
constexpr double kRoomForCopy = 0.25;

}  // namespace

StarCrossings::StarCrossings(Room& room, VoronoiCell3& cell, const VertexPool<3>& pool,
                             const FeaturesBeside& near)
    : cell_(cell),
      pool_(pool),
      near_(near),
      real_(room.real_),
      roles_(room.roles_),
      link_(room.link_),
      balls_(room.balls_),
      height_(room.height_),
      beside_(room.beside_),
      on_(room.on_) {
  real_.clear(), link_.clear(), balls_.clear();
  roles_.resize(index(cell.size()));  // those of `real_` are set
  const Point<3>& v = cell.center().p;
  box_ = {v, v};
  double reach2 = 0;
  for (int i = 0; i < cell.size(); ++i) {
    if (!cell.used(i) || !cell.real(i)) continue;
    real_.push_back(i);
    reach2 = std::max(reach2, squared(cell.neighbour(i)));
    for (int k = 0; k < 3; ++k) {
      box_.lo[k] = std::min(box_.lo[k], cell.place(i)[k]);
      box_.hi[k] = std::max(box_.hi[k], cell.place(i)[k]);
    }
  }
  reach_ = std::sqrt(reach2);
  rounding_ = 0x1p-40 * reach_ + resolution(v, reach_);
  for (int t = 0; t < cell.corners(); ++t) {
    const auto& ends = cell.ends(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const int p = ends[k], q = ends[(k + 1) % 3];
      if (!cell.real(p) || !cell.real(q)) continue;
      if (cell.place(p) < cell.place(q)) link_.push_back({p, q});  // it is seen from both sides
    }
    if (std::none_of(ends.begin(), ends.end(), [&](int i) { return cell.real(i); })) continue;
    balls_.push_back(
        {plus(v, cell.corner(t)), std::sqrt(cell.corner2(t)) * (1 + 0x1p-10) + rounding_});
  }
}

/// Whether a ball meets the star's box, and a ball of a simplex.
bool StarCrossings::meets(const Point<3>& middle, double radius) const noexcept {
  double away2 = 0;
  for (int k = 0; k < 3; ++k) {
    const double away = std::max({box_.lo[k] - middle[k], middle[k] - box_.hi[k], 0.0});
    away2 += away * away;
  }
  const double most = radius + rounding_;
  if (away2 > most * most) return false;
  return std::any_of(balls_.begin(), balls_.end(), [&](const Ball& ball) {
    const double within = ball.radius + radius;
    return squared_distance(middle, ball.centre) <= within * within;
  });
}

/// Of the edges, or polygons, that have come in this update those that may meet the star.
template <class F>
std::vector<const F*> StarCrossings::find_changed() const {
  std::vector<const F*> all;
  near_.store().visit_changed_in(
      [&](const Point<3>& x, double radius) { return !meets(x, radius); },
      [&](const auto& f) {
        if constexpr (std::is_same_v<std::decay_t<decltype(f)>, F>) {
          if (f.alive && meets(middle_of(f), reach_of(f))) all.push_back(&f);
        }
        return false;
      });
  return all;
}

/// The polygons that may meet the star; in no order, some repeatedly.
auto StarCrossings::find_polygons() const -> Polygons {
  FoundFeatures<Polygon> found;
  near_.store().visit_polygons_in(
      [&](const Point<3>& x, double radius) { return !meets(x, radius); },
      [&](const Polygon& f) noexcept { return found.take(f); });
  return std::move(found).all();
}

/// The edges that may; those that are only sides of polygons with few, with these.
auto StarCrossings::find_edges(const Polygons& polygons) const -> Edges {
  const FeatureStore& store = near_.store();
  FoundFeatures<Edge> found;
  near_.store().visit_free_edges_in(
      cell_.center().p, reach_ + rounding_,
      [&](const Point<3>& x, double radius) { return !meets(x, radius); },
      [&](const Edge& e) noexcept { return found.take(e); });
  Edges edges = std::move(found).all();
  std::vector<EdgeHandle> sides;
  for (const Polygon* f : polygons) {
    if (f->all_edges.size() > FeatureStore::kFewSides) continue;
    sides.insert(sides.end(), f->all_edges.begin(), f->all_edges.end());
  }
  make_set(sides);
  for (const EdgeHandle h : sides) {
    const Edge& e = store.edges()[h];
    if (e.bounds && meets(middle_of(e), reach_of(e))) edges.push_back(&e);
  }
  return edges;
}

/// The first in canonical order for which is(f); null: there is none.
template <class F, class Is>
const F* StarCrossings::first(const std::vector<const F*>& all, Is&& is) {
  const F* first = nullptr;
  for (const F* f : all) {
    if (f == first || (first != nullptr && comes_before(*first, *f))) continue;
    if (is(*f)) first = f;
  }
  return first;
}

std::optional<Placed> StarCrossings::place(Known known) {
  if (real_.empty()) return std::nullopt;
  if (known == Known::nothing) near_.ask_within(reach_);
  const bool was_clear = known == Known::was_clear;
  Polygons polygons;
  if (self_.on != 0 || !was_clear) polygons = find_polygons();
  if (self_.on != 0) {
    const auto leans = [&](const Polygon& f) { return place_leaning(f).has_value(); };
    if (const Polygon* f = first(polygons, leans)) return place_leaning(*f);
  }
  const auto crosses = [&](const auto& f) { return look_at(f).has_value(); };
  const Edges edges = was_clear ? find_changed<Edge>() : find_edges(polygons);
  if (const Edge* e = first(edges, crosses)) return place_on(*e, *look_at(*e));
  if (was_clear) polygons = find_changed<Polygon>();
  if (const Polygon* f = first(polygons, crosses)) return place_on(*f, *look_at(*f));
  return std::nullopt;
}

bool StarCrossings::any() {
  if (real_.empty()) return false;
  const Polygons polygons = find_polygons();
  return any_of(find_edges(polygons)) || any_of(polygons);
}

template <class F>
bool StarCrossings::any_of(const std::vector<const F*>& all) {
  return std::any_of(all.begin(), all.end(), [&](const F* f) { return look_at(*f).has_value(); });
}

/// Of the nearest vertex of the star.
double StarCrossings::nearest2(const Point<3>& x) const {
  double least = squared_distance(x, cell_.center().p);
  for (const int i : real_) least = std::min(least, squared_distance(x, cell_.place(i)));
  return least;
}

// --- Small angles ----------------------------------------------------------------------------

/// On f, if it leans on a polygon of v and meets v's cell: a copy of v, or what is roundest of an
/// edge of f in the cell, or a place of f in it that helps.
std::optional<Placed> StarCrossings::place_leaning(const Polygon& f) {
  const Standing self = standing(kSelf);
  const SmallAngles angles(near_);
  if (is_on(self, f) || !meets(f.middle, f.reach) || !angles.leans(self, f)) return std::nullopt;
  const Edge* first = nullptr;
  visit_edges_near(f, self.v.p, std::sqrt(cell_.reach2()), [&](EdgeHandle h) {
    const Edge& e = near_.store().edges()[h];
    if (first != nullptr && !comes_before(e, *first)) return false;
    if (!is_on(self, e) && part_in(cell_, e)) first = &e;
    return false;
  });
  if (first != nullptr) {
    const auto copy = angles.copy(self, *first);
    if (copy && cell_.cuts(copy->p)) return copy;
    const auto at = roundest(*first, part_in(cell_, *first)->middle(0.5));
    if (at) return placed_on(*first, *at);
  }
  const auto x = place_in(cell_, f);
  if (!x) return std::nullopt;
  const auto copy = angles.copy(self, f);
  if (copy && cell_.cuts(copy->p)) return copy;
  const auto y = yield_to_edges(near_, *x, std::sqrt(squared_distance(*x, self.v.p)));
  return y ? *y : placed_on(f, *x);
}

// --- Edges -----------------------------------------------------------------------------------

auto StarCrossings::look_at(const Edge& e) -> std::optional<MissingEdge> {
  project(e);
  const bool on = is_on(standing(kSelf), e);
  if (!on && are_beside()) return std::nullopt;
  project_labels(e);
  if (!on) return pierced_face(e);
  for (const double towards : {-1.0, 1.0}) {
    if (auto missing = missing_from_self(e, towards)) return missing;
  }
  return std::nullopt;
}

void StarCrossings::project(const Edge& e) {
  const Point<3> along = minus(e.place_b, e.place_a);
  const double length2 = squared(along);
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(along[i]) < std::abs(along[least])) least = i;
  }
  Point<3> axis{};
  axis[least] = 1;
  const Point<3> across = cross(along, axis);
  axes_.origin = e.place_a;
  axes_.one = scaled(1 / std::sqrt(squared(across)), across);
  axes_.other = scaled(1 / std::sqrt(length2), cross(along, axes_.one));
  axes_.along = scaled(1 / length2, along);
  on_.assign(index(cell_.size()), 0);
  beside_.resize(index(cell_.size()));
  for (const int i : real_) beside_[index(i)] = seen(cell_.place(i));
  self_beside_ = seen(cell_.center().p);
}

auto StarCrossings::seen(const Point<3>& p) const -> Beside {
  const Point<3> r = minus(p, axes_.origin);
  const Beside b{dot(r, axes_.one), dot(r, axes_.other), dot(r, axes_.along)};
  const auto side = [](bool is, unsigned bit) { return is ? 1u << bit : 0u; };
  const unsigned sides = side(b.x > rounding_, 0) | side(b.x < -rounding_, 1) |
                         side(b.y > rounding_, 2) | side(b.y < -rounding_, 3) |
                         side(b.along >= 1, 4) | side(b.along <= 0, 5);
  return {b.x, b.y, b.along, static_cast<std::uint8_t>(sides)};
}

/// Notes which vertices are on the edge, and that they are on its line, bit for bit.
void StarCrossings::project_labels(const Edge& e) {
  const auto put = [](Beside& b) { b.x = b.y = 0, b.sides &= 0x30; };
  for (const int i : real_) {
    if (!is_on(standing(i), e)) continue;
    on_[index(i)] = 1;
    put(beside_[index(i)]);
  }
  if (is_on(standing(kSelf), e)) put(self_beside_);
}

/// Whether the star is on one side of the edge, or of an end of it.
bool StarCrossings::are_beside() const {
  unsigned sides = self_beside_.sides;
  for (const int i : real_) sides &= beside_[index(i)].sides;
  return sides != 0;
}

bool StarCrossings::is_before(const LinkEdge& a, const LinkEdge& b) const noexcept {
  const auto precedes = [&](int i, int j) {
    return j != kSelf && (i == kSelf || cell_.place(i) < cell_.place(j));
  };
  return a.p == b.p ? precedes(a.q, b.q) : precedes(a.p, b.p);
}

/// Twice the area of a triangle at the line; 0 if rounding may have made its sign.
double StarCrossings::turn(const Beside& a, const Beside& b) const {
  const double twice = a.x * b.y - a.y * b.x;
  return std::abs(twice) <= 4 * rounding_ * reach_ ? 0 : twice;
}

/// Where the line crosses a triangle, in fractions of the edge; nothing, if it does not, or is in
/// its plane.
std::optional<double> StarCrossings::crossing(const Beside& a, const Beside& b,
                                              const Beside& c) const {
  const double ab = turn(a, b), bc = turn(b, c), ca = turn(c, a);
  if (!(ab >= 0 && bc >= 0 && ca >= 0) && !(ab <= 0 && bc <= 0 && ca <= 0)) return std::nullopt;
  const double all = ab + bc + ca;
  if (std::abs(all) <= 16 * rounding_ * reach_) return std::nullopt;
  return (bc * a.along + ca * b.along + ab * c.along) / all;
}

/// The face between v and an edge of the link that e pierces, of several the nearest.
auto StarCrossings::pierced_face(const Edge& e) const -> std::optional<MissingEdge> {
  const Beside& v = self_beside_;
  const Point<3> along = minus(e.place_b, e.place_a);
  std::optional<MissingEdge> best;
  double best2 = kFar;
  for (const LinkEdge& edge : link_) {
    const auto [i, j] = edge;
    const Beside &a = beside_[index(i)], &b = beside_[index(j)];
    if ((v.sides & a.sides & b.sides) != 0 || on_[index(i)] != 0 || on_[index(j)] != 0) continue;
    const std::optional<double> at = crossing(v, a, b);
    if (!at || !(*at > 0 && *at < 1)) continue;
    const Point<3> x = plus(e.place_a, scaled(*at, along));
    const double d2 = squared_distance(x, cell_.center().p);
    if (d2 > best2 || (d2 == best2 && !is_before(edge, {best->beside[0], best->beside[1]})))
      continue;
    best2 = d2;
    best = MissingEdge{};
    best->at = *at;
    best->room = std::sqrt(std::min({d2, squared_distance(x, cell_.place(i)),
                                     squared_distance(x, cell_.place(j))})) /
                 e.length;
    best->beside = {i, j};
  }
  if (!best) return std::nullopt;
  best->part = piece_at(best->at, best->room).middle(1.0 / 3);
  return best;
}

/// Between the neighbours on the edge at both sides of a place; if one is not seen, as far as the
/// other, or as the nearest vertex.
Span StarCrossings::piece_at(double at, double room) const {
  std::optional<double> lo, hi;
  for (const int i : real_) {
    if (on_[index(i)] == 0) continue;
    const double there = beside_[index(i)].along;
    if (there <= at && (!lo || there > *lo)) lo = there;
    if (there >= at && (!hi || there < *hi)) hi = there;
  }
  return {lo ? *lo : std::max(0.0, at - std::max(room, hi ? *hi - at : 0)),
          hi ? *hi : std::min(1.0, at + std::max(room, lo ? at - *lo : 0))};
}

/// Where e goes on from v, but not along an edge of the star. The new vertex has to take what of e
/// is in the cell of v; so its distance, if that is to be a power of 2, is that of a vertex in the
/// way that is as far from v on another edge.
auto StarCrossings::missing_from_self(const Edge& e, double towards) const
    -> std::optional<MissingEdge> {
  const double self = self_beside_.along;
  const double rest = towards > 0 ? 1 - self : self;
  if (rest <= 0x1p-40) return std::nullopt;
  const bool goes_on = std::any_of(real_.begin(), real_.end(), [&](int i) {
    return on_[index(i)] != 0 && (beside_[index(i)].along - self) * towards > 0;
  });
  if (goes_on || !is_visible(towards)) return std::nullopt;
  const Point<3> along = scaled(towards, minus(e.place_b, e.place_a));
  MissingEdge missing;
  double least = rest;
  for (int i = 0; i < cell_.size(); ++i) {
    if (!cell_.used(i)) continue;
    const double slope = dot(cell_.neighbour(i), along);
    if (slope <= 0) continue;
    const double exit = squared(cell_.neighbour(i)) / 2 / slope;
    const int known = missing.beside[0];
    if (exit > least) continue;
    if (exit == least && known != kSelf && cell_.place(known) < cell_.place(i)) continue;
    least = exit;
    missing.beside[0] = cell_.real(i) ? i : kSelf;
  }
  missing.at = self + towards * least;
  missing.room = least;
  const double near = std::min(least, rest * 0.5);
  const double far = std::min(least * (2 - 0x1p-10), rest * (2.0 / 3));
  missing.part = towards > 0 ? Span{self + near, self + far} : Span{self - far, self - near};
  return missing;
}

/// Whether the line from v leaves the star through a face that is not hidden.
bool StarCrossings::is_visible(double towards) const {
  for (int t = 0; t < cell_.corners(); ++t) {
    const auto& ends = cell_.ends(t);
    if (!std::all_of(ends.begin(), ends.end(), [&](int i) { return cell_.real(i); })) continue;
    const Beside &a = beside_[index(ends[0])], &b = beside_[index(ends[1])],
                 &c = beside_[index(ends[2])];
    const std::optional<double> at = crossing(a, b, c);
    if (at && (*at - self_beside_.along) * towards > 0) return true;
  }
  return false;
}

/// A copy of a vertex in the way, or the roundest place of the part, or near where it is missing.
Placed StarCrossings::place_on(const Edge& e, const MissingEdge& missing) {
  const SmallAngles angles(near_);
  for (const int i : {kSelf, missing.beside[0], missing.beside[1]}) {
    const Standing v = standing(i);
    if (v.role.on == 0 || is_on(v, e)) continue;
    const auto copy = angles.copy(v, e);
    if (!copy || nearest2(copy->p) <= squared_distance(copy->p, v.v.p) * 0x1p-60) continue;
    if (cell_.cuts(copy->p)) return *copy;
  }
  const double off = missing.room / 8;
  const Span beside{std::max(missing.at - off, 0.0), std::min(missing.at + off, 1.0)};
  for (const auto& at : {roundest(e, missing.part), roundest(e, beside),
                         std::optional(label_at(e, missing.at * e.length))}) {
    if (!at) continue;
    const Placed y = placed_on(e, *at);
    if (cell_.cuts(y.p)) return y;
  }
  const Placed none = placed_on(e, label_at(e, missing.at * e.length));
  throw Error(ErrorCode::too_close, "features are too close for double precision near " +
                                        place_text(none.p) +
                                        ": rounding leaves no place on a line");
}

// --- Polygons --------------------------------------------------------------------------------

/// Of edges at v the nearest, of those of the link the farthest.
auto StarCrossings::look_at(const Polygon& f) -> std::optional<PiercingEdge> {
  const double noise = rounding_ + 2 * f.thickness;
  height_.assign(index(cell_.size()), 0);
  bool above = false, below = false;
  const auto height = [&](const Point<3>& p) {
    const double h = f.plane.height(p);
    if (std::abs(h) <= noise) return 0.0;
    (h > 0 ? above : below) = true;
    return h;
  };
  for (const int i : real_) height_[index(i)] = height(cell_.place(i));
  self_height_ = height(cell_.center().p);
  if (!above || !below) return std::nullopt;
  std::optional<PiercingEdge> best;
  double best2 = 0;
  for (const PiercingEdge& edge : all_piercing(f)) {
    const double away2 = squared_distance(edge.at, cell_.center().p);
    const double d2 = edge.p == kSelf ? -away2 : away2;
    if (best && (d2 < best2 || (d2 == best2 && !is_before({edge.p, edge.q}, {best->p, best->q}))))
      continue;
    best = edge;
    best2 = d2;
  }
  return best;
}

/// Requires: look_at(f) was the last call of its kind.
auto StarCrossings::all_piercing(const Polygon& f) const -> std::vector<PiercingEdge> {
  std::vector<PiercingEdge> found;
  const auto look = [&](int i, int j, double from, double to) {
    if (!(from * to < 0)) return;
    const Point<3>& p = vertex(i).p;
    const Point<3> x = plus(p, scaled(from / (from - to), minus(vertex(j).p, p)));
    if (contains(f, x)) found.push_back({x, i, j});
  };
  if (self_height_ != 0) {
    for (const int i : real_) look(kSelf, i, self_height_, height_[index(i)]);
  } else if (is_on(standing(kSelf), f)) {
    for (const auto& [i, j] : link_) {
      look(i, j, height_[index(i)], height_[index(j)]);
    }
  }
  return found;
}

/// The copy of an end, at a small angle.
std::optional<Placed> StarCrossings::copy_on(const Polygon& f, const PiercingEdge& edge) {
  const SmallAngles angles(near_);
  for (const int i : {edge.p, edge.q}) {
    const Standing v = standing(i);
    if (v.role.on == 0) continue;
    const auto copy = angles.copy(v, f);
    if (!copy || polygon_of(copy->role) == 0) continue;
    const double room2 = kRoomForCopy * kRoomForCopy * squared_distance(copy->p, v.v.p);
    if (nearest2(copy->p) >= room2 && cell_.cuts(copy->p)) return copy;
  }
  return std::nullopt;
}

/// The foot of an end, if no vertex is nearer to that.
std::optional<Point<3>> StarCrossings::foot_on(const Polygon& f, const PiercingEdge& edge) {
  for (const int i : {edge.p, edge.q}) {
    const Point<3>& v = vertex(i).p;
    const Point<3> foot = f.plane.foot(v);
    if (!contains(f, foot)) continue;
    if (nearest2(foot) >= squared_distance(foot, v) * (1 - 0x1p-30) && cell_.cuts(foot)) {
      return foot;
    }
  }
  return std::nullopt;
}

/// Where the edge pierces f, or the foot of the centre of a simplex with that edge: what is farther
/// from all vertices. (Without the centres, the refinement at 1 degree does not end: where f has
/// coarse vertices yet, edges pierce it next to fine ones.)
Point<3> StarCrossings::roomiest_on(const Polygon& f, const PiercingEdge& edge) {
  Point<3> best = edge.at;
  double best2 = nearest2(best);
  for (int t = 0; t < cell_.corners(); ++t) {
    const auto& ends = cell_.ends(t);
    const auto has = [&](int i) {
      return i == kSelf || std::find(ends.begin(), ends.end(), i) != ends.end();
    };
    if (!has(edge.p) || !has(edge.q)) continue;
    if (!std::all_of(ends.begin(), ends.end(), [&](int i) { return cell_.real(i); })) continue;
    const Point<3> x = f.plane.foot(plus(cell_.center().p, cell_.corner(t)));
    const double d2 = nearest2(x);
    if (d2 < best2 || (d2 == best2 && best < x) || !contains(f, x) || !cell_.cuts(x)) continue;
    best = x;
    best2 = d2;
  }
  return best;
}

Placed StarCrossings::place_on(const Polygon& f, const PiercingEdge& edge) {
  if (const auto copy = copy_on(f, edge)) return *copy;
  if (const auto foot = foot_on(f, edge)) return place_near(f, *foot);
  Point<3> best = roomiest_on(f, edge);
  double best2 = nearest2(best);
  for (const PiercingEdge& other : all_piercing(f)) {
    const Point<3> x = roomiest_on(f, other);
    const double d2 = nearest2(x);
    if (d2 < best2 || (d2 == best2 && best < x)) continue;
    best = x;
    best2 = d2;
  }
  return place_near(f, best);
}

/// On f at x, or on an edge that is near.
Placed StarCrossings::place_near(const Polygon& f, const Point<3>& x) {
  const double room = std::sqrt(nearest2(x));
  const Edge* e = near_.nearest_edge(x, kYields * room);
  if (e == nullptr) return placed_on(f, x);
  const auto y = place_in_ball(*e, x, room);
  if (y && cell_.cuts(y->p)) return *y;
  const double at = foot_fraction(*e, x);
  if (!(at > 0 && at < 1)) return placed_on(f, x);
  const Placed foot = placed_on(*e, label_at(*e, at * e->length));
  return cell_.cuts(foot.p) ? foot : placed_on(f, x);
}

}  // namespace mesher::detail
