// Random planar straight-line graphs and edits of them: the naive twin of a mesher's input.
//
// An edit that would make an invalid input (segments that cross, a point on a segment, a point in
// use that goes) is passed over, decided by exact tests against all features.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "facade/mesh_statically.hpp"
#include "geometry/grid.hpp"
#include "geometry/segment_tests.hpp"
#include "mesher/mesher.hpp"
#include "traced_world.hpp"

namespace support {

/// Points and segments by id.
struct Pslg {
  using Ends = std::pair<std::int64_t, std::int64_t>;
  std::map<std::int64_t, mesher::Point<2>> points;
  std::map<Ends, std::int64_t> segments;  // first < second; the id

  [[nodiscard]] bool in_use(std::int64_t id) const {
    for (const auto& [ends, line] : segments) {
      if (ends.first == id || ends.second == id) return true;
    }
    return false;
  }
  [[nodiscard]] bool accepts(const mesher::Point<2>& p,
                             const mesher::detail::MeshBox<2>& box) const {
    for (const auto& [id, q] : points) {
      if (box.fixed(p) == box.fixed(q)) return false;
    }
    for (const auto& [ends, line] : segments) {
      if (mesher::detail::on_segment(p, points.at(ends.first), points.at(ends.second)))
        return false;
    }
    return true;
  }
  [[nodiscard]] bool accepts(Ends ends) const {
    if (ends.first >= ends.second || segments.contains(ends)) return false;
    const auto& a = points.at(ends.first);
    const auto& b = points.at(ends.second);
    for (const auto& [id, p] : points) {
      if (id == ends.first || id == ends.second) continue;
      if (mesher::detail::on_segment(p, a, b)) return false;
    }
    for (const auto& [other, line] : segments) {
      const auto& c = points.at(other.first);
      const auto& d = points.at(other.second);
      const bool shares = other.first == ends.first || other.first == ends.second ||
                          other.second == ends.first || other.second == ends.second;
      if (!shares && mesher::detail::segments_meet(a, b, c, d)) return false;
      if (shares && (inside(c, a, b) || inside(d, a, b) || inside(a, c, d) || inside(b, c, d))) {
        return false;
      }
    }
    return true;
  }

 private:
  static bool inside(const mesher::Point<2>& p, const mesher::Point<2>& a,
                     const mesher::Point<2>& b) {
    return p != a && p != b && mesher::detail::on_segment(p, a, b);
  }
};

/// Makes a Pslg, and edits it and a target alike.
/// Target: insert(id, p), remove(id), insert_segment(id, a, b), remove_segment(a, b).
class PslgEditor {
 public:
  enum class Family : std::uint8_t {
    uniform,
    lattice,  ///< points on an integer lattice, segments along its lines
    beside,   ///< points at 10^-1 to 10^-7 from segments
    fan,      ///< many segments at few points, at any angle
    wedge,    ///< segments of equal length at one point, at small angles
    steiner,  ///< segments with their middles on vertices of the mesh of the moment
    filled,   ///< on and about places at which a lattice of pitch 1 fills
  };

  PslgEditor(Family family, std::uint64_t seed) : family_(family), random_(seed) {}

  static mesher::Options<2> options() { return {.domain = {{0, 0}, {16, 16}}}; }

  /// The mesh of the moment, for Family::steiner.
  void look_at(const mesher::Mesh<2>& mesh) {
    free_.clear();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const bool free = mesh.kinds[i] == mesher::VertexKind::steiner;
      if (free && in_domain(mesh.vertices[i])) free_.push_back(mesh.vertices[i]);
    }
  }
  /// One random edit, if it is valid.
  template <class Target>
  void edit(Pslg& pslg, const mesher::detail::MeshBox<2>& box, Target& target) {
    if (family_ == Family::wedge && below(4) == 0) return add_leg(pslg, box, target);
    if (!free_.empty() && below(3) == 0) return add_across(pslg, box, target);
    switch (below(10)) {
      case 0:
      case 1:
      case 2:
        return add_point(pslg, box, target);
      case 3:
        return remove_point(pslg, target);
      case 4:
      case 5:
        return remove_segment(pslg, target);
      default:
        return add_segment(pslg, target);
    }
  }
  template <class Target>
  void add_point(Pslg& pslg, const mesher::detail::MeshBox<2>& box, Target& target) {
    const mesher::Point<2> p = place(pslg);
    if (!in_domain(p) || !pslg.accepts(p, box)) return;
    target.insert(mesher::PointId{next_}, p);
    pslg.points[next_++] = p;
  }
  /// A segment that is halved, if it is split, at a free vertex of the mesh.
  template <class Target>
  void add_across(Pslg& pslg, const mesher::detail::MeshBox<2>& box, Target& target) {
    const mesher::Point<2> middle = free_[below(free_.size())];
    const double angle = 7 * unit();
    const double length = std::pow(4, -3 * unit());
    const mesher::Point<2> half{length * std::cos(angle), length * std::sin(angle)};
    const mesher::Point<2> a{middle[0] - half[0], middle[1] - half[1]};
    const mesher::Point<2> b{middle[0] + half[0], middle[1] + half[1]};
    const std::int64_t id = next_;
    for (const auto& p : {a, b}) {
      if (!in_domain(p) || !pslg.accepts(p, box)) return;
      target.insert(mesher::PointId{next_}, p);
      pslg.points[next_++] = p;
    }
    add_segment({id, id + 1}, pslg, target);
  }
  /// A segment turned about its end, with its other end.
  template <class Target>
  void add_leg(Pslg& pslg, const mesher::detail::MeshBox<2>& box, Target& target) {
    if (pslg.segments.empty()) return add_segment(pslg, target);
    auto [apex, end] = some_segment(pslg);
    if (below(2) == 0) std::swap(apex, end);
    const auto& o = pslg.points.at(apex);
    const mesher::Point<2> leg{pslg.points.at(end)[0] - o[0], pslg.points.at(end)[1] - o[1]};
    const double angle = 0.35 * unit();
    const double c = std::cos(angle), d = std::sin(angle);
    const mesher::Point<2> p{o[0] + c * leg[0] - d * leg[1], o[1] + d * leg[0] + c * leg[1]};
    if (!in_domain(p) || !pslg.accepts(p, box)) return;
    const std::int64_t id = next_;
    target.insert(mesher::PointId{next_}, p);
    pslg.points[next_++] = p;
    add_segment({apex, id}, pslg, target);
  }
  template <class Target>
  void remove_point(Pslg& pslg, Target& target) {
    if (pslg.points.empty()) return;
    const std::int64_t id = some_point(pslg);
    if (pslg.in_use(id)) return;
    target.remove(mesher::PointId{id});
    pslg.points.erase(id);
  }
  template <class Target>
  void add_segment(Pslg& pslg, Target& target) {
    if (pslg.points.size() < 2) return;
    Pslg::Ends ends{some_point(pslg), some_point(pslg)};
    if (below(4) != 0) ends.second = near(pslg, ends.first);
    if (family_ == Family::fan && !pslg.segments.empty() && below(2) == 0) {
      ends.first = some_segment(pslg).first;
    }
    add_segment(ends, pslg, target);
  }
  template <class Target>
  void add_segment(Pslg::Ends ends, Pslg& pslg, Target& target) {
    if (ends.first > ends.second) std::swap(ends.first, ends.second);
    if (!pslg.accepts(ends)) return;
    target.insert_segment(mesher::LineId{next_}, mesher::PointId{ends.first},
                          mesher::PointId{ends.second});
    pslg.segments[ends] = next_++;
  }
  template <class Target>
  void remove_segment(Pslg& pslg, Target& target) {
    if (pslg.segments.empty()) return;
    const Pslg::Ends ends = some_segment(pslg);
    target.remove_segment(mesher::PointId{ends.first}, mesher::PointId{ends.second});
    pslg.segments.erase(ends);
  }

 private:
  std::uint64_t below(std::uint64_t n) { return random_() % n; }
  static bool in_domain(const mesher::Point<2>& p) {
    return p[0] >= 0 && p[0] <= 16 && p[1] >= 0 && p[1] <= 16;
  }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  mesher::Point<2> place(const Pslg& pslg) {
    if (family_ == Family::lattice) {
      return {static_cast<double>(below(17)), static_cast<double>(below(17))};
    }
    if (family_ == Family::filled) return beside_lattice();
    if (family_ == Family::beside && !pslg.segments.empty() && below(2) == 0) {
      const Pslg::Ends ends = some_segment(pslg);
      const auto& a = pslg.points.at(ends.first);
      const auto& b = pslg.points.at(ends.second);
      const double t = unit();
      const double d = std::pow(10, -1 - static_cast<double>(below(7))) * (below(2) == 0 ? 1 : -1);
      return {a[0] + t * (b[0] - a[0]) - d * (b[1] - a[1]),
              a[1] + t * (b[1] - a[1]) + d * (b[0] - a[0])};
    }
    return {16 * unit(), 16 * unit()};
  }
  // At a distance that matters to those who fill, or hardly less or more, or on the spot.
  mesher::Point<2> beside_lattice() {
    constexpr double kDistances[] = {0, 0x1p-30, 0.25, 0.5, 1.4, 3.2};
    const double row = static_cast<double>(below(19));
    const mesher::Point<2> q{static_cast<double>(below(17)) + std::fmod(row, 2) / 2, 0.875 * row};
    const double distance = kDistances[below(6)] * (1 + static_cast<double>(below(3)) * 0x1p-40);
    const double angle = below(2) == 0 ? 0 : 7 * unit();
    return {q[0] + distance * std::cos(angle), q[1] + distance * std::sin(angle)};
  }
  std::int64_t some_point(const Pslg& pslg) {
    return std::next(pslg.points.begin(), static_cast<std::ptrdiff_t>(below(pslg.points.size())))
        ->first;
  }
  Pslg::Ends some_segment(const Pslg& pslg) {
    return std::next(pslg.segments.begin(),
                     static_cast<std::ptrdiff_t>(below(pslg.segments.size())))
        ->first;
  }
  // One of the points near this one.
  std::int64_t near(const Pslg& pslg, std::int64_t id) {
    const auto& p = pslg.points.at(id);
    std::int64_t best = id;
    double least = 1e300;
    for (const auto& [other, q] : pslg.points) {
      const double d = std::hypot(q[0] - p[0], q[1] - p[1]) * (0.1 + unit());
      if (other != id && d < least) least = d, best = other;
    }
    return best;
  }

  Family family_;
  std::mt19937_64 random_;
  std::vector<mesher::Point<2>> free_;  // vertices
  std::int64_t next_ = 1;
};

/// Edits that were made elsewhere, to be made again.
class Recorded {
 public:
  void insert(mesher::PointId id, const mesher::Point<2>& p) {
    edits_.push_back([=](TracedWorld& t) { t.insert(id, p); });
  }
  void remove(mesher::PointId id) {
    edits_.push_back([=](TracedWorld& t) { t.remove(id); });
  }
  void insert_segment(mesher::LineId id, mesher::PointId a, mesher::PointId b) {
    edits_.push_back([=](TracedWorld& t) { t.insert_segment(id, a, b); });
  }
  void remove_segment(mesher::PointId a, mesher::PointId b) {
    edits_.push_back([=](TracedWorld& t) { t.remove_segment(a, b); });
  }
  void replay(TracedWorld& target) const {
    for (const auto& edit : edits_) edit(target);
  }

 private:
  std::vector<std::function<void(TracedWorld&)>> edits_;
};

/// The mesh of a run from scratch. Throws: also Error(cancelled), if it takes more than `most`
/// calls.
[[nodiscard]] inline mesher::Mesh<2> static_mesh(const Pslg& pslg,
                                                 const mesher::Options<2>& options,
                                                 std::uint64_t most = ~std::uint64_t{0}) {
  std::vector<mesher::Point<2>> points;
  std::vector<mesher::PointId> ids;
  std::vector<mesher::Segment> segments;
  for (const auto& [id, p] : pslg.points) {
    points.push_back(p);
    ids.push_back(mesher::PointId{id});
  }
  for (const auto& [ends, id] : pslg.segments) {
    segments.push_back(
        {mesher::LineId{id}, mesher::PointId{ends.first}, mesher::PointId{ends.second}});
  }
  mesher::RunControl control;
  control.progress = [most](const mesher::Progress& p) { return p.done < most; };
  return mesher::mesh_statically(points, segments, options, ids, nullptr, control);
}

}  // namespace support
