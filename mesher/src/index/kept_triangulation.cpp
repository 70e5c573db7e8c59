// Vertices that come and go.
#include "index/kept_triangulation.hpp"

#include <algorithm>
#include <utility>

#include "delaunay/build.hpp"
#include "delaunay/facets.hpp"
#include "delaunay/spatial_order.hpp"
#include "mesh/canonical.hpp"
#include "sac/check.hpp"
#include "sets/report_difference.hpp"

namespace mesher::detail {

namespace {

// More than one of so many that go, and all are triangulated anew: it takes a tenth of the time
// that it takes to remove as many.
constexpr std::size_t kManyGo = 8;

template <int D>
[[nodiscard]] std::vector<VertexHandle> ordered(const VertexPool<D>& pool,
                                                const std::vector<VertexHandle>& vertices) {
  return in_spatial_order<D>(vertices, [&](VertexHandle v) { return pool[v].p; });
}

template <int D>
[[nodiscard]] DelaunayKernel<D> triangulation_of(const VertexPool<D>& pool,
                                                 const std::vector<VertexHandle>& vertices) {
  DelaunayKernel<D> kernel;
  kernel.reserve(pool.end_of_handles());
  const Point<D>& any = pool[vertices.front()].p;  // of handles that are no vertices
  while (kernel.places() + 1 < pool.end_of_handles()) static_cast<void>(kernel.add_place(any));
  for (const VertexHandle v : vertices) kernel.set_place(v, pool[v].p);
  const bool built = build<D>(kernel, ordered(pool, vertices), [](std::uint32_t, std::uint32_t) {});
  SAC_ENSURES(built);
  static_cast<void>(built);
  return kernel;
}

}  // namespace

template <int D>
KeptTriangulation<D>::KeptTriangulation(const VertexPool<D>& pool,
                                        const std::vector<VertexHandle>& vertices)
    : kernel_(triangulation_of(pool, vertices)) {}

// Those that go do so after the others have come, and the last first of an order whose first ones
// are far apart: else stars would grow.
template <int D>
void KeptTriangulation<D>::change(const VertexPool<D>& pool, const std::vector<VertexHandle>& come,
                                  const std::vector<VertexHandle>& gone, const Near& near) {
  if (gone.size() * kManyGo > pool.size()) return make_anew(pool, come, gone);
  VertexHandle last = 0;
  for (const VertexHandle v : ordered(pool, come)) {
    insert(pool[v], near(v, last));
    last = v;
  }
  const std::vector<VertexHandle> leave = ordered(pool, gone);
  for (auto v = leave.rbegin(); v != leave.rend(); ++v) remove(*v);
}

template <int D>
void KeptTriangulation<D>::make_anew(const VertexPool<D>& pool,
                                     const std::vector<VertexHandle>& come,
                                     const std::vector<VertexHandle>& gone) {
  std::vector<VertexHandle> all = come;
  pool.for_each([&](const Vertex<D>& v) {
    if (has(v.self)) all.push_back(v.self);
  });
  std::vector<VertexHandle> out = gone;
  std::sort(out.begin(), out.end());
  const auto goes = [&](VertexHandle v) { return std::binary_search(out.begin(), out.end(), v); };
  all.erase(std::remove_if(all.begin(), all.end(), goes), all.end());
  KeptTriangulation anew(pool, all);
  anew.gone_ = std::move(gone_);
  anew.come_ = std::move(come_);
  for_each_simplex([&](const Simplex& s) { anew.gone_.push_back(s); });
  anew.for_each_simplex([&](const Simplex& s) { anew.come_.push_back(s); });
  *this = std::move(anew);
}

template <int D>
void KeptTriangulation<D>::insert(const Vertex<D>& v, VertexHandle near) {
  while (kernel_.places() < v.self) static_cast<void>(kernel_.add_place(v.p));
  kernel_.set_place(v.self, v.p);
  const std::uint32_t s = kernel_.walk(v.p, kernel_.simplex_at(near));
  const auto is_elsewhere = [&](std::uint32_t w) { return kernel_.place(w) != v.p; };
  const auto& corners = kernel_.simplices().corners(s);
  SAC_EXPECTS(std::all_of(corners.begin(), corners.end(), is_elsewhere));
  kernel_.dig(v.self, s);
  try {
    for (const std::uint32_t doomed : kernel_.doomed()) note(doomed, gone_);
    kernel_.for_each_facet_of_hole([&](const std::array<std::uint32_t, D>& facet) {
      if (std::find(facet.begin(), facet.end(), kInfinite) != facet.end()) return;
      Simplex made;
      std::copy(facet.begin(), facet.end(), made.begin());
      made[D] = v.self;
      come_.push_back(made);
    });
  } catch (...) {
    kernel_.undo_dig();
    throw;
  }
  kernel_.fill(v.self);
}

template <int D>
void KeptTriangulation<D>::remove(VertexHandle v) {
  static_cast<void>(kernel_.find_in_star(v, star_, [](std::uint32_t) { return false; }));
  for (const std::uint32_t s : star_) note(s, gone_);
  const bool removed = kernel_.remove(v);
  SAC_ENSURES(removed);
  static_cast<void>(removed);
  for (const std::uint32_t s : kernel_.made()) note(s, come_);
}

template <int D>
void KeptTriangulation<D>::note(std::uint32_t s, std::vector<Simplex>& all) const {
  if (!kernel_.is_ghost(s)) all.push_back(kernel_.simplices().corners(s));
}

template <int D>
auto KeptTriangulation<D>::news() -> News {
  for (auto* all : {&gone_, &come_}) {
    for (Simplex& s : *all) s = smallest_first(s);
  }
  News news;
  report_difference(come_, gone_, news.come, news.gone);
  return news;
}

template <int D>
void KeptTriangulation<D>::commit() noexcept {
  gone_ = std::vector<Simplex>();  // not {}, which keeps the room
  come_ = std::vector<Simplex>();
}

template class KeptTriangulation<2>;
#ifndef MESHER_PLANE_ONLY
template class KeptTriangulation<3>;
#endif

}  // namespace mesher::detail
