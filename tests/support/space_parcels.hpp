// Random complexes in the cubes of a grid, put into a mesher and taken out again by its facade.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/error.hpp"
#include "random_complex.hpp"

namespace support {

/// What edits there are is up to the seed: parts come and go, with their points or without, one for
/// another, or get other ids; single features go and come; points of them move. M: a
/// BoxMesher<3>, or another with its edits.
template <class M>
class SpaceParcels {
 public:
  static constexpr std::size_t kAcross = 2;

  SpaceParcels(M& mesher, std::uint64_t seed) : m_(mesher), random_(seed) {}

  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return random_.below(n); }
  /// Makes some edits and updates by update(), which may throw Error: then they are forgotten.
  /// Returns whether it did not.
  template <class Update>
  bool edit_and(std::uint64_t count, Update&& update) {
    const auto before = parcels_;
    try {
      for (; count > 0; --count) edit();
      update();
      return true;
    } catch (const mesher::Error&) {
      m_.discard_edits();
      parcels_ = before;
      return false;
    }
  }
  void edit() {
    Parcel& parcel = parcels_[below(parcels_.size())];
    if (parcel.points.empty()) return put(parcel);
    switch (below(8)) {
      case 0:
        erase(parcel);
        break;
      case 1:
        erase(parcel);
        put(parcel);
        break;
      case 2:  // other ids
        erase_features(parcel);
        insert_features(parcel);
        break;
      case 3:
        move(parcel);
        break;
      case 4:  // features alone
        parcel.features.empty() ? insert_features(parcel) : erase_features(parcel);
        break;
      default:
        if (!parcel.features.empty()) turn(parcel.features[below(parcel.features.size())]);
        break;
    }
  }

 private:
  struct Feature {
    mesher::Polygon polygon;  // a segment: of one loop of two points
    bool there = true;
    [[nodiscard]] bool is_polygon() const { return polygon.loops[0].size() > 2; }
  };
  struct Parcel {
    Complex complex;
    std::vector<mesher::PointId> points;
    std::vector<Feature> features;
  };

  AnyId fresh() { return AnyId{++last_}; }
  mesher::Point<3> corner_of(const Parcel& parcel) const {
    const auto i = static_cast<std::size_t>(&parcel - parcels_.data());
    return {static_cast<double>(i % kAcross), static_cast<double>(i / kAcross % kAcross),
            static_cast<double>(i / kAcross / kAcross)};
  }

  void put(Parcel& parcel) {
    const bool any = below(2) == 0;  // else what encloses
    parcel.complex = any ? random_.part(corner_of(parcel))
                         : random_.part(corner_of(parcel), below(2) == 0 ? 6 : 8);
    for (const auto& p : parcel.complex.points) {
      parcel.points.push_back(fresh());
      m_.insert(parcel.points.back(), p);
    }
    insert_features(parcel);
  }
  void erase(Parcel& parcel) {
    erase_features(parcel);
    for (const mesher::PointId id : parcel.points) m_.remove(id);
    parcel.points.clear();
  }
  void turn(Feature& f) {
    const mesher::PolygonId polygon = f.polygon.id;
    const mesher::LineId line{static_cast<std::int64_t>(polygon)};
    const auto& loop = f.polygon.loops[0];
    if (f.there) {
      f.is_polygon() ? m_.remove_polygon(polygon) : m_.remove_line(line);
    } else {
      f.is_polygon() ? m_.insert_polygon(f.polygon) : m_.insert_segment(line, loop[0], loop[1]);
    }
    f.there = !f.there;
  }
  void add(Parcel& parcel, const mesher::Polygon& polygon) {
    parcel.features.push_back({polygon, false});
    turn(parcel.features.back());
  }
  void insert_features(Parcel& parcel) {
    const auto& points = parcel.points;
    for (const auto& [a, b] : parcel.complex.segments) {
      add(parcel, {fresh(), {{points[a], points[b]}}});
    }
    for (const Complex::Face& face : parcel.complex.faces) {
      mesher::Polygon polygon{fresh(), {}};
      for (const auto& loop : face.loops) {
        auto& ids = polygon.loops.emplace_back();
        for (const std::size_t i : loop) ids.push_back(points[i]);
      }
      for (const std::size_t i : face.on) polygon.points.push_back(points[i]);
      add(parcel, polygon);
    }
    const auto& faces = parcel.complex.faces;
    if (faces.empty() || !parcel.complex.segments.empty() || below(2) == 0) return;
    const auto& loop = faces[0].loops[0];  // an edge of it is a segment too
    add(parcel, {fresh(), {{points[loop[0]], points[loop[1]]}}});
  }
  void erase_features(Parcel& parcel) {
    for (Feature& f : parcel.features) {
      if (f.there) turn(f);
    }
    parcel.features.clear();
  }
  // All of it, or one point, which bends what is not a triangle.
  void move(Parcel& parcel) {
    const double by = static_cast<double>(1 + below(7)) / 256;
    const std::size_t one = below(2 * parcel.points.size()), axis = below(3);
    for (std::size_t i = 0; i < parcel.points.size(); ++i) {
      if (one < parcel.points.size() && one != i) continue;
      parcel.complex.points[i][axis] += by;
      m_.move(parcel.points[i], parcel.complex.points[i]);
    }
  }

  M& m_;
  RandomComplex random_;
  std::array<Parcel, kAcross * kAcross * kAcross> parcels_;
  std::int64_t last_ = 0;
};

}  // namespace support
