// Reads complexes of any known format and refuses repeated ids.
#include "io/read_plc.hpp"

#include "io/distinct_ids.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

PlcFile read_any(const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".poly") return read_space_poly(path);
  if (extension == ".smesh") return read_smesh(path);
  throw Error(ErrorCode::unknown_format,
              "points, segments and polygons in space are read from .poly and .smesh, not " +
                  text::quoted(extension),
              {path});
}

}  // namespace

PlcFile read_plc(const std::string& path) {
  PlcFile f = read_any(path);
  require_distinct(named("point", f.plc.points, [&](auto i) { return f.place_of_point(i); }));
  require_distinct(named("hole", f.plc.holes, [&](auto i) { return f.place_of_hole(i); }));
  require_distinct(named("region", f.plc.regions, [&](auto i) { return f.place_of_region(i); }));
  return f;
}

}  // namespace mesher
