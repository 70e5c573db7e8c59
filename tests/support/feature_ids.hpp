// Ids for tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "any_id.hpp"
#include "mesher/error.hpp"

namespace support {

/// Of points, lines or polygons: whatever is asked for.
class Ids {
 public:
  Ids() = default;
  Ids(std::initializer_list<AnyId> all) : all_(all) {}
  Ids(std::vector<AnyId> all) : all_(std::move(all)) {}
  Ids(const std::vector<mesher::PointId>& all) { add(all); }
  Ids(const std::vector<mesher::LineId>& all) { add(all); }
  Ids(const std::vector<mesher::PolygonId>& all) { add(all); }

  operator std::vector<mesher::PointId>() const { return {all_.begin(), all_.end()}; }
  operator std::vector<mesher::LineId>() const { return {all_.begin(), all_.end()}; }
  operator std::vector<mesher::PolygonId>() const { return {all_.begin(), all_.end()}; }

  [[nodiscard]] auto begin() const { return all_.begin(); }
  [[nodiscard]] auto end() const { return all_.end(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] AnyId operator[](std::size_t i) const { return all_[i]; }
  [[nodiscard]] AnyId front() const { return all_.front(); }
  [[nodiscard]] AnyId back() const { return all_.back(); }

  friend bool operator==(const Ids&, const Ids&) = default;

 private:
  template <class Id>
  void add(const std::vector<Id>& all) {
    for (const Id id : all) all_.push_back({static_cast<std::int64_t>(id)});
  }
  std::vector<AnyId> all_;
};

inline AnyId id(std::int64_t value) { return AnyId{value}; }
inline Ids ids(std::initializer_list<std::int64_t> values) {
  std::vector<AnyId> all;
  for (const auto value : values) all.push_back(id(value));
  return all;
}

/// Of what the error is about.
inline Ids ids_of(const mesher::Error& error) {
  std::vector<AnyId> all;
  for (const mesher::Feature& f : error.features()) all.push_back(id(f.number));
  return all;
}

}  // namespace support
