// The list programs as one writes them without an engine: loops over linked lists, new nodes from
// an arena or from malloc. The input stays as it is, as that of the examples does.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "../examples/list_filter.hpp"
#include "../examples/list_map.hpp"

namespace plain_lists {

using examples::Element;

struct Node {
  Element element;
  Node* next;
};

/// The next bytes of large blocks, which are kept when all nodes are freed.
class ArenaNodes {
 public:
  Node* make(const Element& element, Node* next = nullptr) {
    if (used_ == kBlock) {
      if (++block_ > blocks_.size()) {
        blocks_.push_back(std::make_unique_for_overwrite<Node[]>(kBlock));
      }
      used_ = 0;
    }
    Node* const node = &blocks_[block_ - 1][used_++];
    *node = {element, next};
    return node;
  }
  void clear() {
    block_ = 0;
    used_ = kBlock;
  }

 private:
  static constexpr std::size_t kBlock = 1 << 14;
  std::vector<std::unique_ptr<Node[]>> blocks_;
  std::size_t block_ = 0;  // number of blocks in use
  std::size_t used_ = kBlock;
};

/// One malloc a node.
class MallocNodes {
 public:
  MallocNodes() = default;
  MallocNodes(const MallocNodes&) = delete;
  MallocNodes& operator=(const MallocNodes&) = delete;
  ~MallocNodes() { clear(); }
  void clear() {
    while (last_ != nullptr) std::free(std::exchange(last_, last_->before));
  }
  Node* make(const Element& element, Node* next = nullptr) {
    last_ = ::new (std::malloc(sizeof(Owned))) Owned{{element, next}, last_};
    return &last_->node;
  }

 private:
  struct Owned {
    Node node;
    Owned* before;
  };
  Owned* last_ = nullptr;
};

/// Builds a list from its first node on.
template <class Nodes>
class Appender {
 public:
  explicit Appender(Nodes& nodes) : nodes_(nodes) {}
  void append(const Element& e) {
    Node* const node = nodes_.make(e);
    *end_ = node;
    end_ = &node->next;
  }
  void append_list(Node* list) { *end_ = list; }
  [[nodiscard]] Node* list() const { return first_; }

 private:
  Nodes& nodes_;
  Node* first_ = nullptr;
  Node** end_ = &first_;
};

template <class Nodes>
Node* map(Nodes& nodes, const Node* in) {
  Appender<Nodes> out(nodes);
  for (; in != nullptr; in = in->next) out.append(examples::image(in->element));
  return out.list();
}

template <class Nodes>
Node* filter(Nodes& nodes, const Node* in) {
  Appender<Nodes> out(nodes);
  for (; in != nullptr; in = in->next) {
    if (examples::is_kept(in->element)) out.append(in->element);
  }
  return out.list();
}

template <class Nodes>
Node* reverse(Nodes& nodes, const Node* in) {
  Node* out = nullptr;
  for (; in != nullptr; in = in->next) out = nodes.make(in->element, out);
  return out;
}

inline std::int64_t sum(const Node* in) {
  std::int64_t sum = 0;
  for (; in != nullptr; in = in->next) sum += in->element.value;
  return sum;
}

inline int minimum(const Node* in) {
  int least = std::numeric_limits<int>::max();
  for (; in != nullptr; in = in->next) least = std::min(least, in->element.value);
  return least;
}

/// `in` sorted, in front of `rest`.
template <class Nodes>
Node* quicksort(Nodes& nodes, const Node* in, Node* rest = nullptr) {
  while (in != nullptr) {
    const Element pivot = in->element;
    Appender<Nodes> less(nodes), greater(nodes);
    for (const Node* node = in->next; node != nullptr; node = node->next) {
      (node->element < pivot ? less : greater).append(node->element);
    }
    rest = nodes.make(pivot, quicksort(nodes, greater.list(), rest));
    in = less.list();
  }
  return rest;
}

template <class Nodes>
Node* merge(Nodes& nodes, Node* a, Node* b) {
  Appender<Nodes> out(nodes);
  while (a != nullptr && b != nullptr) {
    Node*& less = b->element < a->element ? b : a;
    out.append(less->element);
    less = less->next;
  }
  out.append_list(a != nullptr ? a : b);
  return out.list();
}

/// The first n elements of `in` sorted; `in` is behind them then.
template <class Nodes>
Node* mergesort(Nodes& nodes, const Node*& in, std::size_t n) {
  if (n == 0) return nullptr;
  if (n == 1) {
    Node* const one = nodes.make(in->element);
    in = in->next;
    return one;
  }
  Node* const a = mergesort(nodes, in, n / 2);
  Node* const b = mergesort(nodes, in, n - n / 2);
  return merge(nodes, a, b);
}

template <class Nodes>
Node* mergesort(Nodes& nodes, const Node* in) {
  std::size_t n = 0;
  for (const Node* node = in; node != nullptr; node = node->next) ++n;
  return mergesort(nodes, in, n);
}

}  // namespace plain_lists
