// Run and heap of the propagation queue.
#include "sac/internal/propagation_queue.hpp"

#include <new>

#include "sac/check.hpp"

namespace sac {

void PropagationQueue::shrink(std::size_t count) {
  std::vector<Entry> heap;
  heap.reserve(std::max(count, heap_.size()));
  std::vector<Entry> run = run_;
  heap.assign(heap_.begin(), heap_.end());
  heap_.swap(heap);
  run_.swap(run);
  most_in_heap_ = heap_.capacity();  // taken from memory used before
  most_in_run_ = run_.size();
}

void PropagationQueue::push(Entry entry) {
  SAC_ENSURES(arena_[entry.call].queue == 0);
  ++size_;
  if (run_.size() < run_.capacity() && (run_.empty() || before(run_.back(), entry))) {
    return append_to_run(entry);
  }
  heap_.push_back(entry);
  most_in_heap_ = std::max(most_in_heap_, heap_.size());
  put(heap_.size() - 1, entry);
  sift_up(heap_.size() - 1);
}

auto PropagationQueue::pop() -> Entry {
  const Entry first = front();
  const bool in_run = !run_.empty() && run_[run_begin_].call == first.call;
  arena_[first.call].queue = 0;
  --size_;
  // The calls of a large batch lie anywhere in memory, with their edges behind them.
  constexpr std::size_t kAhead = 8;
  if (in_run && run_begin_ + kAhead < run_.size()) {
    const char* const next = reinterpret_cast<const char*>(&arena_[run_[run_begin_ + kAhead].call]);
    __builtin_prefetch(next);
    __builtin_prefetch(next + 64);
  }
  in_run ? erase_from_run(run_begin_) : erase_from_heap(0);
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
  run_[position] = {};
  while (run_begin_ < run_.size() && run_[run_begin_].call == nullptr) ++run_begin_;
  if (run_begin_ == run_.size()) {
    run_.clear();
    run_begin_ = 0;
  }
  while (!run_.empty() && run_.back().call == nullptr) run_.pop_back();
}

void PropagationQueue::erase_from_heap(std::size_t position) noexcept {
  const Entry last = heap_.back();
  heap_.pop_back();
  if (position == heap_.size()) return;
  put(position, last);
  sift_up(position);
  sift_down(arena_[last.call].queue - 1);
}

void PropagationQueue::sort() noexcept {
  constexpr std::size_t kMany = 64;
  if (heap_.size() < kMany) return;
  struct Sorted {
    Timeline::Position at;
    Entry entry;
  };
  std::vector<Sorted> entries;
  try {
    entries.reserve(size_);
    run_.reserve(size_);
  } catch (const std::bad_alloc&) {
    return;
  }
  const auto take = [&](const std::vector<Entry>& part) {
    for (const Entry& e : part) {
      if (e.call != nullptr) entries.push_back({timeline_.position(arena_[e.place]), e});
    }
  };
  take(heap_);
  take(run_);
  std::sort(entries.begin(), entries.end(), [this](const Sorted& a, const Sorted& b) {
    return a.at != b.at ? a.at < b.at : before(a.entry, b.entry);
  });
  heap_.clear();
  run_.clear();
  run_begin_ = 0;
  for (const Sorted& e : entries) append_to_run(e.entry);
}

void PropagationQueue::sift_up(std::size_t position) noexcept {
  const Entry entry = heap_[position];
  for (; position > 0; position = (position - 1) / 2) {
    const Entry parent = heap_[(position - 1) / 2];
    if (!before(entry, parent)) break;
    put(position, parent);
  }
  put(position, entry);
}

void PropagationQueue::sift_down(std::size_t position) noexcept {
  const Entry entry = heap_[position];
  for (std::size_t child = 2 * position + 1; child < heap_.size(); child = 2 * position + 1) {
    if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
    if (!before(heap_[child], entry)) break;
    put(position, heap_[child]);
    position = child;
  }
  put(position, entry);
}

void PropagationQueue::check_invariants() const {
  for (std::size_t i = 0; i < heap_.size(); ++i) {
    SAC_INVARIANT(arena_[heap_[i].call].queue == i + 1);
    SAC_INVARIANT(!arena_[heap_[i].call].dead());
    SAC_INVARIANT(i == 0 || !before(heap_[i], heap_[(i - 1) / 2]));
  }
  SAC_INVARIANT(run_.empty() ? run_begin_ == 0
                             : run_[run_begin_].call != nullptr && run_.back().call != nullptr);
  std::size_t in_run = 0;
  Entry previous;
  for (std::size_t i = run_begin_; i < run_.size(); ++i) {
    if (run_[i].call == nullptr) continue;
    SAC_INVARIANT(arena_[run_[i].call].queue == (kInRun | (i + 1)));
    SAC_INVARIANT(!arena_[run_[i].call].dead());
    SAC_INVARIANT(previous.call == nullptr || before(previous, run_[i]));
    previous = run_[i];
    ++in_run;
  }
  SAC_INVARIANT(size_ == heap_.size() + in_run);
}

}  // namespace sac
