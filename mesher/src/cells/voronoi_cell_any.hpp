// The Voronoi cell of a vertex v in D dimensions, clipped, and with it v's gap balls and Delaunay
// star [Def 4.2.1], as its dual. voronoi_cell3.hpp explains the cell, its corners, cuts, ties and
// repair; this class has the same functions. It is for dimensions above 3: general, not fast.
//
// v's link is a triangulated sphere of simplices of D neighbours: with v each is a Delaunay
// simplex, whose circumcentre is a corner of the cell. The clip are 2 D virtual neighbours at
// distance 2R along directions at right angles, so the cell is in a cube around the ball of radius
// R.
//
// cut(w) removes the corners nearer to w than to v, decided exactly, ties by coordinates; the rim
// of the removed part is joined to w. A repaired cell is cut anew from its remaining neighbours;
// corners that it had before are closed.
//
// A record has: the number of neighbours, their codes, ascending, and D positions among them for
// each simplex of the link: ascending, but that the last two are swapped where that is needed for v
// to be positively oriented before them; simplices ascend.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cells/corner_reach.hpp"
#include "geometry/any_vectors.hpp"
#include "geometry/ball_any.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/mesh.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

template <int D>
class VoronoiCellAny : public CornerReach<int> {
 public:
  static constexpr int kClips = 2 * D;
  using Code = std::uint32_t;
  static constexpr Code kVirtual = 0xffffff00u;
  using Ends = std::array<int, D>;

  /// The clip alone. Requires: radius > 0.
  void reset(const Vertex<D>& v, double radius);
  /// The cell of v among those of its former neighbours for which left(code), with the clip.
  /// `repair`: they are all of v's neighbours that are left, so what was there before is closed.
  template <class Left>
  void restore(const VertexPool<D>& pool, const Vertex<D>& v, double radius,
               std::span<const Code> record, Left&& left, bool repair);

  /// Whether w is nearer than v to some corner; of a virtual neighbour's place: whether it takes
  /// it.
  [[nodiscard]] bool cuts(const Point<D>& w);
  [[nodiscard]] bool cuts_open(const Point<D>& w) { return cuts(w); }
  /// Cuts the cell by the vertex w. Requires: the last call was cuts(its place), and it said true.
  void cut(Code w);

  /// Whether the gap ball of an open corner reaches into the cube [corner, corner + side]^D,
  /// relative to v, widened by `margin`.
  [[nodiscard]] bool enters(const Point<D>& corner, double side, double margin) const noexcept;

  /// Neighbours have numbers below this; some are unused.
  [[nodiscard]] int size() const noexcept { return static_cast<int>(neighbours_.size()); }
  [[nodiscard]] bool used(int i) const noexcept { return at(i).uses != 0; }
  [[nodiscard]] bool real(int i) const noexcept { return at(i).code < kVirtual; }
  [[nodiscard]] VertexHandle handle(int i) const noexcept { return real(i) ? code(i) : 0; }
  [[nodiscard]] Code code(int i) const noexcept { return at(i).code; }
  /// A neighbour relative to v, and where it is.
  [[nodiscard]] const Point<D>& neighbour(int i) const noexcept { return at(i).u; }
  [[nodiscard]] const Point<D>& place(int i) const noexcept { return at(i).place; }
  [[nodiscard]] bool has(VertexHandle u) const noexcept;

  /// The corners are numbered 0 .. corners() - 1; the neighbours around one: v is positively
  /// oriented before them.
  [[nodiscard]] int corners() const noexcept { return static_cast<int>(faces_.size()); }
  [[nodiscard]] const Ends& ends(int t) const noexcept { return faces_[index(t)].end; }
  /// A corner, relative to v.
  [[nodiscard]] const Point<D>& corner(int t) const noexcept { return faces_[index(t)].q; }
  [[nodiscard]] double corner2(int t) const noexcept { return q2_[index(t)]; }
  [[nodiscard]] bool is_compact() const noexcept;
  /// A box around the gap balls of the open corners, relative to v; of the corners between real
  /// neighbours, or on the inner side of the planes through v with these outer normals.
  [[nodiscard]] Box<D> open_extent() const noexcept;
  [[nodiscard]] Box<D> extent_inside(const Point<D>& outward) const noexcept;
  [[nodiscard]] const Vertex<D>& center() const noexcept { return *v_; }

  void write(std::vector<Code>& record) const;
  /// The neighbours of a cell that was written down, ascending.
  [[nodiscard]] static std::span<const Code> neighbours(std::span<const Code> record) noexcept {
    return record.subspan(1, record[0]);
  }
  template <class Before>
  static void put_in_order(std::vector<Code>& codes, Before&& before) {
    std::sort(codes.begin(), codes.end(), before);
  }
  /// Calls visit(codes) for the neighbours around each corner of a cell that was written down.
  template <class Visit>
  static void for_each_link_simplex(std::span<const Code> record, Visit&& visit) {
    const auto codes = neighbours(record);
    for (std::size_t k = 1 + codes.size(); k < record.size(); k += D) {
      std::array<Code, D> simplex;
      for (std::size_t i = 0; i < D; ++i) simplex[i] = codes[record[k + i]];
      visit(simplex);
    }
  }
  /// Whether a vertex at `p` would cut the cell of v that was written down, erring towards yes.
  [[nodiscard]] static bool may_cut(const VertexPool<D>& pool, const Vertex<D>& v, double radius,
                                    std::span<const Code> record, const Point<D>& p);
  static constexpr bool kMayCutIsCheap = false;

  /// Throws InvariantError unless the simplices are around v, each beside D others.
  void check_invariants() const;

 private:
  struct Neighbour {
    Point<D> u{}, place{};
    Code code = 0;
    int uses = 0;  // in simplices
  };
  struct Face {
    Ends end{}, across{};  // the k-th across does not have end[k]
    Point<D> q{};
    bool taken = false;
  };
  // A ridge of the rim: the face whose place a new one takes, less its k-th end, and who is beyond.
  struct Rim {
    Ends end;
    std::size_t k;
    int beyond;
    bool open;
  };

  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] const Neighbour& at(int i) const noexcept { return neighbours_[index(i)]; }
  [[nodiscard]] static Point<D> clip_place(const Point<D>& v, double radius, std::size_t i);
  [[nodiscard]] static Point<D> place_of(const VertexPool<D>& pool, const Point<D>& v,
                                         double radius, Code code) {
    return code >= kVirtual ? clip_place(v, radius, code & 0xff) : pool[code].p;
  }
  [[nodiscard]] BallCorners<D> places(const Ends& ends) const {
    BallCorners<D> corners;
    for (std::size_t k = 0; k < D; ++k) corners[k] = place(ends[k]);
    return corners;
  }
  void close_known(std::span<const Code> record);
  [[nodiscard]] int new_neighbour(Code code, const Point<D>& place);
  [[nodiscard]] int new_face();
  void set_face(int t, const Ends& end, bool open);
  [[nodiscard]] bool takes(int t);
  [[nodiscard]] std::vector<Rim> find_rim() const;
  void release_ends();
  void join(const std::vector<int>& fresh, std::size_t w);
  void give_up_number(int t);
  [[nodiscard]] std::vector<Code> simplices() const;
  void update_reach() noexcept { CornerReach::update_reach(faces_.size()); }
  void add_gap_ball(int t, Box<D>& extent) const noexcept;
  [[nodiscard]] bool is_real(const Ends& ends) const noexcept {
    return std::all_of(ends.begin(), ends.end(), [&](int i) { return real(i); });
  }

  const Vertex<D>* v_ = nullptr;
  std::vector<Neighbour> neighbours_;
  std::vector<int> unused_;
  std::vector<Face> faces_;
  // Of the candidate under test: its place, relative to v too, and the corners that it takes.
  Point<D> w_{}, aim_{};
  double w2_ = 0;
  std::vector<int> taken_;
  int replaces_ = -1;  // a virtual neighbour at the candidate's very place

  static constexpr Code kUnused = 0xffffffffu;
};

// The nearest first: then few cut what the next ones take away again.
template <int D>
template <class Left>
void VoronoiCellAny<D>::restore(const VertexPool<D>& pool, const Vertex<D>& v, double radius,
                                std::span<const Code> record, Left&& left, bool repair) {
  reset(v, radius);
  std::vector<std::pair<double, Code>> by_distance;
  for (const Code code : neighbours(record)) {
    if (code >= kVirtual || !left(code)) continue;
    by_distance.emplace_back(squared_distance(pool[code].p, v.p), code);
  }
  std::sort(by_distance.begin(), by_distance.end());
  for (const auto& [distance2, code] : by_distance) {
    if (cuts(pool[code].p)) cut(code);
  }
  if (repair) close_known(record);
}

}  // namespace mesher::detail
