// A mesh behind a handle. It never changes; what is asked of it later is made then, once.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "handles.hpp"
#include "mesher/meshing.hpp"
#include "mesher/second_order.hpp"

namespace lm {

/// Facets, or edges, in rows of numbers.
struct FlatFacets {
  std::vector<std::uint32_t> corners;
  std::vector<std::int64_t> markers;
  std::vector<std::uint8_t> features;  // lm_feature_kind
  std::vector<std::int64_t> ids;
};

template <int D>
class MeshIn {
 public:
  /// `points`: the input, to find its points among the vertices if the mesh does not tell.
  MeshIn(mesher::MeshData<D> data, std::vector<mesher::GraphPoint<D>> points)
      : data(std::move(data)), points_(std::move(points)) {}

  /// Throws: Failure(LM_BAD_ARGUMENT).
  [[nodiscard]] lm_array array(std::int32_t field);
  [[nodiscard]] lm_array quality(std::int32_t measure);

  /// The mesh of second order of `first`, which is of first order.
  explicit MeshIn(std::shared_ptr<MeshIn> first);

  /// The mesh of first order: this one, or that it was made from.
  [[nodiscard]] const mesher::MeshData<D>& corners() const {
    return first_ == nullptr ? data : first_->data;
  }
  [[nodiscard]] int order() const noexcept { return first_ == nullptr ? 1 : 2; }

  const mesher::MeshData<D> data;
  std::vector<std::uint32_t> point_slots, cell_slots;  // of a live mesh

 private:
  using Simplex = typename mesher::Mesh<D>::Simplex;
  [[nodiscard]] const std::vector<Simplex>& neighbours();
  [[nodiscard]] const FlatFacets& facets_made();
  [[nodiscard]] const FlatFacets& edges_made();
  [[nodiscard]] const std::vector<mesher::Feature>& origins();

  struct FlatSides {
    std::vector<std::array<std::int64_t, 2>> markers;
    std::vector<std::array<double, 3>> translations;
    std::vector<std::int64_t> offsets{0};
    std::vector<std::array<std::uint32_t, 2>> points;
  };
  [[nodiscard]] const FlatSides& periodic_made();

  using Nodes = std::array<std::uint32_t, mesher::SecondOrder<D>::kCellNodes>;
  MeshIn(std::shared_ptr<MeshIn> first, const mesher::SecondOrder<D>& second);
  [[nodiscard]] FlatFacets with_nodes(const FlatFacets& corners, std::size_t columns) const;

  std::shared_ptr<MeshIn> first_;  // of second order
  std::optional<mesher::SecondOrder<D>> second_;
  std::vector<Nodes> nodes_;  // of cells
  std::vector<mesher::GraphPoint<D>> points_;
  std::recursive_mutex making_;
  std::optional<std::vector<Simplex>> neighbours_;
  std::optional<FlatFacets> facets_, edges_;
  std::optional<FlatSides> periodic_;
  std::optional<std::vector<mesher::Feature>> origins_;
  std::optional<std::vector<std::int64_t>> no_markers_;
  std::optional<std::vector<double>> no_regions_;
  std::array<std::optional<std::vector<double>>, LM_MAX_DIHEDRAL + 1> qualities_;
};

struct MeshObject final : Object {
  template <int D>
  MeshObject(std::in_place_index_t<D - 2>, mesher::MeshData<D> data,
             std::vector<mesher::GraphPoint<D>> points);

  [[nodiscard]] const std::vector<std::string>* texts() override { return &notes; }

  template <int D>
  explicit MeshObject(std::shared_ptr<MeshIn<D>> in) : mesh(std::move(in)) {}

  std::variant<std::shared_ptr<MeshIn<2>>, std::shared_ptr<MeshIn<3>>> mesh;
  std::vector<std::string> notes;
  mesher::Algorithm algorithm = mesher::Algorithm::automatic;
  bool keeps_all = false;
};

template <int D>
MeshObject::MeshObject(std::in_place_index_t<D - 2>, mesher::MeshData<D> data,
                       std::vector<mesher::GraphPoint<D>> points)
    : mesh(std::make_shared<MeshIn<D>>(std::move(data), std::move(points))) {}

/// The object of the enclosed part of a mesh. `points`: as for MeshIn.
template <int D>
[[nodiscard]] std::shared_ptr<MeshObject> mesh_object(mesher::DomainMesh<D> made,
                                                      std::vector<mesher::GraphPoint<D>> points) {
  auto object = std::make_shared<MeshObject>(std::in_place_index<D - 2>, std::move(made.mesh),
                                             std::move(points));
  for (const auto& fault : made.faults) object->notes.push_back(describe(fault));
  object->keeps_all = made.keeps_all;
  return object;
}

}  // namespace lm
