// Mesh outputs by extension.
#include "io/write_mesh.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using Write = void (*)(const Mesh<2>&, const MeshFeatures&, const WriteHow<2>&, TextFile&);
using How = WriteHow<2>;

template <void (*kWrite)(const Mesh<2>&, const MeshFeatures&, TextFile&)>
void write_first_order(const Mesh<2>& mesh, const MeshFeatures& features, const How&,
                       TextFile& file) {
  kWrite(mesh, features, file);
}

constexpr std::pair<std::string_view, Write> kSingleFiles[] = {
    {".vtu", write_vtu<2>},
    {".vtk", write_vtk<2>},
    {".msh", write_msh<2>},
    {".inp", write_inp<2>},
    {".su2", write_first_order<write_su2<2>>},
    {".mesh", write_first_order<write_medit<2>>},
    {".off", [](const Mesh<2>& mesh, const MeshFeatures&, const How&,
                TextFile& file) { write_off(mesh, file); }},
    {".obj", write_first_order<write_obj>},
    {".svg", [](const Mesh<2>& mesh, const MeshFeatures& features, const How&, TextFile& file) {
       write_svg(mesh, features, svg_view(mesh), file);
     }}};

constexpr std::string_view kSecondOrder[] = {".node", ".vtu", ".vtk", ".msh", ".inp", ".svg"};

MeshWriter<2> open_node(OutputFiles& files, const std::string& path, MeshFiles content,
                        const WriteOptions& options) {
  TextFile& node = files.open(path);
  TextFile& ele = files.open(text::with_extension(path, ".ele"));
  const auto write = [&node, &ele](const Mesh<2>& mesh, const MeshFeatures& features,
                                   const How& how) {
    write_node(mesh, features, node);
    write_ele(mesh, features, how, ele);
  };
  if (content == MeshFiles::plain) return mesh_writer<2>(options, write);
  TextFile& edge = files.open(text::with_extension(path, ".edge"));
  TextFile& poly = files.open(text::with_extension(path, ".poly"));
  TextFile& neigh = files.open(text::with_extension(path, ".neigh"));
  return mesh_writer<2>(
      options, [write, &edge, &poly, &neigh](const Mesh<2>& mesh, const MeshFeatures& features,
                                             const How& how) {
        write(mesh, features, how);
        write_edge(mesh, features, edge);
        write_poly(features, poly);
        write_neigh(mesh, neigh);
      });
}

}  // namespace

void require_order(int order, const std::string& path) {
  if (order == 1) return;
  if (order != 2) {
    throw Error(ErrorCode::bad_option, "order " + std::to_string(order) + ": must be 1 or 2");
  }
  const std::string extension = text::extension(path);
  if (std::find(std::begin(kSecondOrder), std::end(kSecondOrder), extension) !=
      std::end(kSecondOrder)) {
    return;
  }
  throw Error(ErrorCode::bad_option,
              extension + " has no meshes of second order: .msh, .vtu, .vtk, .inp and .node do",
              {path});
}

template <>
MeshWriter<2> open_mesh<2>(OutputFiles& files, const std::string& path, MeshFiles content,
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
    return mesh_writer<2>(
        own, [write = write, &file](const Mesh<2>& mesh, const MeshFeatures& features,
                                    const How& how) { write(mesh, features, how, file); });
  }
  throw Error(ErrorCode::unknown_format,
              "meshes are written to .node (with .ele), .vtu, .vtk, .msh, .inp, .su2, .mesh, .off, "
              ".obj and .svg, not " +
                  text::quoted(extension),
              {path});
}

std::string format_of(const std::string& path) { return text::extension(path); }

void write_mesh(const Mesh<2>& mesh, const std::string& path, const WriteOptions& options) {
  OutputFiles files;
  open_mesh<2>(files, path, MeshFiles::plain, options)(mesh);
  files.commit();
}

void write_mesh(const MeshData<2>& mesh, const std::string& path, const WriteOptions& options) {
  OutputFiles files;
  const MeshFiles content = mesh.features.empty() ? MeshFiles::plain : MeshFiles::features;
  open_mesh<2>(files, path, content, options)(mesh, mesh.features);
  files.commit();
}

}  // namespace mesher
