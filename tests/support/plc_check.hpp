// Whether a mesh contains a complex: every edge of the input is a union of the mesh's edges, every
// polygon one of faces. Written apart from the mesher's own tests of it, from tetrahedra and the
// vertices' labels alone.
#pragma once

#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"

namespace support {

struct ComplexMesh {
  std::vector<mesher::Point<3>> vertices;
  std::vector<std::array<std::size_t, 4>> tetrahedra;

  struct Edge {
    std::map<double, std::size_t> vertices;  // by where on it they are: 0 to 1
  };
  struct Face {
    std::vector<std::vector<mesher::Point<3>>> loops;  // the outer one, then holes
    std::set<std::size_t> vertices;                    // all that lie on it
    std::vector<std::size_t> edges;
  };
  std::vector<Edge> edges;
  std::vector<Face> faces;
  /// Whether tetrahedra with this shortest edge may be poor: it spans a small angle.
  std::set<std::array<std::size_t, 2>> exempt;
};

struct ComplexReport {
  long missing_edges = 0;  // of the mesh, between neighbours on an edge
  long wrong_edges = 0;    // that pierce a polygon
  double area_error = 0;   // relative, the largest
  long poor = 0;           // tetrahedra off the exempt ones
  long exempt = 0;         // poor but exempt
  long flat = 0;           // of four vertices of one polygon
  double worst = 0;        // radius over edge, off the exempt ones
};
[[nodiscard]] ComplexReport check(const ComplexMesh& mesh, double rho);

}  // namespace support
