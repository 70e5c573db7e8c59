// Reads the points and lines of `.obj` files.
#include "io/obj_file.hpp"
#include "io/read_pslg.hpp"

namespace mesher {

GraphFile<2> read_obj_lines(const std::string& path) {
  const ObjFile obj = read_obj_file(path, CoordinateRule::input);
  PslgBuilder build(path);
  for (const Note& note : obj.notes) build.note(note.text, note.location);
  std::vector<PointId> ids;
  for (std::size_t i = 0; i < obj.vertices.size(); ++i) {
    ids.push_back(build.add_point(obj.vertices[i], 0, obj.positions[i]));
  }
  for (const ObjFile::Element& element : obj.elements) {
    const FileLocation place{path, element.position.line, element.position.column};
    if (element.kind == 'f') {
      throw Error(ErrorCode::unsupported, "a face: only points (v, p) and lines (l) are input",
                  place);
    }
    if (element.kind == 'p') continue;  // its vertices are points anyway
    std::vector<PointId> points;
    for (const std::uint32_t v : element.vertices) points.push_back(ids[v]);
    build.add_line(std::move(points), 0, element.position);
  }
  return build.finish();
}

}  // namespace mesher
