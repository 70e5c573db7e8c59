// Programs for the engine that are data: the same text runs on sac::Scope and sac::PlainScope.
//
// A program is a table of nodes. A node, called with its number and a small argument, reads inputs,
// cells and lists, writes cells (several nodes and calls write one cell: imperative), asks for
// results, allocates, calls and posts nodes of higher number, and goes on with a tail call. What it
// does depends on what it read. Reads and writes come before calls: a call's effects are at the
// place of the call. (A result that was asked for changes what the call does next, not what it
// wrote.)
//
// Around the nodes: a list of the outside is mapped before them; they are drained from two agendas,
// one after the other, each unless an input says no; more runs may follow at the end.
#pragma once

#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "random.hpp"
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

struct Op {
  enum Kind : std::uint8_t {
    // what a node does first,
    read_input, read_cell, read_coarse, read_link, read_list,
    write_cell, rewrite_cell, write_coarse,
    // allocates and writes,
    link,
    // calls,
    ask, call, pass, box, post, stripe, relink,
    // and does last
    tail, tail_box
  };
  static constexpr int kKinds = tail_box + 1;

  Kind kind;
  int target;     // input, cell, node ..., below targets()
  int modulus;    // happens if (what was read) % modulus < threshold
  int threshold;

  /// Ops of a node come in the order of their phases; there is one of the last phase at most.
  [[nodiscard]] int phase() const { return kind < link ? 0 : kind < ask ? 1 : kind < tail ? 2 : 3; }
};

struct RandomProgram {
  static constexpr int kInputs = 4;
  static constexpr int kCells = 5;
  static constexpr int kCoarse = 2;  // cells that tell halves only
  static constexpr int kLinks = 2;   // cells that hold pointers to boxes
  static constexpr int kLeastNodes = 4;
  static constexpr int kMostNodes = 14;

  std::vector<std::vector<Op>> nodes;

  /// Number of targets of an op of node `node`.
  [[nodiscard]] int targets(Op::Kind kind, int node) const {
    switch (kind) {
      case Op::read_input: return kInputs;
      case Op::read_coarse:
      case Op::write_coarse: return kCoarse;
      case Op::read_link:
      case Op::link:
      case Op::relink: return kLinks;
      case Op::read_list: return 4;       // so many elements
      case Op::stripe: return 12 * kCells;  // length and cell
      case Op::call:
      case Op::post:
      case Op::tail: return static_cast<int>(nodes.size()) - 1 - node;  // nodes behind this one
      default: return kCells;
    }
  }

  explicit RandomProgram(int node_count) : nodes(static_cast<std::size_t>(node_count)) {}

  RandomProgram(std::uint64_t seed, int node_count) : RandomProgram(node_count) {
    for (int n = 0; n < node_count; ++n) {
      Random random(seed * 1000 + static_cast<std::uint64_t>(n));
      const auto some = [&](int most, Op::Kind kind) {
        const int to = targets(kind, n);
        for (int i = to > 0 ? random(most + 1) : 0; i > 0; --i) {
          nodes[static_cast<std::size_t>(n)].push_back(
              {kind, random(to), 2 + random(3), 1 + random(2)});
        }
      };
      some(2, Op::read_input);
      some(2, Op::read_cell);
      some(2, Op::write_cell);
      some(1, Op::rewrite_cell);
      if (random(2) == 0) {
        for (const auto kind : {Op::read_coarse, Op::read_link, Op::read_list, Op::write_coarse}) {
          some(1, kind);
        }
      }
      if (random(3) == 0) some(2, Op::link);
      some(1, Op::ask);
      some(2, Op::call);
      some(1, Op::pass);
      some(1, Op::box);
      some(2, Op::post);
      some(1, Op::call);
      if (random(4) == 0) some(1, Op::stripe);
      if (random(4) == 0) some(1, Op::relink);
      some(1, random(2) == 0 ? Op::tail : Op::tail_box);
    }
  }
};

/// What the outside gives to a program.
struct Outside {
  std::vector<int> inputs = std::vector<int>(RandomProgram::kInputs, 1);
  std::multiset<int> posts;  // nodes, with argument 9
  std::vector<int> items{1, 2, 3};  // weights in the list
  std::vector<int> late;     // runs at the end
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
struct Node;
template <class V>
inline constexpr ListRoot<V> list_root{};
template <class V>
inline constexpr Root<V> random_root{};
template <class V>
inline constexpr Late<V> late{};
template <class V>
inline constexpr Node<V> node{};

inline sac::Key node_key(int id, int argument) {
  return {.bucket = id / 2,
          .colour = static_cast<unsigned>(id % 2),
          .order = static_cast<std::uint64_t>(argument / 2)};
}

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
  std::vector<typename S::AgendaType*> agendas;
  int fuse = -1;  // calls left until one throws; -1: none does
  int calls_left = std::numeric_limits<int>::max();  // until it is too long

  void burn() {
    if (fuse >= 0 && fuse-- == 0) throw Failure();
    if (--calls_left == 0) throw TooLong();
  }
  /// The agenda on which a node is posted: late nodes on the second.
  [[nodiscard]] typename S::AgendaType& agenda_of(int id) const { return *agendas[id >= 8]; }

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
  void post(int id) {
    agenda_of(id).template post_from_outside<node<V>>(node_key(id, kPostedArgument), id,
                                                      V(kPostedArgument));
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
    agendas = {&host.make_agenda("early nodes"), &host.make_agenda("late nodes")};
    head = host.template input<const Item<S, V>*>(nullptr);
    list = host.template cell<const Image<S, V>*>();
    for (const int weight : outside.items) insert_item(host, items.size(), weight);
    for (const int id : outside.posts) post(id);
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
    for (const Image<S, V>* i = host.get(list); i != nullptr; i = host.get(i->next)) {
      all.push_back(int(host.get(i->weight)));
    }
    return all;
  }
};

// Maps the list of the outside: every image is made by a tail call.
template <class V>
struct MapItem {
  static constexpr std::string_view kName = "map item";
  template <class S>
  void operator()(S& s, Image<S, V>& self, const Item<S, V>* in) const;
};
template <class V>
inline constexpr MapItem<V> map_item{};

template <class V>
template <class S>
void MapItem<V>::operator()(S& s, Image<S, V>& self, const Item<S, V>* in) const {
  s.template environment<RandomWorld<S, V>>().burn();
  s.write(self.weight, V((3 * int(s.read(in->weight)) + 1) % 5));
  const Item<S, V>* next = s.read(in->next);
  s.write(self.next,
          next != nullptr ? &s.template tail_make<Image<S, V>, map_item<V>>(next) : nullptr);
}

template <class V>
struct ListRoot {
  static constexpr std::string_view kName = "list root";
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const Item<S, V>* first = s.read(w.head);
    s.write(w.list,
            first != nullptr ? &s.template tail_make<Image<S, V>, map_item<V>>(first) : nullptr);
  }
};

// Adds what `from` holds to a cell.
template <class V>
struct Pass {
  static constexpr std::string_view kName = "pass";
  template <class S>
  void operator()(S& s, typename S::template ModType<V> from, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const auto to = w.cells[static_cast<std::size_t>(cell)];
    s.write(to, V((int(s.read(to)) + int(s.read(from))) % 7));
  }
};
template <class V>
inline constexpr Pass<V> pass{};

// What a cell holds, as a result; the caller depends on it.
template <class V>
struct Ask {
  static constexpr std::string_view kName = "ask";
  template <class S>
  V operator()(S& s, V argument, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    return V((int(s.read(w.cells[static_cast<std::size_t>(cell)])) + int(argument)) % 2);
  }
};
template <class V>
inline constexpr Ask<V> ask{};

template <class V>
struct Fill {
  static constexpr std::string_view kName = "fill";
  template <class S>
  void operator()(S& s, Box<S, V>& self, int id, V argument, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const int read = int(s.read(w.cells[static_cast<std::size_t>(cell)]));
    s.write(self.content, V((read + id + int(argument)) % 3));
  }
};
template <class V>
inline constexpr Fill<V> fill{};

// Points the other link to the same box.
template <class V>
struct Relink {
  static constexpr std::string_view kName = "relink";
  template <class S>
  void operator()(S& s, int from) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    s.write(w.links[static_cast<std::size_t>(1 - from)],
            s.read(w.links[static_cast<std::size_t>(from)]));
  }
};
template <class V>
inline constexpr Relink<V> relink{};

// `length` versions of a cell and those behind it, as the inputs will have it.
template <class V>
struct Stripe {
  static constexpr std::string_view kName = "stripe";
  template <class S>
  void operator()(S& s, int length, int cell) const;
};
template <class V>
inline constexpr Stripe<V> stripe{};

template <class V>
template <class S>
void Stripe<V>::operator()(S& s, int length, int cell) const {
  auto& w = s.template environment<RandomWorld<S, V>>();
  w.burn();
  const auto to = w.cells[static_cast<std::size_t>(cell)];
  const int said = int(s.read(w.inputs[static_cast<std::size_t>(length % w.program->kInputs)]));
  if ((said + length) % 3 == 0) s.write(to, V((int(s.read(to)) + length) % 7));
  if ((said + length) % 3 == 1) s.write(to, V(length % 4));
  if (length > 0) s.template tail<stripe<V>>(length - 1, cell);
}

template <class V>
struct Node {
  static constexpr std::string_view kName = "node";
  template <class S>
  void operator()(S& s, int id, V argument) const;
};

template <class V>
template <class S>
void Node<V>::operator()(S& s, int id, V argument) const {
  auto& w = s.template environment<RandomWorld<S, V>>();
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  const auto cell = [&](int i) { return w.cells[index(i)]; };
  w.burn();
  int sum = int(argument);
  int passed = 0;
  for (const Op& op : w.program->nodes[index(id)]) {
    if (sum % op.modulus >= op.threshold) continue;
    const int other = id + 1 + op.target;  // a node behind this one
    switch (op.kind) {
      case Op::read_input:
        sum += int(s.read(w.inputs[index(op.target)]));
        break;
      case Op::read_cell:
        sum += int(s.read(cell(op.target)));
        break;
      case Op::read_coarse:
        sum += int(s.read(w.coarse[index(op.target)])) / 2;
        break;
      case Op::read_link:
        if (const Box<S, V>* box = s.read(w.links[index(op.target)]); box != nullptr) {
          sum += int(s.read(box->content));
        }
        break;
      case Op::read_list: {
        const Image<S, V>* image = s.read(w.list);
        for (int i = 0; i < op.target && image != nullptr; ++i, image = s.read(image->next)) {
          sum += int(s.read(image->weight));
        }
        break;
      }
      case Op::rewrite_cell:
        s.write(cell(op.target), V(sum % 3));
        [[fallthrough]];
      case Op::write_cell:
        s.write(cell(op.target), V((sum + id) % 5));
        break;
      case Op::write_coarse:
        s.write(w.coarse[index(op.target)], V((sum + id) % 5));
        break;
      case Op::link:
        s.write(w.links[index(op.target)],
                &s.template make<Box<S, V>, fill<V>>(id, argument, op.target));
        break;
      case Op::ask:
        sum += int(s.template call<ask<V>>(argument, op.target));
        break;
      case Op::call:
        s.template call<node<V>>(other, V(sum % 3));
        break;
      case Op::pass: {
        auto own = s.template cell<V>(id, argument, passed++);
        s.write(own, V(sum % 4));
        s.template call<pass<V>>(own, op.target);
        break;
      }
      case Op::box: {
        auto& box = s.template make<Box<S, V>, fill<V>>(id, argument, op.target);
        s.template call<pass<V>>(typename S::template ModType<V>(box.content), op.target);
        break;
      }
      case Op::post:
        w.agenda_of(other).template post<node<V>>(s, node_key(other, sum % 3), other, V(sum % 3));
        break;
      case Op::stripe:
        s.template call<stripe<V>>(op.target / w.program->kCells, op.target % w.program->kCells);
        break;
      case Op::relink:
        s.template call<relink<V>>(op.target);
        break;
      case Op::tail:
        s.template tail<node<V>>(other, V(sum % 3));
        break;
      case Op::tail_box:
        s.template tail_make<Box<S, V>, fill<V>>(id, argument, op.target);
        break;
    }
  }
  w.burn();
}

// The program: all cells are written, three nodes are called, what they posted is run, a cell is
// passed on.
template <class V>
struct Root {
  static constexpr std::string_view kName = "root";
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    const int v = int(s.read(w.inputs[0]));
    for (const auto& c : w.cells) s.write(c, V(0));
    for (const auto& c : w.coarse) s.write(c, V(0));
    for (const auto& c : w.links) s.write(c, nullptr);
    for (int n = 0; n < 3; ++n) s.template call<node<V>>(n, V((v + n) % 2));
    if (v % 4 == 1) s.template call<node<V>>(3, V(7));
    if (v % 8 != 7) w.agendas[0]->drain(s);
    s.template call<pass<V>>(w.cells[0], 1 + v % 2);
    if (v % 8 != 6) w.agendas[1]->drain(s);
  }
};

// A run at the end.
template <class V>
struct Late {
  static constexpr std::string_view kName = "late";
  template <class S>
  void operator()(S& s, int n) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const auto cell = [&](int i) {
      return w.cells[static_cast<std::size_t>(i % w.program->kCells)];
    };
    const Image<S, V>* first = s.read(w.list);
    const int weight = first != nullptr ? int(s.read(first->weight)) : 0;
    s.write(cell(n + 1), V((int(s.read(cell(n))) + weight) % 7));
    s.template call<stripe<V>>(n % 8, n % w.program->kCells);
  }
};

}  // namespace support
