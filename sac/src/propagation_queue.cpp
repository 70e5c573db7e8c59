// The heap of the propagation queue.
#include "sac/propagation_queue.hpp"

#include <algorithm>

#include "sac/check.hpp"

namespace sac {

void PropagationQueue::shrink(std::size_t count) {
  std::vector<Handle> smaller;
  smaller.reserve(std::max(count, heap_.size()));
  smaller.assign(heap_.begin(), heap_.end());
  heap_.swap(smaller);
  most_ = heap_.capacity();  // taken from memory used before
}

void PropagationQueue::push(Handle call) {
  SAC_ENSURES(at(call)->queue == 0);
  heap_.push_back(call);
  most_ = std::max(most_, heap_.size());
  put(heap_.size() - 1, call);
  sift_up(heap_.size() - 1);
}

Handle PropagationQueue::pop() {
  const Handle first = heap_.front();
  erase(*at(first));
  return first;
}

void PropagationQueue::erase(Call& call) noexcept {
  const std::size_t position = call.queue - 1;
  call.queue = 0;
  const Handle last = heap_.back();
  heap_.pop_back();
  if (position == heap_.size()) return;
  put(position, last);
  sift_up(position);
  sift_down(at(last)->queue - 1);
}

void PropagationQueue::sift_up(std::size_t position) noexcept {
  const Handle call = heap_[position];
  for (; position > 0; position = (position - 1) / 2) {
    const Handle parent = heap_[(position - 1) / 2];
    if (!before(call, parent)) break;
    put(position, parent);
  }
  put(position, call);
}

void PropagationQueue::sift_down(std::size_t position) noexcept {
  const Handle call = heap_[position];
  for (std::size_t child = 2 * position + 1; child < heap_.size(); child = 2 * position + 1) {
    if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
    if (!before(heap_[child], call)) break;
    put(position, heap_[child]);
    position = child;
  }
  put(position, call);
}

void PropagationQueue::check_invariants() const {
  for (std::size_t i = 0; i < heap_.size(); ++i) {
    SAC_INVARIANT(at(heap_[i])->queue == i + 1);
    SAC_INVARIANT(!at(heap_[i])->has(Call::kDead));
    SAC_INVARIANT(i == 0 || !before(heap_[i], heap_[(i - 1) / 2]));
  }
}

}  // namespace sac
