// The writers of single formats, behind open_mesh. Each throws Error(cannot_write).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"
#include "mesher/second_order.hpp"
#include "mesher/write.hpp"
#include "sets/make_set.hpp"

namespace mesher {

/// What a writer is told besides the mesh. D is 2 or 3.
template <int D>
struct WriteHow {
  /// In second order: midpoints, which are vertices of the mesh, as from with_midpoints; else null.
  const SecondOrder<D>* second = nullptr;
  MshVersion msh = MshVersion::v4_1;
};

template <int D>
void write_node(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);
template <int D>
void write_ele(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file);
template <int D>
void write_vtu(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file);
template <int D>
void write_vtk(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file);
template <int D>
void write_msh(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file);
template <int D>
void write_inp(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file);
template <int D>
void write_su2(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);
template <int D>
void write_medit(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);

/// In space: the faces of the features, or of the boundary if they have none; the features' edges.
void write_face(const Mesh<3>& mesh, const MeshFeatures& features, const WriteHow<3>& how,
                TextFile& file);
void write_edge(const MeshFeatures& features, const WriteHow<3>& how, TextFile& file);

void write_edge(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_poly(const MeshFeatures& features, TextFile& file);
void write_neigh(const Mesh<2>& mesh, TextFile& file);
void write_off(const Mesh<2>& mesh, TextFile& file);
void write_obj(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);

/// Throws: Error(bad_option) for an order that is neither 1 nor 2, and for 2 if the format of
/// `path` has no such meshes.
void require_order(int order, const std::string& path);

/// A writer that calls write(mesh, features, how), with midpoints if that is asked for.
template <int D, class Write>
[[nodiscard]] MeshWriter<D> mesh_writer(const WriteOptions& options, Write write) {
  return MeshWriter<D>([options, write](const Mesh<D>& mesh, const MeshFeatures& features) {
    require_names(features.names);
    if (options.order == 1) return write(mesh, features, WriteHow<D>{nullptr, options.msh});
    const SecondOrder<D> second(mesh);
    const MeshData<D> all = with_midpoints(mesh, features, second);
    write(all, all.features, WriteHow<D>{&second, options.msh});
  });
}

/// Calls visit(nodes) with those of a simplex, edge or face.
template <int D, class Visit>
void visit_nodes(const std::array<std::uint32_t, D + 1>& simplex, const WriteHow<D>& how,
                 Visit&& visit) {
  how.second == nullptr ? visit(simplex) : visit(how.second->nodes_of(simplex));
}
template <int D, class Visit>
void visit_nodes(const MeshEdge& edge, const WriteHow<D>& how, Visit&& visit) {
  how.second == nullptr ? visit(std::array{edge.low, edge.high})
                        : visit(how.second->nodes_of(edge));
}
template <int D, class Visit>
void visit_nodes(const MeshFace& face, const WriteHow<D>& how, Visit&& visit) {
  how.second == nullptr ? visit(face.corners) : visit(how.second->nodes_of(face));
}

/// The coordinates, three of them; in the plane z is 0.
inline void write_in_space(const Point<2>& p, TextFile& file) {
  file << p[0] << ' ' << p[1] << " 0";
}
inline void write_in_space(const Point<3>& p, TextFile& file) {
  file << p[0] << ' ' << p[1] << ' ' << p[2];
}

/// Numbers for formats whose groups are positive integers below 2^31 - 1: 0 stays 0; other values
/// stay if all are such integers, else they are numbered upward from 1. Value is double or an
/// integer.
template <class Value>
class GroupNumbers {
 public:
  explicit GroupNumbers(std::vector<Value> values) : values_(std::move(values)) {
    detail::make_set(values_);
    values_.erase(std::remove(values_.begin(), values_.end(), Value{0}), values_.end());
    as_they_are_ = std::all_of(values_.begin(), values_.end(), [](Value value) {
      return value >= 1 && value < INT32_MAX && value == static_cast<std::int32_t>(value);
    });
  }
  [[nodiscard]] std::int32_t of(Value value) const {
    if (value == 0 || as_they_are_) return static_cast<std::int32_t>(value);
    const auto found = std::lower_bound(values_.begin(), values_.end(), value);
    return static_cast<std::int32_t>(found - values_.begin()) + 1;
  }

 private:
  std::vector<Value> values_;  // distinct, ascending
  bool as_they_are_ = true;
};

}  // namespace mesher
