// Meshes from scratch at every update.
#include "static_mesher.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::FeatureId;
using mesher::Mesh;
using mesher::Point;

using Triangle = std::array<Point<2>, 3>;

std::string id_text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

// Both in order: vertices are, so triangles given by their points are as those given by indices.
std::vector<Triangle> triangles_of(const Mesh<2>& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.simplices.size());
  for (const auto& [a, b, c] : mesh.simplices) {
    triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  return triangles;
}

template <class T>
std::vector<T> difference(const std::vector<T>& all, const std::vector<T>& without) {
  std::vector<T> rest;
  std::set_difference(all.begin(), all.end(), without.begin(), without.end(),
                      std::back_inserter(rest));
  return rest;
}

// Vertices of both that have another kind now.
std::vector<mesher::KindChange<2>> kinds_changed(const Mesh<2>& before, const Mesh<2>& after) {
  std::vector<mesher::KindChange<2>> changes;
  std::size_t i = 0;
  for (std::size_t k = 0; k < after.vertices.size(); ++k) {
    while (i < before.vertices.size() && before.vertices[i] < after.vertices[k]) ++i;
    if (i == before.vertices.size() || before.vertices[i] != after.vertices[k]) continue;
    if (before.kinds[i] == after.kinds[k]) continue;
    changes.push_back({after.vertices[k], before.kinds[i], after.kinds[k]});
  }
  return changes;
}

mesher::Change<2> change_between(const Mesh<2>& before, const Mesh<2>& after) {
  const auto old_triangles = triangles_of(before), new_triangles = triangles_of(after);
  mesher::Change<2> change;
  change.vertices_added = difference(after.vertices, before.vertices);
  change.vertices_removed = difference(before.vertices, after.vertices);
  change.kinds_changed = kinds_changed(before, after);
  change.simplices_added = difference(new_triangles, old_triangles);
  change.simplices_removed = difference(old_triangles, new_triangles);
  return change;
}

}  // namespace

void StaticMesher::require_known(FeatureId id) const {
  if (edited_.points.contains(id)) return;
  throw Error(ErrorCode::unknown_id, "there is no point " + id_text(id), {}, {id});
}

void StaticMesher::require_inside(FeatureId id, const Point<2>& p) const {
  const auto& box = options_.domain;
  if (p[0] >= box.lo[0] && p[0] <= box.hi[0] && p[1] >= box.lo[1] && p[1] <= box.hi[1]) return;
  throw Error(ErrorCode::outside_domain, "point " + id_text(id) + " is outside the domain", {},
              {id});
}

void StaticMesher::require_free(FeatureId id, const Point<2>& p) const {
  const auto other = edited_.ids.find(p);
  if (other == edited_.ids.end()) return;
  throw Error(ErrorCode::duplicate_point,
              "point " + id_text(id) + " would lie on point " + id_text(other->second), {},
              {id, other->second});
}

void StaticMesher::put(FeatureId id, const Point<2>& point) {
  edited_.points.emplace(id, point);
  edited_.ids.emplace(point, id);
}

void StaticMesher::insert(FeatureId id, const Point<2>& point) {
  if (edited_.points.contains(id)) {
    throw Error(ErrorCode::repeated_id, "there is a point " + id_text(id) + " already", {}, {id});
  }
  require_inside(id, point);
  if (!current_.points.contains(id)) require_free(id, point);
  put(id, point);
}

void StaticMesher::insert(const std::vector<FeatureId>& ids, const std::vector<Point<2>>& points) {
  const Features before = edited_;
  try {
    for (std::size_t i = 0; i < ids.size(); ++i) insert(ids[i], points[i]);
  } catch (...) {
    edited_ = before;
    throw;
  }
}

void StaticMesher::remove(FeatureId id) {
  require_known(id);
  const auto row = edited_.points.find(id);
  const auto [first, last] = edited_.ids.equal_range(row->second);
  edited_.ids.erase(std::find_if(first, last, [&](const auto& e) { return e.second == id; }));
  edited_.points.erase(row);
}

void StaticMesher::move(FeatureId id, const Point<2>& point) {
  require_known(id);
  require_inside(id, point);
  remove(id);
  put(id, point);
}

mesher::Change<2> StaticMesher::update(const mesher::RunControl& control) {
  std::vector<FeatureId> ids;
  std::vector<Point<2>> points;
  for (const auto& [id, point] : edited_.points) {
    ids.push_back(id);
    points.push_back(point);
  }
  mesher::MeshStats stats;
  Mesh<2> after = mesher::mesh_statically<2>(points, options_, ids, &stats, control);
  mesher::Change<2> change = change_between(mesh_, after);
  current_ = edited_;
  mesh_ = std::move(after);
  stats_ = stats;
  return change;
}

}  // namespace tool
