// Rounds of meshing until twin sides are divided alike.
#include "mesher/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "facade/twin_lines.hpp"
#include "geometry/input_point.hpp"
#include "graph/require_ids.hpp"
#include "sac/check.hpp"

namespace mesher {
namespace {

using detail::Places;
using detail::TwinLines;
using detail::TwinPieces;
using Chain = std::vector<Point<2>>;  // positions along a piece, in order

// Twin pieces with the points that they have got: in the order of the first.
struct Divided {
  TwinPieces pieces;
  Point<2> by{};
  std::vector<PointId> on_a, on_b;
};

// What lies between two neighbours among the points of twin pieces.
struct Part {
  Divided* of;
  std::size_t k;  // from 0, along the first piece
  Chain a, b;     // what is to be there, as twins
  bool agrees;    // it is
};

// Within the box of the piece between two points: the box of an upright or level piece is that.
Point<2> moved(const Point<2>& p, const Point<2>& by, double sign, const Point<2>& from,
               const Point<2>& to) {
  Point<2> q;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [low, high] = std::minmax(from[i], to[i]);
    q[i] = std::clamp(p[i] + sign * by[i], low, high);
  }
  return q;
}

std::optional<std::uint32_t> find_vertex(const Mesh<2>& mesh, const Point<2>& p) {
  const auto found = std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), p);
  if (found == mesh.vertices.end() || *found != p) return std::nullopt;
  return static_cast<std::uint32_t>(found - mesh.vertices.begin());
}
std::uint32_t vertex_at(const Mesh<2>& mesh, const Point<2>& p) {
  const auto found = find_vertex(mesh, p);
  SAC_EXPECTS(found.has_value());
  return *found;
}

// The edges of lines, by vertex.
class LineEdges {
 public:
  explicit LineEdges(const Mesh<2>& mesh) : mesh_(mesh) {
    for (const auto& e : mesh.edges) {
      edges_[{e.feature.number, e.low}].push_back(e.high);
      edges_[{e.feature.number, e.high}].push_back(e.low);
    }
  }

  // The vertices of a line between two that follow each other on it.
  [[nodiscard]] Chain between(LineId line, const Point<2>& from, const Point<2>& to) const {
    Chain chain;
    const std::uint32_t end = vertex_at(mesh_, to);
    std::uint32_t before = vertex_at(mesh_, from), at = first(line, before, from, to);
    while (at != end) {
      chain.push_back(mesh_.vertices[at]);
      const auto& beside = around(line, at);
      SAC_ENSURES(beside.size() == 2);
      before = std::exchange(at, beside[0] == before ? beside[1] : beside[0]);
    }
    return chain;
  }

 private:
  using Key = std::pair<std::int64_t, std::uint32_t>;

  [[nodiscard]] const std::vector<std::uint32_t>& around(LineId line, std::uint32_t v) const {
    const auto found = edges_.find({static_cast<std::int64_t>(line), v});
    SAC_ENSURES(found != edges_.end());
    return found->second;
  }

  // Of the line's edges at a vertex, the one that leads to `to`: a polyline may come by twice.
  [[nodiscard]] std::uint32_t first(LineId line, std::uint32_t v, const Point<2>& from,
                                    const Point<2>& to) const {
    const double x = to[0] - from[0], y = to[1] - from[1];
    std::optional<std::uint32_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t w : around(line, v)) {
      const double u = mesh_.vertices[w][0] - from[0], t = mesh_.vertices[w][1] - from[1];
      const double sine = std::abs(u * y - t * x) / std::hypot(u, t);
      if (u * x + t * y > 0 && sine < least) std::tie(best, least) = std::pair(w, sine);
    }
    SAC_ENSURES(best.has_value());
    return *best;
  }

  const Mesh<2>& mesh_;
  std::map<Key, std::vector<std::uint32_t>> edges_;
};

class Rounds {
 public:
  Rounds(const Graph<2>& graph, const std::vector<PeriodicMarkers>& pairs) : graph_(graph) {
    std::int64_t last = 0;
    for (const auto& p : graph.points) {
      places_.emplace(p.id, p.at);
      last = std::max(last, static_cast<std::int64_t>(p.id));
    }
    if (last > std::numeric_limits<std::int64_t>::max() / 2) {
      throw Error(ErrorCode::bad_option, "periodic sides need ids above those of points");
    }
    next_ = last;
    for (const TwinLines& twins : detail::twin_lines(graph, places_, pairs)) {
      result_.sides.push_back({twins.markers, twins.translation, {}});
      sides_.emplace_back();
      for (const TwinPieces& pieces : twins.pieces) {
        sides_.back().push_back({pieces, twins.translation, {}, {}});
      }
    }
  }

  // The graph with the points that sides have got.
  [[nodiscard]] Graph<2> graph() const {
    Graph<2> all = graph_;
    all.points.insert(all.points.end(), added_.begin(), added_.end());
    all.attributes.resize(all.points.size() * all.attributes_per_point);
    std::map<std::pair<LineId, std::size_t>, std::vector<PointId>> inside;
    for (const auto& side : sides_) {
      for (const Divided& d : side) {
        if (d.on_a.empty()) continue;
        inside[{d.pieces.a.line, d.pieces.a.index}] = d.on_a;
        auto& on_b = inside[{d.pieces.b.line, d.pieces.b.index}] = d.on_b;
        if (d.pieces.reversed) std::reverse(on_b.begin(), on_b.end());
      }
    }
    put_inside(inside, all);
    return all;
  }

  // Whether twin sides are divided alike in the mesh.
  bool agree(const Mesh<2>& mesh) {
    const LineEdges edges(mesh);
    parts_.clear();
    bool agree = true;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      auto& points = result_.sides[i].points;
      points.clear();
      for (Divided& d : sides_[i]) {
        const auto ends = ends_of(d);
        for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
          Part part = part_of(edges, d, k, ends[k], ends[k + 1]);
          agree = agree && part.agrees;
          points.push_back(ends[k]);
          points.push_back(ends[k + 1]);
          for (std::size_t j = 0; j < part.a.size(); ++j) points.push_back({part.a[j], part.b[j]});
          if (!part.a.empty()) parts_.push_back(std::move(part));
        }
      }
    }
    return agree;
  }

  // Gives both sides the points of the mesh that agree() has looked at.
  void divide() {
    for (auto part = parts_.rbegin(); part != parts_.rend();
         ++part) {  // later ones of a piece first
      Divided& d = *part->of;
      std::vector<PointId> on_a, on_b;
      for (std::size_t j = 0; j < part->a.size(); ++j) {
        on_a.push_back(add(part->a[j], d.pieces.a.line));
        on_b.push_back(add(part->b[j], d.pieces.b.line));
      }
      const auto k = static_cast<std::ptrdiff_t>(part->k);
      d.on_a.insert(d.on_a.begin() + k, on_a.begin(), on_a.end());
      d.on_b.insert(d.on_b.begin() + k, on_b.begin(), on_b.end());
    }
  }

  // A later error may be of points that no file has.
  [[nodiscard]] Error told(const Error& error) const {
    if (added_.empty() || error.code() == ErrorCode::cancelled) return error;
    return error.with_message(error.message() + "; points from " +
                              std::to_string(static_cast<std::int64_t>(added_[0].id)) +
                              " on are those that periodic sides have got");
  }

  [[nodiscard]] PeriodicBox result(Mesh<2> mesh, Graph<2> graph, std::size_t rounds) && {
    result_.mesh = std::move(mesh);
    result_.graph = std::move(graph);
    result_.rounds = rounds;
    for (auto& twins : result_.sides) {
      std::sort(twins.points.begin(), twins.points.end());
      twins.points.erase(std::unique(twins.points.begin(), twins.points.end()), twins.points.end());
    }
    return std::move(result_);
  }

 private:
  static void put_inside(
      const std::map<std::pair<LineId, std::size_t>, std::vector<PointId>>& inside,
      Graph<2>& graph) {
    for (Polyline& line : graph.polylines) {
      std::vector<PointId> points{line.points[0]};
      for (std::size_t k = 1; k < line.points.size(); ++k) {
        const auto found = inside.find({line.id, k - 1});
        if (found != inside.end()) {
          points.insert(points.end(), found->second.begin(), found->second.end());
        }
        points.push_back(line.points[k]);
      }
      line.points = std::move(points);
    }
    std::vector<Segment> segments;
    for (const Segment& s : graph.segments) {
      const auto found = inside.find({s.id, 0});
      if (found == inside.end()) {
        segments.push_back(s);
        continue;
      }
      Polyline line{s.id, {s.from}, s.marker};
      line.points.insert(line.points.end(), found->second.begin(), found->second.end());
      line.points.push_back(s.to);
      graph.polylines.push_back(std::move(line));
    }
    graph.segments = std::move(segments);
  }

  PointId add(const Point<2>& p, LineId line) {
    const PointId id{++next_};
    added_.push_back({id, p, 0});
    places_.emplace(id, p);
    result_.points.emplace(id, line);
    return id;
  }

  // The ends of the parts of twin pieces: of both, in the order of the first.
  [[nodiscard]] std::vector<std::array<Point<2>, 2>> ends_of(const Divided& d) const {
    const auto& [a, b, reversed] = d.pieces;
    std::vector<std::array<Point<2>, 2>> ends;
    ends.push_back({places_.at(a.from), places_.at(reversed ? b.to : b.from)});
    for (std::size_t k = 0; k < d.on_a.size(); ++k) {
      ends.push_back({places_.at(d.on_a[k]), places_.at(d.on_b[k])});
    }
    ends.push_back({places_.at(a.to), places_.at(reversed ? b.from : b.to)});
    return ends;
  }

  // The k-th of these parts, with the vertices that both are to have.
  [[nodiscard]] static Part part_of(const LineEdges& edges, Divided& d, std::size_t k,
                                    const std::array<Point<2>, 2>& from,
                                    const std::array<Point<2>, 2>& to) {
    const auto& [a0, b0] = from;
    const auto& [a1, b1] = to;
    const Chain was_a = edges.between(d.pieces.a.line, a0, a1);
    const Chain was_b = edges.between(d.pieces.b.line, b0, b1);
    Part part{&d, k, was_a, {}, false};
    if (was_b.size() > was_a.size()) {
      part.a.clear();
      for (const Point<2>& q : was_b) part.a.push_back(moved(q, d.by, -1, a0, a1));
    }
    for (const Point<2>& p : part.a) part.b.push_back(moved(p, d.by, 1, b0, b1));
    part.agrees = part.a == was_a && part.b == was_b;
    return part;
  }

  const Graph<2>& graph_;
  Places places_;
  std::vector<GraphPoint<2>> added_;
  std::int64_t next_ = 0;  // the largest id of a point
  std::vector<std::vector<Divided>> sides_;
  std::vector<Part> parts_;  // of the mesh that was looked at, those with vertices inside
  PeriodicBox result_;
};

}  // namespace

PeriodicBox periodic_box_mesh(const Graph<2>& graph, const std::vector<PeriodicMarkers>& pairs,
                              const Options<2>& options, RunReport* report,
                              const RunControl& control, bool refinement) {
  detail::require_ids(graph);
  Options<2> same = options;
  if (same.domain == Box<2>{}) {
    for (const auto& p : graph.points) detail::check_coordinates(p.at, p.id);
    same.domain = snapped_domain<2>(places_of(graph));
  }
  Rounds rounds(graph, pairs);
  for (std::size_t round = 1; round <= kMostPeriodicRounds; ++round) {
    try {
      Graph<2> divided = rounds.graph();
      Mesh<2> mesh = box_mesh(divided, same, report, control, refinement);
      if (rounds.agree(mesh)) {
        return std::move(rounds).result(std::move(mesh), std::move(divided), round);
      }
      rounds.divide();
    } catch (const Error& error) {
      throw rounds.told(error);
    }
  }
  throw Error(ErrorCode::too_many, "periodic sides differ after " +
                                       std::to_string(kMostPeriodicRounds) +
                                       " meshes: what is beside them does not let them agree");
}

DomainMesh<2> periodic_domain_mesh(PeriodicBox box, Extent extent) {
  DomainMesh<2> made = domain_mesh(std::move(box.mesh), box.graph, extent);
  MeshFeatures& features = made.mesh.features;
  for (std::size_t v = 0; v < features.origins.size(); ++v) {
    const auto point = features.origins[v].point();
    const auto got = point ? box.points.find(*point) : box.points.end();
    if (got == box.points.end()) continue;
    features.origins[v] = got->second;
    made.mesh.kinds[v] = VertexKind::segment;
  }
  for (const PeriodicBox::Twins& twins : box.sides) {
    PeriodicSides sides{twins.markers.from, twins.markers.to, position_of(twins.translation), {}};
    for (const auto& [p, q] : twins.points) {
      const auto a = find_vertex(made.mesh, p), b = find_vertex(made.mesh, q);
      if (a && b) sides.vertices.push_back({*a, *b});  // else not kept
    }
    features.periodic.push_back(std::move(sides));
  }
  return made;
}

PeriodicMesh periodic_mesh(const Graph<2>& graph, const std::vector<PeriodicMarkers>& pairs,
                           const Options<2>& options, const RunControl& control) {
  PeriodicMesh made;
  PeriodicBox box = periodic_box_mesh(graph, pairs, options, &made.report, control);
  made.rounds = box.rounds;
  static_cast<DomainMesh<2>&>(made) = periodic_domain_mesh(std::move(box), options.extent);
  return made;
}

}  // namespace mesher
