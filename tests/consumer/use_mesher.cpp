// The example of mesher.hpp, as a user compiles it.
#include <cstdio>
#include <mesher/mesher.hpp>

int main() {
  mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
  options.algorithm = mesher::Algorithm::gap_balls;
  mesher::Mesher<2> m(options);
  m.insert(mesher::PointId{1}, {0.25, 0.5});
  m.update();
  m.insert(mesher::PointId{2}, {0.26, 0.5});
  const auto change = m.update();
  std::printf("%zu vertices came, %zu went\n", change.vertices_added.size(),
              change.vertices_removed.size());
  mesher::Graph<2> graph;
  graph.points = {{mesher::PointId{1}, {0.25, 0.5}}, {mesher::PointId{2}, {0.26, 0.5}}};
  const bool same = m.box_mesh() == mesher::box_mesh(graph, options) &&
                    m.mesh() == mesher::mesh(graph, options).mesh;
  return !change.vertices_added.empty() && same ? 0 : 1;
}
