// The difference of two graphs, feature by feature.
#include "graph_edits.hpp"

#include <bit>
#include <charconv>
#include <cstdint>
#include <map>
#include <utility>

namespace tool {
namespace {

using mesher::Graph;
using mesher::GraphPoint;
using mesher::PointId;
using mesher::Polygon;
using mesher::Polyline;
using mesher::Seed;
using mesher::SeedKind;

std::string number_text(auto id) {
  std::string text(1, ' ');
  return text += std::to_string(static_cast<std::int64_t>(id));
}

template <int D>
std::string place_text(const mesher::Point<D>& p) {
  std::string text;
  for (const double x : p) {
    text += ' ';
    text += script_number(x);
  }
  return text;
}

std::string points_text(const std::vector<PointId>& points) {
  std::string text;
  for (const PointId p : points) text += number_text(p);
  return text;
}

std::string marker_text(std::int64_t marker) {
  return marker == 0 ? "" : " marker " + std::to_string(marker);
}

template <int D>
std::string coming(const GraphPoint<D>& p) {
  return "+point" + number_text(p.id) + place_text<D>(p.at) + marker_text(p.marker);
}
std::string coming(const Polyline& line) {
  return (line.points.size() == 2 ? "+segment" : "+polyline") + number_text(line.id) +
         points_text(line.points) + marker_text(line.marker);
}
std::string coming(const Polygon& f) {
  std::string text = "+polygon" + number_text(f.id);
  for (std::size_t i = 0; i < f.loops.size(); ++i) {
    text += (i > 0 ? " /" : "") + points_text(f.loops[i]);
  }
  if (!f.points.empty()) text += " on" + points_text(f.points);
  if (!f.edges.empty()) text += " along";
  for (const auto& [a, b] : f.edges) text += number_text(a) + number_text(b);
  return text + marker_text(f.marker);
}
template <int D>
std::string coming(const Seed<D>& seed) {
  const bool hole = seed.id.kind == SeedKind::hole;
  std::string text =
      (hole ? "+hole" : "+region") + number_text(seed.id.number) + place_text<D>(seed.at);
  if (hole) return text;
  text += ' ';
  text += script_number(seed.attribute);
  if (!seed.max_measure) return text;
  text += ' ';
  return text += script_number(*seed.max_measure);
}

template <int D>
std::string going(const GraphPoint<D>& p) {
  return "-point" + number_text(p.id);
}
std::string going(const Polyline& line) {
  return (line.points.size() == 2 ? "-segment" : "-polyline") + number_text(line.id);
}
std::string going(const Polygon& f) { return "-polygon" + number_text(f.id); }
template <int D>
std::string going(const Seed<D>& seed) {
  return (seed.id.kind == SeedKind::hole ? "-hole" : "-region") + number_text(seed.id.number);
}

// What makes another feature of one of the same id.
template <class Part>
void add_change(const Part& from, const Part& to, std::vector<std::string>& edits) {
  edits.push_back(going(from));
  edits.push_back(coming(to));
}
template <int D>
void add_change(const GraphPoint<D>& from, const GraphPoint<D>& to,
                std::vector<std::string>& edits) {
  if (from.marker == to.marker) {
    edits.push_back("move" + number_text(to.id) + place_text<D>(to.at));
    return;
  }
  edits.push_back(going(from));
  edits.push_back(coming(to));
}

template <class Part>
void add_changes(const std::vector<Part>& from, const std::vector<Part>& to,
                 std::vector<std::string>& edits) {
  std::map<decltype(Part::id), const Part*> were;
  for (const Part& part : from) were.emplace(part.id, &part);
  std::vector<std::string> come;
  for (const Part& part : to) {
    const auto was = were.find(part.id);
    if (was == were.end()) {
      come.push_back(coming(part));
      continue;
    }
    if (!(*was->second == part)) add_change(*was->second, part, come);
    were.erase(was);
  }
  for (const auto& gone : were) edits.push_back(going(*gone.second));
  edits.insert(edits.end(), come.begin(), come.end());
}

template <int D>
std::vector<Polyline> lines_of(const Graph<D>& graph) {
  std::vector<Polyline> lines = graph.polylines;
  for (const auto& s : graph.segments) lines.push_back({s.id, {s.from, s.to}, s.marker});
  return lines;
}

class Fnv {
 public:
  void add(std::uint64_t x) {
    for (int i = 0; i < 8; ++i) hash_ = (hash_ ^ (x >> (8 * i) & 0xff)) * 0x100000001b3;
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x + 0.0)); }
  void add(PointId id) { add(static_cast<std::uint64_t>(id)); }
  template <class T>
  void add_all(const std::vector<T>& items) {
    add(items.size());
    for (const T& item : items) add(item);
  }
  template <std::size_t D>
  void add_place(const std::array<double, D>& p) {
    for (const double x : p) add(x);
  }
  [[nodiscard]] std::string text() const {
    char digits[17];
    return {digits, std::to_chars(digits, digits + sizeof digits, hash_, 16).ptr};
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

void add_polygon(const Polygon& f, Fnv& hash) {
  hash.add(static_cast<std::uint64_t>(f.id));
  hash.add(f.loops.size());
  for (const auto& loop : f.loops) hash.add_all(loop);
  hash.add(f.edges.size());
  for (const auto& [a, b] : f.edges) {
    hash.add(a);
    hash.add(b);
  }
  hash.add_all(f.points);
  hash.add(static_cast<std::uint64_t>(f.marker));
}

}  // namespace

std::string script_number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string script_of(const std::vector<std::string>& lines) {
  if (lines.size() == 1) return lines[0] + "\n";
  std::string text = "begin\n";
  for (const auto& line : lines) text += line + "\n";
  return text + "commit\n";
}

template <int D>
std::vector<std::string> graph_edits(const Graph<D>& from, const Graph<D>& to) {
  std::vector<std::string> edits;
  add_changes(from.points, to.points, edits);
  add_changes(lines_of(from), lines_of(to), edits);
  if constexpr (D == 3) add_changes(from.polygons, to.polygons, edits);
  add_changes(from.seeds, to.seeds, edits);
  return edits;
}

template <int D>
std::string hash_of_graph(const Graph<D>& graph) {
  Fnv hash;
  hash.add(graph.points.size());
  for (const auto& p : graph.points) {
    hash.add(p.id);
    hash.add_place(p.at);
    hash.add(static_cast<std::uint64_t>(p.marker));
  }
  const auto lines = lines_of(graph);
  hash.add(lines.size());
  for (const auto& line : lines) {
    hash.add(static_cast<std::uint64_t>(line.id));
    hash.add_all(line.points);
    hash.add(static_cast<std::uint64_t>(line.marker));
  }
  if constexpr (D == 3) {
    hash.add(graph.polygons.size());
    for (const auto& f : graph.polygons) add_polygon(f, hash);
  }
  hash.add(graph.seeds.size());
  for (const auto& seed : graph.seeds) {
    hash.add(static_cast<std::uint64_t>(seed.id.kind));
    hash.add(static_cast<std::uint64_t>(seed.id.number));
    hash.add_place(seed.at);
    hash.add(seed.attribute);
    hash.add(seed.max_measure.value_or(0));
  }
  return hash.text();
}

template std::vector<std::string> graph_edits(const Graph<2>&, const Graph<2>&);
template std::vector<std::string> graph_edits(const Graph<3>&, const Graph<3>&);
template std::string hash_of_graph(const Graph<2>&);
template std::string hash_of_graph(const Graph<3>&);

}  // namespace tool
