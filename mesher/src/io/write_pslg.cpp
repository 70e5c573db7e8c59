// Writes graphs as `.poly` (Triangle) and `.obj` (Wavefront).
#include <algorithm>
#include <map>
#include <utility>

#include "mesher/pslg.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

TextFile& operator<<(TextFile& file, FeatureId id) { return file << static_cast<std::int64_t>(id); }

TextFile& operator<<(TextFile& file, const Point<2>& p) { return file << p[0] << ' ' << p[1]; }

template <class Part>
bool any_marked(const std::vector<Part>& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.marker != 0; });
}

void write_points(const Pslg& pslg, TextFile& file) {
  const bool marked = any_marked(pslg.points);
  file << pslg.points.size() << " 2 " << pslg.attributes_per_point << (marked ? " 1\n" : " 0\n");
  for (std::size_t i = 0; i < pslg.points.size(); ++i) {
    file << pslg.points[i].id << ' ' << pslg.points[i].at;
    for (std::size_t k = 0; k < pslg.attributes_per_point; ++k) {
      file << ' ' << pslg.attributes[i * pslg.attributes_per_point + k];
    }
    if (marked) file << ' ' << pslg.points[i].marker;
    file << '\n';
  }
}

void write_segments(const std::vector<Pslg::Segment>& segments, TextFile& file) {
  const bool marked = any_marked(segments);
  file << segments.size() << (marked ? " 1\n" : " 0\n");
  for (const Pslg::Segment& s : segments) {
    file << s.id << ' ' << s.from << ' ' << s.to;
    if (marked) file << ' ' << s.marker;
    file << '\n';
  }
}

// A limit is always written: a region with one value would say less.
void write_regions(const std::vector<Pslg::Region>& regions, TextFile& file) {
  if (regions.empty()) return;
  file << regions.size() << '\n';
  for (const Pslg::Region& r : regions) {
    file << r.id << ' ' << r.seed << ' ' << r.attribute << ' ' << r.max_area.value_or(-1) << '\n';
  }
}

}  // namespace

Pslg without_polylines(Pslg pslg) {
  std::int64_t last = 0;
  for (const auto& s : pslg.segments) last = std::max(last, static_cast<std::int64_t>(s.id));
  for (const auto& p : pslg.polylines) last = std::max(last, static_cast<std::int64_t>(p.id));
  for (const Pslg::Polyline& line : std::exchange(pslg.polylines, {})) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      pslg.segments.push_back({FeatureId{++last}, line.points[i - 1], line.points[i], line.marker});
    }
  }
  return pslg;
}

void write_poly(const Pslg& pslg, TextFile& file) {
  write_points(pslg, file);
  write_segments(without_polylines(pslg).segments, file);
  file << pslg.holes.size() << '\n';
  for (const Pslg::Hole& hole : pslg.holes) file << hole.id << ' ' << hole.seed << '\n';
  write_regions(pslg.regions, file);
}

void write_obj(const Pslg& pslg, TextFile& file) {
  std::map<FeatureId, std::size_t> number;
  for (const Pslg::Vertex& point : pslg.points) {
    number.try_emplace(point.id, number.size() + 1);
    file << "v " << point.at << " 0\n";
  }
  for (const Pslg::Segment& s : pslg.segments) {
    file << "l " << number.at(s.from) << ' ' << number.at(s.to) << '\n';
  }
  for (const Pslg::Polyline& line : pslg.polylines) {
    file << 'l';
    for (const FeatureId id : line.points) file << ' ' << number.at(id);
    file << '\n';
  }
}

void write_pslg(const Pslg& pslg, const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension != ".poly" && extension != ".obj") {
    throw Error(ErrorCode::unknown_format,
                "points and lines are written to .poly and .obj, not " + text::quoted(extension),
                {path});
  }
  OutputFiles files;
  TextFile& file = files.open(path);
  extension == ".poly" ? write_poly(pslg, file) : write_obj(pslg, file);
  files.commit();
}

}  // namespace mesher
