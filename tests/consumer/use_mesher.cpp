// The example of mesher.hpp, as a user compiles it.
#include <cstdio>

#include <mesher/mesher.hpp>

int main() {
  mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
  mesher::Mesher<2> m(options);
  m.insert(mesher::FeatureId{1}, {0.25, 0.5});
  m.update();
  m.insert(mesher::FeatureId{2}, {0.26, 0.5});
  const auto change = m.update();
  std::printf("%zu vertices came, %zu went\n", change.vertices_added.size(),
              change.vertices_removed.size());
  const bool same = m.mesh() == mesher::mesh_statically<2>({{0.25, 0.5}, {0.26, 0.5}}, options);
  return !change.vertices_added.empty() && same ? 0 : 1;
}
