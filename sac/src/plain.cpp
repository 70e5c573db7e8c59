// Draining an agenda without a trace.
#include "sac/plain.hpp"

namespace sac {

bool PlainAgenda::before(const Record* a, const Record* b) {
  if (a->order != b->order) return a->order < b->order;
  if (a->function != b->function) return a->function->name < b->function->name;
  return operations(*a).order(*a, *b) < 0;
}

bool PlainAgenda::same(const Record* a, const Record* b) {
  return a->order == b->order && a->function == b->function && operations(*a).same(*a, *b);
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
  const auto later = [](const Record* a, const Record* b) { return before(b, a); };
  std::vector<Record*> batch = std::move(c.records);
  c.records.clear();
  std::sort(batch.begin(), batch.end(), before);
  std::vector<Record*> late;  // a heap
  const Record* previous = nullptr;
  for (std::size_t i = 0; i < batch.size() || !late.empty();) {
    const bool from_late = i == batch.size() || (!late.empty() && before(late.front(), batch[i]));
    const Record* next;
    if (from_late) {
      std::pop_heap(late.begin(), late.end(), later);
      next = late.back();
      late.pop_back();
    } else {
      next = batch[i++];
    }
    if (previous != nullptr && same(previous, next)) continue;
    if (previous != nullptr && before(next, previous)) throw UsageError("posting into the past");
    previous = next;
    operations(*next).run(s, *next);
    s.run_tails();
    for (Record* r : c.records) {
      late.push_back(r);
      std::push_heap(late.begin(), late.end(), later);
    }
    c.records.clear();
  }
}

}  // namespace sac
