// The output files of a command: opened before the work begins, so that a bad path is found early,
// and removed by an interrupt as by an error.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/domain_mesh.hpp"
#include "mesher/io.hpp"

namespace tool {

class Outputs {
 public:
  Outputs() = default;
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;
  ~Outputs();

  /// Refuses `path` as an output: it is an input.
  void protect(const std::string& path) { files_.protect(path); }
  /// Opens a file. Throws: Error (cannot_write, bad_option).
  mesher::TextFile& open(const std::string& path);
  /// Opens a mesh output, by extension. Throws: Error (unknown_format, cannot_write, bad_option).
  void open_mesh(const std::string& path, mesher::MeshFiles content = mesher::MeshFiles::plain);

  /// Writes what is kept to all mesh outputs; `coloured`: triangles that pictures show as changed.
  /// Throws: Error (cannot_write, cancelled).
  using Triangles = std::vector<std::array<mesher::Point<2>, 3>>;
  void write(const mesher::DomainMesh& mesh, const Triangles& coloured = {});
  /// Makes all files appear. Throws: Error (cannot_write, cancelled), and then none has.
  void commit();

  /// The files' names, in the order of opening; none after `commit`.
  [[nodiscard]] std::vector<std::string> targets() const { return files_.targets(); }

 private:
  void draw(const mesher::DomainMesh& mesh, const Triangles& coloured);

  mesher::OutputFiles files_;
  std::vector<mesher::MeshWriter> writers_;
  std::vector<mesher::TextFile*> pictures_;
};

}  // namespace tool
