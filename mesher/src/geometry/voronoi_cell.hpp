// The Voronoi cell of a vertex v, clipped, and with it v's gap balls and Delaunay star [Def 4.2.1].
//
// The clip is eight virtual vertices at distance 2R around v: the cell is that of v among the real
// and the virtual vertices. A corner of the cell is the centre of a gap ball; a corner between two
// real neighbours u_i, u_{i+1} at distance r from v is a Delaunay triangle of circumradius r.
// A corner next to a virtual neighbour says that the star is hidden there beyond R.
//
// Notation: neighbours u_0 .. u_{m-1} counterclockwise, corner q_i between u_i and u_{i+1}, all
// relative to v. cut(w) takes away the corners nearer to w than to v. Whether q_i is nearer is the
// sign of incircle(v, u_i, u_{i+1}, w): computed from q_i with an error bound, exactly (ties by
// coordinates) where that does not decide. So the result depends on the set of vertices alone, not
// on the order of cuts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesher/mesh.hpp"
#include "index/vertex.hpp"

namespace mesher::detail {

class VoronoiCell {
 public:
  static constexpr int kClips = 8;

  /// The clip alone: the cell of a vertex that is by itself. Requires: radius > 0.
  void reset(const Vertex<2>& v, double radius);

  /// Whether w might cut, by distance: |w - v|^2 < 4 max |q|^2.
  [[nodiscard]] bool in_reach(double distance2) const noexcept { return distance2 <= 4 * reach2_; }

  /// Whether w is nearer than v to some corner; of a virtual neighbour's place: whether it takes
  /// it.
  [[nodiscard]] bool cuts(const Point<2>& w) { return find_cut(w); }
  /// Cuts the cell by the vertex w. Requires: the last call was cuts(its place), and it said true.
  void cut(VertexHandle w);

  /// Whether a gap ball reaches into the square [corner, corner + side]^2, relative to v, widened
  /// by `margin` [L 4.3.3].
  [[nodiscard]] bool enters(const Point<2>& corner, double side, double margin) const noexcept;

  [[nodiscard]] int size() const noexcept { return size_; }
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
  /// max |q_i|^2.
  [[nodiscard]] double reach2() const noexcept { return reach2_; }
  [[nodiscard]] const Vertex<2>& center() const noexcept { return *v_; }

  /// Whether a vertex at `p` would cut the cell of v with these neighbours, erring towards yes.
  /// `handles`: m neighbours counterclockwise, virtual ones coded by clip_code.
  [[nodiscard]] static bool may_cut(const VertexPool<2>& pool, const Vertex<2>& v, double radius,
                                    const std::uint32_t* handles, int m, const Point<2>& p);

  /// How a virtual neighbour is written where a handle is stored.
  static constexpr std::uint32_t kVirtual = 0xffffff00u;
  [[nodiscard]] std::uint32_t code(int i) const noexcept {
    return real(i) ? handle(i) : kVirtual | static_cast<std::uint32_t>(clip_[index(i)]);
  }

 private:
  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] double largest_projection() const noexcept;
  bool find_cut(const Point<2>& w);
  bool exactly_nearer(int i, const Point<2>& w);
  void set_corner(int i);
  void move_entries(int from, int to, int n);
  void insert_neighbour(int first, int count, VertexHandle w);
  void resize(int n);
  void update_reach();

  const Vertex<2>* v_ = nullptr;
  int size_ = 0;
  double reach2_ = 0;
  double error_ = 0;
  // Of the candidate under test: its place relative to v, and the run of corners it takes.
  Point<2> w_{};
  double wx_ = 0;
  double wy_ = 0;
  int run_first_ = 0;
  int run_count_ = 0;
  int replaces_ = -1;  // a virtual neighbour at the candidate's very place
  std::vector<double> ux_, uy_, qx_, qy_, q2_, tolerance2_;
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
  for (int i = 0; i < size_; ++i) {
    const double dx = std::max(std::max(x0 - qx[i], qx[i] - x1), 0.0);
    const double dy = std::max(std::max(y0 - qy[i], qy[i] - y1), 0.0);
    if (dx * dx + dy * dy <= q2[i] * (1 + 0x1p-30)) return true;
  }
  return false;
}

}  // namespace mesher::detail
