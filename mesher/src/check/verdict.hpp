// What single checks of a mesh say, and the list of it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesher/check.hpp"

namespace mesher::detail {

/// What a check says: nothing wrong and what was looked at, or the first violation.
struct Verdict {
  bool holds;
  std::string detail;

  static Verdict good(std::string detail) { return {true, std::move(detail)}; }
  static Verdict bad(std::string detail) { return {false, std::move(detail)}; }
};

class Findings {
 public:
  /// Whether the property holds.
  bool add(const char* property, Verdict verdict) {
    all_.push_back({property, verdict.holds, std::move(verdict.detail)});
    return verdict.holds;
  }
  [[nodiscard]] std::vector<Finding> take() { return std::move(all_); }

 private:
  std::vector<Finding> all_;
};

}  // namespace mesher::detail
