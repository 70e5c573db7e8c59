// Output files that survive neither an error nor an interrupt.
#include "outputs.hpp"

#include "mesher/space_svg.hpp"
#include "mesher/svg.hpp"

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

// --- In the plane ----------------------------------------------------------------------------

void Outputs::open_mesh(const std::string& path, mesher::MeshFiles content) {
  if (mesher::format_of(path) == ".svg") {
    pictures_.push_back(&open(path));
    return;
  }
  writers_.push_back(open_among(
      [&](mesher::OutputFiles& files) { return mesher::open_mesh(files, path, content); }));
}

void Outputs::write(const mesher::DomainMesh& mesh, const Simplices& coloured) {
  require_uninterrupted();
  for (const auto& writer : writers_) writer(mesh.kept, mesh.kept.features);
  if (!pictures_.empty()) draw(mesh, coloured);
}

// A domain has a colour, whether or not it has regions.
void Outputs::draw(const mesher::DomainMesh& mesh, const Simplices& coloured) {
  mesher::SvgView view = mesher::svg_view(mesh.kept);
  view.coloured = coloured;
  mesher::MeshFeatures features = mesh.kept.features;
  if (!mesh.keeps_all) features.regions.resize(mesh.kept.simplices.size());
  for (auto* picture : pictures_) mesher::write_svg(mesh.kept, features, view, *picture);
}

// --- In space --------------------------------------------------------------------------------

void SpaceOutputs::open_mesh(const std::string& path, mesher::MeshFiles content) {
  if (mesher::format_of(path) == ".svg") {
    pictures_.push_back(&open(path));
    return;
  }
  writers_.push_back(open_among(
      [&](mesher::OutputFiles& files) { return mesher::open_space_mesh(files, path, content); }));
}

void SpaceOutputs::write(const mesher::DomainMeshOf<3>& mesh, const Simplices& coloured) {
  require_uninterrupted();
  const auto& kept = mesh.kept;
  for (const auto& writer : writers_) writer(kept, kept.features);
  if (pictures_.empty()) return;
  mesher::SpaceView view = mesher::space_view(kept);
  view.coloured = coloured;
  for (auto* picture : pictures_) mesher::write_svg(kept, kept.features, view, *picture);
}

}  // namespace tool
