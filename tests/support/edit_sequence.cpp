// Making, applying, checking and shrinking sequences of edits.
#include "edit_sequence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "facade/box_mesher.hpp"
#include "facade/mesh_statically.hpp"

namespace support {

using mesher::BoxMesher;
using mesher::ErrorCode;
using mesher::Mesh;
using mesher::PointId;
using mesher::PointKind;
using mesher::SplitMix64;
using mesher::VertexKind;
using Kind = Edit::Kind;
using Corners = std::array<Point<2>, 3>;

const char* name(Family family) {
  switch (family) {
    case Family::uniform:
      return "uniform";
    case Family::gaussian:
      return "gaussian";
    case Family::clustered:
      return "clustered";
    case Family::lattice:
      return "lattice";
    case Family::collinear:
      return "collinear";
    case Family::spiral:
      return "spiral";
    case Family::spread:
      return "spread";
    case Family::borders:
      return "borders";
    case Family::steiner:
      return "steiner";
    case Family::far:
      return "far";
  }
  return "?";
}

mesher::Box<2> domain(Family family) {
  switch (family) {
    case Family::lattice:
      return {{0, 0}, {16, 16}};
    case Family::gaussian:
      return {{-8, -8}, {8, 8}};
    case Family::spiral:
      return {{-9, -9}, {9, 9}};
    case Family::borders:
      return {{-1, -0.5}, {1, 0.75}};
    case Family::far:
      return {{1048576, -3}, {1048577, -2.25}};
    default:
      return {{0, 0}, {1, 1}};
  }
}

// --- Random edits ----------------------------------------------------------------------------

namespace {

class Source {
 public:
  Source(Family family, const mesher::Options<2>& options, std::uint64_t seed)
      : family_(family), options_(options), random_(seed) {
    const auto pool = [&](PointKind kind) { pool_ = mesher::generate_points<2>(kind, 400, seed); };
    if (family == Family::gaussian) pool(PointKind::gaussian);
    if (family == Family::clustered) pool(PointKind::clusters);
    if (family == Family::spiral) pool(PointKind::spiral);
  }

  SplitMix64& random() { return random_; }
  int below(int n) { return static_cast<int>(random_.below(static_cast<std::uint64_t>(n))); }

  /// A point that suits the family; `points` are there already.
  Point<2> point(const PointSet& points) {
    Point<2> p = raw(points);
    for (int i = 0; i < 2; ++i) {
      p[i] = std::clamp(p[i], options_.domain.lo[i], options_.domain.hi[i]);
      if (std::abs(p[i]) < 0x1p-100) p[i] = 0;
    }
    return p;
  }

 private:
  Point<2> unit() { return {random_.unit(), random_.unit()}; }
  const Point<2>& any(const PointSet& points) {
    return std::next(points.begin(), below(static_cast<int>(points.size())))->second;
  }

  Point<2> raw(const PointSet& points) {
    const auto& box = options_.domain;
    switch (family_) {
      case Family::gaussian:
      case Family::clustered:
      case Family::spiral:
        return pool_[random_.below(pool_.size())];
      case Family::lattice:
        return {static_cast<double>(below(17)), static_cast<double>(below(17))};
      case Family::collinear: {
        const double t = below(3) == 0 ? random_.unit() : below(33) / 32.0;
        return below(3) == 0   ? Point<2>{t, 0.5}
               : below(2) == 0 ? Point<2>{0.25, t}
                               : Point<2>{t, 0.125 + t / 2};
      }
      case Family::spread: {
        if (points.empty() || below(4) == 0) return unit();
        const Point<2> p = any(points);
        const double d = std::pow(10.0, -1 - 11 * random_.unit());
        const double angle = 6.25 * random_.unit();
        return {p[0] + d * std::cos(angle), p[1] + d * std::sin(angle)};
      }
      case Family::borders: {
        Point<2> p;
        for (int i = 0; i < 2; ++i) {
          const int which = below(8);
          p[i] = which == 0 ? box.lo[i] : which == 1 ? box.hi[i] : (below(65) - 32) / 32.0;
          if (which == 2) p[i] = std::nextafter(p[i], 2 * below(2) - 1);
          if (which == 3) p[i] += std::ldexp(below(9) - 4, -30 - below(18));
          if (which == 4) p[i] = -p[i] * 0;  // zero of either sign
        }
        return p;
      }
      case Family::steiner: {
        if (points.empty() || below(3) == 0) return unit();
        const auto mesh = static_mesh(points, options_);
        for (int tries = 0; tries < 20; ++tries) {
          const auto& p = mesh.vertices[random_.below(mesh.vertices.size())];
          if (p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1) return p;
        }
        return unit();
      }
      default: {
        const Point<2> u = unit();
        return {box.lo[0] + u[0] * (box.hi[0] - box.lo[0]),
                box.lo[1] + u[1] * (box.hi[1] - box.lo[1])};
      }
    }
  }

  Family family_;
  mesher::Options<2> options_;
  SplitMix64 random_;
  std::vector<Point<2>> pool_;
};

class Writer {
 public:
  Writer(Family family, const mesher::Options<2>& options, std::uint64_t seed)
      : source_(family, options, seed) {}

  Step inserts(int n) {
    Step step;
    for (int i = 0; i < n; ++i) add(step, {Kind::insert, next_id_++, source_.point(points_)});
    return step;
  }
  Step removal_of_all() {
    Step step;
    while (!points_.empty()) add(step, {Kind::remove, points_.begin()->first, {}});
    return step;
  }
  Step random_step() {
    Step step;
    const int size = source_.below(5) == 0 ? 2 + source_.below(6) : 1;
    for (int i = 0; i < size; ++i) add_random(step);
    return step;
  }

 private:
  void add(Step& step, Edit edit) {
    if (perform(edit, points_)) step.push_back(edit);
  }
  void add_random(Step& step) {
    const int what = source_.below(100);
    if (points_.empty() || what < 38) {
      add(step, {Kind::insert, next_id_++, source_.point(points_)});
      return;
    }
    const auto any = std::next(points_.begin(), source_.below(static_cast<int>(points_.size())));
    const auto [id, p] = *any;
    if (what < 70) {
      add(step, {Kind::remove, id, {}});
      if (what < 48) add(step, {Kind::insert, what < 43 ? id : next_id_++, p});  // and again
      if (what >= 60) gone_.push_back(p);
    } else if (what < 78 && !gone_.empty()) {  // where there was a point in former times
      add(step, {Kind::insert, next_id_++, gone_.back()});
      gone_.pop_back();
    } else if (what < 82) {  // there and back
      add(step, {Kind::move, id, source_.point(points_)});
      add(step, {Kind::move, id, p});
    } else {
      add(step, {Kind::move, id, source_.point(points_)});
    }
  }

  Source source_;
  PointSet points_;
  std::vector<Point<2>> gone_;
  std::int64_t next_id_ = 1;
};

}  // namespace

Sequence random_sequence(Family family, mesher::Options<2> options, int n, int edits,
                         std::uint64_t seed) {
  options.domain = domain(family);
  Writer writer(family, options, seed);
  Sequence sequence{options, {writer.inserts(n)}, seed};
  for (int i = 0; i < edits; ++i) {
    if (i == edits / 2) {
      sequence.steps.push_back(writer.removal_of_all());
    } else if (i == edits / 2 + 2) {
      sequence.steps.push_back(writer.inserts(n / 2));
    } else {
      sequence.steps.push_back(writer.random_step());
    }
  }
  return sequence;
}

std::string describe(const Sequence& sequence) {
  char text[160];
  const auto& o = sequence.options;
  std::snprintf(text, sizeof text, "seed %llu, domain %a %a %a %a, rho %.17g, rule %d\n",
                static_cast<unsigned long long>(sequence.seed), o.domain.lo[0], o.domain.lo[1],
                o.domain.hi[0], o.domain.hi[1], o.rho, static_cast<int>(o.rule));
  std::string all = text;
  for (const Step& step : sequence.steps) {
    for (const Edit& e : step) {
      const auto id = static_cast<long long>(e.id);
      if (e.kind == Kind::remove) {
        std::snprintf(text, sizeof text, "-%lld; ", id);
      } else {
        std::snprintf(text, sizeof text, "%s%lld %a %a; ", e.kind == Kind::move ? "move " : "+", id,
                      e.point[0], e.point[1]);
      }
      all += text;
    }
    all += "update\n";
  }
  return all;
}

bool perform(const Edit& edit, PointSet& points) {
  const bool there = points.contains(edit.id);
  if (there == (edit.kind == Kind::insert)) return false;
  if (edit.kind == Kind::remove) {
    points.erase(edit.id);
    return true;
  }
  for (const auto& [id, p] : points) {
    if (p == edit.point && id != edit.id) return false;
  }
  points[edit.id] = edit.point;
  return true;
}

Mesh<2> static_mesh(const PointSet& points, const mesher::Options<2>& options) {
  std::vector<Point<2>> list;
  for (const auto& entry : points) list.push_back(entry.second);
  return mesher::mesh_statically<2>(list, options);
}

// --- Checking --------------------------------------------------------------------------------

namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

// Sorted lists of what a mesh consists of.
struct Parts {
  std::set<Point<2>> vertices;
  std::set<Corners> simplices;
  friend bool operator==(const Parts&, const Parts&) = default;
};

Parts parts_of(const Mesh<2>& mesh) {
  Parts parts{{mesh.vertices.begin(), mesh.vertices.end()}, {}};
  for (const auto& s : mesh.simplices) {
    parts.simplices.insert({mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]]});
  }
  return parts;
}

template <class T>
void apply_difference(const std::vector<T>& added, const std::vector<T>& removed,
                      std::set<T>& all) {
  require(std::is_sorted(added.begin(), added.end()), "change: added is not sorted");
  require(std::is_sorted(removed.begin(), removed.end()), "change: removed is not sorted");
  for (const T& x : removed) require(all.erase(x) == 1, "change: removes what is not there");
  for (const T& x : removed) {
    require(!std::binary_search(added.begin(), added.end(), x), "change: both added and removed");
  }
  for (const T& x : added) require(all.insert(x).second, "change: adds what is there");
}

bool same_bits(const Point<2>& a, const Point<2>& b) {
  return std::bit_cast<std::array<std::uint64_t, 2>>(a) ==
         std::bit_cast<std::array<std::uint64_t, 2>>(b);
}

void compare(const Mesh<2>& mesh, const Mesh<2>& other, const std::string& whose) {
  const std::string counts = std::to_string(mesh.vertices.size()) + " vertices, " + whose + " " +
                             std::to_string(other.vertices.size());
  require(mesh.vertices == other.vertices, "vertices differ: " + counts);
  require(mesh.kinds == other.kinds, "kinds differ from " + whose);
  require(mesh.simplices == other.simplices, "triangles differ from " + whose);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    require(same_bits(mesh.vertices[i], other.vertices[i]), "bits differ from " + whose);
  }
}

void check_input(const Mesh<2>& mesh, const PointSet& points) {
  std::size_t inputs = 0;
  for (const VertexKind kind : mesh.kinds) inputs += kind == VertexKind::input;
  require(inputs == points.size(), "another number of input vertices");
  for (const auto& [id, point] : points) {
    const auto it = std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), point);
    require(it != mesh.vertices.end() && same_bits(*it, unsigned_zero(point)),
            "point " + std::to_string(id) + " is no vertex");
    const auto i = static_cast<std::size_t>(it - mesh.vertices.begin());
    require(mesh.kinds[i] == VertexKind::input, "an input vertex is called another kind");
  }
}

void check_counts(const mesher::Change<2>& change, const BoxMesher<2>& m, const Mesh<2>& mesh) {
  // A point inserted and removed in one batch makes a call that never runs.
  require(change.calls.executed + change.calls.discarded >= change.calls.created,
          "created calls were neither executed nor discarded");
  const auto stats = m.stats();
  require(stats.vertices == mesh.vertices.size(), "stats: vertices");
  require(stats.simplices == mesh.simplices.size(), "stats: simplices");
  require(stats.calls >= mesh.vertices.size() && stats.edges >= mesh.vertices.size(),
          "stats: too few calls");
}

// The vertices that are there before and after, with another kind.
std::vector<mesher::KindChange<2>> kind_changes(const Mesh<2>& before, const Mesh<2>& after) {
  std::vector<mesher::KindChange<2>> changes;
  for (std::size_t i = 0; i < after.vertices.size(); ++i) {
    const Point<2>& p = after.vertices[i];
    const auto it = std::lower_bound(before.vertices.begin(), before.vertices.end(), p);
    if (it == before.vertices.end() || *it != p) continue;
    const VertexKind kind = before.kinds[static_cast<std::size_t>(it - before.vertices.begin())];
    if (kind != after.kinds[i]) changes.push_back({p, kind, after.kinds[i]});
  }
  return changes;
}

// Announces a step; where points have moved too near to others the step is taken back.
std::optional<mesher::Change<2>> update(const Step& step, BoxMesher<2>& m, PointSet& points) {
  const PointSet before = points;
  for (const Edit& edit : step) perform(edit, m, points);
  require(m.size() == points.size(), "another number of points is announced");
  try {
    return m.update();
  } catch (const mesher::Error& error) {
    if (error.code() != ErrorCode::too_close || error.features().size() != 2) throw;
    points = before;
    return std::nullopt;
  }
}

void check_step(const Step& step, BoxMesher<2>& m, PointSet& points, Parts& parts,
                const Sequence& sequence, const Checks& checks, std::size_t number) {
  const Mesh<2> before = m.mesh();
  const auto made = update(step, m, points);
  const Mesh<2> mesh = m.mesh();
  if (!made) return require(mesh == before, "a step that was refused changes the mesh");
  const auto& change = *made;
  if (number > 0) {
    require(change.kinds_changed == kind_changes(before, mesh), "the change of kinds is another");
  }
  compare(mesh, static_mesh(points, sequence.options), "a static run");
  apply_difference(change.vertices_added, change.vertices_removed, parts.vertices);
  apply_difference(change.simplices_added, change.simplices_removed, parts.simplices);
  require(parts == parts_of(mesh), "the change does not lead to the new mesh");
  check_input(mesh, points);
  check_counts(change, m, mesh);
  m.check_invariants();
  if (checks.fresh_every > 0 && number % static_cast<std::size_t>(checks.fresh_every) == 0) {
    BoxMesher<2> fresh(sequence.options);
    for (const auto& [id, p] : points) fresh.insert(PointId{id}, p);
    fresh.update();
    compare(mesh, fresh.mesh(), "a new mesher");
  }
  if (checks.each) checks.each(mesh, points);
}

}  // namespace

std::string first_failure(const Sequence& sequence, const Checks& checks) {
  std::size_t number = 0;
  try {
    BoxMesher<2> m(sequence.options);
    PointSet points;
    Parts parts;
    for (const Step& step : sequence.steps) {
      check_step(step, m, points, parts, sequence, checks, number);
      ++number;
    }
  } catch (const std::exception& error) {
    return "step " + std::to_string(number) + ": " + error.what();
  }
  return "";
}

Sequence shrunk(Sequence sequence, const std::function<bool(const Sequence&)>& fails) {
  // Whole steps first, then single edits: the longest runs first.
  const auto without = [](auto list, std::size_t from, std::size_t count) {
    const auto at = list.begin() + static_cast<std::ptrdiff_t>(from);
    list.erase(at, at + static_cast<std::ptrdiff_t>(std::min(count, list.size() - from)));
    return list;
  };
  for (std::size_t run = sequence.steps.size() / 2; run > 0; run /= 2) {
    for (std::size_t from = 0; from < sequence.steps.size();) {
      Sequence less = sequence;
      less.steps = without(sequence.steps, from, run);
      fails(less) ? void(sequence = std::move(less)) : void(from += run);
    }
  }
  for (std::size_t s = 0; s < sequence.steps.size(); ++s) {
    for (std::size_t run = (sequence.steps[s].size() + 1) / 2; run > 0; run /= 2) {
      for (std::size_t from = 0; from < sequence.steps[s].size();) {
        Sequence less = sequence;
        less.steps[s] = without(sequence.steps[s], from, run);
        fails(less) ? void(sequence = std::move(less)) : void(from += run);
      }
    }
  }
  return sequence;
}

std::string verdict(const Sequence& sequence, const Checks& checks) {
  const std::string failure = first_failure(sequence, checks);
  if (failure.empty()) return "";
  const Checks again{.fresh_every = 1, .each = {}};
  const Sequence small =
      shrunk(sequence, [&](const Sequence& s) { return !first_failure(s, again).empty(); });
  return failure + "\nshrunk: " + first_failure(small, again) + "\n" + describe(small);
}

}  // namespace support
