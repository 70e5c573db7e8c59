// Draining an agenda without a trace.
#include "sac/plain.hpp"

namespace sac {

void* PlainAgenda::Class::allocate(std::size_t bytes) {
  constexpr std::size_t kAlignment = alignof(std::max_align_t);
  bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
  if (used + bytes > kBlock) {
    blocks.push_back(std::make_unique_for_overwrite<std::byte[]>(kBlock));
    used = 0;
  }
  return blocks.back().get() + std::exchange(used, used + bytes);
}

std::strong_ordering PlainAgenda::order(const Entry& a, const Entry& b) {
  if (a.order != b.order) return a.order <=> b.order;
  const Kind& kind = *a.record->kind;
  if (&kind != b.record->kind) return order_of_functions(kind, *b.record->kind);
  return kind.order(*a.record, *b.record);
}

void PlainAgenda::drain(PlainScope& s) {
  if (running_ || drained_) throw UsageError("an agenda is drained twice");
  running_ = true;
  try {
    while (!classes_.empty()) {
      rank_ = classes_.begin()->first;
      run_class(s, classes_.begin()->second);
      cached_ = nullptr;
      classes_.erase(classes_.begin());
    }
  } catch (...) {  // as of a traced run that fails, nothing waits any more
    cached_ = nullptr;
    classes_.clear();
    running_ = false;
    throw;
  }
  running_ = false;
  drained_ = true;
}

void PlainAgenda::run_class(PlainScope& s, Class& c) {
  constexpr auto before = [](const Entry& a, const Entry& b) {
    return a.order != b.order ? a.order < b.order : order(a, b) < 0;
  };
  DueCalls<Entry> due;
  due.begin(c.posts, before);
  Entry last{0, nullptr};
  while (!due.empty()) {
    const Entry& first = due.first(before);
    const Entry next = first;
    due.drop(first);
    const bool is_equal =
        last.record != nullptr && last.record->kind == next.record->kind && order(next, last) == 0;
    if (is_equal) continue;
    last = next;
    next.record->kind->run(s, *next.record);
    s.run_tails();
    for (const Entry& post : c.posts) {
      if (order(post, last) <= 0) throw UsageError("posting into the past");
      due.add(post, before);
    }
    c.posts.clear();
  }
}

}  // namespace sac
