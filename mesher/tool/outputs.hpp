// The output files of a command: opened before the work begins, so that a bad path is found early,
// and removed by an interrupt as by an error.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "cancel.hpp"
#include "mesher/graph.hpp"
#include "mesher/meshing.hpp"
#include "mesher/write.hpp"

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

/// Writes a graph to a file of this name: .poly, else in the plane .obj, in space .smesh.
/// Requires: of .smesh, mesher::require_single_loops(graph) has not thrown.
void write_graph(const mesher::Graph<2>& graph, const std::string& path, mesher::TextFile& file);
void write_graph(const mesher::Graph<3>& graph, const std::string& path, mesher::TextFile& file);

/// With meshes. D is 2 or 3.
template <int D>
class Outputs : public CommandFiles {
 public:
  /// Opens a mesh output, by extension. Throws: Error (unknown_format, cannot_write, bad_option).
  void open_mesh(const std::string& path, mesher::MeshFiles content = mesher::MeshFiles::plain,
                 const mesher::WriteOptions& options = {});
  /// The names of groups in what is written.
  void set_names(mesher::GroupNames names) { names_ = std::move(names); }

  /// Writes what is kept to all mesh outputs; `coloured`: simplices that pictures show as changed.
  /// Throws: Error (cannot_write, cancelled).
  using Simplices = std::vector<std::array<mesher::Point<D>, D + 1>>;
  void write(const mesher::DomainMesh<D>& mesh, const Simplices& coloured = {});

 private:
  std::vector<mesher::MeshWriter<D>> writers_;
  std::vector<mesher::TextFile*> pictures_;
  mesher::GroupNames names_;
};

}  // namespace tool
