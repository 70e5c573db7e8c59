// The output files of a command: opened before the work begins, so that a bad path is found early,
// and removed by an interrupt as by an error.
#pragma once

#include <string>
#include <vector>

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

  /// Writes `mesh` to all mesh outputs. Throws: Error (cannot_write, cancelled).
  void write(const mesher::Mesh<2>& mesh, const mesher::MeshFeatures& features = {});
  /// Makes all files appear. Throws: Error (cannot_write, cancelled), and then none has.
  void commit();

  /// The files' names, in the order of opening; none after `commit`.
  [[nodiscard]] std::vector<std::string> targets() const { return files_.targets(); }

 private:
  mesher::OutputFiles files_;
  std::vector<mesher::MeshWriter> writers_;
};

}  // namespace tool
