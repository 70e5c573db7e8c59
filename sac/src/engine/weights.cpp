#include "engine/weights.hpp"

namespace sac {

void Engine::record_weights() {
  begin_edit("record_weights");
  if (weights_ == nullptr) weights_ = std::make_unique<Weights>(*this);
}

std::uint64_t Engine::weight_of(const Call& call) const noexcept {
  std::uint64_t weight = 0;
  if (weights_ == nullptr) return weight;
  for_each_edge(call, [&](const Edge& edge) { weight += weights_->in(edge); });
  return weight;
}

void Engine::add_weight(Scope& s, std::uint64_t n) {
  Core::add_weight(n);
  weights_->add(s, n);
}

void Scope::record_weight(std::uint64_t n) { engine().add_weight(*this, n); }

}  // namespace sac
