// Random complexes in the cubes of a grid, put into a mesher and taken out again by its facade.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesher.hpp"
#include "random_complex.hpp"

namespace support {

/// What edits there are is up to the seed: parts come and go, with their points or without, one for
/// another, or get other ids; points of them move. M: a Mesher<3>, or another with its edits.
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
    switch (below(6)) {
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
      default:  // features alone
        parcel.features.empty() ? insert_features(parcel) : erase_features(parcel);
        break;
    }
  }

 private:
  struct Feature {
    mesher::FeatureId id;
    bool is_polygon;
  };
  struct Parcel {
    Complex complex;
    std::vector<mesher::FeatureId> points;
    std::vector<Feature> features;
  };

  mesher::FeatureId fresh() { return mesher::FeatureId{++last_}; }
  mesher::Point<3> corner_of(const Parcel& parcel) const {
    const auto i = static_cast<std::size_t>(&parcel - parcels_.data());
    return {static_cast<double>(i % kAcross), static_cast<double>(i / kAcross % kAcross),
            static_cast<double>(i / kAcross / kAcross)};
  }

  void put(Parcel& parcel) {
    parcel.complex = random_.part(corner_of(parcel));
    for (const auto& p : parcel.complex.points) {
      parcel.points.push_back(fresh());
      m_.insert(parcel.points.back(), p);
    }
    insert_features(parcel);
  }
  void erase(Parcel& parcel) {
    erase_features(parcel);
    for (const mesher::FeatureId id : parcel.points) m_.remove(id);
    parcel.points.clear();
  }
  void insert_features(Parcel& parcel) {
    for (const auto& [a, b] : parcel.complex.segments) {
      parcel.features.push_back({fresh(), false});
      m_.insert_segment(parcel.features.back().id, parcel.points[a], parcel.points[b]);
    }
    for (const Complex::Face& face : parcel.complex.faces) {
      mesher::Polygon polygon{fresh(), {}};
      for (const auto& loop : face.loops) {
        auto& ids = polygon.loops.emplace_back();
        for (const std::size_t i : loop) ids.push_back(parcel.points[i]);
      }
      for (const std::size_t i : face.on) polygon.points.push_back(parcel.points[i]);
      m_.insert_polygon(polygon);
      parcel.features.push_back({polygon.id, true});
      const auto& loop = polygon.loops[0];  // an edge of it is a segment too
      if (below(4) == 0 && !has_segments(parcel)) {
        parcel.features.push_back({fresh(), false});
        m_.insert_segment(parcel.features.back().id, loop[0], loop[1]);
      }
    }
  }
  static bool has_segments(const Parcel& parcel) {
    for (const Feature& f : parcel.features) {
      if (!f.is_polygon) return true;
    }
    return false;
  }
  void erase_features(Parcel& parcel) {
    for (const auto& [id, is_polygon] : parcel.features) {
      is_polygon ? m_.remove_polygon(id) : m_.remove_segment(id);
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
