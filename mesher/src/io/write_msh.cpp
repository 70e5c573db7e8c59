// Writes `.msh` files (Gmsh, version 4.1, ASCII), nodes and elements numbered from 1, z = 0.
//
// Gmsh keeps elements in entities, and names groups of entities. Here each region is a surface, and
// each marker of edges a curve; the nodes, in their order, are all of the first surface. If there
// is a group, every entity is in one: readers take a file without groups, or all of it in groups.
#include <algorithm>
#include <map>
#include <string>

#include "geometry/box.hpp"
#include "io/text.hpp"
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

constexpr std::size_t kFirst = 1;
constexpr int kLine = 1, kTriangle = 2;  // element types
constexpr int kCurve = 1, kSurface = 2;  // dimensions of entities

// Elements of one entity, in the order of the mesh.
struct Entity {
  int dimension;
  int type;
  std::string group;  // its name; empty: none
  std::int32_t number;
  Box<2> box;
  std::vector<std::vector<std::uint32_t>> elements;
};

class MshWriter {
 public:
  MshWriter(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file)
      : mesh_(mesh), features_(features), file_(file) {
    collect_triangles();
    collect_edges();
    if (groups() > 0) {
      group_rest(curves_, "marker 0");
      group_rest(surfaces_, "region 0");
    }
  }

  void write() {
    file_ << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    write_names();
    write_entities();
    write_nodes();
    write_elements();
  }

 private:
  void collect_triangles() {
    const GroupNumbers<double> numbers(features_.regions);
    std::map<double, std::vector<std::vector<std::uint32_t>>> by_region;
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const auto& t = mesh_.simplices[i];
      const double region = features_.regions.empty() ? 0 : features_.regions[i] + 0.0;
      by_region[region].emplace_back(t.begin(), t.end());
    }
    if (by_region.empty()) by_region[0];  // the nodes need a surface
    for (auto& [region, triangles] : by_region) {
      const std::string name = region == 0 ? "" : "region " + text::to_text(region);
      add_entity({kSurface, kTriangle, name, numbers.of(region), {}, std::move(triangles)});
    }
  }

  void collect_edges() {
    std::map<std::int64_t, std::vector<std::vector<std::uint32_t>>> by_marker;
    for (const MeshEdge& e : features_.edges) by_marker[e.marker].push_back({e.low, e.high});
    std::vector<std::int64_t> markers;
    for (const auto& [marker, edges] : by_marker) markers.push_back(marker);
    const GroupNumbers<std::int64_t> numbers(markers);
    for (auto& [marker, edges] : by_marker) {
      const std::string name = marker == 0 ? "" : "marker " + std::to_string(marker);
      add_entity({kCurve, kLine, name, numbers.of(marker), {}, std::move(edges)});
    }
  }

  [[nodiscard]] std::size_t groups() const {
    std::size_t count = 0;
    for_each_entity([&](const Entity& e, std::size_t) { count += e.group.empty() ? 0 : 1; });
    return count;
  }

  // What has no group yet gets the number above all others.
  static void group_rest(std::vector<Entity>& entities, const char* name) {
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
        const Point<2>& p = mesh_.vertices[v];
        if (first) entity.box = {p, p};
        detail::grow(entity.box, p);
        first = false;
      }
    }
    (entity.dimension == kCurve ? curves_ : surfaces_).push_back(std::move(entity));
  }

  template <class Each>
  void for_each_entity(Each each) const {
    std::size_t tag = kFirst;
    for (const Entity& curve : curves_) each(curve, tag++);
    tag = kFirst;
    for (const Entity& surface : surfaces_) each(surface, tag++);
  }

  void write_names() {
    if (groups() == 0) return;
    file_ << "$PhysicalNames\n" << groups() << '\n';
    for_each_entity([&](const Entity& e, std::size_t) {
      if (e.group.empty()) return;
      file_ << e.dimension << ' ' << e.number << " \"" << e.group << "\"\n";
    });
    file_ << "$EndPhysicalNames\n";
  }

  void write_entities() {
    file_ << "$Entities\n0 " << curves_.size() << ' ' << surfaces_.size() << " 0\n";
    for_each_entity([&](const Entity& e, std::size_t tag) {
      const auto& [lo, hi] = e.box;
      file_ << tag << ' ' << lo[0] << ' ' << lo[1] << " 0 " << hi[0] << ' ' << hi[1] << " 0 ";
      if (e.group.empty()) {
        file_ << "0 0\n";
      } else {
        file_ << "1 " << e.number << " 0\n";
      }
    });
    file_ << "$EndEntities\n";
  }

  void write_nodes() {
    const std::size_t n = mesh_.vertices.size();
    file_ << "$Nodes\n1 " << n << ' ' << (n > 0 ? kFirst : 0) << ' ' << n << '\n';
    file_ << kSurface << ' ' << kFirst << " 0 " << n << '\n';
    for (std::size_t i = 0; i < n; ++i) file_ << i + kFirst << '\n';
    for (const auto& [x, y] : mesh_.vertices) file_ << x << ' ' << y << " 0\n";
    file_ << "$EndNodes\n";
  }

  void write_elements() {
    std::size_t blocks = 0;
    for_each_entity([&](const Entity& e, std::size_t) { blocks += e.elements.empty() ? 0 : 1; });
    const std::size_t n = mesh_.simplices.size() + features_.edges.size();
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

  const Mesh<2>& mesh_;
  const MeshFeatures& features_;
  TextFile& file_;
  std::vector<Entity> curves_, surfaces_;
};

}  // namespace

void write_msh(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  MshWriter(mesh, features, file).write();
}

}  // namespace mesher
