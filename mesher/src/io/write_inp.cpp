// Writes `.inp` files (Abaqus, CalculiX), numbered from 1; in the plane z = 0.
//
// Elements of a region are a set. Facets of a marker are a set of their nodes, for boundary
// conditions, and a surface, a list of sides of elements, for loads. CalculiX reads 20 characters
// of a number, and 16 numbers a line.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/facet_sides.hpp"
#include "io/plain_names.hpp"
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

constexpr std::size_t kFirstNumber = 1, kNumbersPerLine = 16;
constexpr std::ptrdiff_t kLongestNumber = 20;

// The number of the side across from a corner.
constexpr std::array<int, 3> kSidesOfTriangle{2, 3, 1};        // S1: 12, S2: 23, S3: 31
constexpr std::array<int, 4> kSidesOfTetrahedron{3, 4, 2, 1};  // S1: 123, S2: 142, S3: 243, S4: 341

template <int D>
int side_number(std::uint32_t opposite) {
  if constexpr (D == 2) return kSidesOfTriangle[opposite];
  return kSidesOfTetrahedron[opposite % 4];
}

// With as many digits as there is room for.
void write_number(double value, TextFile& file) {
  char digits[32];
  const auto all = std::to_chars(digits, digits + sizeof digits, value);
  const char* end = all.ptr;
  for (int precision = 17; end - digits > kLongestNumber; --precision) {
    end =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, precision)
            .ptr;
  }
  file << std::string_view(digits, static_cast<std::size_t>(end - digits));
}

// Numbers of nodes, ascending, each once.
void write_set(std::vector<std::uint32_t> nodes, const std::string& name, TextFile& file) {
  detail::make_set(nodes);
  file << "*NSET, NSET=" << name << '\n';
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool ends_line = i % kNumbersPerLine == kNumbersPerLine - 1 || i + 1 == nodes.size();
    file << nodes[i] + kFirstNumber << (ends_line ? "\n" : ", ");
  }
}

template <int D>
class InpWriter {
 public:
  InpWriter(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
            TextFile& file)
      : mesh_(mesh), features_(features), how_(how), file_(file) {}

  void write() {
    file_ << "*HEADING\nmesh\n*NODE, NSET=Nall\n";
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) write_node(i);
    write_elements();
    write_facets();
    if (D == 3) write_lines();
  }

 private:
  void write_node(std::size_t i) {
    file_ << i + kFirstNumber;
    for (int k = 0; k < 3; ++k) {
      file_ << ", ";
      write_number(k < D ? mesh_.vertices[i][static_cast<std::size_t>(k % D)] : 0, file_);
    }
    file_ << '\n';
  }

  [[nodiscard]] const char* type() const {
    if (D == 2) return how_.second == nullptr ? "CPS3" : "CPS6";
    return how_.second == nullptr ? "C3D4" : "C3D10";
  }

  void write_elements() {
    std::map<double, std::vector<std::size_t>> by_region;
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      by_region[features_.regions.empty() ? 0 : features_.regions[i] + 0.0].push_back(i);
    }
    std::vector<std::string> sets;
    for (const auto& [region, elements] : by_region) {
      sets.push_back(names_.make(features_.names.of_region(region)));
      file_ << "*ELEMENT, TYPE=" << type() << ", ELSET=" << sets.back() << '\n';
      for (const std::size_t i : elements) write_element(i);
    }
    file_ << "*ELSET, ELSET=Eall\n";
    for (const std::string& set : sets) file_ << set << ",\n";
  }
  void write_element(std::size_t i) {
    file_ << i + kFirstNumber;
    visit_nodes<D>(mesh_.simplices[i], how_, [&](const auto& nodes) {
      for (const std::uint32_t v : nodes) file_ << ", " << v + kFirstNumber;
    });
    file_ << '\n';
  }

  void write_facets() {
    std::map<std::int64_t, std::vector<FacetSide<D>>> by_marker;
    for (const FacetSide<D>& facet : facet_sides(mesh_, features_)) {
      by_marker[facet.marker].push_back(facet);
    }
    for (const auto& [marker, facets] : by_marker) {
      const std::string name = names_.make(features_.names.of_facets(marker));
      std::vector<std::uint32_t> nodes;
      for (const auto& facet : facets) add_nodes(feature_of(facet), nodes);
      write_set(std::move(nodes), name, file_);
      file_ << "*SURFACE, NAME=" << name << ", TYPE=ELEMENT\n";
      for (const auto& facet : facets) {
        file_ << facet.simplex + kFirstNumber << ", S" << side_number<D>(facet.opposite) << '\n';
      }
    }
  }

  void write_lines() {
    std::map<std::int64_t, std::vector<std::uint32_t>> by_marker;
    for (const MeshEdge& e : features_.edges) add_nodes(e, by_marker[e.marker]);
    for (const auto& [marker, nodes] : by_marker) {
      write_set(nodes, names_.make(features_.names.of_lines(marker)), file_);
    }
  }

  template <class Part>
  void add_nodes(const Part& part, std::vector<std::uint32_t>& all) const {
    visit_nodes<D>(part, how_,
                   [&](const auto& nodes) { all.insert(all.end(), nodes.begin(), nodes.end()); });
  }

  const Mesh<D>& mesh_;
  const MeshFeatures& features_;
  const WriteHow<D>& how_;
  TextFile& file_;
  PlainNames names_{"Nall", "Eall"};
};

}  // namespace

template <int D>
void write_inp(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file) {
  InpWriter<D>(mesh, features, how, file).write();
}

template void write_inp(const Mesh<2>&, const MeshFeatures&, const WriteHow<2>&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_inp(const Mesh<3>&, const MeshFeatures&, const WriteHow<3>&, TextFile&);
#endif

}  // namespace mesher
