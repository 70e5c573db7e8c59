// Programs on the engine whose traces the tests record.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "sac/sac.hpp"
#include "traces/recorder.hpp"

namespace programs {

struct Item {
  int id = 0;
  sac::Mod<Item*> next;
};

/// Copies a list of modifiable links; concise and monotone. What it makes is named by the items.
inline void map(sac::Scope& s, sac::Mod<Item*> in, sac::Mod<Item*> out) {
  Item* item = s.read(in);
  if (item == nullptr) return s.write<Item*>(out, nullptr);
  Item& copy = s.make<Item>("copy", item->id);
  copy.id = -item->id;
  copy.next = s.cell<Item*>("next", item->id);
  s.write(out, &copy);
  s.tail<map>(item->next, copy.next);
}

/// A list of input modifiables with names, and its copy.
class ListMap {
 public:
  /// `spoilers`: unused modifiables made first, so that handles differ from other runs.
  explicit ListMap(const std::vector<int>& ids, int spoilers = 0) {
    for (int i = 0; i < spoilers; ++i) static_cast<void>(engine_.input(i));
    // Made last to first: handles do not follow the list.
    Item* next = nullptr;
    for (auto id = ids.rbegin(); id != ids.rend(); ++id) next = &new_item(*id, next);
    head_ = engine_.input(next);
    out_ = engine_.cell<Item*>();
    recorder_.name(head_, "head");
    recorder_.name(out_, "out");
    engine_.run<map>(head_, out_);
  }

  /// Inserts behind the item `before` by change propagation.
  sac::Counts insert(int id, int before) {
    for (Item& item : items_) {
      if (item.id != before) continue;
      const sac::Mod<Item*> link = item.next;
      engine_.set(link, &new_item(id, engine_.get(link)));
      return engine_.propagate();
    }
    throw std::out_of_range("no such item");
  }
  traces::Recording record(const std::string& path) const { return recorder_.record(path); }
  [[nodiscard]] traces::Trace trace() const { return recorder_.trace(); }

 private:
  Item& new_item(int id, Item* next) {
    Item& item = items_.emplace_back(Item{id, engine_.input(next)});
    recorder_.name(&item, "item", id);
    recorder_.name(item.next, "link", id);
    return item;
  }

  std::deque<Item> items_;  // outlive the engine
  sac::Engine engine_;
  traces::Recorder recorder_{engine_};
  sac::Mod<Item*> head_, out_;
};

inline void visit(sac::Scope&, int) {}

/// Visits the digits of `text` in order.
inline void visit_all(sac::Scope& s, sac::Mod<std::string> text) {
  for (const char c : s.read(text)) s.call<visit>(c - '0');
}

/// Records a fresh run of visit_all.
inline void record_visits(const std::string& text, const std::string& path) {
  sac::Engine engine;
  const auto input = engine.input(text);
  engine.run<visit_all>(input);
  traces::Recorder recorder(engine);
  recorder.name(input, "text");
  recorder.record(path);
}

}  // namespace programs
