// The kept part of a mesh as a mesh of its own.
#include <algorithm>

#include "mesh/adjacency.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

constexpr std::uint32_t kAbsent = UINT32_MAX;

// Of several markers, the least but 0.
void keep_least(std::int64_t& least, std::int64_t marker) {
  if (marker != 0 && (least == 0 || marker < least)) least = marker;
}

// What both dimensions have.
template <int D>
class Extractor {
 public:
  Extractor(const MeshData<D>& whole, const Domain<D>& domain) : whole_(whole), domain_(domain) {
    choose();
    copy_vertices();
    copy_simplices();
    copy_attributes();
  }

 protected:
  void choose() {
    new_vertex_.assign(whole_.vertices.size(), kAbsent);
    new_simplex_.assign(whole_.simplices.size(), kNoTriangle);
    for (std::uint32_t t = 0; t < whole_.simplices.size(); ++t) {
      if (!domain_.keeps(t)) continue;
      new_simplex_[t] = static_cast<std::uint32_t>(part_.triangles.size());
      part_.triangles.push_back(t);
      for (const std::uint32_t v : whole_.simplices[t]) new_vertex_[v] = 0;
    }
    for (std::uint32_t v = 0; v < whole_.vertices.size(); ++v) {
      if (new_vertex_[v] == kAbsent) continue;
      new_vertex_[v] = static_cast<std::uint32_t>(part_.vertices.size());
      part_.vertices.push_back(v);
    }
  }

  void copy_vertices() {
    auto& features = part_.mesh.features;
    const auto& from = whole_.features;
    for (const std::uint32_t v : part_.vertices) {
      part_.mesh.vertices.push_back(whole_.vertices[v]);
      if (!whole_.kinds.empty()) part_.mesh.kinds.push_back(whole_.kinds[v]);
      if (!from.origins.empty()) features.origins.push_back(from.origins[v]);
      features.markers.push_back(from.markers.empty() ? 0 : from.markers[v]);
    }
  }

  void copy_simplices() {
    for (const std::uint32_t t : part_.triangles) {
      auto corners = whole_.simplices[t];
      for (std::uint32_t& v : corners) v = new_vertex_[v];
      part_.mesh.simplices.push_back(corners);
      auto neighbours = domain_.neighbours[t];
      for (std::uint32_t& n : neighbours) n = n == kNoTriangle ? n : new_simplex_[n];
      part_.neighbours.push_back(neighbours);
    }
  }

  void copy_attributes() {
    const bool any =
        std::any_of(domain_.regions.begin(), domain_.regions.end(), [&](const Region& region) {
          return domain_.keeps(region) && region.label.seed && region.label.zone != Zone::hole;
        });
    if (!any) return;
    for (const std::uint32_t t : part_.triangles) {
      part_.mesh.features.regions.push_back(domain_.regions[domain_.region_of[t]].attribute);
    }
  }

  // Vertices without a marker get the least of the walls or edges that they are on. `corners_of`:
  // of one of these, as an array.
  template <class Parts, class CornersOf>
  void mark(const Parts& parts, CornersOf&& corners_of) {
    auto& markers = part_.mesh.features.markers;
    std::vector<std::int64_t> least(markers.size(), 0);
    for (const auto& part : parts) {
      for (const std::uint32_t v : corners_of(part)) {
        if (new_vertex_[v] != kAbsent) keep_least(least[new_vertex_[v]], part.marker);
      }
    }
    for (std::size_t v = 0; v < markers.size(); ++v) {
      if (markers[v] == 0) markers[v] = least[v];
    }
  }
  template <std::size_t N>
  void mark_boundary(const std::array<std::uint32_t, N>& corners) {
    for (const std::uint32_t v : corners) {
      std::int64_t& marker = part_.mesh.features.markers[v];
      if (marker == 0) marker = kBoundaryMarker;
    }
  }

  static std::array<std::uint32_t, 2> ends_of(const MeshEdge& e) { return {e.low, e.high}; }

  const MeshData<D>& whole_;
  const Domain<D>& domain_;
  Extract<D> part_;
  std::vector<std::uint32_t> new_vertex_, new_simplex_;
};

class PlaneExtractor : Extractor<2> {
 public:
  using Extractor::Extractor;

  Extract<2> run() {
    mark(whole_.features.edges, ends_of);
    for (const SidedEdge& edge : sided_edges(whole_, whole_.features.edges, domain_)) {
      if (edge.left == kNoRegion && edge.right == kNoRegion) continue;
      MeshEdge kept = edge;
      kept.low = new_vertex_[kept.low];
      kept.high = new_vertex_[kept.high];
      part_.mesh.features.edges.push_back(kept);
      if (edge.left == kNoRegion || edge.right == kNoRegion) mark_boundary(ends_of(kept));
    }
    return std::move(part_);
  }
};

class SpaceExtractor : Extractor<3> {
 public:
  using Extractor::Extractor;

  Extract<3> run() {
    mark(whole_.features.edges, ends_of);
    mark(whole_.features.faces, [](const MeshFace& f) { return f.corners; });
    copy_edges();
    for (const std::uint32_t t : part_.triangles) {
      for (std::size_t i = 0; i < 4; ++i) copy_face(t, i);
    }
    auto& faces = part_.mesh.features.faces;
    std::sort(faces.begin(), faces.end(),
              [](const MeshFace& a, const MeshFace& b) { return a.key() < b.key(); });
    return std::move(part_);
  }

 private:
  // Those that a kept tetrahedron has.
  void copy_edges() {
    const auto& edges = whole_.features.edges;
    std::vector<bool> kept(edges.size());
    for (const std::uint32_t t : part_.triangles) {
      const auto& s = whole_.simplices[t];
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = i + 1; k < 4; ++k) {
          const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(s[i], s[k]);
          const auto found = std::lower_bound(
              edges.begin(), edges.end(), ends,
              [](const MeshEdge& e, const auto& key) { return std::pair(e.low, e.high) < key; });
          if (found == edges.end() || std::pair(found->low, found->high) != ends) continue;
          kept[static_cast<std::size_t>(found - edges.begin())] = true;
        }
      }
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (!kept[i]) continue;
      MeshEdge edge = edges[i];
      edge.low = new_vertex_[edge.low];
      edge.high = new_vertex_[edge.high];
      part_.mesh.features.edges.push_back(edge);
    }
  }

  // A face between two kept tetrahedra is taken from the first.
  void copy_face(std::uint32_t t, std::size_t i) {
    const std::uint32_t other = domain_.neighbours[t][i];
    const bool boundary = other == kNoTriangle || !domain_.keeps(other);
    if (!boundary && other < t) return;
    detail::Face corners = detail::faces_of(whole_.simplices[t])[i];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    MeshFace face{corners, {}, 0};
    const bool wall = copy_wall(face);
    if (!boundary && !wall) return;
    if (boundary && face.marker == 0) face.marker = kBoundaryMarker;
    face.corners = boundary ? corners : face.key();
    for (std::uint32_t& v : face.corners) v = new_vertex_[v];
    if (boundary) mark_boundary(face.corners);
    part_.mesh.features.faces.push_back(face);
  }
  bool copy_wall(MeshFace& face) const {
    const auto& walls = whole_.features.faces;
    const auto it =
        std::lower_bound(walls.begin(), walls.end(), face,
                         [](const MeshFace& a, const MeshFace& b) { return a.key() < b.key(); });
    if (it == walls.end() || it->key() != face.key()) return false;
    face = *it;
    return true;
  }
};

}  // namespace

template <>
Extract<2> extract(const MeshData<2>& whole, const Domain<2>& domain) {
  return PlaneExtractor(whole, domain).run();
}
template <>
Extract<3> extract(const MeshData<3>& whole, const Domain<3>& domain) {
  return SpaceExtractor(whole, domain).run();
}

}  // namespace mesher
