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

void Outputs::open_mesh(const std::string& path) {
  const HoldInterrupts hold;
  writers_.push_back(mesher::open_mesh(files_, path));
  set_doomed(files_.temporaries());
}

void Outputs::write(const mesher::Mesh<2>& mesh) {
  require_uninterrupted();
  for (const auto& writer : writers_) writer(mesh);
}

void Outputs::commit() {
  const HoldInterrupts hold;
  require_uninterrupted();
  files_.commit();
  set_doomed({});
}

}  // namespace tool
