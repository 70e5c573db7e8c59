// A follower of the parts of segments and polygons, by the changes that updates report.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "mesher/mesher.hpp"

namespace support {

/// The edges and faces of a mesh that are on features, by places.
struct SpaceParts {
  std::set<mesher::LineEdge<3>> edges;
  std::set<mesher::PolygonFace<3>> faces;

  /// What goes must be there, what comes must not; both ascend.
  void follow(const mesher::Change<3>& change) {
    follow(edges, change.edges_added, change.edges_removed);
    follow(faces, change.faces_added, change.faces_removed);
  }
  friend bool operator==(const SpaceParts&, const SpaceParts&) = default;

 private:
  template <class T>
  static void follow(std::set<T>& all, const std::vector<T>& in, const std::vector<T>& out) {
    REQUIRE(std::is_sorted(in.begin(), in.end()));
    REQUIRE(std::is_sorted(out.begin(), out.end()));
    for (const T& part : out) REQUIRE(all.erase(part) == 1);
    for (const T& part : in) {
      REQUIRE(all.insert(part).second);
      REQUIRE(!std::binary_search(out.begin(), out.end(), part));
    }
  }
};

inline SpaceParts parts_of(const mesher::Mesh<3>& mesh) {
  SpaceParts parts;
  const auto& at = mesh.vertices;
  for (const auto& e : mesh.edges) {
    parts.edges.insert({at[e.low], at[e.high], e.feature});
  }
  for (const auto& f : mesh.faces) {
    parts.faces.insert({{at[f.corners[0]], at[f.corners[1]], at[f.corners[2]]}, f.polygon});
  }
  REQUIRE(parts.edges.size() == mesh.edges.size());
  REQUIRE(parts.faces.size() == mesh.faces.size());
  return parts;
}

}  // namespace support
