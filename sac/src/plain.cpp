// Draining an agenda without a trace.
#include "sac/plain.hpp"

namespace sac {

bool PlainAgenda::before_in_tie(const Record& a, const Record& b) {
  if (a.function != b.function) return order_by_name(*a.function, *b.function) < 0;
  return operations(a).order(a, b) < 0;
}

bool PlainAgenda::same(const Entry& a, const Entry& b) {
  return a.order == b.order && a.record->function == b.record->function &&
         operations(*a.record).same(*a.record, *b.record);
}

void PlainAgenda::drain(PlainScope& s) {
  if (running_) throw UsageError("an agenda is drained twice");
  running_ = true;
  while (!classes_.empty()) {
    rank_ = classes_.begin()->first;
    cached_ = nullptr;
    run_class(s, classes_.begin()->second);
    cached_ = nullptr;
    classes_.erase(classes_.begin());
  }
  running_ = false;
}

// What was posted before runs in order, merged with what these calls post into the same class.
void PlainAgenda::run_class(PlainScope& s, Class& c) {
  const auto later = [](const Entry& a, const Entry& b) { return before(b, a); };
  std::vector<Entry> batch = std::move(c.records);
  c.records.clear();
  std::sort(batch.begin(), batch.end(),
            [](const Entry& a, const Entry& b) { return before(a, b); });
  std::vector<Entry> late;  // a heap
  Entry previous{0, nullptr};
  for (std::size_t i = 0; i < batch.size() || !late.empty();) {
    const bool from_late = i == batch.size() || (!late.empty() && before(late.front(), batch[i]));
    Entry next;
    if (from_late) {
      std::pop_heap(late.begin(), late.end(), later);
      next = late.back();
      late.pop_back();
    } else {
      next = batch[i++];
    }
    if (previous.record != nullptr && same(previous, next)) continue;
    if (previous.record != nullptr && before(next, previous))
      throw UsageError("posting into the past");
    previous = next;
    operations(*next.record).run(s, *next.record);
    s.run_tails();
    for (const Entry& r : c.records) {
      late.push_back(r);
      std::push_heap(late.begin(), late.end(), later);
    }
    c.records.clear();
  }
}

}  // namespace sac
