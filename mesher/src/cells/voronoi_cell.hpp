// The Voronoi cell of a vertex v, clipped, and with it v's gap balls and Delaunay star [Def 4.2.1].
//
// The clip is eight virtual vertices at distance 2R around v: the cell is that of v among the real
// and the virtual vertices. A corner of the cell is the centre of a gap ball; a corner between two
// real neighbours u_i, u_{i+1} at distance r from v is a Delaunay triangle of circumradius r.
// At a corner next to a virtual neighbour the star is hidden beyond R.
//
// Notation: neighbours u_0 .. u_{m-1} counterclockwise, corner q_i between u_i and u_{i+1}, all
// relative to v. cut(w) removes the corners nearer to w than to v. Whether q_i is nearer is the
// sign of incircle(v, u_i, u_{i+1}, w): computed from q_i with an error bound, exactly (ties by
// coordinates) where that does not decide. So the result depends on the set of vertices alone, not
// on the order of cuts.
//
// Repair. A cell known for one set of vertices is updated to another set: restore() takes the
// remaining neighbours, cut() the new vertices, and removed neighbours leave *open* corners, whose
// gap balls must be searched for their successors. A corner between two neighbours that were next
// to each other before is closed: its gap ball is empty but for the new vertices. So is one that a
// cut makes on the edge between two closed corners, since its ball is in the union of theirs. A
// cell that starts from the clip has open corners only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cells/corner_reach.hpp"
#include "mesher/mesh.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

class VoronoiCell : public CornerReach<std::uint16_t> {
 public:
  static constexpr int kClips = 8;

  /// The clip alone: the cell of a vertex that is by itself. Requires: radius > 0.
  void reset(const Vertex<2>& v, double radius);

  /// A neighbour as it is written down: a handle, or a virtual one.
  using Code = std::uint32_t;
  /// The cell of v among those of its former neighbours, counterclockwise, for which left(code).
  /// `repair`: they are all of v's neighbours that are left, so corners between those that were
  /// next to each other are closed; else all are open. Requires: radius > 0; virtual ones that are
  /// left are of this radius.
  template <class Left>
  void restore(const VertexPool<2>& pool, const Vertex<2>& v, double radius,
               std::span<const Code> codes, Left&& left, bool repair);

  /// A neighbour in a Delaunay triangulation, which needs no link beside: the plane's are a ring.
  struct Neighbour {
    Code code;
    Point<2> place;
  };
  struct Face {};
  /// The cell of v among its neighbours in a Delaunay triangulation of all vertices, which it is
  /// inside of: all of them, counterclockwise. No corner is open. Requires: radius > 0.
  void adopt(const Vertex<2>& v, double radius, std::span<const Neighbour> ring);
  /// The cell of v among these, in any order; all corners may be open. Requires: radius > 0.
  void begin_among(const Vertex<2>& v, double radius, std::span<const Neighbour> neighbours);

  /// Whether w is nearer than v to some corner; of a virtual neighbour's place: whether it takes
  /// it.
  [[nodiscard]] bool cuts(const Point<2>& w) {
    aim(w);
    return !is_clear(largest_projection()) && find_cut();
  }
  /// The same for a w that is known not to take closed corners only.
  [[nodiscard]] bool cuts_open(const Point<2>& w) {
    aim(w);
    return !is_clear(largest_open_projection()) && find_cut();
  }
  /// Cuts the cell by the vertex w. Requires: the last call was cuts(its place) or cuts_open, and
  /// it said true.
  void cut(Code w);

  /// Whether the gap ball of an open corner reaches into the square [corner, corner + side]^2,
  /// relative to v, widened by `margin` [L 4.3.3].
  [[nodiscard]] bool enters(const Point<2>& corner, double side, double margin) const noexcept;

  [[nodiscard]] int size() const noexcept { return size_; }
  /// Whether u is a neighbour.
  [[nodiscard]] bool has(VertexHandle u) const noexcept;
  [[nodiscard]] bool real(int i) const noexcept { return handle_[index(i)] != 0; }
  [[nodiscard]] VertexHandle handle(int i) const noexcept { return handle_[index(i)]; }
  /// Neighbour u_i relative to v.
  [[nodiscard]] Point<2> neighbour(int i) const noexcept { return {ux_[index(i)], uy_[index(i)]}; }
  /// Neighbour u_i where it is.
  [[nodiscard]] const Point<2>& place(int i) const noexcept { return place_[index(i)]; }
  /// Corner q_i between u_i and u_{i+1}, relative to v.
  [[nodiscard]] Point<2> corner(int i) const noexcept { return {qx_[index(i)], qy_[index(i)]}; }
  [[nodiscard]] double corner2(int i) const noexcept { return q2_[index(i)]; }
  [[nodiscard]] int next(int i) const noexcept { return i + 1 == size_ ? 0 : i + 1; }
  /// Corners have the numbers of neighbours; around q_i are these.
  [[nodiscard]] int corners() const noexcept { return size_; }
  [[nodiscard]] std::array<int, 2> ends(int i) const noexcept { return {i, next(i)}; }
  /// Whether no open corner is next to a virtual neighbour, nor farther than the neighbours: then
  /// the cell is not much larger than it will be.
  [[nodiscard]] bool is_compact() const noexcept;
  /// A box around the gap balls of the open corners, relative to v.
  [[nodiscard]] Box<2> open_extent() const noexcept;
  /// The same of the corners that are next to a real neighbour on both sides, or on the inner side
  /// of the lines through v with these outer normals (entries -1, 0, 1; 0: no line).
  [[nodiscard]] Box<2> extent_inside(const Point<2>& outward) const noexcept;
  [[nodiscard]] const Vertex<2>& center() const noexcept { return *v_; }

  /// Whether a vertex at `p` would cut the cell of v with these neighbours, erring towards yes.
  /// `codes`: all its neighbours, counterclockwise.
  [[nodiscard]] static bool may_cut(const VertexPool<2>& pool, const Vertex<2>& v, double radius,
                                    std::span<const Code> codes, const Point<2>& p);
  /// Whether that takes less than a look at memory.
  static constexpr bool kMayCutIsCheap = true;

  /// Writes the cell down: its neighbours, counterclockwise from the least code on.
  void write(std::vector<Code>& codes) const;
  /// The neighbours of a cell that was written down.
  [[nodiscard]] static std::span<const Code> neighbours(std::span<const Code> codes) noexcept {
    return codes;
  }
  /// Neighbours as they were written down, but from the least on in the order `before`.
  template <class Before>
  static void put_in_order(std::vector<Code>& codes, Before&& before) {
    std::rotate(codes.begin(), std::min_element(codes.begin(), codes.end(), before), codes.end());
  }
  /// Calls visit(u_i, u_{i+1}) for the neighbours around each corner of a cell that was written
  /// down by its neighbours, counterclockwise.
  template <class Visit>
  static void for_each_link_simplex(std::span<const Code> codes, Visit&& visit) {
    for (std::size_t i = 0; i < codes.size(); ++i) {
      visit(std::array<Code, 2>{codes[i], codes[i + 1 == codes.size() ? 0 : i + 1]});
    }
  }

  /// Throws InvariantError unless the corners are those of the neighbours and surround v.
  void check_invariants() const;

  /// How a virtual neighbour is written where a handle is stored.
  static constexpr Code kVirtual = 0xffffff00u;
  [[nodiscard]] Code code(int i) const noexcept {
    return real(i) ? handle(i) : kVirtual | static_cast<Code>(clip_[index(i)]);
  }

 private:
  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  void aim(const Point<2>& w) noexcept;
  [[nodiscard]] bool is_clear(double projection) const noexcept {
    return projection < (wx_ * wx_ + wy_ * wy_) / 2 - error_;
  }
  [[nodiscard]] double largest_projection() const noexcept;
  [[nodiscard]] double largest_open_projection() const noexcept;
  void append(const VertexPool<2>& pool, double radius, Code code, bool open_before);
  [[nodiscard]] bool close_ring();
  void cut_by_clip(double radius);
  void clip(double radius, bool finite);
  void close_known(std::span<const Code> codes);
  bool find_cut();
  bool exactly_nearer(int i, const Point<2>& w);
  void set_corner(int i);
  void move_entries(int from, int to, int n);
  void insert_neighbour(int first, int count, Code w);
  void resize(int n);
  void update_reach() noexcept { CornerReach::update_reach(index(size_)); }
  void add_gap_ball(std::size_t i, Box<2>& extent) const noexcept;

  const Vertex<2>* v_ = nullptr;
  int size_ = 0;
  // Of the candidate under test: its place relative to v, and the run of corners it takes.
  Point<2> w_{};
  double wx_ = 0;
  double wy_ = 0;
  int run_first_ = 0;
  int run_count_ = 0;
  int replaces_ = -1;  // a virtual neighbour at the candidate's very place
  std::vector<double> ux_, uy_, qx_, qy_;
  std::vector<Point<2>> place_;
  std::vector<VertexHandle> handle_;
  std::vector<std::uint8_t> clip_;
};

inline bool VoronoiCell::enters(const Point<2>& corner, double side, double margin) const noexcept {
  const double x0 = corner[0] - margin;
  const double y0 = corner[1] - margin;
  const double x1 = corner[0] + side + margin;
  const double y1 = corner[1] + side + margin;
  if (x0 <= 0 && y0 <= 0 && x1 >= 0 && y1 >= 0) return true;  // v itself
  const double* qx = qx_.data();
  const double* qy = qy_.data();
  const double* q2 = q2_.data();
  bool enters = false;  // corners are few: no early end, which could not be predicted
  for (int k = 0; k < open_count_; ++k) {
    const std::size_t i = open_[index(k)];
    const double dx = std::max(std::max(x0 - qx[i], qx[i] - x1), 0.0);
    const double dy = std::max(std::max(y0 - qy[i], qy[i] - y1), 0.0);
    enters |= dx * dx + dy * dy <= q2[i] * (1 + 0x1p-30);
  }
  return enters;
}

inline bool VoronoiCell::has(VertexHandle u) const noexcept {
  const VertexHandle* handles = handle_.data();
  bool has = false;
  for (int i = 0; i < size_; ++i) has |= handles[i] == u;
  return has;
}

template <class Left>
void VoronoiCell::restore(const VertexPool<2>& pool, const Vertex<2>& v, double radius,
                          std::span<const Code> codes, Left&& left, bool repair) {
  v_ = &v;
  size_ = 0;
  bool gap = !codes.empty() && !left(codes.back());
  for (const Code code : codes) {
    const bool stays = left(code);
    if (stays) append(pool, radius, code, gap || !repair);
    gap = !stays;
  }
  if (close_ring()) return cut_by_clip(radius);
  reset(v, radius);  // they do not surround v
  for (const Code code : codes) {
    if (code < kVirtual && left(code) && cuts(pool[code].p)) cut(code);
  }
  if (repair) close_known(codes);
}

}  // namespace mesher::detail
