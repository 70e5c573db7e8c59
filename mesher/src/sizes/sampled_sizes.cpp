// Fields of sizes: functions of bounded slope, and backgrounds.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "geometry/grid.hpp"
#include "geometry/plane.hpp"
#include "input.hpp"
#include "mesher/error.hpp"
#include "mesher/sizes.hpp"
#include "sizes/facet.hpp"
#include "sizes/sample_triangulation.hpp"

namespace mesher {

SizeRange SlopedSizes::range(const Box<2>& box) const {
  const Point<2> middle{(box.lo[0] + box.hi[0]) / 2, (box.lo[1] + box.hi[1]) / 2};
  const double radius = std::hypot(box.hi[0] - middle[0], box.hi[1] - middle[1]);
  const double here = size_(middle), change = slope_ * radius * (1 + 0x1p-40);
  return {std::max(here - change, least_), here + change};
}

namespace {

using detail::Facet;
using detail::SampleTriangulation;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

bool meet(const Box<2>& a, const Box<2>& b) {
  return a.lo[0] <= b.hi[0] && b.lo[0] <= a.hi[0] && a.lo[1] <= b.hi[1] && b.lo[1] <= a.hi[1];
}
bool is_inside(const Box<2>& a, const Box<2>& b) {
  return a.lo[0] >= b.lo[0] && a.hi[0] <= b.hi[0] && a.lo[1] >= b.lo[1] && a.hi[1] <= b.hi[1];
}
Box<2> joined(const Box<2>& a, const Box<2>& b) {
  return {{std::min(a.lo[0], b.lo[0]), std::min(a.lo[1], b.lo[1])},
          {std::max(a.hi[0], b.hi[0]), std::max(a.hi[1], b.hi[1])}};
}

// Facets in a tree of boxes. Each is the same function where two meet, but for rounding: the one
// that comes first in the order of `facets` is asked.
class SampledSizes final : public SizeField<2> {
 public:
  SampledSizes(const Box<2>& square, std::vector<Facet> facets)
      : square_(square), facets_(std::move(facets)), order_(facets_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    nodes_.reserve(2 * facets_.size());
    build(0, facets_.size());
  }

  [[nodiscard]] double at(const Point<2>& place) const override {
    const Point<2> p = nearest_in_square(place);
    std::size_t first = facets_.size();
    visit(
        [&](const Node& n) { return meet(n.box, {p, p}); },
        [&](std::size_t i) {
          if (i < first && facets_[i].contains(p)) first = i;
        });
    return facets_[first].at(p);
  }
  [[nodiscard]] SizeRange range(const Box<2>& place) const override {
    const Box<2> box{nearest_in_square(place.lo), nearest_in_square(place.hi)};
    SizeRange all{kInfinite, 0};
    const auto take = [&](const SizeRange& r) {
      all.least = std::min(all.least, r.least);
      all.most = std::max(all.most, r.most);
    };
    visit(
        [&](const Node& n) {
          const bool known = n.range.least >= all.least && n.range.most <= all.most;
          if (known || !meet(n.box, box)) return false;
          if (is_inside(n.box, box)) return take(n.range), false;
          return true;
        },
        [&](std::size_t i) {
          if (facets_[i].meets(box)) take(facets_[i].range(box));
        });
    return all;
  }

 private:
  // Its left child follows; a leaf has none.
  struct Node {
    Box<2> box;
    SizeRange range;
    std::size_t begin = 0, end = 0;  // of order_
    std::size_t right = 0;           // 0: a leaf
  };

  [[nodiscard]] Point<2> nearest_in_square(const Point<2>& p) const {
    return {std::clamp(p[0], square_.lo[0], square_.hi[0]),
            std::clamp(p[1], square_.lo[1], square_.hi[1])};
  }
  void build(std::size_t begin, std::size_t end) {
    constexpr std::size_t kLeaf = 4;
    const std::size_t me = nodes_.size();
    Node node{facets_[order_[begin]].extent(), {kInfinite, 0}, begin, end};
    for (std::size_t i = begin; i < end; ++i) {
      const Facet& f = facets_[order_[i]];
      node.box = joined(node.box, f.extent());
      node.range.least = std::min(node.range.least, f.least());
      node.range.most = std::max(node.range.most, f.most());
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return;
    const std::size_t axis =
        node.box.hi[0] - node.box.lo[0] < node.box.hi[1] - node.box.lo[1] ? 1 : 0;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
      return facets_[a].middle()[axis] < facets_[b].middle()[axis];
    });
    build(begin, middle);
    nodes_[me].right = nodes_.size();
    build(middle, end);
  }
  template <class Enter, class Visit>
  void visit(Enter&& enter, Visit&& visit_facet) const {
    std::array<std::size_t, 128> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const std::size_t me = stack[--top];
      const Node& n = nodes_[me];
      if (!enter(n)) continue;
      if (n.right == 0) {
        for (std::size_t i = n.begin; i < n.end; ++i) visit_facet(order_[i]);
      } else {
        stack[top++] = n.right;
        stack[top++] = me + 1;
      }
    }
  }

  Box<2> square_;
  std::vector<Facet> facets_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

void check(const std::vector<SizeSample>& samples) {
  if (samples.empty()) throw Error(ErrorCode::bad_option, "a background without samples");
  for (const SizeSample& s : samples) {
    if (s.h > 0 && std::isfinite(s.h)) continue;
    throw Error(ErrorCode::bad_option,
                "the size at " + detail::place_text(s.at) + " is not above 0 and finite");
  }
}

// Four times as wide as what the samples lie in; its side is a power of two.
Box<2> square_around(const std::vector<SizeSample>& samples) {
  Box<2> box{samples.front().at, samples.front().at};
  for (const SizeSample& s : samples) box = joined(box, {s.at, s.at});
  double largest = 0x1p-90, extent = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    largest = std::max({largest, std::abs(box.lo[i]), std::abs(box.hi[i])});
    extent = std::max(extent, box.hi[i] - box.lo[i]);
  }
  const double half = std::exp2(std::ceil(std::log2(std::max(extent, largest * 0x1p-20)))) * 2;
  Box<2> square;
  for (std::size_t i = 0; i < 2; ++i) {
    const double middle = box.lo[i] + (box.hi[i] - box.lo[i]) / 2;
    square.lo[i] = middle - half;
    square.hi[i] = middle + half;
  }
  return square;
}

double nearest_size(const std::vector<SizeSample>& samples, const Point<2>& p) {
  const auto nearer = [&](const SizeSample& s, const SizeSample& t) {
    const double ds = detail::squared_distance(s.at, p), dt = detail::squared_distance(t.at, p);
    return ds != dt ? ds < dt : s.at < t.at;
  };
  return std::min_element(samples.begin(), samples.end(), nearer)->h;
}

}  // namespace

std::shared_ptr<const SizeField<2>> sampled_sizes(const std::vector<SizeSample>& samples) {
  check(samples);
  const Box<2> square = square_around(samples);
  std::vector<Point<2>> points{square.lo,
                               {square.hi[0], square.lo[1]},
                               square.hi,
                               {square.lo[0], square.hi[1]}};
  std::vector<double> sizes;
  for (const Point<2>& p : points) sizes.push_back(nearest_size(samples, p));
  std::vector<Point<2>> places;
  for (const SizeSample& s : samples) places.push_back(s.at);
  const double side = square.hi[0] - square.lo[0];
  for (const std::size_t i : detail::morton_order(places, {square.lo, side})) {
    points.push_back(samples[i].at);
    sizes.push_back(samples[i].h);
  }
  std::vector<Facet> facets;
  for (const auto& [a, b, c] : SampleTriangulation(points).triangles()) {
    facets.emplace_back(std::array{points[a], points[b], points[c]},
                        std::array{sizes[a], sizes[b], sizes[c]});
  }
  return std::make_shared<SampledSizes>(square, std::move(facets));
}

}  // namespace mesher
