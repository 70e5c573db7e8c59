// Edits of points, lines and polygons from several processes, and the same of one mesher: at every
// step the mesh, the change and the errors are those of one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "joint_case.hpp"
#include "mesher/extra/generate.hpp"

namespace support {

/// `M`: a mesher of several processes. All of them do the same with one, which they have as well,
/// but each announces only what is its own: by the id, so that edits of one id keep their order.
template <int D, class M>
class JointTwin {
 public:
  JointTwin(M& joint, std::size_t self, std::size_t size)
      : joint_(joint), one_(alone(joint.options())), self_(self), size_(size) {}

  void insert(mesher::PointId id, const mesher::Point<D>& p) {
    both(id, [&](auto& m) { m.insert(id, p); });
  }
  void remove(mesher::PointId id) {
    both(id, [&](auto& m) { m.remove(id); });
  }
  void move(mesher::PointId id, const mesher::Point<D>& p) {
    both(id, [&](auto& m) { m.move(id, p); });
  }
  void insert_segment(mesher::LineId id, mesher::PointId a, mesher::PointId b) {
    both(id, [&](auto& m) { m.insert_segment(id, a, b); });
  }
  void insert_polyline(mesher::LineId id, const std::vector<mesher::PointId>& points) {
    both(id, [&](auto& m) { m.insert_polyline(id, points); });
  }
  void remove_line(mesher::LineId id) {
    both(id, [&](auto& m) { m.remove_line(id); });
  }
  void insert_polygon(const mesher::Polygon& polygon) {
    both(polygon.id, [&](auto& m) { m.insert_polygon(polygon); });
  }
  void remove_polygon(mesher::PolygonId id) {
    both(id, [&](auto& m) { m.remove_polygon(id); });
  }
  void limit(const mesher::SizeLimits<D>& limits) {
    both(mesher::PointId{0}, [&](auto& m) { m.limit(limits); });
  }
  void limit(const mesher::Box<D>& box, const mesher::SizeLimits<D>& limits) {
    both(mesher::PointId{0}, [&](auto& m) { m.limit(box, limits); });
  }
  void discard_edits() { joint_.discard_edits(), one_.discard_edits(); }

  /// Throws: the error of both.
  void update() {
    std::optional<mesher::Error> error;
    mesher::Change<D> expected, change;
    const auto said_of = [&](auto&& act) {
      return said_by([&] {
        try {
          act();
        } catch (const mesher::Error& e) {
          error = e;
          throw;
        }
      });
    };
    const std::string refused = said_of([&] { expected = one_.update(); });
    const std::string refused_too = said_of([&] { change = joint_.update(); });
    demand(refused_too == refused, "\"" + refused_too + "\" is not \"" + refused + "\"");
    if (error) throw *error;
    demand(change.vertices_added == expected.vertices_added, "vertices added");
    demand(change.kinds_added == expected.kinds_added, "kinds added");
    demand(change.vertices_removed == expected.vertices_removed, "vertices removed");
    demand(change.kinds_changed == expected.kinds_changed, "kinds changed");
    demand(change.simplices_added == expected.simplices_added, "simplices added");
    demand(change.simplices_removed == expected.simplices_removed, "simplices removed");
    demand(change.edges_added == expected.edges_added, "edges added");
    demand(change.edges_removed == expected.edges_removed, "edges removed");
    demand(change.faces_added == expected.faces_added, "faces added");
    demand(change.faces_removed == expected.faces_removed, "faces removed");
    demand(change.angles == expected.angles, "angles");
    demand(change.guard == expected.guard, "the guard");
    check();
  }

  /// The mesh is that of one, and so are the parts.
  void check() {
    const mesher::Mesh<D> whole = one_.mesh();
    demand(joint_.gather(0) == (self_ == 0 ? whole : mesher::Mesh<D>()), "the mesh");
    check_part(joint_.own_mesh(), whole, "an update");
    const mesher::MeshStats stats = joint_.stats(), expected = one_.stats();
    demand(stats.vertices == expected.vertices, "number of vertices");
    demand(stats.simplices == expected.simplices, "number of simplices");
    const auto points = joint_.gather_points(0);
    demand(points == (self_ == 0 ? one_.points() : std::vector<mesher::GraphPoint<D>>()), "points");
    demand(joint_.lines() == one_.lines(), "lines");
    demand(joint_.polygons() == one_.polygons(), "polygons");
    joint_.check_invariants();
    const std::string fault = joint_.certificate();
    demand(fault.empty(), "the certificate: " + fault);
  }

  [[nodiscard]] mesher::BoxMesher<D>& one() { return one_; }
  [[nodiscard]] M& joint() { return joint_; }

 private:
  static mesher::Options<D> alone(mesher::Options<D> options) {
    options.threads = 1;
    return options;
  }
  // What one refuses at once nobody announces.
  template <class Id, class Edit>
  void both(Id id, Edit&& edit) {
    edit(one_);
    if (static_cast<std::size_t>(id) * 7 % size_ == self_) edit(joint_);
  }

  M& joint_;
  mesher::BoxMesher<D> one_;
  std::size_t self_, size_;
};

/// A random edit of points and lines in the unit square.
template <class Twin>
class JointLines {
 public:
  JointLines(Twin& twin, std::uint64_t seed) : twin_(twin), random_(seed) {}

  void insert(const mesher::Graph<2>& graph) {
    for (const auto& p : graph.points) twin_.insert(p.id, p.at), next_ = std::max(next_, after(p));
    for (const auto& s : graph.segments) {
      twin_.insert_segment(s.id, s.from, s.to), next_ = std::max(next_, after(s));
    }
    for (const auto& l : graph.polylines) {
      twin_.insert_polyline(l.id, l.points), next_ = std::max(next_, after(l));
    }
  }
  void edit() {
    try {
      edit_any();
    } catch (const mesher::Error&) {  // refused at once
    }
  }
  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return random_.below(n); }

 private:
  using Point = mesher::Point<2>;
  template <class Part>
  static std::int64_t after(const Part& part) {
    return static_cast<std::int64_t>(part.id) + 1;
  }
  void edit_any() {
    const auto points = twin_.one().points();
    const auto lines = twin_.one().lines();
    const auto any = [&](const auto& all) { return all[below(all.size())].id; };
    const double step = below(2) == 0 ? 0.02 : 0.2;
    const auto near = [&](Point p) {
      for (double& x : p) x = std::clamp(x + step * (random_.unit() - 0.5), 0.0, 1.0);
      return p;
    };
    switch (below(8)) {
      case 0:
        if (!points.empty()) twin_.remove(any(points));
        break;
      case 1:
      case 2:
        if (!lines.empty()) twin_.remove_line(any(lines));
        break;
      case 3:
        if (!points.empty()) {
          const auto& p = points[below(points.size())];
          twin_.move(p.id, near(p.at));
        }
        break;
      case 4:
        twin_.insert(fresh(), {random_.unit(), random_.unit()});
        break;
      case 5:
        if (points.size() > 1) twin_.insert_segment(fresh(), any(points), any(points));
        break;
      default: {
        const Point p{random_.unit(), random_.unit()};
        const mesher::PointId a = fresh(), b = fresh();
        twin_.insert(a, p), twin_.insert(b, near(p));
        twin_.insert_segment(fresh(), a, b);
      }
    }
  }
  AnyId fresh() { return AnyId{next_++}; }

  Twin& twin_;
  mesher::SplitMix64 random_;
  std::int64_t next_ = 1;
};

}  // namespace support
