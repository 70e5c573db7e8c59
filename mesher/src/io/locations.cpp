// Where the features of a file stand.
#include <algorithm>
#include <cstddef>

#include "mesher/plc.hpp"
#include "mesher/pslg.hpp"

namespace mesher {
namespace {

template <class Part>
FeatureId id_of_part(const Part& part) {
  return part.id;
}
FeatureId id_of_part(const Plc::Facet& facet) { return facet.polygon.id; }

// Of the part with that id: parts[i] stands at (file.*location_of)(i).
template <class File, class Part, class LocationOf>
FileLocation location_among(const File& file, FeatureId id, const std::vector<Part>& parts,
                            LocationOf location_of) {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const Part& part) { return id_of_part(part) == id; });
  if (found == parts.end()) return {file.file};
  return (file.*location_of)(static_cast<std::size_t>(found - parts.begin()));
}

// Of what graphs and complexes have in common.
template <class File, class Graph>
FileLocation location_in_both(const Feature& f, const File& file, const Graph& graph) {
  switch (f.kind) {
    case FeatureKind::point:
      return location_among(file, f.id, graph.points, &File::location_of_point);
    case FeatureKind::line:
      return location_among(file, f.id, graph.segments, &File::location_of_segment);
    case FeatureKind::hole:
      return location_among(file, f.id, graph.holes, &File::location_of_hole);
    case FeatureKind::region:
      return location_among(file, f.id, graph.regions, &File::location_of_region);
    case FeatureKind::polygon:
    case FeatureKind::none:
      break;
  }
  return {file.file};
}

}  // namespace

FileLocation location_of(const Feature& feature, const PslgFile& file) {
  const FileLocation found = location_in_both(feature, file, file.pslg);
  if (feature.kind != FeatureKind::line || found.line > 0) return found;
  return location_among(file, feature.id, file.pslg.polylines, &PslgFile::location_of_polyline);
}

FileLocation location_of(const Feature& feature, const PlcFile& file) {
  if (feature.kind != FeatureKind::polygon) return location_in_both(feature, file, file.plc);
  return location_among(file, feature.id, file.plc.facets, &PlcFile::location_of_facet);
}

Error located(const Error& error, const PslgFile& file) {
  return located(error, [&](const Feature& f) { return location_of(f, file); });
}

Error located(const Error& error, const PlcFile& file) {
  return located(error, [&](const Feature& f) { return location_of(f, file); });
}

}  // namespace mesher
