// The naive twin of a live mesh: what is in which slot, as the changes alone tell.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <vector>

#include "mesher/mesher.hpp"

namespace support {

/// Things by what they are, with their slots; freed slots as the twin of a heap.
template <class Thing>
class SlotsOf {
 public:
  /// Requires what is said to come and go to be exact, and slots to be the lowest that are free.
  void follow(const std::vector<Thing>& in, const std::vector<mesher::Slot>& in_slots,
              const std::vector<Thing>& out, const std::vector<mesher::Slot>& out_slots) {
    REQUIRE(in.size() == in_slots.size());
    REQUIRE(out.size() == out_slots.size());
    free_.insert(left_.begin(), left_.end());
    left_.clear();
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto it = slots.find(out[i]);
      REQUIRE(it != slots.end());
      REQUIRE(it->second == out_slots[i]);
      slots.erase(it);
      left_.insert(out_slots[i]);
    }
    for (std::size_t i = 0; i < in.size(); ++i) {
      if (free_.empty()) free_.insert(end_++);
      REQUIRE(in_slots[i] == *free_.begin());
      free_.erase(free_.begin());
      REQUIRE(slots.emplace(in[i], in_slots[i]).second);
    }
  }
  [[nodiscard]] bool is_free(mesher::Slot s) const {
    return free_.contains(s) || left_.contains(s);
  }
  /// Free slots included.
  [[nodiscard]] std::size_t end() const { return end_; }

  std::map<Thing, mesher::Slot> slots;

 private:
  std::set<mesher::Slot> free_, left_;
  mesher::Slot end_ = 0;
};

template <int D>
class SlotTwin {
 public:
  using Corners = std::array<mesher::Point<D>, D + 1>;

  /// `live`: of the mesher that gave the change.
  void follow(const mesher::Change<D>& c, const mesher::LiveMesh<D>& live) {
    const mesher::SlotChange& s = c.slots;
    vertices_.follow(c.vertices_added, s.vertices_added, c.vertices_removed, s.vertices_removed);
    simplices_.follow(c.simplices_added, s.simplices_added, c.simplices_removed,
                      s.simplices_removed);
    edges_.follow(c.edges_added, s.edges_added, c.edges_removed, s.edges_removed);
    faces_.follow(c.faces_added, s.faces_added, c.faces_removed, s.faces_removed);
    REQUIRE(s.kinds_changed.size() == c.kinds_changed.size());
    for (std::size_t i = 0; i < c.kinds_changed.size(); ++i) {
      const auto& k = c.kinds_changed[i];
      REQUIRE(s.kinds_changed[i] ==
              mesher::SlotChange::Kind{vertices_.slots.at(k.vertex), k.before, k.after});
    }
    require_shown(c, live);
  }

  /// That `live` shows `mesh`, and each thing in its slot.
  void require(const mesher::LiveMesh<D>& live, const mesher::Mesh<D>& mesh) const {
    require_vertices(live, mesh);
    require_simplices(live, mesh);
    REQUIRE(edges_.slots.size() == mesh.edges.size());
    for (const auto& [e, slot] : edges_.slots) {
      REQUIRE(live.is_edge(slot));
      const auto& shown = live.edges()[slot];
      REQUIRE(live.points()[shown.low] == e.low);
      REQUIRE(live.points()[shown.high] == e.high);
    }
    REQUIRE(faces_.slots.size() == mesh.faces.size());
    for (const auto& [f, slot] : faces_.slots) {
      REQUIRE(live.is_face(slot));
      for (std::size_t i = 0; i < 3; ++i) {
        REQUIRE(live.points()[live.faces()[slot].corners[i]] == f.corners[i]);
      }
    }
    const auto compact = live.compact();
    REQUIRE(compact.mesh == mesh);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      REQUIRE(compact.vertices[i] == vertices_.slots.at(mesh.vertices[i]));
    }
    for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
      REQUIRE(compact.simplices[i] == simplices_.slots.at(corners_of(mesh, mesh.simplices[i])));
    }
  }
  [[nodiscard]] const auto& simplices() const { return simplices_.slots; }

 private:
  static Corners corners_of(const mesher::Mesh<D>& mesh,
                            const typename mesher::Mesh<D>::Simplex& simplex) {
    Corners corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = mesh.vertices[simplex[i]];
    return corners;
  }
  static Corners shown(const mesher::LiveMesh<D>& live, mesher::Slot s) {
    Corners corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = live.points()[live.simplices()[s][i]];
    return corners;
  }

  // What went is still to be seen.
  void require_shown(const mesher::Change<D>& c, const mesher::LiveMesh<D>& live) const {
    for (std::size_t i = 0; i < c.vertices_removed.size(); ++i) {
      const mesher::Slot v = c.slots.vertices_removed[i];
      REQUIRE_FALSE(live.is_vertex(v));
      REQUIRE(live.points()[v] == c.vertices_removed[i]);
      REQUIRE(live.find(c.vertices_removed[i]) == mesher::kNoSlot);
    }
    for (std::size_t i = 0; i < c.simplices_removed.size(); ++i) {
      const mesher::Slot t = c.slots.simplices_removed[i];
      REQUIRE_FALSE(live.is_simplex(t));
      REQUIRE(shown(live, t) == c.simplices_removed[i]);
      REQUIRE(live.find_simplex(c.simplices_removed[i]) == mesher::kNoSlot);
    }
  }
  void require_vertices(const mesher::LiveMesh<D>& live, const mesher::Mesh<D>& mesh) const {
    REQUIRE(live.vertices() == mesh.vertices.size());
    REQUIRE(live.vertex_slots() == vertices_.end());
    REQUIRE(live.kinds().size() == live.vertex_slots());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const mesher::Slot slot = vertices_.slots.at(mesh.vertices[i]);
      REQUIRE(live.is_vertex(slot));
      REQUIRE(live.points()[slot] == mesh.vertices[i]);
      REQUIRE(live.kinds()[slot] == mesh.kinds[i]);
      REQUIRE(live.find(mesh.vertices[i]) == slot);
      const mesher::Slot at = live.simplex_at(slot);
      REQUIRE(live.is_simplex(at));
      const auto& corners = live.simplices()[at];
      REQUIRE(std::count(corners.begin(), corners.end(), slot) == 1);
    }
    for (mesher::Slot s = 0; s < live.vertex_slots(); ++s) {
      REQUIRE(live.is_vertex(s) != vertices_.is_free(s));
    }
    REQUIRE_FALSE(live.is_vertex(mesher::kNoSlot));
  }
  void require_simplices(const mesher::LiveMesh<D>& live, const mesher::Mesh<D>& mesh) const {
    REQUIRE(live.simplex_count() == mesh.simplices.size());
    REQUIRE(live.simplex_slots() == simplices_.end());
    REQUIRE(live.neighbours().size() == live.simplex_slots());
    std::map<std::set<mesher::Slot>, std::vector<mesher::Slot>> at;  // the simplices at each side
    const auto side = [&](mesher::Slot s, std::size_t across) {
      std::set<mesher::Slot> corners(live.simplices()[s].begin(), live.simplices()[s].end());
      corners.erase(live.simplices()[s][across]);
      return corners;
    };
    for (const auto& simplex : mesh.simplices) {
      const Corners corners = corners_of(mesh, simplex);
      const mesher::Slot slot = simplices_.slots.at(corners);
      REQUIRE(live.is_simplex(slot));
      REQUIRE(shown(live, slot) == corners);
      REQUIRE(live.find_simplex(corners) == slot);
      for (std::size_t i = 0; i <= D; ++i) at[side(slot, i)].push_back(slot);
    }
    for (mesher::Slot s = 0; s < live.simplex_slots(); ++s) {
      REQUIRE(live.is_simplex(s) != simplices_.is_free(s));
      if (!live.is_simplex(s)) continue;
      for (std::size_t i = 0; i <= D; ++i) {
        mesher::Slot other = mesher::kNoSlot;
        for (const mesher::Slot t : at.at(side(s, i))) other = t == s ? other : t;
        REQUIRE(live.neighbours()[s][i] == other);
      }
    }
  }

  SlotsOf<mesher::Point<D>> vertices_;
  SlotsOf<Corners> simplices_;
  SlotsOf<mesher::LineEdge<D>> edges_;
  SlotsOf<mesher::PolygonFace<D>> faces_;
};

/// All that a live mesh shows, free slots included.
template <int D>
struct Shown {
  std::vector<mesher::Point<D>> points;
  std::vector<mesher::VertexKind> kinds;
  std::vector<typename mesher::LiveMesh<D>::Simplex> simplices, neighbours;
  std::vector<typename mesher::Mesh<D>::Edge> edges;
  std::vector<typename mesher::Mesh<D>::Face> faces;
  std::vector<bool> is_vertex, is_simplex, is_edge, is_face;
  friend bool operator==(const Shown&, const Shown&) = default;

  Shown() = default;
  explicit Shown(const mesher::LiveMesh<D>& live)
      : points(live.points().begin(), live.points().end()),
        kinds(live.kinds().begin(), live.kinds().end()),
        simplices(live.simplices().begin(), live.simplices().end()),
        neighbours(live.neighbours().begin(), live.neighbours().end()),
        edges(live.edges().begin(), live.edges().end()),
        faces(live.faces().begin(), live.faces().end()) {
    for (mesher::Slot s = 0; s < points.size(); ++s) is_vertex.push_back(live.is_vertex(s));
    for (mesher::Slot s = 0; s < simplices.size(); ++s) is_simplex.push_back(live.is_simplex(s));
    for (mesher::Slot s = 0; s < edges.size(); ++s) is_edge.push_back(live.is_edge(s));
    for (mesher::Slot s = 0; s < faces.size(); ++s) is_face.push_back(live.is_face(s));
  }
};

}  // namespace support
