// Mesh outputs by extension.
#include "io/write_mesh.hpp"

#include "mesher/io.hpp"
#include "mesher/svg.hpp"
#include "io/text.hpp"

namespace mesher {

MeshWriter open_mesh(OutputFiles& files, const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".node") {
    TextFile& node = files.open(path);
    TextFile& ele = files.open(text::with_extension(path, ".ele"));
    return [&node, &ele](const Mesh<2>& mesh) {
      write_node(mesh, node);
      write_ele(mesh, ele);
    };
  }
  const bool known = extension == ".vtu" || extension == ".off" || extension == ".svg";
  if (!known) {
    throw Error(ErrorCode::unknown_format,
                "meshes are written to .node (with .ele), .vtu, .off and .svg, not " +
                    text::quoted(extension),
                {path});
  }
  TextFile& file = files.open(path);
  if (extension == ".vtu") return [&file](const Mesh<2>& mesh) { write_vtu(mesh, file); };
  if (extension == ".off") return [&file](const Mesh<2>& mesh) { write_off(mesh, file); };
  return [&file](const Mesh<2>& mesh) { write_svg(mesh, svg_view(mesh), file); };
}

void write_mesh(const Mesh<2>& mesh, const std::string& path) {
  OutputFiles files;
  open_mesh(files, path)(mesh);
  files.commit();
}

}  // namespace mesher
