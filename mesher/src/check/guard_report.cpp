// Counting what has stayed poor beside each feature.
#include <algorithm>

#include "check/check_complex.hpp"
#include "check/poor_beside.hpp"
#include "check/space_quality.hpp"
#include "graph/has_features.hpp"
#include "mesher/graph.hpp"
#include "text/text.hpp"

namespace mesher {

namespace {

// `counts(corners)`: whether a tetrahedron is one to be looked at.
template <class Counts>
GuardReport report_of(const Mesh<3>& mesh, const Graph<3>& complex, double rho, Counts&& counts) {
  if (rho >= kGuarded || !has_features(complex)) return {};
  GraphFile<3> file;
  file.graph = complex;
  CheckOptions<3> options;
  options.graph = &file;
  options.rho = rho;
  const detail::CheckedMesh<3> checked(mesh);
  const detail::ComplexCheck parts(checked, options);
  const detail::IsolatedEdges isolated(complex);
  detail::GuardCounts found;
  for (const auto& s : mesh.simplices) {
    const auto& v = mesh.vertices;
    const std::array corners{v[s[0]], v[s[1]], v[s[2]], v[s[3]]};
    const detail::RadiusEdge ratio = detail::radius_edge(mesh, s);
    if (!detail::is_above(ratio, rho) || !counts(corners) || parts.excuses(s)) continue;
    found.look(detail::GuardCounts::shortest_edges(corners), ratio.ratio,
               [&](const auto& p, const auto& q) { return isolated.find(p, q); });
  }
  return found.report();
}

}  // namespace

GuardReport guard_report(const Mesh<3>& mesh, const Graph<3>& complex, double rho) {
  return report_of(mesh, complex, rho, [](const auto&) { return true; });
}

GuardReport guard_news(const Mesh<3>& mesh, const Graph<3>& complex, double rho,
                       const std::vector<std::array<Point<3>, 4>>& tetrahedra) {
  return report_of(mesh, complex, rho, [&](const auto& corners) {
    return std::binary_search(tetrahedra.begin(), tetrahedra.end(), corners);
  });
}

std::string GuardReport::text() const {
  std::string all;
  for (const PoorBeside& place : places) {
    all += text_of(place.feature) + ": " + std::to_string(place.tetrahedra) +
           " tetrahedra stay poor beside it, up to " + text::to_text(place.max_radius_edge) +
           ", the first at " + text::to_text<3>(place.at) + '\n';
  }
  return all;
}

}  // namespace mesher
