// The examples on lists, arrays and points (sac/examples), as Apps (app.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "../array_map.hpp"
#include "../diameter.hpp"
#include "../distance.hpp"
#include "../list_filter.hpp"
#include "../list_map.hpp"
#include "../list_minimum.hpp"
#include "../list_reverse.hpp"
#include "../list_sum.hpp"
#include "../mergesort.hpp"
#include "../mergesort_elements.hpp"
#include "../quickhull.hpp"
#include "../quicksort.hpp"
#include "../quicksort_elements.hpp"
#include "app.hpp"

namespace apps {

using namespace examples;

inline Element random_value(Random& random, std::uint32_t id) { return {random(40) - 20, id}; }
// Few places, so that many points share one or lie on a line.
inline Point random_point(Random& random, std::uint32_t id, int from_x, int size) {
  return {from_x + random(size), random(size), id};
}

template <class T>
struct ListEdit {
  enum Kind { insert, erase } kind;
  int place;
  T element;
};

// Inputs and edits of programs on one list; `element(Random&, id)` is a random element.
template <class T, auto element>
struct ListApp {
  struct Input {
    std::vector<T> elements;
    std::uint32_t next_id = 1;
  };
  using Edit = ListEdit<T>;

  static Input random_input(Random& random, int size) {
    Input input;
    for (int i = 0; i < size; ++i) input.elements.push_back(element(random, input.next_id++));
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    const int n = static_cast<int>(input.elements.size());
    if (n > 0 && random(2) == 0) {
      const int place = random(n);
      return {Edit::erase, place, input.elements[static_cast<std::size_t>(place)]};
    }
    return {Edit::insert, random(n + 1), element(random, input.next_id)};
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
      ++input.next_id;
    }
  }
};
using ElementApp = ListApp<Element, random_value>;

// A list of the host's, edited by place.
template <class Host, class T>
class HostList {
 public:
  using N = Node<ScopeOf<Host>, T>;

  HostList(Host& host, const std::vector<T>& elements) : host_(host) {
    nodes_.push_back(&host_.template make<N>());
    host_.set(header()->next, static_cast<const N*>(nullptr));
    for (std::size_t i = 0; i < elements.size(); ++i) insert(i, elements[i]);
  }
  [[nodiscard]] const N* header() const { return nodes_.front(); }
  template <class Recorder>
  void name(Recorder& recorder, const char* node_name = "node") const {
    for (const N* node : nodes_) recorder.name(node, node_name, node->element.id);
  }

  void edit(const ListEdit<T>& e) {
    const auto place = static_cast<std::size_t>(e.place);
    if (e.kind == ListEdit<T>::erase) {
      erase(place);
    } else {
      insert(place, e.element);
    }
  }

 private:
  void insert(std::size_t place, const T& element) {
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

// Programs from a list to one value.
template <auto f, class T, class Value, class Host>
class ListToValue {
 public:
  template <class Input>
  ListToValue(Host& host, const Input& input)
      : host_(host), list_(host, input.elements), result_(host.template cell<Value>()) {
    host.template run<f>(list_.header(), result_);
  }
  void edit(const ListEdit<T>& e) { list_.edit(e); }
  template <class Recorder>
  void name(Recorder& recorder) const {
    list_.name(recorder);
    recorder.name(result_, "result");
  }
  Value result() { return host_.get(result_); }

 private:
  Host& host_;
  HostList<Host, T> list_;
  typename ScopeOf<Host>::template ModType<Value> result_;
};

// Programs from a list to a list; `f` writes the header, or with kFirst the first node.
template <auto f, bool kFirst, class Host>
class ListToList : public ListToValue<f, Element, const Node<ScopeOf<Host>>*, Host> {
  using N = Node<ScopeOf<Host>>;
  using Base = ListToValue<f, Element, const N*, Host>;

 public:
  ListToList(Host& host, const ElementApp::Input& input) : Base(host, input), host_(host) {}
  std::vector<Element> result() {
    const N* const node = Base::result();
    if (!kFirst) return elements_behind(host_, node);
    if (node == nullptr) return {};
    std::vector<Element> elements = elements_behind(host_, node);
    elements.insert(elements.begin(), node->element);
    return elements;
  }

 private:
  Host& host_;
};

struct MapApp : ElementApp {
  static constexpr const char* kName = "list map";
  template <class Host>
  using World = ListToList<map_list, false, Host>;
  static std::vector<Element> oracle(const Input& input) {
    std::vector<Element> out;
    for (const Element& e : input.elements) out.push_back(image(e));
    return out;
  }
};

struct FilterApp : ElementApp {
  static constexpr const char* kName = "list filter";
  template <class Host>
  using World = ListToList<filter_list, false, Host>;
  static std::vector<Element> oracle(const Input& input) {
    std::vector<Element> out;
    std::copy_if(input.elements.begin(), input.elements.end(), std::back_inserter(out), is_kept);
    return out;
  }
};

struct ReverseApp : ElementApp {
  static constexpr const char* kName = "list reverse";
  template <class Host>
  using World = ListToList<reverse_list, true, Host>;
  static std::vector<Element> oracle(const Input& input) {
    return {input.elements.rbegin(), input.elements.rend()};
  }
};

struct SumApp : ElementApp {
  static constexpr const char* kName = "list sum";
  template <class Host>
  using World = ListToValue<sum_list, Element, Sum::Value, Host>;
  static std::int64_t oracle(const Input& input) {
    std::int64_t sum = 0;
    for (const Element& e : input.elements) sum += e.value;
    return sum;
  }
};

struct MinimumApp : ElementApp {
  static constexpr const char* kName = "list minimum";
  template <class Host>
  using World = ListToValue<minimum_list, Element, Minimum::Value, Host>;
  static int oracle(const Input& input) {
    const auto least = std::min_element(input.elements.begin(), input.elements.end());
    return least == input.elements.end() ? Minimum::kNone : least->value;
  }
};

struct SortApp : ElementApp {
  static std::vector<Element> oracle(Input input) {
    std::sort(input.elements.begin(), input.elements.end());
    return input.elements;
  }
};

struct QuicksortApp : SortApp {
  static constexpr const char* kName = "quicksort";
  template <class Host>
  using World = ListToList<quicksort, false, Host>;
};

struct MergesortApp : SortApp {
  static constexpr const char* kName = "mergesort";
  template <class Host>
  using World = ListToList<mergesort, false, Host>;
};

struct QuicksortElementsApp : SortApp {
  static constexpr const char* kName = "quicksort by elements";
  template <class Host>
  using World = ListToList<quicksort_elements, false, Host>;
};

struct MergesortElementsApp : SortApp {
  static constexpr const char* kName = "mergesort by elements";
  template <class Host>
  using World = ListToList<mergesort_elements, false, Host>;
};

// --- Arrays ----------------------------------------------------------------------------------

struct ArrayApp {
  static constexpr const char* kName = "array map";
  using Input = std::vector<int>;
  struct Edit {
    std::size_t place;
    int value;
  };

  static Input random_input(Random& random, int size) {
    Input input;
    for (int i = 0; i <= size; ++i) input.push_back(random(100));
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    return {static_cast<std::size_t>(random(static_cast<int>(input.size()))), random(100)};
  }
  static Edit inverse(const Input& input, const Edit& e) { return {e.place, input[e.place]}; }
  static void apply(Input& input, const Edit& e) { input[e.place] = e.value; }
  static std::vector<int> oracle(const Input& input) {
    std::vector<int> out;
    for (const int x : input) out.push_back(image(x));
    return out;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input) : host_(host) {
      for (const int x : input) {
        array_.in.push_back(host_.template input<int>(x));
        array_.out.push_back(host_.template cell<int>());
      }
      host_.set_environment(&array_);
      host_.template run<map_array>();
    }
    void edit(const Edit& e) { host_.set(array_.in[e.place], e.value); }
    template <class Recorder>
    void name(Recorder& recorder) const {
      name_all(recorder, array_.in, "in");
      name_all(recorder, array_.out, "out");
    }
    std::vector<int> result() {
      std::vector<int> values;
      for (const auto& mod : array_.out) values.push_back(host_.get(mod));
      return values;
    }

   private:
    Host& host_;
    Array<ScopeOf<Host>> array_;
  };
};

// --- Hulls -----------------------------------------------------------------------------------

inline Point any_point(Random& random, std::uint32_t id) { return random_point(random, id, 0, 12); }
inline Point spread_point(Random& random, std::uint32_t id) {
  return random_point(random, id, 0, 2000);
}

// Andrew's monotone chain: corners only, clockwise, from the leftmost.
inline std::vector<Point> naive_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end(), same_place), points.end());
  if (points.size() < 2) return points;
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 && left_of(hull[hull.size() - 2], hull.back(), p) >= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

template <auto element>
struct QuickhullApp : ListApp<Point, element> {
  using typename ListApp<Point, element>::Input;
  static constexpr const char* kName = "quickhull";
  static std::vector<Point> oracle(const Input& input) { return naive_hull(input.elements); }

  template <class Host>
  class World : ListToValue<quickhull, Point, Hull<ScopeOf<Host>>, Host> {
    using Base = ListToValue<quickhull, Point, Hull<ScopeOf<Host>>, Host>;

   public:
    World(Host& host, const Input& input) : Base(host, input), host_(host) {}
    using Base::edit;
    using Base::name;
    std::vector<Point> result() { return corners_of(host_, Base::result()); }

   private:
    Host& host_;
  };
};

template <auto element>
struct DiameterApp : ListApp<Point, element> {
  using typename ListApp<Point, element>::Input;
  static constexpr const char* kName = "diameter";
  template <class Host>
  using World = ListToValue<diameter, Point, std::int64_t, Host>;
  static std::int64_t oracle(const Input& input) {
    std::int64_t most = 0;
    for (const Point& p : input.elements) {
      for (const Point& q : input.elements) most = std::max(most, squared_distance(p, q));
    }
    return most;
  }
};

// Two sets of points, one to the left of the other; their ids differ.
template <int size>
struct DistanceApp {
  static Point left(Random& random, std::uint32_t id) { return random_point(random, id, 0, size); }
  static Point right(Random& random, std::uint32_t id) {
    return random_point(random, (1u << 30) + id, size, size);
  }
  using Left = ListApp<Point, left>;
  using Right = ListApp<Point, right>;
  static constexpr const char* kName = "distance";
  struct Input {
    typename Left::Input left;
    typename Right::Input right;
  };
  struct Edit {
    bool is_left;
    ListEdit<Point> edit;
  };

  static Input random_input(Random& random, int n) {
    const int some = random(n + 1);
    return {Left::random_input(random, some), Right::random_input(random, n - some)};
  }
  static Edit random_edit(Random& random, const Input& input) {
    if (random(2) == 0) return {true, Left::random_edit(random, input.left)};
    return {false, Right::random_edit(random, input.right)};
  }
  static Edit inverse(const Input& input, const Edit& e) {
    return {e.is_left, Left::inverse(input.left, e.edit)};
  }
  static void apply(Input& input, const Edit& e) {
    if (e.is_left) {
      Left::apply(input.left, e.edit);
    } else {
      Right::apply(input.right, e.edit);
    }
  }
  static double oracle(const Input& input) {
    const std::vector<Point> a = naive_hull(input.left.elements);
    const std::vector<Point> b = naive_hull(input.right.elements);
    double least = std::numeric_limits<double>::infinity();
    const auto from = [&](const std::vector<Point>& corners, const std::vector<Point>& hull) {
      for (const Point& p : corners) {
        for (std::size_t i = 0; i < hull.size(); ++i) {
          least = std::min(least, squared_distance(p, hull[i], hull[(i + 1) % hull.size()]));
        }
      }
    };
    from(a, b);
    from(b, a);
    return least;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host),
          left_(host, input.left.elements),
          right_(host, input.right.elements),
          result_(host.template cell<double>()) {
      host.template run<distance>(left_.header(), right_.header(), result_);
    }
    void edit(const Edit& e) { (e.is_left ? left_ : right_).edit(e.edit); }
    template <class Recorder>
    void name(Recorder& recorder) const {
      left_.name(recorder, "left");
      right_.name(recorder, "right");
      recorder.name(result_, "result");
    }
    double result() { return host_.get(result_); }

   private:
    Host& host_;
    HostList<Host, Point> left_, right_;
    typename ScopeOf<Host>::template ModType<double> result_;
  };
};

}  // namespace apps
