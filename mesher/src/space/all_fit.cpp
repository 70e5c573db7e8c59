// Pairs of features whose boxes meet.
#include "space/all_fit.hpp"

#include <algorithm>
#include <vector>

#include "geometry/box_tree.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

namespace {

Box<3> widened(Box<3> box, double by) {
  for (std::size_t i = 0; i < 3; ++i) box.lo[i] -= by, box.hi[i] += by;
  return box;
}

// What is in conflict meets within the sum of these.
Box<3> box_of(const Edge& e) {
  Box<3> box{e.place_a, e.place_a};
  for (std::size_t i = 0; i < 3; ++i) {
    box.lo[i] = std::min(box.lo[i], e.place_b[i]);
    box.hi[i] = std::max(box.hi[i], e.place_b[i]);
  }
  return widened(box, 2 * resolution(middle_of(box), e.length));
}
Box<3> box_of(const Polygon& f) {
  Box<3> box{f.places[0], f.places[0]};
  for (const Point<3>& p : f.places) {
    for (std::size_t i = 0; i < 3; ++i) {
      box.lo[i] = std::min(box.lo[i], p[i]);
      box.hi[i] = std::max(box.hi[i], p[i]);
    }
  }
  return widened(box, 2 * (f.thickness + resolution(f.middle, f.reach)));
}

class Pairs {
 public:
  explicit Pairs(const FeatureStore& store) : store_(store) {
    store.edges().for_each([&](const Edge& e) {
      if (e.alive) edges_.push_back(&e), boxes_.push_back(box_of(e));
    });
    store.polygons().for_each([&](const Polygon& f) {
      if (f.alive) polygons_.push_back(&f), boxes_.push_back(box_of(f));
    });
    store.points().for_each([&](const Vertex<3>& v) {
      if (v.input) points_.push_back(&v), boxes_.push_back({v.p, v.p});
    });
  }

  [[nodiscard]] bool fit(const std::function<void()>& ask) const {
    constexpr std::size_t kBetween = 256;
    std::size_t pairs = 0;
    return !BoxTree<3>(boxes_).visit_pairs([&](std::uint32_t i, std::uint32_t j) {
      if (pairs++ % kBetween == 0) ask();
      return i < j ? are_in_conflict(i, j) : are_in_conflict(j, i);
    });
  }

 private:
  // Edges come first, then polygons, then points.
  [[nodiscard]] bool are_in_conflict(std::size_t i, std::size_t j) const {
    const std::size_t edges = edges_.size(), faces = edges + polygons_.size();
    if (i >= faces) return false;
    if (i < edges) {
      const Edge& e = *edges_[i];
      if (j < edges) return conflict_with(e, *edges_[j]).has_value();
      if (j < faces) return conflict_with(e, *polygons_[j - edges]).has_value();
      return conflict_with(*points_[j - faces], e).has_value();
    }
    const Polygon& f = *polygons_[i - edges];
    if (j < faces) return conflict_with(f, *polygons_[j - edges], store_).has_value();
    return conflict_with(*points_[j - faces], f).has_value();
  }

  const FeatureStore& store_;
  std::vector<const Edge*> edges_;
  std::vector<const Polygon*> polygons_;
  std::vector<const Vertex<3>*> points_;
  std::vector<Box<3>> boxes_;
};

}  // namespace

bool all_fit(const FeatureStore& store, const std::function<void()>& ask) {
  return Pairs(store).fit(ask);
}

}  // namespace mesher::detail
