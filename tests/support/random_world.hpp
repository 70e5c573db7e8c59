// What a random program works on: inputs, cells, a list, agendas and structures, on sac::Scope or
// on sac::PlainScope.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "../../sac/examples/claims.hpp"
#include "counter.hpp"
#include "judge.hpp"
#include "program_text.hpp"
#include "sac/sac.hpp"

namespace support {

/// Thrown by a program whose fuse has burnt down.
struct Failure : std::runtime_error {
  Failure() : std::runtime_error("the fuse of a random program") {}
};
/// Thrown by a program that makes too many calls.
struct TooLong : std::runtime_error {
  TooLong() : std::runtime_error("a random program makes too many calls") {}
};
/// Thrown by a node, as its text says.
struct Refusal : std::runtime_error {
  Refusal() : std::runtime_error("a node of a random program refuses") {}
};

/// What the outside gives to a program.
struct Outside {
  std::vector<int> inputs = std::vector<int>(RandomProgram::kInputs, 1);
  std::multiset<int> posts;         // nodes, with argument 9; on side agendas: + 16, + 32
  std::vector<int> items{1, 2, 3};  // weights in the list
  std::vector<int> late;            // runs at the end
};

/// Two numbers are the same if their halves are: what is read of it may be that only.
struct SameHalf {
  template <class V>
  bool operator()(const V& a, const V& b) const {
    return int(a) / 2 == int(b) / 2;
  }
};

// An object that holds something of a cell, behind a modifiable of its own.
template <class S, class V>
struct Box {
  typename S::template CellType<V> content;
};
// Elements of the outside's list, and of the list that it is mapped to.
template <class S, class V>
struct Item {
  typename S::template CellType<V> weight;
  typename S::template CellType<const Item*> next;
};
template <class S, class V>
struct Image {
  typename S::template CellType<V> weight;
  typename S::template CellType<const Image*> next;
};

template <class V>
struct ListRoot;
template <class V>
struct Root;
template <class V>
struct Late;
template <class V>
struct Posted;
template <class V>
inline constexpr ListRoot<V> list_root{};
template <class V>
inline constexpr Root<V> random_root{};
template <class V>
inline constexpr Late<V> late{};
template <class V>
inline constexpr Posted<V> posted{};

inline sac::Key node_key(int id, int argument) {
  return {.bucket = id / 2,
          .colour = static_cast<unsigned>(id % 2),
          .order = static_cast<std::uint64_t>(argument / 2)};
}
// Each posted function has labels and ranks of its own.
inline constexpr int kNodeLabel = 0, kMarkLabel = 1, kKeyedLabel = 2, kRealLabel = 3;

/// V: the type of values and arguments, made from an int and converted to one.
template <class S, class V = int>
struct RandomWorld {
  template <class T, class Same = std::equal_to<>>
  using Mod = typename S::template ModType<T, Same>;
  static constexpr int kPostedArgument = 9;

  const RandomProgram* program = nullptr;
  std::vector<Mod<V>> inputs;
  std::vector<Mod<V>> cells;
  std::vector<Mod<V, SameHalf>> coarse;
  std::vector<Mod<const Box<S, V>*>> links;
  std::vector<Item<S, V>*> items;  // the outside's list, in order
  Mod<const Item<S, V>*> head;
  Mod<const Image<S, V>*> list;
  std::vector<Mod<V>> maybes;                    // not written before the nodes run
  std::vector<typename S::AgendaType*> agendas;  // early, late, and those at the side
  std::unique_ptr<examples::Claims<int, S>> claims;
  std::vector<std::unique_ptr<Counter<S>>> counters;
  Judge judge;                            // of a plain run
  std::set<std::vector<int>> executions;  // what nodes that have run to their end have seen
  int fuse = -1;                          // calls left until one throws; -1: none does
  int calls_left = std::numeric_limits<int>::max();  // until it is too long

  void burn() {
    if (fuse >= 0 && fuse-- == 0) throw Failure();
    if (--calls_left == 0) throw TooLong();
  }
  /// The agenda on which a node is posted: late nodes on the second.
  [[nodiscard]] static std::size_t agenda_of(int id) { return id >= 8 ? 1 : 0; }
  [[nodiscard]] static std::size_t side(int k) { return 2 + static_cast<std::size_t>(k); }

  /// Posts F(agenda, args...).
  template <auto F, class... Args>
  void post(S& s, std::size_t agenda, const PostedLabel& label, const sac::Key& key, Args... args) {
    if constexpr (!S::kTraced) judge.post(agenda, label, key);
    agendas[agenda]->template post<F>(s, key, static_cast<int>(agenda), std::move(args)...);
  }
  void post_node(S& s, std::size_t agenda, int id, int argument) {
    post<posted<V>>(s, agenda, {kNodeLabel, id, argument}, node_key(id, argument), id, V(argument));
  }
  void drain(S& s, std::size_t agenda) {
    if constexpr (!S::kTraced) judge.begin_drain(agenda);
    agendas[agenda]->drain(s);
    if constexpr (!S::kTraced) judge.end_drain(agenda);
  }
  /// A posted call starts.
  void started(int agenda, const PostedLabel& label) {
    if constexpr (!S::kTraced) judge.run(static_cast<std::size_t>(agenda), label);
    burn();
  }
  /// Reads a cell that nobody may have written.
  const V& read_maybe(S& s, int i) {
    const auto& maybe = maybes[static_cast<std::size_t>(i)];
    if constexpr (!S::kTraced) {
      if (!maybe.place().has_value()) judge.refuse();
    }
    return s.read(maybe);
  }
  void write_input(S& s, int i, V value) {
    if constexpr (!S::kTraced) judge.refuse();
    s.write(inputs[static_cast<std::size_t>(i)], std::move(value));
  }
  /// What a child threw was caught.
  void caught() {
    if constexpr (!S::kTraced) judge.resent();
  }
  /// Does something that is another's business: the side of the engine that is the client's.
  void misuse(S& s, int how) {
    if constexpr (S::kTraced) {
      sac::Engine& engine = s.engine();
      switch (how) {
        case 0:
          return static_cast<void>(engine.input(V(1)));
        case 1:
          return static_cast<void>(engine.template cell<V>());
        case 2:
          return static_cast<void>(engine.template make<Box<S, V>>());
        case 3:
          return engine.set(inputs[0], V(6));
        case 4:
          return engine.release(maybes[0]);
        default:
          return static_cast<void>(engine.make_agenda("made by a node"));
      }
    } else {
      static_cast<void>(how);
      judge.refuse();
    }
  }

  /// Where the list points to its i-th element.
  [[nodiscard]] Mod<const Item<S, V>*> link_to(std::size_t i) const {
    return i == 0 ? head : Mod<const Item<S, V>*>(items[i - 1]->next);
  }
  void insert_item(auto& host, std::size_t i, int weight) {
    Item<S, V>& item = host.template make<Item<S, V>>();
    host.set(item.weight, V(weight));
    host.set(item.next, host.get(link_to(i)));
    host.set(link_to(i), &item);
    items.insert(items.begin() + static_cast<std::ptrdiff_t>(i), &item);
  }
  void post_from_outside(int code) {
    const int id = code % 16;
    const std::size_t agenda = agenda_of_code(code);
    const sac::Key key = node_key(id, kPostedArgument);
    if constexpr (!S::kTraced) judge.post(agenda, {kNodeLabel, id, kPostedArgument}, key);
    agendas[agenda]->template post_from_outside<posted<V>>(key, static_cast<int>(agenda), id,
                                                           V(kPostedArgument));
  }
  void retract_from_outside(int code) {
    const std::size_t agenda = agenda_of_code(code);
    agendas[agenda]->template retract_from_outside<posted<V>>(static_cast<int>(agenda), code % 16,
                                                              V(kPostedArgument));
  }
  [[nodiscard]] static std::size_t agenda_of_code(int code) {
    return code < 16 ? agenda_of(code) : side(code / 16 - 1);
  }

  void start(auto& host, const RandomProgram& text, const Outside& outside) {
    program = &text;
    host.set_environment(this);
    for (const int v : outside.inputs) inputs.push_back(host.template input<V>(V(v)));
    for (int i = 0; i < text.kCells; ++i) cells.push_back(host.template cell<V>());
    for (int i = 0; i < text.kCoarse; ++i) coarse.push_back(host.template cell<V, SameHalf>());
    for (int i = 0; i < text.kLinks; ++i) {
      links.push_back(host.template cell<const Box<S, V>*>());
    }
    for (int i = 0; i < text.kMaybes; ++i) maybes.push_back(host.template cell<V>());
    for (const char* name : {"early nodes", "late nodes", "left side", "right side"}) {
      agendas.push_back(&host.make_agenda(name));
    }
    claims = std::make_unique<examples::Claims<int, S>>(host);
    for (int i = 0; i < text.kCounters; ++i) counters.push_back(std::make_unique<Counter<S>>(host));
    head = host.template input<const Item<S, V>*>(nullptr);
    list = host.template cell<const Image<S, V>*>();
    for (const int weight : outside.items) insert_item(host, items.size(), weight);
    for (const int code : outside.posts) post_from_outside(code);
  }
  void run(auto& host, const Outside& outside) {
    host.template run<list_root<V>>();
    host.template run<random_root<V>>();
    for (const int n : outside.late) host.template run<late<V>>(n);
  }
  /// All that the program leaves.
  std::vector<int> values(auto& host) const {
    std::vector<int> all;
    for (const auto& c : cells) all.push_back(int(host.get(c)));
    for (const auto& c : coarse) all.push_back(int(host.get(c)) / 2);
    for (const auto& c : links) {
      const Box<S, V>* box = host.get(c);
      all.push_back(box != nullptr ? int(host.get(box->content)) : -1);
    }
    for (const auto& c : maybes) all.push_back(value_or(host, c, -1));
    for (const Image<S, V>* i = host.get(list); i != nullptr; i = host.get(i->next)) {
      all.push_back(int(host.get(i->weight)));
    }
    return all;
  }
  void check_invariants() const {
    claims->check_invariants();
    for (const auto& counter : counters) counter->check_invariants();
  }

 private:
  static int value_or(auto& host, const Mod<V>& mod, int none) {
    try {
      return int(host.get(mod));
    } catch (const sac::UsageError&) {
      return none;
    }
  }
};

}  // namespace support
