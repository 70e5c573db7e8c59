// The engine's examples, recorded: their traces have names throughout, propagated traces are those
// of fresh runs, and work follows the distance [Theorem 1.4.4].
#include <catch2/catch.hpp>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "list_filter.hpp"
#include "list_map.hpp"
#include "list_reverse.hpp"
#include "mergesort.hpp"
#include "quicksort.hpp"
#include "traces/recorder.hpp"
#include "traces/stability.hpp"

namespace {

using examples::Element;
using Node = examples::Node<sac::Scope>;

// A program on a list, in an engine of its own.
template <auto Program>
class ListRun {
 public:
  explicit ListRun(const std::vector<Element>& elements) {
    nodes_.push_back(&make({}));
    for (std::size_t i = 0; i < elements.size(); ++i) link(i, elements[i]);
    const auto result = engine_.template cell<const Node*>();
    recorder_.name(result, "result");
    engine_.template run<Program>(static_cast<const Node*>(nodes_[0]), result);
  }
  sac::Counts insert(std::size_t place, const Element& element) {
    link(place, element);
    return engine_.propagate();
  }
  sac::Counts erase(std::size_t place) {
    engine_.set(nodes_[place]->next, engine_.get(nodes_[place + 1]->next));
    nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(place) + 1);
    return engine_.propagate();
  }
  [[nodiscard]] traces::Trace trace() const { return recorder_.trace(); }

 private:
  Node& make(const Element& element) {
    Node& node = engine_.template make<Node>();
    node.element = element;
    engine_.set(node.next, static_cast<const Node*>(nullptr));
    recorder_.name(&node, "node", element.id);
    return node;
  }
  void link(std::size_t place, const Element& element) {
    Node& node = make(element);
    engine_.set(node.next, engine_.get(nodes_[place]->next));
    engine_.set(nodes_[place]->next, static_cast<const Node*>(&node));
    nodes_.insert(nodes_.begin() + static_cast<std::ptrdiff_t>(place) + 1, &node);
  }

  sac::Engine engine_;
  traces::Recorder recorder_{engine_};
  std::vector<Node*> nodes_;  // the header first
};

// The same under random insertions and deletions.
template <auto Program>
class ListSubject final : public traces::Subject {
 public:
  ListSubject(std::uint32_t size, unsigned seed)
      : random_(seed), elements_(random_elements(size)), run_(elements_) {}

  Edit edit() override {
    const bool erases = !elements_.empty() && random_() % 2 == 0;
    const std::size_t place = random_() % (elements_.size() + (erases ? 0 : 1));
    const auto at = elements_.begin() + static_cast<std::ptrdiff_t>(place);
    if (erases) {
      elements_.erase(at);
      return {run_.erase(place), {}};
    }
    const Element element = random_element();
    elements_.insert(at, element);
    return {run_.insert(place, element), {}};
  }
  [[nodiscard]] traces::Trace trace() const override { return run_.trace(); }
  [[nodiscard]] traces::Trace fresh_trace() const override {
    return ListRun<Program>(elements_).trace();
  }

 private:
  Element random_element() { return {static_cast<int>(random_() % 1000), ++last_id_}; }
  std::vector<Element> random_elements(std::uint32_t size) {
    std::vector<Element> elements;
    while (elements.size() < size) elements.push_back(random_element());
    return elements;
  }

  std::mt19937 random_;
  std::uint32_t last_id_ = 0;
  std::vector<Element> elements_;
  ListRun<Program> run_;
};

template <auto Program>
void check_example(const std::string& name, double bound) {
  const unsigned seed = std::random_device{}();
  for (const std::uint32_t size : {0u, 3u, 60u}) {
    ListSubject<Program> subject(size, seed);
    for (const traces::StabilityRow& row : traces::stability(subject, 40)) {
      INFO(name << ", size " << size << ", seed " << seed);
      REQUIRE(row.drift == 0);
      CAPTURE(row.work(), row.distance);
      REQUIRE(row.ratio() <= bound);
    }
  }
}

}  // namespace

TEST_CASE("Examples: propagated traces are fresh ones, and work follows distance [Thm 1.4.4]") {
  check_example<examples::map_list>("map", 2);
  check_example<examples::filter_list>("filter", 2);
  check_example<examples::reverse_list>("reverse", 2);
  check_example<examples::quicksort>("quicksort", 2);
  check_example<examples::mergesort>("mergesort", 2);
}
