// The writers of single formats, behind open_mesh. Each throws Error(cannot_write).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"
#include "mesher/write.hpp"
#include "sets/make_set.hpp"

namespace mesher {

// D is 2 or 3.
template <int D>
void write_node(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);
template <int D>
void write_ele(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);
template <int D>
void write_vtu(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);
template <int D>
void write_vtk(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);
template <int D>
void write_msh(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);
template <int D>
void write_medit(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file);

/// In space: the faces of the features, or of the boundary if they have none; the features' edges.
void write_face(const Mesh<3>& mesh, const MeshFeatures& features, TextFile& file);
void write_edge(const MeshFeatures& features, TextFile& file);

void write_edge(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);
void write_poly(const MeshFeatures& features, TextFile& file);
void write_neigh(const Mesh<2>& mesh, TextFile& file);
void write_off(const Mesh<2>& mesh, TextFile& file);
void write_obj(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file);

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
