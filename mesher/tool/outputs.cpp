// Output files that survive neither an error nor an interrupt.
#include "outputs.hpp"

#include <filesystem>

#include "mesher/write.hpp"

namespace tool {

CommandFiles::~CommandFiles() { set_doomed({}); }

mesher::TextFile& CommandFiles::open(const std::string& path) {
  return *open_among([&](mesher::OutputFiles& files) { return &files.open(path); });
}

void CommandFiles::commit() {
  const HoldInterrupts hold;
  require_uninterrupted();
  files_.commit();
  set_doomed({});
}

namespace {

bool is_poly(const std::string& path) { return std::filesystem::path(path).extension() == ".poly"; }

}  // namespace

void write_graph(const mesher::Graph<2>& graph, const std::string& path, mesher::TextFile& file) {
  is_poly(path) ? mesher::write_poly(graph, file) : mesher::write_obj(graph, file);
}
void write_graph(const mesher::Graph<3>& graph, const std::string& path, mesher::TextFile& file) {
  is_poly(path) ? mesher::write_poly(graph, file) : mesher::write_smesh(graph, file);
}

// --- Meshes ----------------------------------------------------------------------------------

template <int D>
void Outputs<D>::open_mesh(const std::string& path, mesher::MeshFiles content,
                           const mesher::WriteOptions& options) {
  if (mesher::format_of(path) == ".svg") {
    pictures_.push_back(&open(path));
    return;
  }
  writers_.push_back(open_among([&](mesher::OutputFiles& files) {
    return mesher::open_mesh<D>(files, path, content, options);
  }));
}

// In the plane a domain has a colour, whether or not it has regions.
template <int D>
void Outputs<D>::write(const mesher::DomainMesh<D>& made, const Simplices& coloured) {
  require_uninterrupted();
  const mesher::MeshData<D>& mesh = made.mesh;
  if (mesh.features.names == names_) {
    for (const auto& writer : writers_) writer(mesh, mesh.features);
  } else {
    mesher::MeshFeatures named = mesh.features;
    named.names = names_;
    for (const auto& writer : writers_) writer(mesh, named);
  }
  if (pictures_.empty()) return;
  mesher::SvgView<D> view = mesher::svg_view(mesh);
  view.coloured = coloured;
  mesher::MeshFeatures features = mesh.features;
  if (D == 2 && !made.keeps_all) features.regions.resize(mesh.simplices.size());
  for (auto* picture : pictures_) mesher::write_svg(mesh, features, view, *picture);
}

template class Outputs<2>;
template class Outputs<3>;

}  // namespace tool
