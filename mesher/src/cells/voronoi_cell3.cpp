// Cutting the Voronoi cell in space.
#include "cells/voronoi_cell3.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/circumcentre.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/predicates.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

namespace {

// Of so many neighbours there is a table of all pairs.
constexpr int kMostInTable = 128;

// Three unit directions at right angles, right-handed: turned by 0.7, 0.5 and 0.3 radians about the
// axes, so that no grid is aligned with them. The virtual neighbours are these and their opposites.
constexpr std::array<Point<3>, 3> kAxes{{
    {0.83838664359420356, 0.25934338005223079, -0.47942553860420301},
    {0.069033568057884742, 0.82195436950412748, 0.56535420838114381},
    {0.54068678763591338, -0.50708187275444627, 0.67121216615895773},
}};

}  // namespace

Point<3> VoronoiCell3::clip_place(const Point<3>& v, double radius, std::size_t i) {
  return plus(v, scaled((i % 2 == 0 ? 2 : -2) * radius, kAxes[i / 2]));
}

// --- Columns ---------------------------------------------------------------------------------

void VoronoiCell3::clear(const Vertex<3>& v) noexcept {
  v_ = &v;
  neighbours_ = 0;
  corners_ = 0;
  unused_.clear();
}

// The column that grows last says how much room there is: memory may run out on the way.
int VoronoiCell3::new_neighbour(Code code, const Point<3>& place) {
  int i;
  if (unused_.empty()) {
    i = neighbours_++;
    if (rim_at_.size() < index(neighbours_)) {
      const std::size_t room = 2 * index(neighbours_) + 16;
      unused_.reserve(room);
      u_.resize(room);
      place_.resize(room);
      code_.resize(room);
      uses_.resize(room);
      rim_at_.resize(room);
    }
  } else {
    i = unused_.back();
    unused_.pop_back();
  }
  code_[index(i)] = code;
  place_[index(i)] = place;
  u_[index(i)] = minus(place, v_->p);
  uses_[index(i)] = 0;
  return i;
}

int VoronoiCell3::new_face() {
  if (open_.size() < index(corners_ + 1)) {
    const std::size_t room = 2 * index(corners_) + 32;
    for (auto* column : {&qx_, &qy_, &qz_, &q2_, &tolerance2_}) column->resize(room);
    for (auto* column : {&near_.q[0], &near_.q[1], &near_.q[2], &near_.q2}) column->resize(room);
    face_.resize(room);
    is_open_.resize(room);
    is_taken_.resize(room);
    open_.resize(room);
  }
  return corners_++;
}

void VoronoiCell3::set_face(int t, const Face& face, bool open) {
  const std::size_t at = index(t);
  face_[at] = face;
  is_open_[at] = open;
  for (const int i : face.end) ++uses_[index(i)];
  const Circumcentre c =
      circumcentre(v_->p, place(face.end[0]), place(face.end[1]), place(face.end[2]));
  qx_[at] = c.q[0];
  qy_[at] = c.q[1];
  qz_[at] = c.q[2];
  q2_[at] = c.length2;
  tolerance2_[at] = c.tolerance2;
}

// --- Cells to start from ---------------------------------------------------------------------

// An octahedron's triangles: one for each choice of signs along the three directions, a bit each.
// An odd number of negative ones turns the orientation round.
void VoronoiCell3::reset(const Vertex<3>& v, double radius) {
  SAC_EXPECTS(radius > 0);
  clear(v);
  for (std::size_t i = 0; i < kClips; ++i) {
    static_cast<void>(new_neighbour(kVirtual | static_cast<Code>(i), clip_place(v.p, radius, i)));
  }
  for (int t = 0; t < 8; ++t) static_cast<void>(new_face());
  for (int t = 0; t < 8; ++t) {
    Face face{{t & 1, 2 + (t >> 1 & 1), 4 + (t >> 2 & 1)}, {t ^ 1, t ^ 2, t ^ 4}};
    if (std::popcount(static_cast<unsigned>(t)) % 2 == 1) {
      std::swap(face.end[1], face.end[2]);
      std::swap(face.across[1], face.across[2]);
    }
    set_face(t, face, true);
  }
  update_reach();
}

void VoronoiCell3::load(const VertexPool<3>& pool, double radius, const LinkRecord& record,
                        bool open) {
  for (const Code code : record.neighbours()) {
    static_cast<void>(new_neighbour(code, place_of(pool, v_->p, radius, code)));
  }
  const auto n = static_cast<int>(record.triangles());
  for (int t = 0; t < n; ++t) static_cast<void>(new_face());
  for (int t = 0; t < n; ++t) {
    const auto [a, b, c] = record.triangle(index(t));
    const std::array<int, 3> end{static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)};
    set_face(t, {end, {-1, -1, -1}}, open);
  }
  join_across();
}

// Tells triangles whom they share edges with: each directed edge is of one of them, and the
// opposite one of the triangle across.
void VoronoiCell3::join_across() {
  if (neighbours_ > kMostInTable) return join_many_across();
  const int shift = std::bit_width(static_cast<unsigned>(neighbours_));
  const std::size_t places = std::size_t{1} << 2 * shift;
  if (edges_.size() < places) edges_.resize(places);
  int* const edge = edges_.data();
  for (int t = 0; t < corners_; ++t) {
    const auto& [a, b, c] = face_[index(t)].end;
    edge[a << shift | b] = edge[b << shift | c] = edge[c << shift | a] = t;
  }
  for (int t = 0; t < corners_; ++t) {
    const auto& [a, b, c] = face_[index(t)].end;
    face_[index(t)].across = {edge[c << shift | b], edge[a << shift | c], edge[b << shift | a]};
  }
}

// An edge waits for its other triangle at the end that has fewer: all that are looked at are O(n),
// the link being a planar graph.
void VoronoiCell3::join_many_across() {
  if (unpaired_.size() < index(neighbours_)) unpaired_.resize(index(neighbours_));
  for (int i = 0; i < neighbours_; ++i) unpaired_[index(i)].clear();
  for (int t = 0; t < corners_; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      int at = face_[index(t)].end[(k + 1) % 3], other = face_[index(t)].end[(k + 2) % 3];
      const int fewer = uses_[index(other)] - uses_[index(at)];
      if (fewer < 0 || (fewer == 0 && other < at)) std::swap(at, other);
      auto& waiting = unpaired_[index(at)];
      const auto found = std::find_if(waiting.begin(), waiting.end(),
                                      [&](const Unpaired& e) { return e.other == other; });
      if (found == waiting.end()) {
        waiting.push_back({other, t, static_cast<int>(k)});
        continue;
      }
      face_[index(t)].across[k] = found->face;
      face_[index(found->face)].across[index(found->opposite)] = t;
      *found = waiting.back();
      waiting.pop_back();
    }
  }
  for (int i = 0; i < neighbours_; ++i) SAC_ENSURES(unpaired_[index(i)].empty());
}

void VoronoiCell3::adopt(const Vertex<3>& v, double radius, std::span<const Neighbour> neighbours,
                         std::span<const Face> faces) {
  SAC_EXPECTS(radius > 0);
  clear(v);
  for (const Neighbour& u : neighbours) static_cast<void>(new_neighbour(u.code, u.place));
  for (const Face& face : faces) set_face(new_face(), face, false);
  update_reach();
  if (!(reach2_ < radius * radius * (1 - 0x1p-20))) clip(radius);
}

// The nearest first: then few cut what the next ones take away again.
void VoronoiCell3::begin_among(const Vertex<3>& v, double radius, std::span<Neighbour> neighbours) {
  reset(v, radius);
  std::sort(neighbours.begin(), neighbours.end(), [&](const Neighbour& a, const Neighbour& b) {
    return squared_distance(a.place, v.p) < squared_distance(b.place, v.p);
  });
  for (const Neighbour& u : neighbours) {
    if (cuts(u.place)) cut(u.code);
  }
}

// A virtual neighbour is 2 radius away: no corner nearer than that is its.
void VoronoiCell3::cut_by_clip(double radius) {
  if (open2_ >= radius * radius * (1 - 0x1p-20)) clip(radius);
}

void VoronoiCell3::clip(double radius) {
  for (std::size_t i = 0; i < kClips; ++i) {
    const Code code = kVirtual | static_cast<Code>(i);
    if (!has(code) && cuts(clip_place(v_->p, radius, i)) && replaces_ < 0) cut(code);
  }
}

// A triangle that was there when the record was made has an empty ball but for who has come since.
void VoronoiCell3::close_known(const LinkRecord& record) {
  for (int t = 0; t < corners_; ++t) {
    LinkRecord::Triangle at;
    bool known = true;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = record.find(code(face_[index(t)].end[k]));
      known = known && at[k] < record.size();
    }
    if (known && record.has(at)) is_open_[index(t)] = 0;
  }
  update_reach();
}

void VoronoiCell3::update_reach() noexcept {
  CornerReach::update_reach(index(corners_));
  const std::size_t n = index(open_count_);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t t = index(open_[k]);
    near_.q[0][k] = qx_[t], near_.q[1][k] = qy_[t], near_.q[2][k] = qz_[t];
    near_.q2[k] = q2_[t] * (1 + 0x1p-30);
  }
  for (near_count_ = n; near_count_ % kLanes != 0; ++near_count_) {
    for (auto& q : near_.q) q[near_count_] = 0;
    near_.q2[near_count_] = -1;
  }
}

// --- Cuts ------------------------------------------------------------------------------------

void VoronoiCell3::aim(const Point<3>& w) noexcept {
  w_ = w;
  aim_ = minus(w, v_->p);
  w2_ = squared(aim_);
  replaces_ = -1;
  taken_.clear();
}

// max w.q over the corners.
double VoronoiCell3::largest_projection() const noexcept {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < index(corners_); ++t) {
    most = std::max(most, aim_[0] * qx_[t] + aim_[1] * qy_[t] + aim_[2] * qz_[t]);
  }
  return most;
}

// Whether the candidate may be nearer to an open corner.
bool VoronoiCell3::may_take_open() const noexcept {
  const Lanes clear = both(w2_ / 2 - error_);
  const Lanes x = both(aim_[0]), y = both(aim_[1]), z = both(aim_[2]);
  LaneMask taken{};
  for (std::size_t k = 0; k < near_count_; k += kLanes) {
    const Lanes along =
        x * lanes_at(&near_.q[0][k]) + y * lanes_at(&near_.q[1][k]) + z * lanes_at(&near_.q[2][k]);
    taken |= along >= clear;
  }
  return any(taken);
}

bool VoronoiCell3::find_cut() {
  for (int t = 0; t < corners_; ++t) {
    const double value = 2 * dot(aim_, corner(t)) - w2_;
    const bool clear = value * value > tolerance2_[index(t)] * w2_;
    is_taken_[index(t)] = clear ? value > 0 : exactly_nearer(t);
    if (is_taken_[index(t)] != 0) taken_.push_back(t);
  }
  if (taken_.empty()) return replaces_ >= 0 && !real(replaces_);
  replaces_ = -1;
  return true;
}

bool VoronoiCell3::exactly_nearer(int t) {
  const auto& [a, b, c] = ends(t);
  for (const int k : {a, b, c}) {
    if (place(k) == w_) {
      replaces_ = k;
      return false;
    }
  }
  return predicates::insphere_perturbed(v_->p, place(a), place(b), place(c), w_) > 0;
}

void VoronoiCell3::cut(Code w) {
  if (replaces_ >= 0) {
    code_[index(replaces_)] = w;
    return;
  }
  find_rim();
  const int at = new_neighbour(w, w_);
  release_ends();
  join_rim(at);
  update_reach();
}

void VoronoiCell3::find_rim() {
  rim_.clear();
  for (const int t : taken_) {
    const Face& face = face_[index(t)];
    for (std::size_t k = 0; k < 3; ++k) {
      const int beyond = face.across[k];
      if (is_taken_[index(beyond)] != 0) continue;
      const int from = face.end[(k + 1) % 3];
      rim_at_[index(from)] = static_cast<int>(rim_.size());
      const bool open = (is_open_[index(t)] | is_open_[index(beyond)]) != 0;
      rim_.push_back({from, face.end[(k + 2) % 3], beyond, open});
    }
  }
}

// Neighbours inside the disc lose all their triangles. Those on the rim keep some beyond it.
void VoronoiCell3::release_ends() {
  for (const int t : taken_) {
    for (const int i : face_[index(t)].end) {
      if (--uses_[index(i)] > 0) continue;
      code_[index(i)] = kUnused;
      unused_.push_back(i);
    }
  }
}

// The triangles of w take the numbers of those that go.
void VoronoiCell3::join_rim(int w) {
  const std::size_t gone = taken_.size();
  for (std::size_t i = gone; i < rim_.size(); ++i) taken_.push_back(new_face());
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    const Rim& edge = rim_[i];
    const int t = taken_[i];
    link_across(edge.beyond, edge.from, edge.to, t);
    const int next = taken_[index(rim_at_[index(edge.to)])];
    set_face(t, {{edge.from, edge.to, w}, {next, -1, edge.beyond}}, edge.open);
  }
  for (std::size_t i = 0; i < rim_.size(); ++i) {
    face_[index(face_[index(taken_[i])].across[0])].across[1] = taken_[i];
  }
  for (std::size_t i = gone; i-- > rim_.size();) give_up_number(taken_[i]);
}

// Triangle t has `other` beyond its edge between two neighbours.
void VoronoiCell3::link_across(int t, int from, int to, int other) noexcept {
  Face& face = face_[index(t)];
  for (std::size_t k = 0; k < 3; ++k) {
    if (face.end[k] != from && face.end[k] != to) face.across[k] = other;
  }
}

// The last triangle takes the number t. (Numbers are given up from the greatest on.)
void VoronoiCell3::give_up_number(int t) {
  const int last = --corners_;
  if (t == last) return;
  const std::size_t to = index(t), from = index(last);
  for (auto* column : {&qx_, &qy_, &qz_, &q2_, &tolerance2_}) (*column)[to] = (*column)[from];
  face_[to] = face_[from];
  is_open_[to] = is_open_[from];
  for (const int other : face_[to].across) {
    for (int& back : face_[index(other)].across) {
      if (back == last) back = t;
    }
  }
}

// --- What it says ----------------------------------------------------------------------------

void VoronoiCell3::add_gap_ball(int t, Box<3>& extent) const noexcept {
  const double r = gap_radius(index(t));
  const Point<3> q = corner(t);
  for (std::size_t i = 0; i < 3; ++i) {
    extent.lo[i] = std::min(extent.lo[i], q[i] - r);
    extent.hi[i] = std::max(extent.hi[i], q[i] + r);
  }
}

bool VoronoiCell3::is_compact() const noexcept {
  for (int k = 0; k < open_count_; ++k) {
    const auto& [a, b, c] = ends(open_[index(k)]);
    if (!real(a) || !real(b) || !real(c)) return false;
  }
  double farthest2 = 0;
  for (int i = 0; i < neighbours_; ++i) {
    if (used(i)) farthest2 = std::max(farthest2, squared(u_[index(i)]));
  }
  return open2_ <= farthest2;
}

Box<3> VoronoiCell3::open_extent() const noexcept {
  Box<3> extent;
  for (int k = 0; k < open_count_; ++k) add_gap_ball(open_[index(k)], extent);
  return extent;
}

Box<3> VoronoiCell3::extent_inside(const Point<3>& outward) const noexcept {
  Box<3> extent;
  for (int t = 0; t < corners_; ++t) {
    const Point<3> q = corner(t);
    bool beyond = false;
    for (std::size_t i = 0; i < 3; ++i) beyond = beyond || q[i] * outward[i] > 0;
    const auto& [a, b, c] = ends(t);
    if (!beyond || (real(a) && real(b) && real(c))) add_gap_ball(t, extent);
  }
  return extent;
}

void VoronoiCell3::write(std::vector<Code>& record) const {
  by_code_.clear();
  for (int i = 0; i < neighbours_; ++i) {
    if (used(i)) by_code_.emplace_back(code(i), static_cast<std::uint32_t>(i));
  }
  std::sort(by_code_.begin(), by_code_.end());
  codes_.clear();
  position_.resize(std::max(position_.size(), index(neighbours_)));
  for (const auto& [code, i] : by_code_) {
    position_[i] = static_cast<std::uint32_t>(codes_.size());
    codes_.push_back(code);
  }
  triangles_.clear();
  for (int t = 0; t < corners_; ++t) {
    const auto& [a, b, c] = ends(t);
    triangles_.push_back({position_[index(a)], position_[index(b)], position_[index(c)]});
  }
  LinkRecord::write(codes_, triangles_, record);
}

// Of all corners, that of (a, b, c) reaches farthest in the direction of w if w lies in the cone of
// a, b and c, the normals of the sides that meet there: if that is not nearer to w, none is. On
// which side of the plane of 0, a, b w lies says (w x a).b, computed to within 2^-48 |w||a||b|.
bool VoronoiCell3::may_cut(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
                           std::span<const Code> record, const Point<3>& p) noexcept {
  constexpr std::size_t kMost = 96;  // neighbours; nearly no cell has more
  const LinkRecord link(record);
  if (link.size() > kMost) return true;
  const Point<3> w = minus(p, v.p);
  const double w2 = squared(w);
  std::array<Point<3>, kMost> u, across;
  std::array<double, kMost> u2;
  for (std::size_t i = 0; i < link.size(); ++i) {
    u[i] = minus(place_of(pool, v.p, radius, link.neighbours()[i]), v.p);
    across[i] = cross(w, u[i]);
    u2[i] = squared(u[i]);
  }
  for (std::size_t t = 0; t < link.triangles(); ++t) {
    const LinkRecord::Triangle end = link.triangle(t);
    bool inside = true;  // of the cone, perhaps
    bool clear = true;   // and not on its rim
    for (std::size_t k = 0; k < 3 && inside; ++k) {
      const std::size_t a = end[k], b = end[(k + 1) % 3];
      const double side = dot(across[a], u[b]);
      const double error2 = 0x1p-96 * w2 * u2[a] * u2[b];
      inside = side >= 0 || side * side <= error2;
      clear = clear && side * side > error2;
    }
    if (!inside) continue;
    const auto place = [&](std::size_t k) {
      return place_of(pool, v.p, radius, link.neighbours()[end[k]]);
    };
    const Circumcentre c = circumcentre(v.p, place(0), place(1), place(2));
    const double value = 2 * dot(w, c.q) - w2;
    if (value >= 0 || !(value * value > c.tolerance2 * w2)) return true;
    if (clear) return false;
  }
  return false;
}

void VoronoiCell3::check_invariants() const {
  SAC_INVARIANT(corners_ >= 4);
  std::vector<int> uses(index(neighbours_));
  int open = 0;
  for (int t = 0; t < corners_; ++t) {
    const Face& face = face_[index(t)];
    const auto& [a, b, c] = face.end;
    SAC_INVARIANT(predicates::orient3d(v_->p, place(a), place(b), place(c)) > 0);
    const Circumcentre q = circumcentre(v_->p, place(a), place(b), place(c));
    SAC_INVARIANT(q.q == corner(t) && q.length2 == corner2(t) && q.length2 <= reach2_);
    SAC_INVARIANT(is_open_[index(t)] == 0 || corner2(t) <= open2_);
    open += is_open_[index(t)];
    for (std::size_t k = 0; k < 3; ++k) {
      ++uses[index(face.end[k])];
      const Face& other = face_[index(face.across[k])];
      const auto back = std::find(other.across.begin(), other.across.end(), t);
      SAC_INVARIANT(back != other.across.end());
      const auto at = static_cast<std::size_t>(back - other.across.begin());
      SAC_INVARIANT(other.end[(at + 1) % 3] == face.end[(k + 2) % 3]);
      SAC_INVARIANT(other.end[(at + 2) % 3] == face.end[(k + 1) % 3]);
    }
  }
  SAC_INVARIANT(open == open_count_);
  int vertices = 0;
  for (int i = 0; i < neighbours_; ++i) {
    SAC_INVARIANT(uses[index(i)] == uses_[index(i)]);
    SAC_INVARIANT(used(i) == (code(i) != kUnused));
    vertices += used(i);
  }
  SAC_INVARIANT(2 * vertices - 4 == corners_);  // a sphere, of triangles
}

}  // namespace mesher::detail
