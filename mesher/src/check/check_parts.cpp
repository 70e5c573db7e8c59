// Coordinates, vertices, orientations and kinds, in the plane and in space.
#include "check/check_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

#include "geometry/box.hpp"
#include "geometry/exact_sign.hpp"
#include "mesh/simplex_name.hpp"
#include "mesher/predicates.hpp"
#include "text/id_text.hpp"
#include "text/text.hpp"

namespace mesher::detail {
namespace {

using predicates::detail::BitRange;

bool in_range(double x) { return x == 0 || (std::abs(x) >= 0x1p-160 && std::abs(x) <= 0x1p101); }

template <int D>
bool on_box(const Box<D>& box, const Point<D>& p) {
  for (std::size_t i = 0; i < D; ++i) {
    if (p[i] == box.lo[i] || p[i] == box.hi[i]) return true;
  }
  return false;
}

template <int D>
int orientation(const Mesh<D>& mesh, const typename Mesh<D>::Simplex& t) {
  const auto& v = mesh.vertices;
  if constexpr (D == 2) {
    return predicates::orient2d(v[t[0]], v[t[1]], v[t[2]]);
  } else {
    return predicates::orient3d(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
  }
}

}  // namespace

template <int D>
std::string vertex_name(const Mesh<D>& mesh, std::size_t v) {
  return "vertex " + std::to_string(v + 1) + " at " + text::to_text<D>(mesh.vertices[v]);
}

template <int D>
std::string simplex_name(const Mesh<D>& mesh, std::size_t i) {
  std::string name =
      std::string(kSimplexName<D>) + ' ' + std::to_string(i + 1) + " with the vertices ";
  for (std::size_t k = 0; k <= D; ++k) {
    name += (k > 0 ? ", " : "") + std::to_string(mesh.simplices[i][k] + std::size_t{1});
  }
  return name;
}

template <int D>
Verdict check_coordinates(const Mesh<D>& mesh) {
  constexpr int kBits = predicates::detail::kCoordinateBits<4>;
  std::size_t finest = 0, largest = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Point<D>& p = mesh.vertices[v];
    if (!std::all_of(p.begin(), p.end(), in_range)) {
      return Verdict::bad(vertex_name(mesh, v) + " is beyond the magnitudes 2^-160 to 2^101");
    }
    if (BitRange(p).low < BitRange(mesh.vertices[finest]).low) finest = v;
    if (BitRange(p).high > BitRange(mesh.vertices[largest]).high) largest = v;
  }
  if (mesh.vertices.empty()) return Verdict::good("0 vertices");
  const int bits = BitRange(mesh.vertices[largest]).high - BitRange(mesh.vertices[finest]).low;
  if (bits > kBits) {
    return Verdict::bad("from the last digits of " + vertex_name(mesh, finest) + " to " +
                        vertex_name(mesh, largest) + " there are " + std::to_string(bits) +
                        " bits, more than the " + std::to_string(kBits) + " that can be judged");
  }
  return Verdict::good(std::to_string(mesh.vertices.size()) + " vertices");
}

template <int D>
Verdict check_vertices(const Mesh<D>& mesh) {
  const auto at = [&](std::uint32_t v) -> const Point<D>& { return mesh.vertices[v]; };
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return at(a) < at(b); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (at(order[i - 1]) != at(order[i])) continue;
    return Verdict::bad(vertex_name(mesh, order[i - 1]) + " and " + vertex_name(mesh, order[i]) +
                        " coincide");
  }
  std::vector<bool> used(mesh.vertices.size());
  for (const auto& t : mesh.simplices) {
    for (const auto corner : t) used[corner] = true;
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  if (unused == used.end()) return Verdict::good("all distinct, all used");
  return Verdict::bad(vertex_name(mesh, static_cast<std::size_t>(unused - used.begin())) +
                      " is in no " + kSimplexName<D>);
}

template <int D>
Verdict check_orientation(const Mesh<D>& mesh) {
  const std::string oriented = D == 2 ? "counterclockwise" : "positively oriented";
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    if (orientation(mesh, mesh.simplices[i]) > 0) continue;
    return Verdict::bad(simplex_name(mesh, i) + " is not " + oriented);
  }
  return Verdict::good(std::to_string(mesh.simplices.size()) + ' ' + kSimplicesName<D> + ' ' +
                       oriented);
}

template <int D>
Verdict check_kinds(const Mesh<D>& mesh, const GraphFile<D>* input,
                    const std::vector<mesher::Feature>& origins) {
  std::map<Point<D>, PointId> named;
  if (input != nullptr) {
    for (const auto& p : input->graph.points) named[p.at] = p.id;
  }
  const Box<D> box = bounding_box<D>(mesh.vertices);
  for (std::size_t v = 0; v < mesh.kinds.size(); ++v) {
    const bool is_input = mesh.kinds[v] == VertexKind::input;
    const auto bad = [&](const std::string& what) {
      return Verdict::bad(vertex_name(mesh, v) + what);
    };
    if (mesh.kinds[v] == VertexKind::boundary && !on_box<D>(box, mesh.vertices[v])) {
      return bad(" is said to be of the boundary, but is on no side of the box");
    }
    if (input == nullptr) continue;
    const auto point = named.find(mesh.vertices[v]);
    if (is_input && point == named.end()) return bad(" is said to be an input point, but is none");
    if (!is_input && point != named.end()) return bad(" is an input point, but not said to be");
    if (is_input && !origins.empty() && origins[v] != mesher::Feature(point->second)) {
      return bad(" is said to be input point " + std::to_string(origins[v].number) +
                 ", but is input point " + id_text(point->second));
    }
  }
  return Verdict::good("as the vertices' places are");
}

template std::string vertex_name<2>(const Mesh<2>&, std::size_t);
template std::string simplex_name<2>(const Mesh<2>&, std::size_t);
template Verdict check_coordinates<2>(const Mesh<2>&);
template Verdict check_vertices<2>(const Mesh<2>&);
template Verdict check_orientation<2>(const Mesh<2>&);
template Verdict check_kinds<2>(const Mesh<2>&, const GraphFile<2>*,
                                const std::vector<mesher::Feature>&);
#ifndef MESHER_PLANE_ONLY
template std::string vertex_name<3>(const Mesh<3>&, std::size_t);
template std::string simplex_name<3>(const Mesh<3>&, std::size_t);
template Verdict check_coordinates<3>(const Mesh<3>&);
template Verdict check_vertices<3>(const Mesh<3>&);
template Verdict check_orientation<3>(const Mesh<3>&);
template Verdict check_kinds<3>(const Mesh<3>&, const GraphFile<3>*,
                                const std::vector<mesher::Feature>&);
#endif

}  // namespace mesher::detail
