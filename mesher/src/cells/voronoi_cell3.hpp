// The Voronoi cell of a vertex v in space, clipped, and with it v's gap balls and Delaunay star
// [Def 4.2.1], as its dual [rules B1].
//
// The clip is six virtual vertices at distance 2R around v, as for VoronoiCell in the plane;
// voronoi_cell.hpp explains the cell, its corners, cuts, ties and repair. Here the neighbours u of
// v are the vertices of a triangulated sphere, v's link: a triangle (a, b, c), with v, is a
// Delaunay tetrahedron, whose circumcentre is a corner of the cell.
//
// cut(w) removes the corners nearer to w than to v. They are connected, and so are the others (the
// cell is a convex polyhedron, cut by a plane): their triangles make a disc, whose rim is joined to
// w instead. Each triangle knows those across its edges.
//
// Neighbours and triangles have numbers, which change with cuts; as sets they depend on the set of
// vertices alone. A neighbour's number may be unused.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cells/corner_reach.hpp"
#include "cells/link_record.hpp"
#include "geometry/circumcentre.hpp"
#include "geometry/lanes.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/mesh.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

class VoronoiCell3 : public CornerReach<int> {
 public:
  static constexpr int kClips = 6;
  using Code = LinkRecord::Code;
  static constexpr Code kVirtual = LinkRecord::kVirtual;

  /// The clip alone: the cell of a vertex that is by itself. Requires: radius > 0.
  void reset(const Vertex<3>& v, double radius);

  /// The cell of v among those of its former neighbours for which left(code). `repair`: they are
  /// all of v's neighbours that are left, so triangles that were there before are closed; else all
  /// are open. `radius`: of the clip, and of that of the record if virtual ones are left.
  template <class Left>
  void restore(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
               std::span<const Code> record, Left&& left, bool repair);

  struct Neighbour {
    Code code;
    Point<3> place;
  };
  struct Face {
    std::array<int, 3> end;     // neighbours
    std::array<int, 3> across;  // the triangle that does not have end[k]
  };
  /// The cell of v among its neighbours in a Delaunay triangulation of all vertices, which it is
  /// inside of: all of them, with the triangles between them. No corner is open.
  /// Requires: radius > 0; orient3d(v, a, b, c) > 0 of each face.
  void adopt(const Vertex<3>& v, double radius, std::span<const Neighbour> neighbours,
             std::span<const Face> faces);
  /// The cell of v among these, in any order; all corners may be open. Requires: radius > 0.
  void begin_among(const Vertex<3>& v, double radius, std::span<Neighbour> neighbours);

  /// Whether w is nearer than v to some corner; of a virtual neighbour's place: whether it takes
  /// it.
  [[nodiscard]] bool cuts(const Point<3>& w) {
    aim(w);
    return !is_clear(largest_projection()) && find_cut();
  }
  /// The same for a w that is known not to take closed corners only.
  [[nodiscard]] bool cuts_open(const Point<3>& w) {
    aim(w);
    return may_take_open() && find_cut();
  }
  /// Cuts the cell by the vertex w. Requires: the last call was cuts(its place) or cuts_open, and
  /// it said true.
  void cut(Code w);

  /// Whether the gap ball of an open corner reaches into the cube [corner, corner + side]^3,
  /// relative to v, widened by `margin` [L 4.3.3].
  [[nodiscard]] bool enters(const Point<3>& corner, double side, double margin) const noexcept;

  /// Neighbours have numbers below this; some are unused.
  [[nodiscard]] int size() const noexcept { return neighbours_; }
  [[nodiscard]] bool used(int i) const noexcept { return uses_[index(i)] != 0; }
  [[nodiscard]] bool real(int i) const noexcept { return code_[index(i)] < kVirtual; }
  [[nodiscard]] VertexHandle handle(int i) const noexcept { return real(i) ? code(i) : 0; }
  [[nodiscard]] Code code(int i) const noexcept { return code_[index(i)]; }
  /// A neighbour relative to v.
  [[nodiscard]] const Point<3>& neighbour(int i) const noexcept { return u_[index(i)]; }
  /// A neighbour where it is.
  [[nodiscard]] const Point<3>& place(int i) const noexcept { return place_[index(i)]; }
  /// Whether u is a neighbour.
  [[nodiscard]] bool has(VertexHandle u) const noexcept;

  /// The triangles, and so the corners, are numbered 0 .. corners() - 1.
  [[nodiscard]] int corners() const noexcept { return corners_; }
  /// The neighbours around a corner: orient3d(v, a, b, c) > 0.
  [[nodiscard]] const std::array<int, 3>& ends(int t) const noexcept { return face_[index(t)].end; }
  /// The corners beside a corner: the k-th does not have ends(t)[k] around it.
  [[nodiscard]] const std::array<int, 3>& across(int t) const noexcept {
    return face_[index(t)].across;
  }
  /// A corner, relative to v.
  [[nodiscard]] Point<3> corner(int t) const noexcept {
    return {qx_[index(t)], qy_[index(t)], qz_[index(t)]};
  }
  [[nodiscard]] double corner2(int t) const noexcept { return q2_[index(t)]; }
  /// As in the plane: whether the cell is not much larger than it will be.
  [[nodiscard]] bool is_compact() const noexcept;
  /// A box around the gap balls of the open corners, relative to v.
  [[nodiscard]] Box<3> open_extent() const noexcept;
  /// The same of the corners between three real neighbours, or on the inner side of the planes
  /// through v with these outer normals (entries -1, 0, 1; 0: no plane).
  [[nodiscard]] Box<3> extent_inside(const Point<3>& outward) const noexcept;
  [[nodiscard]] const Vertex<3>& center() const noexcept { return *v_; }

  /// Writes the cell down, as LinkRecord reads it.
  void write(std::vector<Code>& record) const;

  /// The neighbours of a cell that was written down, ascending.
  [[nodiscard]] static std::span<const Code> neighbours(std::span<const Code> record) noexcept {
    return LinkRecord(record).neighbours();
  }
  /// Neighbours as they were written down, but in the order `before`.
  template <class Before>
  static void put_in_order(std::vector<Code>& codes, Before&& before) {
    std::sort(codes.begin(), codes.end(), before);
  }
  /// Calls visit(a, b, c) for the neighbours around each corner of a cell that was written down.
  template <class Visit>
  static void for_each_link_simplex(std::span<const Code> record, Visit&& visit) {
    const LinkRecord link(record);
    for (std::size_t t = 0; t < link.triangles(); ++t) visit(link.codes(t));
  }

  /// Whether a vertex at `p` would cut the cell of v that was written down, erring towards yes.
  [[nodiscard]] static bool may_cut(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
                                    std::span<const Code> record, const Point<3>& p) noexcept;
  /// Whether that takes less than a look at memory.
  static constexpr bool kMayCutIsCheap = false;
  /// Calls visit(centre, radius2), relative to v, for the gap balls of the cell of v that was
  /// written down, but for those between virtual neighbours alone.
  template <class Visit>
  static void visit_gap_balls(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
                              std::span<const Code> record, Visit&& visit);

  /// Throws InvariantError unless the triangles are a sphere around v, and the corners theirs.
  void check_invariants() const;

 private:
  // An edge of the disc that a cut takes, and the triangle that stays beyond it.
  struct Rim {
    int from, to;
    int beyond;
    bool open;
  };

  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  static Point<3> clip_place(const Point<3>& v, double radius, std::size_t i);
  static Point<3> place_of(const VertexPool<3>& pool, const Point<3>& v, double radius, Code code) {
    return code >= kVirtual ? clip_place(v, radius, code & 0xff) : pool[code].p;
  }
  void clear(const Vertex<3>& v) noexcept;
  [[nodiscard]] int new_neighbour(Code code, const Point<3>& place);
  [[nodiscard]] int new_face();
  void set_face(int t, const Face& face, bool open);
  void load(const VertexPool<3>& pool, double radius, const LinkRecord& record, bool open);
  void join_across();
  void join_many_across();
  template <class Left>
  bool restore_by_removal(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
                          const LinkRecord& record, Left& left, bool repair);
  template <class Left>
  void cut_by_nearest(const VertexPool<3>& pool, std::span<const Code> codes, Left&& left);
  void cut_by_clip(double radius);
  void clip(double radius);
  void close_known(const LinkRecord& record);
  void aim(const Point<3>& w) noexcept;
  [[nodiscard]] bool is_clear(double projection) const noexcept {
    return projection < w2_ / 2 - error_;
  }
  [[nodiscard]] double largest_projection() const noexcept;
  [[nodiscard]] bool may_take_open() const noexcept;
  bool find_cut();
  bool exactly_nearer(int t);
  void find_rim();
  void release_ends();
  void join_rim(int to);
  void link_across(int t, int from, int to, int other) noexcept;
  void give_up_number(int t);
  bool remove(int i);
  void walk_rim();
  [[nodiscard]] bool is_ear(std::size_t at);
  void cut_ear(std::size_t at, int t);
  void update_reach() noexcept;
  void add_gap_ball(int t, Box<3>& extent) const noexcept;

  const Vertex<3>* v_ = nullptr;
  // Of the candidate under test: its place, relative to v too, and the corners it takes.
  Point<3> w_{};
  Point<3> aim_{};
  double w2_ = 0;
  std::vector<int> taken_;
  std::vector<std::uint8_t> is_taken_;
  int replaces_ = -1;  // a virtual neighbour at the candidate's very place
  std::vector<Rim> rim_;
  std::vector<std::pair<double, Code>> by_distance_;
  std::vector<int> rim_at_;  // by neighbour: the edge of the rim that starts there
  // Of a hole that is being filled: what is left of its rim, in order.
  struct Side {
    int from;    // a neighbour
    int beyond;  // the triangle beyond the edge to the next one
  };
  std::vector<Side> hole_;
  // Of a record that is being loaded: the triangle of each directed edge, in a square table; or, of
  // many, the edges whose other triangle has not come, by neighbour.
  std::vector<int> edges_;
  struct Unpaired {
    int other, face, opposite;
  };
  std::vector<std::vector<Unpaired>> unpaired_;
  // Of a record that is being written.
  mutable std::vector<std::pair<Code, std::uint32_t>> by_code_;
  mutable std::vector<std::uint32_t> position_;
  mutable std::vector<Code> codes_;
  mutable std::vector<LinkRecord::Triangle> triangles_;

  int neighbours_ = 0;
  std::vector<Point<3>> u_, place_;
  std::vector<Code> code_;  // kUnused of an unused number
  std::vector<int> uses_;   // in triangles
  std::vector<int> unused_;
  int corners_ = 0;
  std::vector<double> qx_, qy_, qz_;
  std::vector<Face> face_;
  // The open corners once more, one behind the other, to be looked at several in one step; behind
  // them may be one that nothing comes near.
  struct {
    std::array<std::vector<double>, 3> q;
    std::vector<double> q2;  // a little more
  } near_;
  std::size_t near_count_ = 0;  // a multiple of kLanes

  static constexpr Code kUnused = 0xffffffffu;
};

inline bool VoronoiCell3::enters(const Point<3>& corner, double side,
                                 double margin) const noexcept {
  Point<3> lo, hi;
  bool holds_v = true;
  for (std::size_t i = 0; i < 3; ++i) {
    lo[i] = corner[i] - margin;
    hi[i] = corner[i] + side + margin;
    holds_v &= lo[i] <= 0 && hi[i] >= 0;
  }
  if (holds_v) return true;
  LaneMask enters{};  // no early end, which could not be predicted
  for (std::size_t k = 0; k < near_count_; k += kLanes) {
    Lanes away2{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Lanes q = lanes_at(&near_.q[i][k]);
      const Lanes d = greater(greater(both(lo[i]) - q, q - both(hi[i])), Lanes{});
      away2 += d * d;
    }
    enters |= away2 <= lanes_at(&near_.q2[k]);
  }
  return any(enters);
}

inline bool VoronoiCell3::has(VertexHandle u) const noexcept {
  bool has = false;
  for (int i = 0; i < neighbours_; ++i) has |= code_[index(i)] == u;
  return has;
}

// The nearest first: then few cut what the next ones take away again.
template <class Left>
void VoronoiCell3::cut_by_nearest(const VertexPool<3>& pool, std::span<const Code> codes,
                                  Left&& left) {
  by_distance_.clear();
  for (const Code code : codes) {
    if (code >= kVirtual || !left(code)) continue;
    by_distance_.emplace_back(squared_distance(pool[code].p, v_->p), code);
  }
  std::sort(by_distance_.begin(), by_distance_.end());
  for (const auto& [distance2, code] : by_distance_) {
    if (cuts(pool[code].p)) cut(code);
  }
}

template <class Left>
void VoronoiCell3::restore(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
                           std::span<const Code> record, Left&& left, bool repair) {
  const LinkRecord link(record);
  if (!restore_by_removal(pool, v, radius, link, left, repair)) {
    reset(v, radius);
    cut_by_nearest(pool, link.neighbours(), left);
    if (repair) close_known(link);
  }
}

template <class Visit>
void VoronoiCell3::visit_gap_balls(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
                                   std::span<const Code> record, Visit&& visit) {
  const LinkRecord link(record);
  for (std::size_t t = 0; t < link.triangles(); ++t) {
    const auto [a, b, c] = link.codes(t);
    if (a >= kVirtual && b >= kVirtual && c >= kVirtual) continue;
    const auto place = [&](Code code) { return place_of(pool, v.p, radius, code); };
    const Circumcentre ball = circumcentre(v.p, place(a), place(b), place(c));
    visit(ball.q, squared(ball.q));
  }
}

// Returns false, and then leaves no cell, if those who are left do not surround v, if the places of
// virtual neighbours are others now, or if that took longer than to begin anew.
template <class Left>
bool VoronoiCell3::restore_by_removal(const VertexPool<3>& pool, const Vertex<3>& v, double radius,
                                      const LinkRecord& record, Left& left, bool repair) {
  const auto codes = record.neighbours();
  const auto clip = std::lower_bound(codes.begin(), codes.end(), kVirtual);
  if (!std::all_of(clip, codes.end(), left)) return false;
  clear(v);
  load(pool, radius, record, !repair);
  for (auto code = codes.begin(); code != clip; ++code) {
    if (!left(*code) && !remove(static_cast<int>(code - codes.begin()))) return false;
  }
  update_reach();
  cut_by_clip(radius);
  return true;
}

}  // namespace mesher::detail
