// The Delaunay triangulation of the current vertices during a run from scratch.
//
// A vertex's star there is its Voronoi cell, so that nothing has to be searched for: a cell is read
// off and clipped. Ties are decided by coordinates in both, so it is the cell that a search finds,
// to the last bit. A star that is seen to be good, and within the clip, is not even read.
//
// A run begins with all its points. Far parts of them may have as many simplices as pairs of points
// [rules B3]: then of() gives none, and cells are searched for.
//
// Vertices are named by their handles, which count from 1 without a gap; after the beginning some
// may be of records that are no vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "cells/cell_of.hpp"
#include "delaunay/kernel.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

enum class Of : bool { all_records, vertices };

template <int D>
class LiveTriangulation {
 public:
  /// Of all vertices of the pool, or all records: see `Of`. `good2`: a simplex with a circumradius,
  /// squared, below this times its shortest edge, squared, is good. `step()` is called for each
  /// vertex. Returns: null if that would have far more simplices than vertices. Requires: handles
  /// are 1 .. pool.size(). Throws: what step() throws, Error(too_many).
  [[nodiscard]] static std::unique_ptr<LiveTriangulation> of(const VertexPool<D>& pool,
                                                             double good2,
                                                             const std::function<void()>& step,
                                                             Of which = Of::all_records);

  /// Makes a vertex of a record. False, and nothing done, if there is one in its place. Requires:
  /// it has been made since of(), and is none. Cost: as an insertion near the vertex that was asked
  /// about last.
  bool insert(const Vertex<D>& v);
  /// Whether the record is a vertex here.
  [[nodiscard]] bool has(const Vertex<D>& v) const noexcept {
    return v.self <= kernel_.places() && kernel_.has(v.self);
  }
  /// Takes a vertex out. Requires: `good2` is 0, and it is not on the hull's corners.
  /// Cost: that of its neighbours.
  void remove(const Vertex<D>& v);

  /// Whether all simplices around v are surely good, with circumradii surely less than `radius`.
  [[nodiscard]] bool is_settled(const Vertex<D>& v, double radius);
  /// Makes `cell` the cell of v with the clip `radius`.
  void read(CellOf<D>& cell, const Vertex<D>& v, double radius);
  /// Makes `cell` what the cell of v, which is no vertex, would be. Requires: no vertex is at its
  /// place, which is inside of the box; `near` is a vertex. Cost: as an insertion near it.
  void read_as_if(CellOf<D>& cell, const Vertex<D>& v, VertexHandle near, double radius);
  /// Lists v's neighbours, or, if v is no vertex, those that it would have. Requires: no other
  /// vertex is at its place, which is inside of the box. Cost: as an insertion near the vertex that
  /// was asked about last.
  void list_near(const Vertex<D>& v, std::vector<VertexHandle>& all);
  struct Nearest {
    VertexHandle handle;
    double distance2;
  };
  /// The nearest other vertex, by squared distances as doubles have them; of equally near ones the
  /// least in coordinates. Cost: O(1); reads a few stars where lengths differ by more than 2^19.
  [[nodiscard]] Nearest nearest(const Vertex<D>& v);

  using Kernel = DelaunayKernel<D, BallLayout<D>>;
  [[nodiscard]] const Kernel& kernel() const noexcept { return kernel_; }

  /// Calls visit(corners) for each simplex, positively oriented, by handles.
  template <class Visit>
  void for_each_simplex(Visit&& visit) const {
    kernel_.for_each_finite([&](std::uint32_t s) { visit(kernel_.simplices().corners(s)); });
  }

 private:
  explicit LiveTriangulation(double good2) : good2_(good2) {}
  // What is kept of a vertex, so that its star need not be read.
  struct Around {
    Nearest nearest{0, std::numeric_limits<double>::infinity()};  // of all that were neighbours
    float reach2 = 0;        // no circumradius around it is larger, squared: stars shrink
    std::uint32_t poor = 0;  // simplices around it that are not surely good
  };

  // What is kept of a simplex: whether it is good, and where it is in star_, if it is.
  struct Simplex {
    std::uint32_t in_star : 31 = 0;
    std::uint32_t is_good : 1 = false;
  };

  bool build(const VertexPool<D>& pool, const std::function<void()>& step, Of which);
  void make_room();
  void note(std::uint32_t s, const Shape& shape);
  void note_all();
  void note_doomed();
  void note_distance(VertexHandle u, VertexHandle v);
  void note_nearer(Nearest& nearest, VertexHandle u, double distance2) const;
  void find_nearest(VertexHandle u);
  void look_around(VertexHandle v);
  [[nodiscard]] std::uint32_t recent_simplex() const noexcept {
    return kernel_.simplex_at(center_ != 0 ? center_ : kernel_.last_changed());
  }
  void find_link(const Point<D>& p, std::uint32_t from);
  void read_star(CellOf<D>& cell, const Vertex<D>& v, double radius);
  template <class Visit>
  void for_each_neighbour(VertexHandle v, Visit&& visit);

  Kernel kernel_;
  double good2_;
  std::vector<Simplex, sac::HugePages<Simplex>> simplices_;
  std::vector<Around, sac::HugePages<Around>> around_;       // by vertex
  double least2_ = std::numeric_limits<double>::infinity();  // of all distances to neighbours
  // The simplices around a vertex that was asked about, ghosts too, and what is known of them.
  VertexHandle center_ = 0;  // 0: of none
  std::vector<std::uint32_t> star_;
  bool on_hull_ = false;
  float farthest2_ = 0;  // more than each circumradius, squared
  // The neighbours, and their numbers by vertex; right if the neighbour of that number is it.
  std::vector<std::uint32_t> number_;
  std::vector<typename CellOf<D>::Neighbour> ring_;
  std::vector<typename CellOf<D>::Face> faces_;
  std::vector<VertexHandle> near_, nearly_;
};

/// Beyond space there is none.
template <int D>
requires(D > 3) class LiveTriangulation<D> {
 public:
  [[nodiscard]] static std::unique_ptr<LiveTriangulation> of(const VertexPool<D>&, double,
                                                             const std::function<void()>&,
                                                             Of = Of::all_records) {
    return nullptr;
  }
  bool insert(const Vertex<D>&) { return false; }
  [[nodiscard]] bool has(const Vertex<D>&) const noexcept { return false; }
  void remove(const Vertex<D>&) {}
  [[nodiscard]] bool is_settled(const Vertex<D>&, double) { return false; }
  void read(CellOf<D>&, const Vertex<D>&, double) {}
  void read_as_if(CellOf<D>&, const Vertex<D>&, VertexHandle, double) {}
  void list_near(const Vertex<D>&, std::vector<VertexHandle>&) {}
  struct Nearest {
    VertexHandle handle;
    double distance2;
  };
  [[nodiscard]] Nearest nearest(const Vertex<D>&) { return {}; }
  template <class Visit>
  void for_each_simplex(Visit&&) const {}
};

}  // namespace mesher::detail
