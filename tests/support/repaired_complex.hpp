// A complex that is repaired, as tests want it: a mesher takes the result and meshes it, and a
// second repair does nothing.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "graph/plc_builder.hpp"
#include "mesher/repair.hpp"
#include "space/polygon_shape.hpp"

namespace support {

using Places = mesher::detail::PlcBuilder::Places;

inline mesher::Box<3> domain_of(const mesher::Graph<3>& plc) {
  std::vector<mesher::Point<3>> places;
  for (const auto& p : plc.points) places.push_back(p.at);
  return mesher::snapped_domain<3>(places);
}

inline mesher::Repaired<3> repaired(const mesher::Graph<3>& plc) {
  const auto domain = domain_of(plc);
  mesher::Repaired<3> result = mesher::repair(plc, {.domain = domain});
  const mesher::Graph<3>& out = result.file.graph;
  mesher::BoxMesher<3> m({.domain = domain, .max_vertices = 200000});
  for (const auto& p : out.points) m.insert(p.id, p.at);
  for (const auto& s : out.segments) m.insert_segment(s.id, s.from, s.to);
  for (const auto& f : out.polygons) m.insert_polygon(f);
  m.update();
  const mesher::Repaired<3> again = mesher::repair(result.file, {.domain = domain});
  REQUIRE(again.file.graph == out);
  REQUIRE(again.notes.empty());
  return result;
}

inline std::vector<std::string> notes_of(const mesher::Repaired<3>& r) {
  std::vector<std::string> texts;
  for (const auto& note : r.notes) texts.push_back(note.text());
  return texts;
}

inline Places square(double x, double y, double z, double side = 1) {
  return {{x, y, z}, {x + side, y, z}, {x + side, y + side, z}, {x, y + side, z}};
}

/// Of all polygons, less their holes.
inline double area(const mesher::Graph<3>& plc) {
  std::map<mesher::PointId, mesher::Point<3>> at;
  for (const auto& p : plc.points) at[p.id] = p.at;
  double sum = 0;
  for (const auto& f : plc.polygons) {
    double sign = 1;
    for (const auto& loop : f.loops) {
      Places places;
      for (const auto v : loop) places.push_back(at.at(v));
      sum += sign * std::sqrt(mesher::detail::squared(mesher::detail::twice_area(places))) / 2;
      sign = -1;
    }
  }
  return sum;
}

}  // namespace support
