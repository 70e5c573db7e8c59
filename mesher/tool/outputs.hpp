// The output files of a command: opened before the work begins, so that a bad path is found early,
// and removed by an interrupt as by an error.
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "cancel.hpp"
#include "mesher/domain_mesh.hpp"
#include "mesher/io.hpp"
#include "mesher/space_files.hpp"

namespace tool {

/// Files of any kind.
class CommandFiles {
 public:
  CommandFiles() = default;
  CommandFiles(const CommandFiles&) = delete;
  CommandFiles& operator=(const CommandFiles&) = delete;
  ~CommandFiles();

  /// Refuses `path` as an output: it is an input.
  void protect(const std::string& path) { files_.protect(path); }
  /// Opens a file. Throws: Error (cannot_write, bad_option).
  mesher::TextFile& open(const std::string& path);
  /// Makes all files appear. Throws: Error (cannot_write, cancelled), and then none has.
  void commit();

  /// The files' names, in the order of opening; none after `commit`.
  [[nodiscard]] std::vector<std::string> targets() const { return files_.targets(); }

 protected:
  /// What `open(files)` gives; the files that it opens do not survive an interrupt.
  template <class Open>
  auto open_among(Open open) {
    const HoldInterrupts hold;
    auto opened = open(files_);
    set_doomed(files_.temporaries());
    return opened;
  }

 private:
  mesher::OutputFiles files_;
};

/// With meshes in the plane.
class Outputs : public CommandFiles {
 public:
  /// Opens a mesh output, by extension. Throws: Error (unknown_format, cannot_write, bad_option).
  void open_mesh(const std::string& path, mesher::MeshFiles content = mesher::MeshFiles::plain);

  /// Writes what is kept to all mesh outputs; `coloured`: triangles that pictures show as changed.
  /// Throws: Error (cannot_write, cancelled).
  using Simplices = std::vector<std::array<mesher::Point<2>, 3>>;
  void write(const mesher::DomainMesh& mesh, const Simplices& coloured = {});

 private:
  void draw(const mesher::DomainMesh& mesh, const Simplices& coloured);

  std::vector<mesher::MeshWriter> writers_;
  std::vector<mesher::TextFile*> pictures_;
};

/// With meshes in space.
class SpaceOutputs : public CommandFiles {
 public:
  /// As those of Outputs.
  void open_mesh(const std::string& path, mesher::MeshFiles content = mesher::MeshFiles::plain);
  using Simplices = std::vector<std::array<mesher::Point<3>, 4>>;
  void write(const mesher::DomainMeshOf<3>& mesh, const Simplices& coloured = {});

 private:
  std::vector<mesher::SpaceMeshWriter> writers_;
  std::vector<mesher::TextFile*> pictures_;
};

/// The outputs of a dimension.
template <int D>
using OutputsOf = std::conditional_t<D == 2, Outputs, SpaceOutputs>;

}  // namespace tool
