// Outputs of meshes of tetrahedra, by extension.
#include <string_view>
#include <utility>

#include "io/write_mesh.hpp"
#include "io/write_surface.hpp"
#include "mesher/write.hpp"
#include "text/text.hpp"

namespace mesher {

namespace {

using Write = void (*)(const Mesh<3>&, const MeshFeatures&, TextFile&);

template <auto kWrite>
void write_boundary(const Mesh<3>& mesh, const MeshFeatures&, TextFile& file) {
  kWrite(mesh, file);
}

constexpr std::pair<std::string_view, Write> kSingleFiles[] = {
    {".vtu", write_vtu<3>},
    {".vtk", write_vtk<3>},
    {".msh", write_msh<3>},
    {".mesh", write_medit<3>},
    {".off", write_boundary<write_surface_off>},
    {".obj", write_boundary<write_surface_obj>},
    {".stl", write_boundary<write_surface_stl>},
    {".svg", [](const Mesh<3>& mesh, const MeshFeatures& features, TextFile& file) {
       write_svg(mesh, features, svg_view(mesh), file);
     }}};

MeshWriter<3> open_node(OutputFiles& files, const std::string& path, MeshFiles content) {
  TextFile& node = files.open(path);
  TextFile& ele = files.open(text::with_extension(path, ".ele"));
  TextFile& face = files.open(text::with_extension(path, ".face"));
  TextFile* const edge =
      content == MeshFiles::plain ? nullptr : &files.open(text::with_extension(path, ".edge"));
  return MeshWriter<3>(
      [&node, &ele, &face, edge](const Mesh<3>& mesh, const MeshFeatures& features) {
        write_node(mesh, features, node);
        write_ele(mesh, features, ele);
        write_face(mesh, features, face);
        if (edge != nullptr) write_edge(features, *edge);
      });
}

}  // namespace

template <>
MeshWriter<3> open_mesh<3>(OutputFiles& files, const std::string& path, MeshFiles content) {
  const std::string extension = text::extension(path);
  if (extension == ".node") return open_node(files, path, content);
  for (const auto& [known, write] : kSingleFiles) {
    if (extension != known) continue;
    TextFile& file = files.open(path);
    return MeshWriter<3>([write = write, &file](const Mesh<3>& mesh, const MeshFeatures& features) {
      write(mesh, features, file);
    });
  }
  throw Error(ErrorCode::unknown_format,
              "meshes of tetrahedra are written to .node (with .ele and .face), .vtu, .vtk, .msh "
              "and .mesh, their boundaries to .off, .obj and .stl, pictures to .svg, not " +
                  text::quoted(extension),
              {path});
}

void write_mesh(const Mesh<3>& mesh, const std::string& path) {
  OutputFiles files;
  open_mesh<3>(files, path)(mesh);
  files.commit();
}

void write_mesh(const MeshData<3>& mesh, const std::string& path) {
  OutputFiles files;
  const bool plain = mesh.features.empty();
  open_mesh<3>(files, path, plain ? MeshFiles::plain : MeshFiles::features)(mesh, mesh.features);
  files.commit();
}

}  // namespace mesher
