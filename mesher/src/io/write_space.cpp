// Outputs of meshes of tetrahedra, by extension.
#include <string_view>
#include <utility>

#include "io/write_mesh.hpp"
#include "io/write_surface.hpp"
#include "mesher/write.hpp"
#include "text/text.hpp"

namespace mesher {

namespace {

using How = WriteHow<3>;
using Write = void (*)(const Mesh<3>&, const MeshFeatures&, const How&, TextFile&);

template <void (*kWrite)(const Mesh<3>&, const MeshFeatures&, TextFile&)>
void write_first_order(const Mesh<3>& mesh, const MeshFeatures& features, const How&,
                       TextFile& file) {
  kWrite(mesh, features, file);
}

constexpr std::pair<std::string_view, Write> kSingleFiles[] = {
    {".vtu", write_vtu<3>},
    {".vtk", write_vtk<3>},
    {".msh", write_msh<3>},
    {".inp", write_inp<3>},
    {".su2", write_first_order<write_su2<3>>},
    {".mesh", write_first_order<write_medit<3>>},
    {".off", [](const Mesh<3>& mesh, const MeshFeatures&, const How&,
                TextFile& file) { write_surface_off(mesh, file); }},
    {".obj", write_first_order<write_surface_obj>},
    {".stl", write_first_order<write_surface_stl>},
    {".svg", [](const Mesh<3>& mesh, const MeshFeatures& features, const How&, TextFile& file) {
       write_svg(mesh, features, svg_view(mesh), file);
     }}};

MeshWriter<3> open_node(OutputFiles& files, const std::string& path, MeshFiles content,
                        const WriteOptions& options) {
  TextFile& node = files.open(path);
  TextFile& ele = files.open(text::with_extension(path, ".ele"));
  TextFile& face = files.open(text::with_extension(path, ".face"));
  TextFile* const edge =
      content == MeshFiles::plain ? nullptr : &files.open(text::with_extension(path, ".edge"));
  return mesh_writer<3>(
      options, [&node, &ele, &face, edge](const Mesh<3>& mesh, const MeshFeatures& features,
                                          const How& how) {
        write_node(mesh, features, node);
        write_ele(mesh, features, how, ele);
        write_face(mesh, features, how, face);
        if (edge != nullptr) write_edge(features, how, *edge);
      });
}

}  // namespace

template <>
MeshWriter<3> open_mesh<3>(OutputFiles& files, const std::string& path, MeshFiles content,
                           const WriteOptions& options) {
  const std::string extension = text::extension(path);
  if (extension == ".node") {
    require_order(options.order, path);
    return open_node(files, path, content, options);
  }
  for (const auto& [known, write] : kSingleFiles) {
    if (extension != known) continue;
    require_order(options.order, path);
    WriteOptions own = options;
    if (extension == ".svg") own.order = 1;
    TextFile& file = files.open(path);
    return mesh_writer<3>(
        own, [write = write, &file](const Mesh<3>& mesh, const MeshFeatures& features,
                                    const How& how) { write(mesh, features, how, file); });
  }
  throw Error(ErrorCode::unknown_format,
              "meshes of tetrahedra are written to .node (with .ele and .face), .vtu, .vtk, .msh "
              "and .mesh, their boundaries to .off, .obj and .stl, pictures to .svg, not " +
                  text::quoted(extension),
              {path});
}

void write_mesh(const Mesh<3>& mesh, const std::string& path, const WriteOptions& options) {
  OutputFiles files;
  open_mesh<3>(files, path, MeshFiles::plain, options)(mesh);
  files.commit();
}

void write_mesh(const MeshData<3>& mesh, const std::string& path, const WriteOptions& options) {
  OutputFiles files;
  const MeshFiles content = mesh.features.empty() ? MeshFiles::plain : MeshFiles::features;
  open_mesh<3>(files, path, content, options)(mesh, mesh.features);
  files.commit();
}

}  // namespace mesher
