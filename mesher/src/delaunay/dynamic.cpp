// A triangulation that changes: the kernel, and what there is while all points are in one
// hyperplane.
#include <map>
#include <utility>

#include "delaunay/bulk.hpp"
#include "delaunay/check_places.hpp"
#include "delaunay/nearby.hpp"
#include "mesher/delaunay.hpp"
#include "sac/check.hpp"

namespace mesher {

using detail::kNone;

/// Vertex i is vertex i + 1 of the kernel. While there are no simplices the vertices are in
/// `flat_`, by place; else that is empty.
template <int D>
class DynamicDelaunay<D>::State {
 public:
  State() = default;
  explicit State(std::span<const Point<D>> points) {
    detail::check_places<D>(points);
    kernel_.reserve(points.size());
    for (const Point<D>& p : points) kernel_.add_place(p);
    free_.reserve(points.size());
    std::vector<std::uint32_t> order = detail::spatial_order<D>(points);
    for (std::uint32_t& v : order) ++v;
    const auto set_free = [&](std::uint32_t v, std::uint32_t) { free_.push_back(v); };
    if (!detail::build<D>(kernel_, order, set_free)) flat_ = flat_without(free_);
    size_ = points.size() - free_.size();
  }

  Inserted insert(const Point<D>& p) {
    detail::check_coordinates(p, PointId{static_cast<std::int64_t>(size_ + 1)});
    if (const auto at = flat_.vertices.find(p); at != flat_.vertices.end()) {
      return {at->second - 1, false};
    }
    const std::uint32_t v = new_place(p);
    std::uint32_t w = v;
    try {
      if (is_flat()) {
        insert_flat(v, p);
      } else {
        w = insert_near(v, p);
      }
    } catch (...) {
      give_place(v);
      throw;
    }
    if (w != v) {
      give_place(v);
    } else {
      ++size_;
    }
    return {w - 1, w == v};
  }

  void remove(std::uint32_t v) {
    if (is_flat() && !flat_.first.keeps(v)) {
      flat_.vertices.erase(kernel_.place(v));
    } else if (is_flat()) {
      flat_ = flat_without({v});
    } else {
      remove_from_kernel(v);
    }
    free_.push_back(v);
    --size_;
  }

  [[nodiscard]] bool has(std::uint32_t v) const noexcept {
    if (v < 1 || v > kernel_.places()) return false;
    if (!is_flat()) return kernel_.has(v);
    const auto at = flat_.vertices.find(kernel_.place(v));
    return at != flat_.vertices.end() && at->second == v;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const detail::DelaunayKernel<D>& kernel() const noexcept { return kernel_; }
  [[nodiscard]] bool is_flat() const noexcept { return kernel_.simplices().size() == 0; }

  void check_invariants() const {
    kernel_.check_invariants();
    std::size_t vertices = 0;
    for (std::uint32_t v = 1; v <= kernel_.places(); ++v) vertices += has(v) ? 1 : 0;
    SAC_INVARIANT(vertices == size_ && size_ + free_.size() == kernel_.places());
    SAC_INVARIANT(flat_.vertices.size() == (is_flat() ? size_ : 0) && !flat_.first.full());
    for (const std::uint32_t v : free_) SAC_INVARIANT(!has(v));
  }

 private:
  struct Flat {
    std::map<Point<D>, std::uint32_t> vertices;
    detail::Independent<D> first;  // of these, as many as there are
  };

  // A free number, or one more.
  std::uint32_t new_place(const Point<D>& p) {
    if (free_.empty()) {
      if (free_.capacity() <= kernel_.places()) free_.reserve(2 * kernel_.places() + 1);
      return kernel_.add_place(p);
    }
    const std::uint32_t v = free_.back();
    free_.pop_back();
    kernel_.set_place(v, p);
    return v;
  }
  // There is room for each number.
  void give_place(std::uint32_t v) noexcept {
    if (v == kernel_.places()) {
      kernel_.drop_place();
    } else {
      free_.push_back(v);
    }
  }

  std::uint32_t insert_near(std::uint32_t v, const Point<D>& p) {
    if (!nearby_.fits(p, size_ + 1)) nearby_ = nearby_with(p);
    const std::uint32_t start = nearby_.near(
        p, [&](std::uint32_t near) { return near <= kernel_.places() && kernel_.has(near); });
    if (start != kNone) kernel_.walk_from(start);
    const std::uint32_t w = kernel_.insert(v);
    nearby_.add(w, p);
    return w;
  }
  [[nodiscard]] detail::Nearby<D> nearby_with(const Point<D>& p) const {
    Box<D> box{p, p};
    const auto for_each_vertex = [&](auto&& visit) {
      for (std::uint32_t v = 1; v <= kernel_.places(); ++v) {
        if (kernel_.has(v)) visit(v, kernel_.place(v));
      }
    };
    for_each_vertex([&](std::uint32_t, const Point<D>& place) { detail::grow(box, place); });
    detail::Nearby<D> nearby(box, size_ + 1);
    for_each_vertex([&](std::uint32_t v, const Point<D>& place) { nearby.add(v, place); });
    return nearby;
  }
  void remove_from_kernel(std::uint32_t v) {
    if (kernel_.remove(v)) {
      if (nearby_.fits(kernel_.place(v), 0)) {
        nearby_.replace(v, kernel_.place(v), kernel_.last_changed());
      }
      return;
    }
    Flat without = flat_without({v});
    kernel_.clear_simplices();
    nearby_ = {};
    flat_ = std::move(without);
  }

  void insert_flat(std::uint32_t v, const Point<D>& p) {
    const auto at = flat_.vertices.emplace(p, v).first;
    const detail::Independent<D> before = flat_.first;
    if (!flat_.first.offer(v, p) || !flat_.first.full()) return;
    try {
      build_all();
      flat_ = {};
    } catch (...) {
      kernel_.clear_simplices();
      flat_.vertices.erase(at);
      flat_.first = before;
      throw;
    }
  }
  void build_all() {
    std::vector<std::uint32_t> vertices;
    for (const auto& [p, v] : flat_.vertices) vertices.push_back(v);
    const std::vector<std::uint32_t> order =
        detail::in_spatial_order<D>(vertices, [&](std::uint32_t v) { return kernel_.place(v); });
    detail::build<D>(kernel_, order, [](std::uint32_t, std::uint32_t) {});
  }

  // All vertices but some, and but those that are free.
  [[nodiscard]] Flat flat_without(const std::vector<std::uint32_t>& some) const {
    std::vector<bool> out(kernel_.places() + 1);
    for (const std::uint32_t v : free_) out[v] = true;
    for (const std::uint32_t v : some) out[v] = true;
    Flat flat;
    for (std::uint32_t v = 1; v <= kernel_.places(); ++v) {
      if (out[v]) continue;
      flat.vertices.emplace(kernel_.place(v), v);
      flat.first.offer(v, kernel_.place(v));
    }
    return flat;
  }

  detail::DelaunayKernel<D> kernel_;
  Flat flat_;
  detail::Nearby<D> nearby_;         // of the kernel's vertices, made when first needed
  std::vector<std::uint32_t> free_;  // numbers of no vertex
  std::size_t size_ = 0;
};

template <int D>
DynamicDelaunay<D>::DynamicDelaunay() : state_(std::make_unique<State>()) {}
template <int D>
DynamicDelaunay<D>::DynamicDelaunay(std::span<const Point<D>> points)
    : state_(std::make_unique<State>(points)) {}
template <int D>
DynamicDelaunay<D>::DynamicDelaunay(DynamicDelaunay&&) noexcept = default;
template <int D>
DynamicDelaunay<D>& DynamicDelaunay<D>::operator=(DynamicDelaunay&&) noexcept = default;
template <int D>
DynamicDelaunay<D>::~DynamicDelaunay() = default;

template <int D>
typename DynamicDelaunay<D>::Inserted DynamicDelaunay<D>::insert(const Point<D>& p) {
  return state_->insert(p);
}
template <int D>
void DynamicDelaunay<D>::remove(std::uint32_t vertex) {
  SAC_EXPECTS(has(vertex));
  state_->remove(vertex + 1);
}
template <int D>
std::size_t DynamicDelaunay<D>::size() const noexcept {
  return state_->size();
}
template <int D>
bool DynamicDelaunay<D>::has(std::uint32_t vertex) const noexcept {
  return state_->has(vertex + 1);
}
template <int D>
const Point<D>& DynamicDelaunay<D>::place(std::uint32_t vertex) const {
  SAC_EXPECTS(has(vertex));
  return state_->kernel().place(vertex + 1);
}

template <int D>
std::vector<std::uint32_t> DynamicDelaunay<D>::neighbours(std::uint32_t vertex) const {
  SAC_EXPECTS(has(vertex));
  if (state_->is_flat()) return {};
  const auto& kernel = state_->kernel();
  std::vector<std::uint32_t> link = kernel.link_of(kernel.star(vertex + 1), vertex + 1);
  for (std::uint32_t& v : link) --v;
  return link;
}

template <int D>
Delaunay<D> DynamicDelaunay<D>::simplices() const {
  auto flat = detail::without_ghosts<D>(state_->kernel().simplices(),
                                        [](std::uint32_t v) { return v - 1; });
  return {std::move(flat.simplices), std::move(flat.neighbours), {}};
}

template <int D>
void DynamicDelaunay<D>::check_invariants() const {
  state_->check_invariants();
}

template class DynamicDelaunay<2>;
#ifndef MESHER_PLANE_ONLY
template class DynamicDelaunay<3>;
#endif

}  // namespace mesher
