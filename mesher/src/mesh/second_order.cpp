// Midpoints of edges, numbered behind the vertices in the order of the edges.
#include "mesher/second_order.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace mesher {
namespace {

// Every edge as (low, high): those of one low vertex are few, and are sorted.
template <int D>
std::vector<std::array<std::uint32_t, 2>> edges_of(const Mesh<D>& mesh,
                                                   std::vector<std::size_t>& begin) {
  const auto for_each_edge = [&](auto&& visit) {
    for (const auto& s : mesh.simplices) {
      for (std::size_t i = 0; i <= D; ++i) {
        for (std::size_t k = i + 1; k <= D; ++k) {
          visit(std::min(s[i], s[k]), std::max(s[i], s[k]));
        }
      }
    }
  };
  begin.assign(mesh.vertices.size() + 1, 0);
  for_each_edge([&](std::uint32_t low, std::uint32_t) { ++begin[low + 1]; });
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<std::uint32_t> highs(begin.back());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  for_each_edge([&](std::uint32_t low, std::uint32_t high) { highs[end[low]++] = high; });
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::uint32_t low = 0; low < mesh.vertices.size(); ++low) {
    const auto first = highs.begin() + static_cast<std::ptrdiff_t>(begin[low]);
    const auto last = highs.begin() + static_cast<std::ptrdiff_t>(begin[low + 1]);
    std::sort(first, last);
    begin[low] = edges.size();
    for (auto it = first; it != last; ++it) {
      if (it == first || *it != *(it - 1)) edges.push_back({low, *it});
    }
  }
  begin.back() = edges.size();
  return edges;
}

template <int D>
Point<D> middle_of(const Point<D>& a, const Point<D>& b) {
  Point<D> middle;
  for (int i = 0; i < D; ++i) middle[i] = 0.5 * a[i] + 0.5 * b[i];
  return middle;
}

// Gives midpoints what the features beside them have, edges before faces.
template <int D>
class MidpointFeatures {
 public:
  MidpointFeatures(MeshData<D>& mesh, const SecondOrder<D>& second)
      : mesh_(mesh), second_(second) {}

  void set(std::uint32_t a, std::uint32_t b, const Feature& feature, std::int64_t marker) {
    const std::uint32_t node = second_.between(a, b);
    auto& origins = mesh_.features.origins;
    auto& markers = mesh_.features.markers;
    if (!markers.empty() && markers[node] == 0) markers[node] = marker;
    if (feature.kind == FeatureKind::none || mesh_.kinds[node] == VertexKind::segment) return;
    mesh_.kinds[node] = VertexKind::segment;
    if (!origins.empty()) origins[node] = feature;
  }

 private:
  MeshData<D>& mesh_;
  const SecondOrder<D>& second_;
};

template <class Id>
Feature feature_of(const std::optional<Id>& id) {
  return id ? Feature(*id) : Feature();
}

}  // namespace

template <int D>
SecondOrder<D>::SecondOrder(const Mesh<D>& mesh)
    : vertices_(mesh.vertices.size()), edges_(edges_of(mesh, begin_)) {
  if (nodes() < std::numeric_limits<std::uint32_t>::max()) return;
  throw Error(ErrorCode::too_many,
              "a mesh of second order with " + std::to_string(nodes()) + " nodes");
}

template <int D>
std::uint32_t SecondOrder<D>::between(std::uint32_t a, std::uint32_t b) const {
  const std::array<std::uint32_t, 2> edge{std::min(a, b), std::max(a, b)};
  const auto at = [&](std::uint32_t low) {
    return edges_.begin() +
           static_cast<std::ptrdiff_t>(begin_[std::min<std::size_t>(low, vertices_)]);
  };
  const auto last = at(edge[0] + 1);
  const auto found = std::lower_bound(at(edge[0]), last, edge);
  if (found != last && *found == edge) {
    return static_cast<std::uint32_t>(vertices_) +
           static_cast<std::uint32_t>(found - edges_.begin());
  }
  throw Error(ErrorCode::bad_mesh, "no simplex has an edge of vertices " + std::to_string(edge[0]) +
                                       " and " + std::to_string(edge[1]) + " (counted from 0)");
}

template <int D>
std::array<std::uint32_t, 6> SecondOrder<D>::nodes_of_triangle(
    const std::array<std::uint32_t, 3>& corners) const {
  const auto [a, b, c] = corners;
  return {a, b, c, between(a, b), between(b, c), between(c, a)};
}

template <int D>
auto SecondOrder<D>::nodes_of(const std::array<std::uint32_t, D + 1>& simplex) const
    -> std::array<std::uint32_t, kCellNodes> {
  if constexpr (D == 2) {
    return nodes_of_triangle(simplex);
  } else {
    const auto [a, b, c, d] = simplex;
    return {a,
            b,
            c,
            d,
            between(a, b),
            between(b, c),
            between(c, a),
            between(a, d),
            between(b, d),
            between(c, d)};
  }
}

template <int D>
std::array<std::uint32_t, 3> SecondOrder<D>::nodes_of(const MeshEdge& edge) const {
  return {edge.low, edge.high, between(edge.low, edge.high)};
}

template <int D>
std::array<std::uint32_t, 6> SecondOrder<D>::nodes_of(const MeshFace& face) const {
  return nodes_of_triangle(face.corners);
}

template <int D>
MeshData<D> with_midpoints(const Mesh<D>& mesh, const MeshFeatures& features,
                           const SecondOrder<D>& second) {
  MeshData<D> all(mesh, features);
  all.vertices.reserve(second.nodes());
  for (const auto& [a, b] : second.edges()) {
    all.vertices.push_back(middle_of<D>(mesh.vertices[a], mesh.vertices[b]));
  }
  all.kinds.resize(second.nodes(), VertexKind::steiner);
  if (!features.origins.empty()) all.features.origins.resize(second.nodes());
  if (!features.markers.empty()) all.features.markers.resize(second.nodes());
  MidpointFeatures<D> midpoints(all, second);
  for (const MeshEdge& e : features.edges) {
    midpoints.set(e.low, e.high, feature_of(e.line), e.marker);
  }
  for (const MeshFace& f : features.faces) {
    const auto [a, b, c] = f.corners;
    for (const auto& [p, q] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
      midpoints.set(p, q, feature_of(f.polygon), f.marker);
    }
  }
  return all;
}

#define MESHER_INSTANTIATE(D)    \
  template class SecondOrder<D>; \
  template MeshData<D> with_midpoints(const Mesh<D>&, const MeshFeatures&, const SecondOrder<D>&)

MESHER_INSTANTIATE(2);
#ifndef MESHER_PLANE_ONLY
MESHER_INSTANTIATE(3);
#endif
#undef MESHER_INSTANTIATE

}  // namespace mesher
