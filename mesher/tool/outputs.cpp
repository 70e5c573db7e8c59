// Output files that survive neither an error nor an interrupt.
#include "outputs.hpp"

#include "cancel.hpp"
#include "mesher/svg.hpp"

namespace tool {

Outputs::~Outputs() { set_doomed({}); }

mesher::TextFile& Outputs::open(const std::string& path) {
  const HoldInterrupts hold;
  mesher::TextFile& file = files_.open(path);
  set_doomed(files_.temporaries());
  return file;
}

void Outputs::open_mesh(const std::string& path, mesher::MeshFiles content) {
  if (mesher::format_of(path) == ".svg") {
    pictures_.push_back(&open(path));
    return;
  }
  const HoldInterrupts hold;
  writers_.push_back(mesher::open_mesh(files_, path, content));
  set_doomed(files_.temporaries());
}

void Outputs::write(const mesher::DomainMesh& mesh, const Triangles& coloured) {
  require_uninterrupted();
  for (const auto& writer : writers_) writer(mesh.kept, mesh.kept.features);
  if (!pictures_.empty()) draw(mesh, coloured);
}

// A domain has a colour, whether or not it has regions.
void Outputs::draw(const mesher::DomainMesh& mesh, const Triangles& coloured) {
  mesher::SvgView view = mesher::svg_view(mesh.kept);
  view.coloured = coloured;
  mesher::MeshFeatures features = mesh.kept.features;
  if (!mesh.keeps_all) features.regions.resize(mesh.kept.simplices.size());
  for (auto* picture : pictures_) mesher::write_svg(mesh.kept, features, view, *picture);
}

void Outputs::commit() {
  const HoldInterrupts hold;
  require_uninterrupted();
  files_.commit();
  set_doomed({});
}

}  // namespace tool
