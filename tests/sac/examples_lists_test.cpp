// The list examples (sac/examples) under random edits.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "example_harness.hpp"
#include "list_filter.hpp"
#include "list_map.hpp"
#include "list_minimum.hpp"
#include "list_reverse.hpp"
#include "list_sum.hpp"

namespace {

using namespace support;
using namespace examples;

// Inputs and edits of programs on one list.
struct ListApp {
  struct Input {
    std::vector<Element> elements;
    std::uint32_t next_id = 1;
  };
  struct Edit {
    enum Kind { insert, erase } kind;
    int place;
    Element element;
  };

  static Element random_element(Random& random, std::uint32_t id) { return {random(40) - 20, id}; }
  static Input random_input(Random& random, int size) {
    Input input;
    for (int i = 0; i < size; ++i) {
      input.elements.push_back(random_element(random, input.next_id++));
    }
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    const int n = static_cast<int>(input.elements.size());
    if (n > 0 && random(2) == 0) {
      const int place = random(n);
      return {Edit::erase, place, input.elements[static_cast<std::size_t>(place)]};
    }
    return {Edit::insert, random(n + 1), random_element(random, input.next_id)};
  }
  static Edit inverse(const Input&, Edit edit) {
    edit.kind = edit.kind == Edit::insert ? Edit::erase : Edit::insert;
    return edit;
  }
  static void apply(Input& input, const Edit& edit) {
    const auto at = input.elements.begin() + edit.place;
    if (edit.kind == Edit::erase) {
      input.elements.erase(at);
    } else {
      input.elements.insert(at, edit.element);
      input.next_id = std::max(input.next_id, edit.element.id + 1);
    }
  }
};

// A list of the host's, edited by place.
template <class Host>
class HostList {
 public:
  using N = Node<ScopeOf<Host>>;

  HostList(Host& host, const std::vector<Element>& elements) : host_(host) {
    nodes_.push_back(&host_.template make<N>());
    host_.set(header()->next, static_cast<const N*>(nullptr));
    for (std::size_t i = 0; i < elements.size(); ++i) insert(i, elements[i]);
  }
  [[nodiscard]] const N* header() const { return nodes_.front(); }

  void edit(const ListApp::Edit& e) {
    const auto place = static_cast<std::size_t>(e.place);
    if (e.kind == ListApp::Edit::erase) {
      erase(place);
    } else {
      insert(place, e.element);
    }
  }

 private:
  void insert(std::size_t place, const Element& element) {
    N& node = host_.template make<N>();
    node.element = element;
    const N* const next = host_.get(nodes_[place]->next);
    host_.set(node.next, next);
    host_.set(nodes_[place]->next, static_cast<const N*>(&node));
    nodes_.insert(nodes_.begin() + static_cast<std::ptrdiff_t>(place) + 1, &node);
  }
  void erase(std::size_t place) {
    N& node = *nodes_[place + 1];
    const N* const next = host_.get(node.next);
    host_.set(nodes_[place]->next, next);
    nodes_.erase(nodes_.begin() + static_cast<std::ptrdiff_t>(place) + 1);
    if constexpr (ScopeOf<Host>::kTraced) host_.release(node);
  }

  Host& host_;
  std::vector<N*> nodes_;  // in the order of the list, the header first
};

// Programs from a list to a list; `f` writes the header, or with kFirst the first node.
template <auto f, bool kFirst, class Host>
class ListToList {
 public:
  using N = Node<ScopeOf<Host>>;

  ListToList(Host& host, const ListApp::Input& input)
      : host_(host), list_(host, input.elements), result_(host.template cell<const N*>()) {
    host.template run<f>(list_.header(), result_);
  }
  void edit(const ListApp::Edit& e) { list_.edit(e); }
  std::vector<Element> result() {
    const N* const node = host_.get(result_);
    if (!kFirst) return elements_behind(host_, node);
    if (node == nullptr) return {};
    std::vector<Element> elements = elements_behind(host_, node);
    elements.insert(elements.begin(), node->element);
    return elements;
  }

 private:
  Host& host_;
  HostList<Host> list_;
  NodeMod<ScopeOf<Host>> result_;
};

// Programs from a list to one value.
template <auto f, class Value, class Host>
class ListToValue {
 public:
  ListToValue(Host& host, const ListApp::Input& input)
      : host_(host), list_(host, input.elements), result_(host.template cell<Value>()) {
    host.template run<f>(list_.header(), result_);
  }
  void edit(const ListApp::Edit& e) { list_.edit(e); }
  Value result() { return host_.get(result_); }

 private:
  Host& host_;
  HostList<Host> list_;
  typename ScopeOf<Host>::template ModType<Value> result_;
};

struct MapApp : ListApp {
  static constexpr const char* kName = "list map";
  template <class Host>
  using World = ListToList<map_list, false, Host>;
  static std::vector<Element> oracle(const Input& input) {
    std::vector<Element> out;
    for (const Element& e : input.elements) out.push_back(image(e));
    return out;
  }
};

struct FilterApp : ListApp {
  static constexpr const char* kName = "list filter";
  template <class Host>
  using World = ListToList<filter_list, false, Host>;
  static std::vector<Element> oracle(const Input& input) {
    std::vector<Element> out;
    std::copy_if(input.elements.begin(), input.elements.end(), std::back_inserter(out), is_kept);
    return out;
  }
};

struct ReverseApp : ListApp {
  static constexpr const char* kName = "list reverse";
  template <class Host>
  using World = ListToList<reverse_list, true, Host>;
  static std::vector<Element> oracle(const Input& input) {
    return {input.elements.rbegin(), input.elements.rend()};
  }
};

struct SumApp : ListApp {
  static constexpr const char* kName = "list sum";
  template <class Host>
  using World = ListToValue<sum_list, Sum::Value, Host>;
  static std::int64_t oracle(const Input& input) {
    std::int64_t sum = 0;
    for (const Element& e : input.elements) sum += e.value;
    return sum;
  }
};

struct MinimumApp : ListApp {
  static constexpr const char* kName = "list minimum";
  template <class Host>
  using World = ListToValue<minimum_list, Minimum::Value, Host>;
  static int oracle(const Input& input) {
    const auto least = std::min_element(input.elements.begin(), input.elements.end());
    return least == input.elements.end() ? Minimum::kNone : least->value;
  }
};

}  // namespace

TEMPLATE_TEST_CASE("list examples run plainly give what naive programs give", "", MapApp, FilterApp,
                   ReverseApp, SumApp, MinimumApp) {
  check_example_plain<TestType>(100, 100);
}
