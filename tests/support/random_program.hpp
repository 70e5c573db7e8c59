// Programs for the engine that are data: the same text runs on sac::Scope and sac::PlainScope.
//
// A program is a table of nodes (program_text.hpp). A node, called with its number and a small
// argument, reads inputs, cells and lists, writes cells (several nodes and calls write one cell:
// imperative), asks and tells structures, asks for results, allocates, calls and posts nodes of
// higher number, drains agendas, fails, and goes on with a tail call. What it does depends on what
// it read. Reads and writes come before calls: a call's effects are at the place of the call. (A
// result that was asked for changes what the call does next, not what it wrote.)
//
// Around the nodes: a list of the outside is mapped before them; they are drained from two agendas,
// one after the other, each unless an input says no; more runs may follow at the end.
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "random_world.hpp"

namespace support {

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

// Returns what it reads, and goes on by a tail call, which writes.
template <class V>
struct Change {
  static constexpr std::string_view kName = "change";
  template <class S>
  void operator()(S& s, V by, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const auto to = w.cells[static_cast<std::size_t>(cell)];
    s.write(to, V((int(s.read(to)) + int(by) + 1) % 5));
    if (int(by) > 0) s.template tail<Change<V>{}>(V(int(by) - 1), cell);
  }
};
template <class V>
inline constexpr Change<V> change{};
template <class V>
struct Answer {
  static constexpr std::string_view kName = "answer";
  template <class S>
  V operator()(S& s, V argument, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.burn();
    const int read = int(s.read(w.cells[static_cast<std::size_t>(cell)]));
    s.template tail<change<V>>(V((read + int(argument)) % 3), cell);
    return V(read % 4);
  }
};
template <class V>
inline constexpr Answer<V> answer{};

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

// Writes a cell from a side agenda.
template <class V>
struct Mark {
  static constexpr std::string_view kName = "mark";
  static sac::Key key(int cell, int value) {
    return {.bucket = cell, .phase = kMarkLabel, .order = static_cast<std::uint64_t>(value)};
  }
  template <class S>
  void operator()(S& s, int agenda, int cell, V value) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.started(agenda, {kMarkLabel, cell, int(value)});
    s.write(w.cells[static_cast<std::size_t>(cell)], value);
  }
};
template <class V>
inline constexpr Mark<V> mark{};

// Writes a cell from a side agenda, at a key that the poster chooses.
template <class V>
struct Keyed {
  static constexpr std::string_view kName = "keyed";
  template <class S>
  void operator()(S& s, int agenda, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.started(agenda, {kKeyedLabel, cell, 0});
    const auto to = w.cells[static_cast<std::size_t>(cell / 2)];
    s.write(to, V((2 * int(s.read(to)) + cell) % 7));
  }
};
template <class V>
inline constexpr Keyed<V> keyed{};

// Writes a cell from a side agenda; its argument may not equal itself.
template <class V>
struct Real {
  static constexpr std::string_view kName = "real";
  template <class S>
  void operator()(S& s, int agenda, double value, int cell) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    const int whole = value > 0 ? static_cast<int>(value) : 0;
    w.started(agenda, {kRealLabel, whole, cell});
    s.write(w.cells[static_cast<std::size_t>(cell)], V(whole));
  }
};
template <class V>
inline constexpr Real<V> real{};

// Drains an agenda: 0: itself, 1: in a call of its own, 2: after posting on it.
template <class V>
struct DrainCall {
  static constexpr std::string_view kName = "drain call";
  template <class S>
  void operator()(S& s, int agenda, int how) const;
};
template <class V>
inline constexpr DrainCall<V> drain_call{};

template <class V>
template <class S>
void DrainCall<V>::operator()(S& s, int agenda, int how) const {
  auto& w = s.template environment<RandomWorld<S, V>>();
  w.burn();
  const std::size_t side = w.side(agenda);
  if (how == 1) return s.template call<drain_call<V>>(agenda, 0);
  if (how == 2) {
    w.template post<mark<V>>(s, side, {kMarkLabel, 0, 3}, Mark<V>::key(0, 3), 0, V(3));
  }
  w.drain(s, side);
}

// Drains an agenda, and returns what a cell holds then.
template <class V>
struct DrainAsk {
  static constexpr std::string_view kName = "drain and ask";
  template <class S>
  V operator()(S& s, int agenda, int cell) const {
    s.template environment<RandomWorld<S, V>>().burn();
    s.template call<drain_call<V>>(agenda, 0);
    return V(int(s.template call<ask<V>>(V(0), cell)));
  }
};
template <class V>
inline constexpr DrainAsk<V> drain_ask{};

// What a node does. A posted node does the same as one that is called.
template <class V>
struct Node {
  static constexpr std::string_view kName = "node";
  template <class S>
  void operator()(S& s, int id, V argument) const;

 private:
  // A number that is none, now and then.
  template <class S>
  static void post_real(S& s, RandomWorld<S, V>& w, int target, int sum) {
    const int cell = target / w.program->kSides;
    const double value = sum % 4 == 0 ? std::numeric_limits<double>::quiet_NaN() : sum % 4;
    if constexpr (!S::kTraced) {
      if (sum % 4 == 0) w.judge.refuse();
    }
    w.template post<real<V>>(s, w.side(target % w.program->kSides), {kRealLabel, sum % 4, cell},
                             {.phase = kRealLabel}, value, cell);
  }
};
template <class V>
inline constexpr Node<V> node{};

template <class V>
struct Posted {
  static constexpr std::string_view kName = "posted node";
  template <class S>
  void operator()(S& s, int agenda, int id, V argument) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    w.started(agenda, {kNodeLabel, id, int(argument)});
    node<V>(s, id, argument);
  }
};

// Does what a node does, once for all that ask; returns what a cell holds then.
template <class V>
struct Inquire {
  static constexpr std::string_view kName = "inquire";
  template <class S>
  V operator()(S& s, int id, V argument) const {
    auto& w = s.template environment<RandomWorld<S, V>>();
    node<V>(s, id, argument);
    return V(int(s.read(w.cells[static_cast<std::size_t>(id % w.program->kCells)])) % 4);
  }
};
template <class V>
inline constexpr Inquire<V> inquire{};

template <class V>
template <class S>
void Node<V>::operator()(S& s, int id, V argument) const {
  auto& w = s.template environment<RandomWorld<S, V>>();
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  const auto cell = [&](int i) { return w.cells[index(i)]; };
  w.burn();
  int sum = int(argument);
  int passed = 0;
  std::vector<int> seen{id, sum};
  for (const Op& op : w.program->nodes[index(id)]) {
    seen.push_back(sum);
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
        w.post_node(s, w.agenda_of(other), other, sum % 3);
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
      case Op::read_maybe:
        sum += int(w.read_maybe(s, op.target));
        break;
      case Op::catch_maybe:
        try {
          sum += int(w.read_maybe(s, op.target));
        } catch (const sac::UsageError&) {
          ++sum;
        }
        break;
      case Op::write_maybe:
        s.write(w.maybes[index(op.target)], V((sum + id) % 5));
        break;
      case Op::write_input:
        w.write_input(s, op.target, V(sum % 5));
        break;
      case Op::catch_write:
        try {
          w.write_input(s, op.target, V(sum % 5));
        } catch (const sac::UsageError&) {
          ++sum;
        }
        break;
      case Op::claim:
        sum += w.claims->claim(s, op.target) ? 1 : 0;
        break;
      case Op::count:
        w.counters[index(op.target / w.program->kKeys)]->add(s, op.target % w.program->kKeys,
                                                             1 + sum % 2);
        break;
      case Op::total:
        sum +=
            w.counters[index(op.target / w.program->kKeys)]->total(s, op.target % w.program->kKeys);
        break;
      case Op::mark: {
        const int to = op.target / w.program->kSides;
        w.template post<mark<V>>(s, w.side(op.target % w.program->kSides),
                                 {kMarkLabel, to, sum % 2}, Mark<V>::key(to, sum % 2), to,
                                 V(sum % 2));
        break;
      }
      case Op::post_side:
        w.post_node(s, w.side(op.target % w.program->kSides),
                    id + 1 + op.target / w.program->kSides, sum % 3);
        break;
      case Op::post_early:
        w.post_node(s, 0, other, sum % 3);
        break;
      case Op::drain:
        w.drain(s, w.side(op.target));
        break;
      case Op::drain_call: {
        const int which = op.target % w.program->kSides;
        const int how = op.target / w.program->kSides;
        if (how == 3) {
          sum += int(s.template call<drain_ask<V>>(which, 0));
        } else {
          s.template call<drain_call<V>>(which, how);
        }
        break;
      }
      case Op::tail_drain:
        s.template tail<drain_call<V>>(op.target, 0);
        break;
      case Op::keyed: {
        const int to = op.target / w.program->kSides;
        w.template post<keyed<V>>(
            s, w.side(op.target % w.program->kSides), {kKeyedLabel, to, 0},
            {.bucket = sum % 3, .phase = kKeyedLabel, .order = static_cast<std::uint64_t>(to)}, to);
        break;
      }
      case Op::real:
        post_real(s, w, op.target, sum);
        break;
      case Op::catch_real:
        try {
          post_real(s, w, op.target, sum);
        } catch (const sac::UsageError&) {
          ++sum;
        }
        break;
      case Op::fail:
        throw Refusal();
      case Op::catch_own:
        try {
          throw Refusal();
        } catch (const Refusal&) {
          ++sum;
        }
        break;
      case Op::catch_call:
        try {
          s.template call<node<V>>(other, V(sum % 3));
        } catch (const Refusal&) {
          w.caught();
        } catch (const sac::UsageError&) {
          w.caught();
        }
        break;
      case Op::misuse:
        w.misuse(s, op.target);
        break;
      case Op::catch_misuse:
        try {
          w.misuse(s, op.target);
        } catch (const sac::UsageError&) {
          ++sum;
        }
        break;
      case Op::answer:
        sum += int(s.template call<answer<V>>(argument, op.target));
        break;
      case Op::late_write:
        sum += int(s.read(cell(op.target)));
        s.write(cell(op.target), V((sum + id) % 5));
        break;
      case Op::query:
        sum += int(s.template query<inquire<V>>(other, V(sum % 2)));
        break;
      case Op::query_any:
        sum += int(s.template query<inquire<V>>(op.target, V(sum % 2)));
        break;
    }
  }
  seen.push_back(sum);
  w.executions.insert(std::move(seen));
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
    if (v % 8 != 7) w.drain(s, 0);
    s.template call<pass<V>>(w.cells[0], 1 + v % 2);
    if (v % 8 != 6) w.drain(s, 1);
  }
};

// A run at the end; from 16 on, it posts on a side agenda, drains it, or does both.
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
    if (n < 16) return;
    const std::size_t side = w.side(n % 2);
    if (n / 2 % 4 != 0) {
      w.template post<mark<V>>(s, side, {kMarkLabel, 1, 2}, Mark<V>::key(1, 2), 1, V(2));
    }
    if (n / 2 % 4 != 1) w.drain(s, side);
  }
};

}  // namespace support
