// Run and heap of the propagation queue.
#include "sac/internal/propagation_queue.hpp"

#include <new>

#include "sac/check.hpp"

namespace sac {

void PropagationQueue::shrink(std::size_t count) {
  std::vector<Handle> heap;
  heap.reserve(std::max(count, heap_.size()));
  std::vector<Handle> run = run_;
  heap.assign(heap_.begin(), heap_.end());
  heap_.swap(heap);
  run_.swap(run);
  most_in_heap_ = heap_.capacity();  // taken from memory used before
  most_in_run_ = run_.size();
}

void PropagationQueue::push(Handle call) {
  SAC_ENSURES(at(call)->queue == 0);
  ++size_;
  if (run_.size() < run_.capacity() && (run_.empty() || before(run_.back(), call))) {
    return append_to_run(call);
  }
  heap_.push_back(call);
  most_in_heap_ = std::max(most_in_heap_, heap_.size());
  put(heap_.size() - 1, call);
  sift_up(heap_.size() - 1);
}

Handle PropagationQueue::pop() {
  const Handle first = front();
  erase(*at(first));
  return first;
}

void PropagationQueue::erase(Call& call) noexcept {
  const std::uint32_t position = call.queue;
  call.queue = 0;
  --size_;
  if ((position & kInRun) != 0) {
    erase_from_run((position & ~kInRun) - 1);
  } else {
    erase_from_heap(position - 1);
  }
}

void PropagationQueue::erase_from_run(std::size_t position) noexcept {
  run_[position] = 0;
  while (run_begin_ < run_.size() && run_[run_begin_] == 0) ++run_begin_;
  if (run_begin_ == run_.size()) {
    run_.clear();
    run_begin_ = 0;
  }
  while (!run_.empty() && run_.back() == 0) run_.pop_back();
}

void PropagationQueue::erase_from_heap(std::size_t position) noexcept {
  const Handle last = heap_.back();
  heap_.pop_back();
  if (position == heap_.size()) return;
  put(position, last);
  sift_up(position);
  sift_down(at(last)->queue - 1);
}

void PropagationQueue::sort() noexcept {
  constexpr std::size_t kMany = 64;
  if (heap_.size() < kMany) return;
  struct Entry {
    Timeline::Place place;
    Handle call;
  };
  std::vector<Entry> entries;
  try {
    entries.reserve(size_);
    run_.reserve(size_);
  } catch (const std::bad_alloc&) {
    return;
  }
  const auto take = [&](const std::vector<Handle>& part) {
    for (const Handle h : part) {
      if (h != 0) entries.push_back({timeline_.place(*at(h)), h});
    }
  };
  take(heap_);
  take(run_);
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.place < b.place; });
  heap_.clear();
  run_.clear();
  run_begin_ = 0;
  for (const Entry& e : entries) append_to_run(e.call);
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
    SAC_INVARIANT(!at(heap_[i])->dead());
    SAC_INVARIANT(i == 0 || !before(heap_[i], heap_[(i - 1) / 2]));
  }
  SAC_INVARIANT(run_.empty() ? run_begin_ == 0 : run_[run_begin_] != 0 && run_.back() != 0);
  std::size_t in_run = 0;
  Handle previous = 0;
  for (std::size_t i = run_begin_; i < run_.size(); ++i) {
    if (run_[i] == 0) continue;
    SAC_INVARIANT(at(run_[i])->queue == (kInRun | (i + 1)));
    SAC_INVARIANT(!at(run_[i])->dead());
    SAC_INVARIANT(previous == 0 || before(previous, run_[i]));
    previous = run_[i];
    ++in_run;
  }
  SAC_INVARIANT(size_ == heap_.size() + in_run);
}

}  // namespace sac
