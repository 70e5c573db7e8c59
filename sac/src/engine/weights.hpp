// Weights: the steps that calls report, kept in the trace.
//
// A structure without observations. Each Scope::weigh is an effect whose edge holds the number; a
// call that runs again overwrites those of its last execution.
#pragma once

#include <cstdint>
#include <ostream>

#include "sac/scope.hpp"

namespace sac {

class Weights final : public Structure {
 public:
  explicit Weights(Engine& engine) : id_(engine.add_structure(*this)) {}

  void add(Scope& s, std::uint64_t n) {
    Weight* weight = s.recall<Weight>(
        id_, 0, [](const Weight&) { return true; }, Scope::kMostRecalled);
    if (weight == nullptr) weight = &s.effect<Weight>(id_, 0);
    weight->steps = n;
  }
  /// What the edge adds to its call's weight.
  [[nodiscard]] std::uint64_t in(const Edge& edge) const noexcept {
    return edge.structure == id_ ? static_cast<const Weight&>(edge).steps : 0;
  }

  void retract(Call&, Edge&) noexcept override {}
  void print(const Call&, const Edge& edge, std::ostream& out) const override {
    out << "weighs " << in(edge);
  }

 private:
  struct Weight : Edge {
    std::uint64_t steps;
  };

  std::uint8_t id_;
};

}  // namespace sac
