// Output files that survive neither an error nor an interrupt.
#include "outputs.hpp"

#include "cancel.hpp"

namespace tool {

Outputs::~Outputs() { set_doomed({}); }

mesher::TextFile& Outputs::open(const std::string& path) {
  const HoldInterrupts hold;
  mesher::TextFile& file = files_.open(path);
  set_doomed(files_.temporaries());
  return file;
}

void Outputs::open_mesh(const std::string& path, mesher::MeshFiles content) {
  const HoldInterrupts hold;
  writers_.push_back(mesher::open_mesh(files_, path, content));
  set_doomed(files_.temporaries());
}

void Outputs::write(const mesher::Mesh<2>& mesh, const mesher::MeshFeatures& features) {
  require_uninterrupted();
  for (const auto& writer : writers_) writer(mesh, features);
}

void Outputs::commit() {
  const HoldInterrupts hold;
  require_uninterrupted();
  files_.commit();
  set_doomed({});
}

}  // namespace tool
