// Edits from several processes: at every step the mesh, and the change, are those of one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "code_of.hpp"
#include "facade/box_mesher.hpp"
#include "facade/mesh_statically.hpp"
#include "mesher/extra/generate.hpp"
#include "sizes/sampled_sizes.hpp"

namespace support {

/// Throws: std::logic_error with the text, unless `holds`. (Of threads and processes, to whom the
/// test framework does not listen.)
inline void demand(bool holds, const std::string& text) {
  if (!holds) throw std::logic_error(text);
}

/// What the Error says that act() throws; nothing if it throws none.
template <class Act>
std::string said_by(Act&& act) {
  try {
    act();
  } catch (const mesher::Error& e) {
    std::string text = std::string(mesher::code_name(e.code())) + ": " + e.what();
    for (const auto& f : e.features()) text += "; " + mesher::text_of(f);
    return text;
  }
  return {};
}

/// The vertices of a part are vertices of the whole mesh, of the same kinds.
template <int D>
void check_part(const mesher::Mesh<D>& own, const mesher::Mesh<D>& whole, const std::string& when) {
  for (std::size_t i = 0; i < own.vertices.size(); ++i) {
    const auto at = std::lower_bound(whole.vertices.begin(), whole.vertices.end(), own.vertices[i]);
    demand(at != whole.vertices.end() && *at == own.vertices[i], when + ": a vertex of a part");
    const auto index = static_cast<std::size_t>(at - whole.vertices.begin());
    demand(whole.kinds[index] == own.kinds[i], when + ": the kind of a vertex of a part");
  }
}

template <int D>
mesher::Options<D> joint_options(const std::vector<mesher::Point<D>>& points, int threads = 1) {
  mesher::Options<D> options;
  options.domain = mesher::snapped_domain<D>(points);
  options.threads = threads;
  return options;
}

/// `M`: a mesher of several processes. All of them do the same with one, which they have as well,
/// but each announces only what is its own.
template <int D, class M>
class JointCase {
 public:
  JointCase(M& joint, std::size_t self, std::size_t size,
            const std::vector<mesher::Point<D>>& points, std::uint64_t seed)
      : joint_(joint), one_(alone(joint.options())), self_(self), size_(size), random_(~seed) {
    for (const auto& p : points) edit(next_++, p);
    update("the first run");
  }

  void run(int steps) {
    for (int step = 0; step < steps; ++step) {
      const std::uint64_t edits = 1 + random_.below(5);
      for (std::uint64_t i = 0; i < edits; ++i) edit_any();
      update("step " + std::to_string(step));
    }
    check_statically();
  }

  /// Another process announces: the same id once an update.
  void edit(std::int64_t number, const std::optional<mesher::Point<D>>& to) { edits_[number] = to; }
  /// Everywhere, or in a box; announced by all if there is a function.
  void limit(const std::optional<mesher::Box<D>>& box, const mesher::SizeLimits<D>& limits) {
    limits_.push_back({box, limits});
  }
  void edit_any() {
    const std::uint64_t what = random_.below(4);
    const auto any = any_id();
    if (any && what == 0) edit(*any, std::nullopt);
    if (any && what == 1) edit(*any, near(points_.at(*any), random_.below(2) ? 1e-6 : 0.1));
    if (!any || what > 1) edit(next_++, any_place());
  }

  /// Whether it was done; both refuse in the same words.
  bool update(const std::string& when) {
    announce_limits();
    for (const auto& edit : edits_) {
      const std::int64_t number = edit.first;
      const auto announce = [&, id = mesher::PointId{number}, to = edit.second](auto& mesher) {
        const bool was = points_.count(number) != 0;
        if (was && to) mesher.move(id, *to);
        if (was && !to) mesher.remove(id);
        if (!was && to) mesher.insert(id, *to);
      };
      announce(one_);
      if (static_cast<std::size_t>(number) * 7 % size_ == self_) announce(joint_);
    }
    const auto edits = std::exchange(edits_, {});
    mesher::Change<D> expected, change;
    const std::string refused = said_by([&] { expected = one_.update(); });
    const std::string refused_too = said_by([&] { change = joint_.update(); });
    demand(refused_too == refused, when + ": \"" + refused_too + "\" is not \"" + refused + "\"");
    for (const auto& [number, to] : edits) {
      if (to && refused.empty()) points_[number] = *to;
      if (!to && refused.empty()) points_.erase(number);
    }
    demand(change.vertices_added == expected.vertices_added, when + ": vertices added");
    demand(change.kinds_added == expected.kinds_added, when + ": kinds added");
    demand(change.vertices_removed == expected.vertices_removed, when + ": vertices removed");
    demand(change.kinds_changed == expected.kinds_changed, when + ": kinds changed");
    demand(change.simplices_added == expected.simplices_added, when + ": simplices added");
    demand(change.simplices_removed == expected.simplices_removed, when + ": simplices removed");
    check(when);
    return refused.empty();
  }

  /// The mesh is that of one, and so are the parts.
  void check(const std::string& when) {
    const mesher::Mesh<D> whole = one_.mesh();
    const mesher::Mesh<D> gathered = joint_.gather();
    demand(gathered == (self_ == 0 ? whole : mesher::Mesh<D>()), when + ": the mesh");
    check_part(joint_.own_mesh(), whole, when);
    const mesher::MeshStats stats = joint_.stats(), expected = one_.stats();
    demand(stats.vertices == expected.vertices, when + ": number of vertices");
    demand(stats.simplices == expected.simplices, when + ": number of simplices");
    joint_.check_invariants();
    const std::string fault = joint_.certificate();
    demand(fault.empty(), when + ": the certificate: " + fault);
  }

  void check_statically() {
    mesher::Options<D> options = joint_.options();
    options.threads = 1;
    std::vector<mesher::Point<D>> places;
    for (const auto& [number, p] : points_) places.push_back(p);
    demand(one_.mesh() == mesher::mesh_statically<D>(places, options), "statically");
  }

  [[nodiscard]] mesher::BoxMesher<D>& one() { return one_; }
  [[nodiscard]] const std::map<std::int64_t, mesher::Point<D>>& points() const { return points_; }

 private:
  struct Limits {
    std::optional<mesher::Box<D>> box;
    mesher::SizeLimits<D> limits;
  };

  // Some process announces all that are no functions: their order is that of one.
  void announce_limits() {
    const std::uint64_t some = random_.below(size_);
    for (const auto& [box, limits] : std::exchange(limits_, {})) {
      const auto announce = [&, b = box, l = limits](auto& m) { b ? m.limit(*b, l) : m.limit(l); };
      announce(one_);
      const bool is_function =
          limits.sizes != nullptr && mesher::detail::samples_of<D>(*limits.sizes) == nullptr;
      if (is_function || some == self_) announce(joint_);
    }
  }
  static mesher::Options<D> alone(mesher::Options<D> options) {
    options.threads = 1;
    return options;
  }
  std::optional<std::int64_t> any_id() {
    if (points_.empty()) return std::nullopt;
    return std::next(points_.begin(), static_cast<std::ptrdiff_t>(random_.below(points_.size())))
        ->first;
  }
  mesher::Point<D> any_place() {
    const auto& domain = one_.options().domain;
    mesher::Point<D> p;
    for (std::size_t i = 0; i < D; ++i) {
      p[i] = domain.lo[i] + random_.unit() * (domain.hi[i] - domain.lo[i]);
    }
    return p;
  }
  mesher::Point<D> near(mesher::Point<D> p, double by) {
    const auto& domain = one_.options().domain;
    for (std::size_t i = 0; i < D; ++i) {
      p[i] += by * (2 * random_.unit() - 1);
      if (p[i] < domain.lo[i] || p[i] > domain.hi[i]) return any_place();
    }
    return p;
  }

  M& joint_;
  mesher::BoxMesher<D> one_;
  std::size_t self_, size_;
  mesher::SplitMix64 random_;
  std::int64_t next_ = 1;
  std::map<std::int64_t, mesher::Point<D>> points_;
  std::map<std::int64_t, std::optional<mesher::Point<D>>> edits_;
  std::vector<Limits> limits_;
};

/// An update that one process spoils leaves the mesh in all, and the next one works.
template <class M>
void check_failures(M& joint, std::size_t self, std::size_t size) {
  using mesher::ErrorCode;
  using mesher::PointId;
  const std::size_t last = size - 1;
  const auto points = mesher::generate_points<2>(mesher::PointKind::uniform, 400, 4);
  JointCase<2, M> both(joint, self, size, points, 9);
  const auto update = [&] { static_cast<void>(joint.update()); };
  const auto refused = [&](ErrorCode code, const std::string& why) {
    demand(code_of(update) == code, why);
    both.check(why);
  };
  if (self == last) joint.insert(PointId{1000}, {100, 100});
  if (self == 0) joint.remove(PointId{1});
  refused(ErrorCode::outside_domain, "a point outside the domain");
  if (self == last) joint.remove(PointId{1000});
  refused(ErrorCode::unknown_id, "a point that is not there");
  joint.insert(PointId{1000}, {0.5, 0.5});
  if (size > 1) refused(ErrorCode::repeated_id, "a point of all");
  joint.discard_edits();
  if (self == 0) joint.insert(PointId{1000}, points[0]);
  if (self == last) joint.insert(PointId{1001}, points[1]);
  refused(ErrorCode::duplicate_point, "points on others");
  // One that is stopped: the edits stay.
  for (int after = 0; after < 40; after = 2 * after + 1) {
    if (self == 0) {
      for (std::int64_t i = 1; i <= 300; ++i)
        joint.move(PointId{i}, {points[static_cast<std::size_t>(i - 1)][0] * 0.99,
                                points[static_cast<std::size_t>(i - 1)][1]});
    }
    int asked = 0;
    mesher::RunControl control;
    if (self == last) control.progress = [&](const mesher::Progress&) { return asked++ < after; };
    const auto code = code_of([&] { static_cast<void>(joint.update(control)); });
    if (!code) break;
    demand(code == ErrorCode::cancelled, "cancelled");
    joint.discard_edits();
    both.check("cancelled after " + std::to_string(after));
  }
}

/// Points of different processes swap their places, and one comes where another goes.
template <class M>
void check_places(M& joint, std::size_t self, std::size_t size) {
  const auto points = mesher::generate_points<2>(mesher::PointKind::uniform, 100, 5);
  JointCase<2, M> both(joint, self, size, points, 2);
  both.edit(1, points[1]), both.edit(2, points[0]);
  both.update("two points swap");
  for (std::int64_t i = 0; i < 6; ++i) {
    both.edit(10 + i, std::nullopt);
    both.edit(1000 + i, points[static_cast<std::size_t>(9 + i)]);
  }
  both.update("points come where others go");
}

/// Who is told of a change. `Told`: the mesher's own.
template <class Told, class M>
void check_told(M& joint, std::size_t self, std::size_t size) {
  const auto points = mesher::generate_points<2>(mesher::PointKind::uniform, 200, 5);
  mesher::BoxMesher<2> one(joint_options<2>(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (self == size - 1) joint.insert(mesher::PointId(i + 1), points[i]);
    one.insert(mesher::PointId(i + 1), points[i]);
  }
  one.update();
  const auto own = joint.update({}, Told::own);
  const mesher::Mesh<2> part = joint.own_mesh();
  demand(own.simplices_added.size() == part.simplices.size(), "the simplices of a part");
  demand(own.vertices_added.size() <= part.vertices.size(), "the vertices of a part");
  if (self == 0) joint.move(mesher::PointId{1}, {0.5, 0.5});
  one.move(mesher::PointId{1}, {0.5, 0.5});
  const auto expected = one.update();
  const auto change = joint.update({}, Told::first);
  using Simplices = decltype(expected.simplices_added);
  demand(change.simplices_added == (self == 0 ? expected.simplices_added : Simplices()),
         "what the first is told");
  demand(joint.gather(static_cast<int>(size) - 1) ==
             (self == size - 1 ? one.mesh() : mesher::Mesh<2>()),
         "the mesh in the last");
}

/// No more vertices than allowed.
template <class M>
void check_too_many(M& joint, std::size_t self, std::size_t size,
                    const std::vector<mesher::Point<2>>& points) {
  using mesher::ErrorCode;
  using mesher::PointId;
  JointCase<2, M> both(joint, self, size, points, 9);
  for (int i = 0; i < 2; ++i) {
    if (self == size - 1) joint.insert(PointId{1000}, {points[0][0] + 1e-5, points[0][1]});
    demand(code_of([&] { static_cast<void>(joint.update()); }) == ErrorCode::too_many,
           "too many vertices");
    both.check("too many vertices");
  }
  for (int i = 1; i <= 20; ++i) both.edit(i, std::nullopt);
  both.update("after too many vertices");
}

}  // namespace support
