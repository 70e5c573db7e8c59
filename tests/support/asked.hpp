// What is asked of a check of a mesh, to be written with designators: CheckOptions has a base
// class.
#pragma once

#include <optional>

#include "mesher/check.hpp"

namespace support {

template <int D>
struct Asked {
  const mesher::GraphFile<D>* graph = nullptr;
  std::optional<double> rho{};
  mesher::BoundaryRule boundary = mesher::BoundaryRule::box;
  const mesher::MeshFeatures* features = nullptr;
  std::optional<double> max_measure{};
  bool constrained = false;    ///< in the plane
  bool ties = false;           ///< in space
  bool near_delaunay = false;  ///< likewise

  operator mesher::CheckOptions<D>() const {
    mesher::CheckOptions<D> options;
    options.graph = graph;
    options.rho = rho;
    options.boundary = boundary;
    options.features = features;
    options.max_measure = max_measure;
    if constexpr (D == 2) {
      options.constrained = constrained;
    } else {
      options.ties = ties;
      options.near_delaunay = near_delaunay;
    }
    return options;
  }
};

}  // namespace support
