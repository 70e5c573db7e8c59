// The Delaunay triangulation of a mesh's vertices, kept from update to update [§4.3.1].
//
// An update hands over the vertices that came and went, and asks which simplices did. Ties are
// decided by coordinates, so it is the triangulation of a run from scratch, whatever was done
// before.
//   (The thesis makes a call of each vertex's star, and so did this mesher. In space a third of an
// update's time and a quarter of a first run's were stars: most of those that look at a vertex that
// comes or goes are run again, each finds the simplices that D others find, and writes them down.
// A triangulation makes each simplex once.)
//
// A tile keeps that of the vertices that it has. Its own vertices' simplices are those of the mesh,
// since it has all their neighbours (PointWorld::post_border_star).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "delaunay/facets.hpp"
#include "delaunay/kernel.hpp"
#include "index/live_triangulation.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

template <int D>
class KeptTriangulation {
 public:
  /// Positively oriented; in news the smallest handle comes first, and then that of the others.
  using Simplex = std::array<VertexHandle, D + 1>;

  /// Of these vertices, which are not all in one plane (on one line). Cost: as in bulk.
  KeptTriangulation(const VertexPool<D>& pool, const std::vector<VertexHandle>& vertices);
  explicit KeptTriangulation(const LiveTriangulation<D>& live) : kernel_(live.kernel()) {}

  [[nodiscard]] bool has(VertexHandle v) const noexcept {
    return v <= kernel_.places() && kernel_.has(v);
  }
  /// Takes in those that come, and takes out those that go. near(v, last): a vertex from which it
  /// is not far to v; `last` has come before it (0: none has). What throws has done a part of it,
  /// and news() is wrong. Cost: O(simplices made and taken out); of all, if many go.
  using Near = std::function<VertexHandle(VertexHandle v, VertexHandle last)>;
  void change(const VertexPool<D>& pool, const std::vector<VertexHandle>& come,
              const std::vector<VertexHandle>& gone, const Near& near);

  struct News {
    std::vector<Simplex> gone, come;  // ascending
  };
  /// By what the set of simplices is another one than at the last commit().
  [[nodiscard]] News news();
  void commit() noexcept;

  template <class Visit>
  void for_each_simplex(Visit&& visit) const {
    kernel_.for_each_finite([&](std::uint32_t s) { visit(kernel_.simplices().corners(s)); });
  }
  /// Calls visit(simplex) for those with corner v, which comes first. Requires: has(v).
  template <class Visit>
  void for_each_simplex_at(VertexHandle v, Visit&& visit) const;

  [[nodiscard]] std::size_t bytes() const noexcept { return kernel_.bytes(); }
  /// Throws InvariantError.
  void check_invariants() const { kernel_.check_invariants(); }

 private:
  using Kernel = DelaunayKernel<D>;

  void make_anew(const VertexPool<D>& pool, const std::vector<VertexHandle>& come,
                 const std::vector<VertexHandle>& gone);
  void insert(const Vertex<D>& v, VertexHandle near);
  void remove(VertexHandle v);
  void note(std::uint32_t s, std::vector<Simplex>& all) const;

  Kernel kernel_;
  std::vector<Simplex> gone_, come_;  // since the last commit; some may have done both
  std::vector<std::uint32_t> star_;   // of a vertex that goes
};

template <int D>
template <class Visit>
void KeptTriangulation<D>::for_each_simplex_at(VertexHandle v, Visit&& visit) const {
  const auto meet = [&](Simplex s) {
    const std::uint32_t at = corner_of(s, v);
    if constexpr (D == 2) {
      std::rotate(s.begin(), s.begin() + at, s.end());
    } else if (at != 0) {  // two swaps do not turn it
      std::swap(s[0], s[at]);
      std::swap(s[1], s[2]);
    }
    if (corner_of(s, kInfinite) > D) visit(s);
  };
  const auto& simplices = kernel_.simplices();
  if constexpr (D == 2) {
    const std::uint32_t first = kernel_.simplex_at(v);
    std::uint32_t s = first;
    do {
      const auto& corners = simplices.corners(s);
      s = simplices.across(s)[kFacet<2>[corner_of(corners, v)][0]] >> 2;
      meet(corners);
    } while (s != first);
  } else {
    for (const std::uint32_t s : kernel_.star(v)) meet(simplices.corners(s));
  }
}

/// Beyond space there is none.
template <int D>
requires(D > 3) class KeptTriangulation<D> {
};

}  // namespace mesher::detail
