// Mesh outputs by extension.
#include "io/write_mesh.hpp"

#include <utility>

#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using Write = void (*)(const Mesh<2>&, const MeshFeatures&, TextFile&);

constexpr std::pair<std::string_view, Write> kSingleFiles[] = {
    {".vtu", write_vtu<2>},
    {".vtk", write_vtk<2>},
    {".msh", write_msh<2>},
    {".mesh", write_medit<2>},
    {".off",
     [](const Mesh<2>& mesh, const MeshFeatures&, TextFile& file) { write_off(mesh, file); }},
    {".obj", write_obj},
    {".svg", [](const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
       write_svg(mesh, features, svg_view(mesh), file);
     }}};

MeshWriter<2> open_node(OutputFiles& files, const std::string& path, MeshFiles content) {
  TextFile& node = files.open(path);
  TextFile& ele = files.open(text::with_extension(path, ".ele"));
  const auto write = [&node, &ele](const Mesh<2>& mesh, const MeshFeatures& features) {
    write_node(mesh, features, node);
    write_ele(mesh, features, ele);
  };
  if (content == MeshFiles::plain) return MeshWriter<2>(write);
  TextFile& edge = files.open(text::with_extension(path, ".edge"));
  TextFile& poly = files.open(text::with_extension(path, ".poly"));
  TextFile& neigh = files.open(text::with_extension(path, ".neigh"));
  return MeshWriter<2>(
      [write, &edge, &poly, &neigh](const Mesh<2>& mesh, const MeshFeatures& features) {
        write(mesh, features);
        write_edge(mesh, features, edge);
        write_poly(features, poly);
        write_neigh(mesh, neigh);
      });
}

}  // namespace

template <>
MeshWriter<2> open_mesh<2>(OutputFiles& files, const std::string& path, MeshFiles content) {
  const std::string extension = text::extension(path);
  if (extension == ".node") return open_node(files, path, content);
  for (const auto& [known, write] : kSingleFiles) {
    if (extension != known) continue;
    TextFile& file = files.open(path);
    return MeshWriter<2>([write = write, &file](const Mesh<2>& mesh, const MeshFeatures& features) {
      write(mesh, features, file);
    });
  }
  throw Error(ErrorCode::unknown_format,
              "meshes are written to .node (with .ele), .vtu, .vtk, .msh, .mesh, .off, .obj and "
              ".svg, not " +
                  text::quoted(extension),
              {path});
}

std::string format_of(const std::string& path) { return text::extension(path); }

void write_mesh(const Mesh<2>& mesh, const std::string& path) {
  OutputFiles files;
  open_mesh<2>(files, path)(mesh);
  files.commit();
}

void write_mesh(const MeshData<2>& mesh, const std::string& path) {
  OutputFiles files;
  const bool plain = mesh.features.empty();
  open_mesh<2>(files, path, plain ? MeshFiles::plain : MeshFiles::features)(mesh, mesh.features);
  files.commit();
}

}  // namespace mesher
