// Cutting the Voronoi cell.
#include "cells/voronoi_cell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesher/predicates.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

namespace {

// Eight unit directions, a turn of 45 degrees apart, starting at 0.3 radians: no grid is aligned
// with them.
constexpr std::array<Point<2>, VoronoiCell::kClips> kDirections{{
    {0.955336489125606, 0.29552020666134},
    {0.466559651251443, 0.884489248146117},
    {-0.29552020666134, 0.955336489125606},
    {-0.884489248146117, 0.466559651251443},
    {-0.955336489125606, -0.29552020666134},
    {-0.466559651251443, -0.884489248146117},
    {0.29552020666134, -0.955336489125606},
    {0.884489248146117, -0.466559651251443},
}};

Point<2> clip_place(const Point<2>& v, double radius, std::size_t i) {
  return {v[0] + 2 * radius * kDirections[i][0], v[1] + 2 * radius * kDirections[i][1]};
}

// Of a squared length: beyond, products of two overflow.
constexpr double kFar2 = 0x1p400;

struct Corner {
  double x, y, length2, tolerance2;
};

// The circumcentre q of (0, a, b), and the square of a bound on the error of 2 w.q in units of |w|.
// With k = |a||b|/|a x b| and eps = 2^-53, rounding in the numerators is at most
// 4 eps k (|a| + |b|), in the denominator 4 eps k |q|, and the rounded a, b move q by as much
// again; |a|, |b| <= 2|q|. So the error of q is below 40 eps k |q|, that of 2 w.q below
// 80 eps k |q| |w|, and that of the sum and of |w|^2 below 16 eps |q| |w| where |w| <= 4|q|
// (beyond, 2 w.q - |w|^2 <= -|w|^2 / 2 is clear). 256 eps k |q| is more than twice that.
Corner circumcentre(double ax, double ay, double bx, double by) {
  const double a2 = ax * ax + ay * ay;
  const double b2 = bx * bx + by * by;
  const double d = 0.5 / (ax * by - ay * bx);
  const double x = (a2 * by - b2 * ay) * d;
  const double y = (b2 * ax - a2 * bx) * d;
  const double q2 = x * x + y * y;
  constexpr double kBound = 2 * 256 * 0x1p-53;  // k = 2 |a||b||d|
  return {x, y, q2, kBound * kBound * (a2 * d) * (b2 * d) * q2};
}

}  // namespace

// The column that grows last says how much room there is: memory may run out on the way.
void VoronoiCell::resize(int n) {
  if (open_.size() < index(n)) {
    const std::size_t room = 2 * index(n);
    for (auto* column : {&ux_, &uy_, &qx_, &qy_, &q2_, &tolerance2_}) column->resize(room);
    place_.resize(room);
    handle_.resize(room);
    clip_.resize(room);
    is_open_.resize(room);
    open_.resize(room);
  }
  size_ = n;
}

void VoronoiCell::reset(const Vertex<2>& v, double radius) {
  SAC_EXPECTS(radius > 0);
  v_ = &v;
  resize(kClips);
  for (std::size_t i = 0; i < kClips; ++i) {
    place_[i] = clip_place(v.p, radius, i);
    ux_[i] = place_[i][0] - v.p[0];
    uy_[i] = place_[i][1] - v.p[1];
    handle_[i] = 0;
    clip_[i] = static_cast<std::uint8_t>(i);
    is_open_[i] = 1;
  }
  for (int i = 0; i < kClips; ++i) set_corner(i);
  update_reach();
}

// The next neighbour of a cell under restoration; the corner before it may be open.
void VoronoiCell::append(const VertexPool<2>& pool, double radius, Code code, bool open_before) {
  const std::size_t i = index(size_);
  resize(size_ + 1);
  const bool is_virtual = code >= kVirtual;
  place_[i] = is_virtual ? clip_place(v_->p, radius, code & 0xff) : pool[code].p;
  ux_[i] = place_[i][0] - v_->p[0];
  uy_[i] = place_[i][1] - v_->p[1];
  handle_[i] = is_virtual ? 0 : code;
  clip_[i] = static_cast<std::uint8_t>(is_virtual ? code & 0xff : 0);
  is_open_[i] = open_before;  // moved to the corner's place by close_ring
}

// Neighbours stay neighbours, in the same order, when others go: what is left to do are the
// corners. They bound one polygon if successive neighbours turn clearly to the left.
bool VoronoiCell::close_ring() {
  if (size_ < 3) return false;
  std::rotate(is_open_.begin(), is_open_.begin() + 1, is_open_.begin() + size_);
  for (int i = 0; i < size_; ++i) {
    const std::size_t a = index(i);
    const std::size_t b = index(next(i));
    const double cross = ux_[a] * uy_[b] - uy_[a] * ux_[b];
    const double a2 = ux_[a] * ux_[a] + uy_[a] * uy_[a];
    const double b2 = ux_[b] * ux_[b] + uy_[b] * uy_[b];
    if (is_open_[a] != 0 && !(cross > 0 && cross * cross > 0x1p-20 * a2 * b2)) return false;
    set_corner(i);
  }
  update_reach();
  return true;
}

// Virtual neighbours that others had hidden come back where these went. They are 2 radius away: no
// corner nearer than that is theirs.
void VoronoiCell::cut_by_clip(double radius) {
  if (open2_ < radius * radius * (1 - 0x1p-20)) return;
  for (std::size_t i = 0; i < kClips; ++i) {
    if (cuts(clip_place(v_->p, radius, i)) && replaces_ < 0) cut(kVirtual | static_cast<Code>(i));
  }
}

void VoronoiCell::adopt(const Vertex<2>& v, double radius, std::span<const Neighbour> ring) {
  SAC_EXPECTS(radius > 0 && ring.size() >= 3);
  v_ = &v;
  resize(static_cast<int>(ring.size()));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    place_[i] = ring[i].place;
    ux_[i] = place_[i][0] - v.p[0];
    uy_[i] = place_[i][1] - v.p[1];
    handle_[i] = ring[i].code;
    clip_[i] = 0;
    is_open_[i] = 0;
  }
  bool finite = true;
  for (int i = 0; i < size_; ++i) {
    set_corner(i);
    finite = finite && q2_[index(i)] < kFar2;
  }
  update_reach();
  if (!finite || reach2_ >= radius * radius * (1 - 0x1p-20)) clip(radius, finite);
}

// The circumcentre of a very flat triangle is infinitely far for doubles, or no number at all: if
// corners are not all finite, only find_cut() is right.
void VoronoiCell::clip(double radius, bool finite) {
  for (std::size_t i = 0; i < kClips; ++i) {
    aim(clip_place(v_->p, radius, i));
    if (finite && is_clear(largest_projection())) continue;
    if (!find_cut() || replaces_ >= 0) continue;
    insert_neighbour(run_first_, run_count_, kVirtual | static_cast<Code>(i));
    update_reach();
  }
}

void VoronoiCell::begin_among(const Vertex<2>& v, double radius,
                              std::span<const Neighbour> neighbours) {
  reset(v, radius);
  for (const Neighbour& u : neighbours) {
    if (cuts(u.place)) cut(u.code);
  }
}

// A corner between two that were next to each other has an empty ball but for who has come since.
void VoronoiCell::close_known(std::span<const Code> codes) {
  for (int i = 0; i < size_; ++i) {
    const auto at = std::find(codes.begin(), codes.end(), code(i));
    if (at == codes.end()) continue;
    const Code after = at + 1 == codes.end() ? codes.front() : at[1];
    if (code(next(i)) == after) is_open_[index(i)] = 0;
  }
  update_reach();
}

Box<2> VoronoiCell::extent_inside(const Point<2>& outward) const noexcept {
  Box<2> extent{{0, 0}, {0, 0}};
  for (int i = 0; i < size_; ++i) {
    const Point<2> q = corner(i);
    const bool beyond = q[0] * outward[0] > 0 || q[1] * outward[1] > 0;
    if (!beyond || (real(i) && real(next(i)))) add_gap_ball(index(i), extent);
  }
  return extent;
}

void VoronoiCell::set_corner(int i) {
  const std::size_t a = index(i);
  const std::size_t b = index(next(i));
  const Corner c = circumcentre(ux_[a], uy_[a], ux_[b], uy_[b]);
  qx_[a] = c.x;
  qy_[a] = c.y;
  q2_[a] = c.length2;
  tolerance2_[a] = c.tolerance2;
}

bool VoronoiCell::is_compact() const noexcept {
  for (int k = 0; k < open_count_; ++k) {
    const int i = open_[index(k)];
    if (!real(i) || !real(next(i))) return false;
  }
  double farthest2 = 0;
  for (std::size_t i = 0; i < index(size_); ++i) {
    farthest2 = std::max(farthest2, ux_[i] * ux_[i] + uy_[i] * uy_[i]);
  }
  return open2_ <= farthest2;
}

void VoronoiCell::add_gap_ball(std::size_t i, Box<2>& extent) const noexcept {
  const double r = gap_radius(i);
  extent.lo = {std::min(extent.lo[0], qx_[i] - r), std::min(extent.lo[1], qy_[i] - r)};
  extent.hi = {std::max(extent.hi[0], qx_[i] + r), std::max(extent.hi[1], qy_[i] + r)};
}

Box<2> VoronoiCell::open_extent() const noexcept {
  Box<2> extent{{0, 0}, {0, 0}};
  for (int k = 0; k < open_count_; ++k) add_gap_ball(open_[index(k)], extent);
  return extent;
}

bool VoronoiCell::exactly_nearer(int i, const Point<2>& w) {
  const int j = next(i);
  for (const int k : {i, j}) {
    if (place(k) == w) {
      replaces_ = k;
      return false;
    }
  }
  return predicates::incircle_perturbed(v_->p, place(i), place(j), w) > 0;
}

void VoronoiCell::aim(const Point<2>& w) noexcept {
  w_ = w;
  wx_ = w[0] - v_->p[0];
  wy_ = w[1] - v_->p[1];
  replaces_ = -1;
  run_count_ = 0;
}

// max w.q over the corners.
double VoronoiCell::largest_projection() const noexcept {
  const double* x = qx_.data();
  const double* y = qy_.data();
  double a = wx_ * x[0] + wy_ * y[0];
  double b = a;
  int i = 1;
  for (; i + 1 < size_; i += 2) {
    a = std::max(a, wx_ * x[i] + wy_ * y[i]);
    b = std::max(b, wx_ * x[i + 1] + wy_ * y[i + 1]);
  }
  if (i < size_) a = std::max(a, wx_ * x[i] + wy_ * y[i]);
  return std::max(a, b);
}

double VoronoiCell::largest_open_projection() const noexcept {
  double most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < open_count_; ++k) {
    const std::size_t i = open_[index(k)];
    most = std::max(most, wx_ * qx_[i] + wy_ * qy_[i]);
  }
  return most;
}

// Finds the run of corners that w takes; by convexity there is one run.
bool VoronoiCell::find_cut() {
  const Point<2> w = w_;
  const double w2 = wx_ * wx_ + wy_ * wy_;
  const auto nearer = [&](int i) {
    const double value = 2 * (wx_ * qx_[index(i)] + wy_ * qy_[index(i)]) - w2;
    if (value * value > tolerance2_[index(i)] * w2) return value > 0;
    return exactly_nearer(i, w);
  };
  int seed = -1;
  for (int i = 0; i < size_ && seed < 0; ++i) {
    if (nearer(i)) seed = i;
  }
  if (seed < 0) return replaces_ >= 0 && !real(replaces_);
  int first = seed;
  int count = 1;
  if (seed == 0) {
    for (int i = size_ - 1; i > 0 && nearer(i); --i) first = i, ++count;
  }
  for (int i = seed + 1; i < (first > seed ? first : size_) && nearer(i); ++i) ++count;
  replaces_ = -1;
  run_first_ = first;
  run_count_ = count;
  return true;
}

void VoronoiCell::cut(Code w) {
  if (replaces_ >= 0) {
    handle_[index(replaces_)] = w;
    return;
  }
  insert_neighbour(run_first_, run_count_, w);
  update_reach();
}

void VoronoiCell::move_entries(int from, int to, int n) {
  const auto copy = [&](int i, int j) {
    const std::size_t a = index(i);
    const std::size_t b = index(j);
    ux_[b] = ux_[a];
    uy_[b] = uy_[a];
    qx_[b] = qx_[a];
    qy_[b] = qy_[a];
    q2_[b] = q2_[a];
    tolerance2_[b] = tolerance2_[a];
    is_open_[b] = is_open_[a];
    place_[b] = place_[a];
    handle_[b] = handle_[a];
    clip_[b] = clip_[a];
  };
  if (from > to) {
    for (int i = 0; i < n; ++i) copy(from + i, to + i);
  } else if (from < to) {
    for (int i = n - 1; i >= 0; --i) copy(from + i, to + i);
  }
}

// Corners first .. first + count - 1 go, and with them the neighbours between; w comes instead.
void VoronoiCell::insert_neighbour(int first, int count, Code w) {
  const int before = first;                   // u_first stays
  const int after = (first + count) % size_;  // u_{first+count} stays
  const int old_size = size_;
  const auto open = [&](int i) { return is_open_[index(i % old_size)] != 0; };
  const bool left_open = open(first + old_size - 1) || open(first);
  const bool right_open = open(first + count - 1) || open(first + count);
  const int fresh_size = size_ - count + 2;  // count - 1 neighbours go, one comes
  int at;                                    // where w goes
  resize(std::max(fresh_size, old_size));
  size_ = fresh_size;
  if (after > before || after == 0) {
    const int end = after == 0 ? old_size : after;
    move_entries(end, before + 2, old_size - end);
    at = before + 1;
  } else {  // the run wraps around: what stays is after .. before
    move_entries(after, 0, before - after + 1);
    at = before - after + 1;
  }
  const std::size_t k = index(at);
  ux_[k] = wx_;
  uy_[k] = wy_;
  place_[k] = w_;
  handle_[k] = w >= kVirtual ? 0 : w;
  clip_[k] = static_cast<std::uint8_t>(w >= kVirtual ? w & 0xff : 0);
  const int left = at == 0 ? size_ - 1 : at - 1;
  set_corner(left);
  set_corner(at);
  is_open_[index(left)] = left_open;
  is_open_[k] = right_open;
}

// The same ring may start elsewhere: the order in which vertices were met decides that.
void VoronoiCell::write(std::vector<Code>& codes) const {
  codes.clear();
  for (int i = 0; i < size_; ++i) codes.push_back(code(i));
  std::rotate(codes.begin(), std::min_element(codes.begin(), codes.end()), codes.end());
}

// Of all corners, the one between a and b reaches farthest in the direction of w if w lies in the
// angle from a to b, the normals of the sides that meet there: if that is not nearer to w, none is.
bool VoronoiCell::may_cut(const VertexPool<2>& pool, const Vertex<2>& v, double radius,
                          std::span<const Code> codes, const Point<2>& p) {
  const Point<2> w{p[0] - v.p[0], p[1] - v.p[1]};
  const double w2 = w[0] * w[0] + w[1] * w[1];
  const auto neighbour = [&](Code code) -> Point<2> {
    const Point<2> place = code >= kVirtual ? clip_place(v.p, radius, code & 0xff) : pool[code].p;
    return {place[0] - v.p[0], place[1] - v.p[1]};
  };
  struct Side {
    bool left, right;  // whether w may be to the left, or to the right, of the direction
  };
  const auto side_of = [&](const Point<2>& a) -> Side {
    const double x = a[0] * w[1];
    const double y = a[1] * w[0];
    const double error = 0x1p-50 * (std::abs(x) + std::abs(y));
    return {x - y >= -error, x - y <= error};
  };
  // Clearly between two directions it is between no others.
  const auto clear = [](const Side& side) { return side.left != side.right; };
  Point<2> a = neighbour(codes.back());
  Side beside_a = side_of(a);
  for (const Code code : codes) {
    const Point<2> b = neighbour(code);
    const Side beside_b = side_of(b);
    if (beside_a.left && beside_b.right) {
      const Corner q = circumcentre(a[0], a[1], b[0], b[1]);
      const double value = 2 * (w[0] * q.x + w[1] * q.y) - w2;
      if (value >= 0 || !(value * value > q.tolerance2 * w2)) return true;
      if (clear(beside_a) && clear(beside_b)) return false;
    }
    a = b;
    beside_a = beside_b;
  }
  return false;
}

void VoronoiCell::check_invariants() const {
  SAC_INVARIANT(size_ >= 3);
  int open = 0;
  for (int i = 0; i < size_; ++i) {
    const std::size_t a = index(i);
    const std::size_t b = index(next(i));
    SAC_INVARIANT(place_[a] != v_->p && place_[a] != place_[b]);
    SAC_INVARIANT(ux_[a] == place_[a][0] - v_->p[0] && uy_[a] == place_[a][1] - v_->p[1]);
    SAC_INVARIANT(predicates::orient2d(v_->p, place_[a], place_[b]) > 0);
    const Corner q = circumcentre(ux_[a], uy_[a], ux_[b], uy_[b]);
    SAC_INVARIANT(q.x == qx_[a] && q.y == qy_[a] && q.length2 == q2_[a]);
    SAC_INVARIANT(q2_[a] <= reach2_ && (is_open_[a] == 0 || q2_[a] <= open2_));
    SAC_INVARIANT(real(i) || clip_[a] < kClips);
    open += is_open_[a] != 0;
  }
  SAC_INVARIANT(open == open_count_);
}

}  // namespace mesher::detail
