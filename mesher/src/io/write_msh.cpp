// Writes `.msh` files (Gmsh, versions 4.1 and 2.2, ASCII), nodes and elements numbered from 1; in
// the plane z = 0.
//
// Gmsh keeps elements in entities, and names groups of entities. Here each region is a surface, and
// each marker of edges a curve; in space each region is a volume, and each marker of faces a
// surface. The nodes, in their order, are all of the first region. If there is a group, every
// entity is in one: readers take a file without groups, or all of it in groups.
//
// $Periodic pairs the curves of periodic sides, and their nodes: first that of the curve `to`, then
// its twin, which the affine map moves there.
//
// Names stand in the order facets, regions, in space edges: gmshToFoam takes the first name of a
// number, whatever its dimension, and patches are what it needs names for.
#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "geometry/box.hpp"
#include "io/write_mesh.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

constexpr std::size_t kFirst = 1;
constexpr int kLine = 1, kTriangle = 2, kTetrahedron = 4;  // element types
constexpr int kQuadraticLine = 8, kQuadraticTriangle = 9, kQuadraticTetrahedron = 11;
constexpr std::size_t kCurve = 1, kSurface = 2;  // dimensions of entities

// Elements of one entity, in the order of the mesh.
template <int D>
struct Entity {
  std::size_t dimension;
  int type;
  std::string group;  // its name; empty: none
  std::int32_t number;
  Box<D> box;
  std::vector<std::vector<std::uint32_t>> elements;  // by nodes
};

// Gmsh has the last two midpoints of a tetrahedron the other way around.
template <std::size_t N>
std::vector<std::uint32_t> in_order_of_gmsh(std::array<std::uint32_t, N> nodes) {
  if constexpr (N == 10) std::swap(nodes[8], nodes[9]);
  return {nodes.begin(), nodes.end()};
}

template <int D>
class MshWriter {
 public:
  MshWriter(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
            TextFile& file)
      : mesh_(mesh), features_(features), how_(how), file_(file) {
    collect_simplices();
    collect_parts(kCurve, type(kLine, kQuadraticLine), features.edges);
    if (D == 3) collect_parts(kSurface, type(kTriangle, kQuadraticTriangle), features.faces);
    if (groups() == 0 && !names_zero()) return;
    for (std::size_t d = kCurve; d <= D; ++d) group_rest(entities_[d], name_of(d, 0));
  }

  void write() {
    const bool is_old = how_.msh == MshVersion::v2_2;
    file_ << "$MeshFormat\n" << (is_old ? "2.2" : "4.1") << " 0 8\n$EndMeshFormat\n";
    write_names();
    if (is_old) {
      write_old_nodes();
      write_old_elements();
    } else {
      write_entities();
      write_nodes();
      write_elements();
    }
    write_periodic(is_old);
  }

 private:
  using Entity = mesher::Entity<D>;
  using Elements = std::vector<std::vector<std::uint32_t>>;

  [[nodiscard]] int type(int first, int second) const {
    return how_.second == nullptr ? first : second;
  }

  // The name of a marker or region, of elements of a dimension.
  [[nodiscard]] std::string name_of(std::size_t dimension, std::int64_t marker) const {
    const GroupNames& names = features_.names;
    if (dimension == D) return names.of_region(static_cast<double>(marker));
    return dimension == D - 1 ? names.of_facets(marker) : names.of_lines(marker);
  }
  // Whether what has no marker, or no region, has a name nevertheless.
  [[nodiscard]] bool names_zero() const {
    const GroupNames& names = features_.names;
    return names.facets.contains(0) || names.regions.contains(0) ||
           (D == 3 && names.lines.contains(0));
  }

  void collect_simplices() {
    const GroupNumbers<double> numbers(features_.regions);
    std::map<double, Elements> by_region;
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const double region = features_.regions.empty() ? 0 : features_.regions[i] + 0.0;
      visit_nodes<D>(mesh_.simplices[i], how_, [&](const auto& nodes) {
        by_region[region].push_back(in_order_of_gmsh(nodes));
      });
    }
    if (by_region.empty()) by_region[0];  // the nodes need an entity
    for (auto& [region, elements] : by_region) {
      add_entity(
          {D,
           D == 2 ? type(kTriangle, kQuadraticTriangle) : type(kTetrahedron, kQuadraticTetrahedron),
           region == 0 ? "" : features_.names.of_region(region),
           numbers.of(region),
           {},
           std::move(elements)});
    }
  }

  // Edges or faces by their markers.
  template <class Parts>
  void collect_parts(std::size_t dimension, int type, const Parts& parts) {
    std::map<std::int64_t, Elements> by_marker;
    for (const auto& part : parts) {
      visit_nodes<D>(part, how_, [&](const auto& nodes) {
        by_marker[part.marker].push_back(in_order_of_gmsh(nodes));
      });
    }
    std::vector<std::int64_t> markers;
    for (const auto& [marker, elements] : by_marker) markers.push_back(marker);
    const GroupNumbers<std::int64_t> numbers(markers);
    for (auto& [marker, elements] : by_marker) {
      const std::string name = marker == 0 ? "" : name_of(dimension, marker);
      if (dimension == kCurve) curves_[marker] = entities_[kCurve].size() + kFirst;
      add_entity({dimension, type, name, numbers.of(marker), {}, std::move(elements)});
    }
  }

  [[nodiscard]] std::size_t groups() const {
    std::size_t count = 0;
    for_each_entity([&](const Entity& e, std::size_t) { count += e.group.empty() ? 0 : 1; });
    return count;
  }

  // What has no group yet gets the number above all others.
  static void group_rest(std::vector<Entity>& entities, const std::string& name) {
    std::int32_t highest = 0;
    for (const Entity& e : entities) highest = std::max(highest, e.number);
    for (Entity& e : entities) {
      if (!e.group.empty()) continue;
      e.group = name;
      e.number = highest + 1;
    }
  }

  void add_entity(Entity entity) {
    bool first = true;
    for (const auto& element : entity.elements) {
      for (const std::uint32_t v : element) {
        const Point<D>& p = mesh_.vertices[v];
        if (first) entity.box = {p, p};
        detail::grow<D>(entity.box, p);
        first = false;
      }
    }
    entities_[entity.dimension].push_back(std::move(entity));
  }

  template <class Each>
  void for_each_entity(Each each) const {
    for (const auto& all : entities_) {
      std::size_t tag = kFirst;
      for (const Entity& entity : all) each(entity, tag++);
    }
  }

  void write_names() {
    if (groups() == 0) return;
    file_ << "$PhysicalNames\n" << groups() << '\n';
    for (const std::size_t d :
         D == 2 ? std::vector<std::size_t>{1, 2} : std::vector<std::size_t>{2, 3, 1}) {
      for (const Entity& e : entities_[d]) {
        if (e.group.empty()) continue;
        file_ << e.dimension << ' ' << e.number << " \"" << e.group << "\"\n";
      }
    }
    file_ << "$EndPhysicalNames\n";
  }

  // --- Version 2.2: rows `number x y z`, and `number type 2 group entity node...` --------------

  void write_old_nodes() {
    file_ << "$Nodes\n" << mesh_.vertices.size() << '\n';
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
      file_ << i + kFirst << ' ';
      write_in_space(mesh_.vertices[i], file_);
      file_ << '\n';
    }
    file_ << "$EndNodes\n";
  }

  void write_old_elements() {
    file_ << "$Elements\n"
          << mesh_.simplices.size() + features_.faces.size() + features_.edges.size() << '\n';
    std::size_t number = kFirst;
    for_each_entity([&](const Entity& e, std::size_t tag) {
      for (const auto& element : e.elements) {
        file_ << number++ << ' ' << e.type << " 2 " << (e.group.empty() ? 0 : e.number) << ' '
              << tag;
        for (const std::uint32_t v : element) file_ << ' ' << v + kFirst;
        file_ << '\n';
      }
    });
    file_ << "$EndElements\n";
  }

  // --- Version 4.1 -----------------------------------------------------------------------------

  void write_entities() {
    file_ << "$Entities\n0";
    for (std::size_t d = kCurve; d <= 3; ++d) file_ << ' ' << (d <= D ? entities_[d].size() : 0);
    file_ << '\n';
    for_each_entity([&](const Entity& e, std::size_t tag) {
      const auto& [lo, hi] = e.box;
      file_ << tag << ' ';
      write_in_space(lo, file_);
      file_ << ' ';
      write_in_space(hi, file_);
      if (e.group.empty()) {
        file_ << " 0 0\n";
      } else {
        file_ << " 1 " << e.number << " 0\n";
      }
    });
    file_ << "$EndEntities\n";
  }

  void write_nodes() {
    const std::size_t n = mesh_.vertices.size();
    file_ << "$Nodes\n1 " << n << ' ' << (n > 0 ? kFirst : 0) << ' ' << n << '\n';
    file_ << D << ' ' << kFirst << " 0 " << n << '\n';
    for (std::size_t i = 0; i < n; ++i) file_ << i + kFirst << '\n';
    for (const Point<D>& p : mesh_.vertices) {
      write_in_space(p, file_);
      file_ << '\n';
    }
    file_ << "$EndNodes\n";
  }

  void write_elements() {
    std::size_t blocks = 0;
    for_each_entity([&](const Entity& e, std::size_t) { blocks += e.elements.empty() ? 0 : 1; });
    const std::size_t n = mesh_.simplices.size() + features_.faces.size() + features_.edges.size();
    file_ << "$Elements\n" << blocks << ' ' << n << ' ' << (n > 0 ? kFirst : 0) << ' ' << n << '\n';
    std::size_t number = kFirst;
    for_each_entity([&](const Entity& e, std::size_t tag) {
      if (e.elements.empty()) return;
      file_ << e.dimension << ' ' << tag << ' ' << e.type << ' ' << e.elements.size() << '\n';
      for (const auto& element : e.elements) {
        file_ << number++;
        for (const std::uint32_t v : element) file_ << ' ' << v + kFirst;
        file_ << '\n';
      }
    });
    file_ << "$EndElements\n";
  }

  // --- Periodic sides --------------------------------------------------------------------------

  struct PeriodicNodes {
    std::size_t from = 0, to = 0;  // curves
    const PeriodicSides* sides = nullptr;
    std::vector<std::array<std::uint32_t, 2>> nodes;  // of `from`, of `to`
  };

  // With midpoints, in second order: one between twins is the twin of the one between the others.
  [[nodiscard]] PeriodicNodes periodic_nodes(const PeriodicSides& sides) const {
    PeriodicNodes found{curves_.at(sides.from), curves_.at(sides.to), &sides, sides.vertices};
    if (how_.second == nullptr) return found;
    std::map<std::uint32_t, std::uint32_t> twins;
    for (const auto& [a, b] : sides.vertices) twins.emplace(a, b);
    for (const MeshEdge& edge : features_.edges) {
      if (edge.marker != sides.from) continue;
      const auto low = twins.find(edge.low), high = twins.find(edge.high);
      if (low == twins.end() || high == twins.end()) continue;
      const auto [a, b] = std::minmax(low->second, high->second);
      found.nodes.push_back(
          {how_.second->between(edge.low, edge.high), how_.second->between(a, b)});
    }
    return found;
  }

  void write_periodic(bool is_old) {
    std::vector<PeriodicNodes> all;
    for (const PeriodicSides& sides : features_.periodic) {
      if (curves_.contains(sides.from) && curves_.contains(sides.to)) {
        all.push_back(periodic_nodes(sides));
      }
    }
    if (all.empty()) return;
    file_ << "$Periodic\n" << all.size() << '\n';
    for (const PeriodicNodes& pair : all) {
      file_ << kCurve << ' ' << pair.to << ' ' << pair.from << '\n';
      file_ << (is_old ? "Affine" : "16");
      for (std::size_t i = 0; i < 16; ++i) {
        const bool moves = i % 4 == 3 && i < 12;
        file_ << ' ' << (moves ? pair.sides->translation[i / 4] : i % 5 == 0 ? 1.0 : 0.0);
      }
      file_ << '\n' << pair.nodes.size() << '\n';
      for (const auto& [a, b] : pair.nodes) {
        file_ << b + kFirst << ' ' << a + kFirst << '\n';
      }
    }
    file_ << "$EndPeriodic\n";
  }

  const Mesh<D>& mesh_;
  const MeshFeatures& features_;
  const WriteHow<D>& how_;
  TextFile& file_;
  std::array<std::vector<Entity>, D + 1> entities_;  // by dimension
  std::map<std::int64_t, std::size_t> curves_;       // by marker, from 1
};

}  // namespace

template <int D>
void write_msh(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file) {
  MshWriter<D>(mesh, features, how, file).write();
}

template void write_msh(const Mesh<2>&, const MeshFeatures&, const WriteHow<2>&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_msh(const Mesh<3>&, const MeshFeatures&, const WriteHow<3>&, TextFile&);
#endif

}  // namespace mesher
