// Sorting by the first bits of Morton codes, then by all.
#include "refinement/distinct_order.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "geometry/input_point.hpp"
#include "sets/counting_sort.hpp"

namespace mesher::detail {

namespace {

/// Where a point is: the first bits of its code, and which one it is.
struct Coded {
  std::uint64_t code;
  std::size_t index;
};

/// Whether f comes before g in Morton order, the last axis first: the axis decides in which they
/// differ at the highest bit.
template <int D>
bool comes_before(const Fixed<D>& f, const Fixed<D>& g) {
  std::uint64_t most = 0;
  std::size_t axis = 0;
  for (std::size_t i = D; i-- > 0;) {
    const std::uint64_t differ = f[i] ^ g[i];
    if (most >= differ || (most ^ differ) <= most) continue;  // no higher bit
    most = differ;
    axis = i;
  }
  return f[axis] < g[axis];
}

template <int D>
class Order {
 public:
  Order(const std::vector<Point<D>>& points, const std::vector<PointId>& ids, const MeshBox<D>& box)
      : points_(points), ids_(ids), box_(box) {}

  void check(const Box<D>& domain) const {
    for (std::size_t i = 0; i < points_.size(); ++i) check_point(points_[i], domain, id(i));
  }
  [[nodiscard]] std::vector<Point<D>> sorted() const {
    std::vector<Coded> all(points_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = {morton<D>(fixed(i)), i};
    sort_spread(
        all, [](const Coded& c) { return c.code; },
        [](const Coded& a, const Coded& b) {
          return a.code != b.code ? a.code < b.code : a.index < b.index;
        });
    for (auto from = all.begin(), to = from; from != all.end(); from = to) {
      while (to != all.end() && to->code == from->code) ++to;
      if (to - from > 1) sort_cell(from, to);
    }
    std::vector<Point<D>> places;
    places.reserve(all.size());
    for (const Coded& c : all) places.push_back(points_[c.index]);
    return places;
  }

 private:
  using It = std::vector<Coded>::iterator;

  void sort_cell(It from, It to) const {
    std::sort(from, to, [&](const Coded& a, const Coded& b) {
      const Fixed<D> f = fixed(a.index), g = fixed(b.index);
      return f != g ? comes_before<D>(f, g) : a.index < b.index;
    });
    const auto near = std::adjacent_find(
        from, to, [&](const Coded& a, const Coded& b) { return fixed(a.index) == fixed(b.index); });
    if (near == to) return;
    const std::size_t one = near->index, other = (near + 1)->index;
    fail_too_near(points_[other], id(other), points_[one], id(one));
  }
  [[nodiscard]] Fixed<D> fixed(std::size_t i) const { return box_.fixed(points_[i]); }
  [[nodiscard]] PointId id(std::size_t i) const {
    return ids_.empty() ? PointId{static_cast<std::int64_t>(i + 1)} : ids_[i];
  }

  const std::vector<Point<D>>& points_;
  const std::vector<PointId>& ids_;
  const MeshBox<D>& box_;
};

}  // namespace

template <int D>
std::vector<Point<D>> in_distinct_order(const std::vector<Point<D>>& points,
                                        const std::vector<PointId>& ids, const Box<D>& domain,
                                        const MeshBox<D>& box) {
  const Order<D> order(points, ids, box);
  order.check(domain);
  return order.sorted();
}

template std::vector<Point<2>> in_distinct_order<2>(const std::vector<Point<2>>&,
                                                    const std::vector<PointId>&, const Box<2>&,
                                                    const MeshBox<2>&);
#ifndef MESHER_PLANE_ONLY
template std::vector<Point<3>> in_distinct_order<3>(const std::vector<Point<3>>&,
                                                    const std::vector<PointId>&, const Box<3>&,
                                                    const MeshBox<3>&);
#endif

}  // namespace mesher::detail
