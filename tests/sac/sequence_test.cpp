// Sequences, and the operations on lists, under random edits.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <functional>
#include <iterator>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "example_harness.hpp"
#include "random.hpp"
#include "sac/sac.hpp"

namespace {

using sac::ElementId;
using support::Random;

// --- A sequence and its twin -------------------------------------------------------------------

struct Item {
  ElementId id;
  int value;
};
using Items = std::list<Item>;
using Numbers = std::vector<std::uint64_t>;

struct Edit {
  enum Kind { push_back, push_front, before, after, erase, set, bias } kind;
  ElementId at{};  // what the edit is about
  int value = 0;
};

// What programs work on. `bias` is a modifiable that functions read for themselves.
struct Input {
  Items items;
  std::uint64_t next_id = 1;
  int bias = 0;

  [[nodiscard]] Items::iterator find(ElementId id) {
    return std::find_if(items.begin(), items.end(), [&](const Item& i) { return i.id == id; });
  }
  void apply(const Edit& e) {
    const auto insert = [&](Items::iterator place) {
      items.insert(place, {ElementId{next_id++}, e.value});
    };
    switch (e.kind) {
      case Edit::push_back:
        return insert(items.end());
      case Edit::push_front:
        return insert(items.begin());
      case Edit::before:
        return insert(find(e.at));
      case Edit::after:
        return insert(std::next(find(e.at)));
      case Edit::erase:
        items.erase(find(e.at));
        return;
      case Edit::set:
        find(e.at)->value = e.value;
        return;
      case Edit::bias:
        bias = e.value;
        return;
    }
  }
};

int random_value(Random& random) { return random(40); }

Edit random_edit(Random& random, const Input& input) {
  const int value = random_value(random);
  if (random(8) == 0) return {Edit::bias, {}, random(6)};
  if (input.items.empty() || random(6) == 0) {
    return {random(2) == 0 ? Edit::push_back : Edit::push_front, {}, value};
  }
  const int place = random(static_cast<int>(input.items.size()));
  const ElementId at = std::next(input.items.begin(), place)->id;
  constexpr Edit::Kind kKinds[] = {Edit::before, Edit::after, Edit::erase, Edit::erase, Edit::set};
  return {kKinds[random(5)], at, value};
}

Input random_input(Random& random, int size) {
  Input input;
  for (int i = 0; i < size; ++i) input.apply({Edit::push_back, {}, random_value(random)});
  return input;
}

// What takes `e` back, which is made next; nothing if no edit does.
std::optional<Edit> inverse(Input input, const Edit& e) {
  if (e.kind == Edit::erase) return std::nullopt;  // the element that comes has another id
  if (e.kind == Edit::set) return Edit{Edit::set, e.at, input.find(e.at)->value};
  if (e.kind == Edit::bias) return Edit{Edit::bias, {}, input.bias};
  return Edit{Edit::erase, ElementId{input.next_id}, 0};
}

template <class Sequence>
void edit_sequence(Sequence& sequence, const Edit& e) {
  switch (e.kind) {
    case Edit::push_back:
      sequence.push_back(e.value);
      return;
    case Edit::push_front:
      sequence.push_front(e.value);
      return;
    case Edit::before:
      sequence.insert_before(e.at, e.value);
      return;
    case Edit::after:
      sequence.insert_after(e.at, e.value);
      return;
    case Edit::erase:
      sequence.erase(e.at);
      return;
    case Edit::set:
      sequence.set(e.at, e.value);
      return;
    case Edit::bias:
      return;  // not its matter
  }
}

// --- Functions for the operations ---------------------------------------------------------------

template <class S>
struct Environment {
  typename S::template ModType<int> bias;
  typename S::template ModType<std::uint64_t> digest;
};

int twice(int x) { return 2 * x; }
bool is_odd(int x) { return x % 2 != 0; }
// Few values, so that there are many ties.
struct LessCoarsely {
  static constexpr std::string_view kName = "less_coarsely";
  bool operator()(int a, int b) const { return a / 8 < b / 8; }
};
struct LessByRemainder {
  static constexpr std::string_view kName = "less_by_remainder";
  bool operator()(int a, int b) const { return a % 5 < b % 5; }
};

template <class S>
int bias_of(S& s) {
  return s.read(s.template environment<Environment<S>>().bias);
}
struct AddBias {
  static constexpr std::string_view kName = "add_bias";
  template <class S>
  int operator()(S& s, int x) const {
    return x % 3 == 0 ? x : x + bias_of(s);
  }
};
struct AddIdAndBias {
  static constexpr std::string_view kName = "add_id_and_bias";
  template <class S>
  std::uint64_t operator()(S& s, ElementId id, int x) const {
    return 1000 * id.value + static_cast<std::uint64_t>(x + bias_of(s));
  }
};
struct AboveBias {
  static constexpr std::string_view kName = "above_bias";
  template <class S>
  bool operator()(S& s, int x) const {
    return x % 6 > bias_of(s);
  }
};
struct LessWithBias {
  static constexpr std::string_view kName = "less_with_bias";
  template <class S>
  bool operator()(S& s, int a, int b) const {
    const int bias = bias_of(s);
    return (a + bias) % 7 < (b + bias) % 7;
  }
};
// x -> a x + b, composed: associative, and the order matters.
struct Affine {
  std::uint32_t a = 1, b = 0;
  Affine() = default;
  explicit Affine(int x)
      : a(static_cast<std::uint32_t>(2 * x + 1)), b(static_cast<std::uint32_t>(x)) {}
  friend bool operator==(const Affine&, const Affine&) = default;
};
struct Compose {
  static constexpr std::string_view kName = "compose";
  Affine operator()(const Affine& f, const Affine& g) const {
    Affine h;
    h.a = g.a * f.a;
    h.b = g.a * f.b + g.b;
    return h;
  }
};
struct AddWithBias {  // associative for every bias
  static constexpr std::string_view kName = "add_with_bias";
  template <class S>
  int operator()(S& s, int a, int b) const {
    return a + b + bias_of(s);
  }
};
struct Digest {
  static constexpr std::string_view kName = "digest";
  template <class S>
  void operator()(S& s, int x) const {
    const auto digest = s.template environment<Environment<S>>().digest;
    const std::uint64_t before = s.read(digest);
    s.write(digest, sac::mix(before + static_cast<std::uint64_t>(x)));
  }
};

// --- Programs, and what they should give ---------------------------------------------------------

template <class Value>
Numbers numbers_of(const std::list<std::pair<ElementId, Value>>& list) {
  Numbers numbers;
  for (const auto& [id, value] : list) {
    numbers.push_back(id.value);
    numbers.push_back(static_cast<std::uint64_t>(value));
  }
  return numbers;
}
Numbers numbers_of(const Items& items) {
  Numbers numbers;
  for (const Item& i : items) {
    numbers.push_back(i.id.value);
    numbers.push_back(static_cast<std::uint64_t>(i.value));
  }
  return numbers;
}

// A program says what it makes of a list, and a twin what that should be.
struct MapOfValue {
  static constexpr const char* kName = "map of the value";
  static auto make(auto& s, auto in) { return sac::map<&twice>(s, in); }
  static Items oracle(Items items, int) {
    for (Item& i : items) i.value *= 2;
    return items;
  }
};
struct MapInScope {
  static constexpr const char* kName = "map in a scope";
  static auto make(auto& s, auto in) { return sac::map<AddBias{}>(s, in); }
  static Items oracle(Items items, int bias) {
    for (Item& i : items) i.value += i.value % 3 == 0 ? 0 : bias;
    return items;
  }
};
struct Filter {
  static constexpr const char* kName = "filter";
  static auto make(auto& s, auto in) { return sac::filter<&is_odd>(s, in); }
  static Items oracle(Items items, int) {
    items.remove_if([](const Item& i) { return !is_odd(i.value); });
    return items;
  }
};
struct FilterInScope {
  static constexpr const char* kName = "filter in a scope";
  static auto make(auto& s, auto in) { return sac::filter<AboveBias{}>(s, in); }
  static Items oracle(Items items, int bias) {
    items.remove_if([&](const Item& i) { return i.value % 6 <= bias; });
    return items;
  }
};
struct Reverse {
  static constexpr const char* kName = "reverse";
  static auto make(auto& s, auto in) { return sac::reverse(s, in); }
  static Items oracle(Items items, int) {
    items.reverse();
    return items;
  }
};
struct Sort {
  static constexpr const char* kName = "sort";
  static auto make(auto& s, auto in) { return sac::sort<LessCoarsely{}>(s, in); }
  static Items oracle(Items items, int) {
    items.sort([](const Item& a, const Item& b) { return LessCoarsely{}(a.value, b.value); });
    return items;
  }
};
struct SortInScope {
  static constexpr const char* kName = "sort in a scope";
  static constexpr bool kMonotone = false;  // another bias is another order
  static auto make(auto& s, auto in) { return sac::sort<LessWithBias{}>(s, in); }
  static Items oracle(Items items, int bias) {
    items.sort(
        [&](const Item& a, const Item& b) { return (a.value + bias) % 7 < (b.value + bias) % 7; });
    return items;
  }
};
struct SortFilterMap {
  static constexpr const char* kName = "sort of filter of map";
  static auto make(auto& s, auto in) {
    return sac::sort<LessCoarsely{}>(s, sac::filter<&is_odd>(s, sac::map<AddBias{}>(s, in)));
  }
  static Items oracle(const Items& items, int bias) {
    return Sort::oracle(Filter::oracle(MapInScope::oracle(items, bias), bias), bias);
  }
};
struct SortOfSort {
  static constexpr const char* kName = "filter of sort of reverse of sort";
  static auto make(auto& s, auto in) {
    const auto backwards = sac::reverse(s, sac::sort<LessCoarsely{}>(s, in));
    return sac::filter<AboveBias{}>(s, sac::sort<LessByRemainder{}>(s, backwards));
  }
  static Items oracle(const Items& items, int bias) {
    Items out = Reverse::oracle(Sort::oracle(items, bias), bias);
    out.sort([](const Item& a, const Item& b) { return LessByRemainder{}(a.value, b.value); });
    return FilterInScope::oracle(out, bias);
  }
};
// Equal operations on different lists, different operations on one.
struct ManyOfOne {
  static constexpr const char* kName = "several operations on one list";
  static auto make(auto& s, auto in) {
    const auto a = sac::map<&twice>(s, in);
    const auto b = sac::map<&twice>(s, sac::map<AddBias{}>(s, in));
    const auto c = sac::sort<LessByRemainder{}>(s, sac::sort<LessCoarsely{}>(s, in));
    const auto d = sac::sort<LessCoarsely{}>(s, sac::sort<LessByRemainder{}>(s, in));
    static_cast<void>(sac::filter<&is_odd>(s, a));
    static_cast<void>(sac::filter<AboveBias{}>(s, c));
    static_cast<void>(sac::filter<&is_odd>(s, d));
    return sac::map<&twice>(s, b);
  }
  static Items oracle(const Items& items, int bias) {
    Items out = MapInScope::oracle(items, bias);
    for (Item& i : out) i.value *= 4;
    return out;
  }
};
struct MapWithIds {
  static constexpr const char* kName = "map with ids";
  static auto make(auto& s, auto in) { return sac::map<AddIdAndBias{}>(s, in); }
  static auto oracle(const Items& items, int bias) {
    std::list<std::pair<ElementId, std::uint64_t>> out;
    for (const Item& i : items) {
      out.emplace_back(i.id, 1000 * i.id.value + static_cast<std::uint64_t>(i.value + bias));
    }
    return out;
  }
};

// Lists of chunks have their elements' digests.
std::uint64_t digest_of(const std::vector<int>& chunk) {
  std::uint64_t digest = chunk.size();
  for (const int x : chunk) digest = sac::mix(digest + static_cast<std::uint64_t>(x));
  return digest;
}
template <int kMost>
struct Chunks {
  static constexpr const char* kName = "chunks";
  static auto make(auto& s, auto in) { return sac::map<&digest_of>(s, sac::chunks(s, in, kMost)); }
  static std::vector<std::pair<ElementId, std::vector<int>>> cut(const Items& items) {
    const auto lot = [](const Item& i) { return sac::mix(~i.id.value); };
    const std::vector<Item> all(items.begin(), items.end());
    std::vector<std::pair<ElementId, std::vector<int>>> chunks;
    for (std::size_t begin = 0; begin < all.size();) {
      std::size_t end = all.size();
      if (end - begin > kMost) {
        end = begin + (kMost + 1) / 2;
        for (std::size_t i = end; i <= begin + kMost; ++i) {
          if (lot(all[i]) < lot(all[end])) end = i;
        }
      }
      chunks.push_back({all[begin].id, {}});
      for (; begin < end; ++begin) chunks.back().second.push_back(all[begin].value);
    }
    return chunks;
  }
  static auto oracle(const Items& items, int) {
    std::list<std::pair<ElementId, std::uint64_t>> out;
    for (const auto& [id, chunk] : cut(items)) out.emplace_back(id, digest_of(chunk));
    return out;
  }
};

// A grid whose borders tell all that precedes.
struct Weave {
  using Across = std::uint64_t;
  using Down = std::pair<std::uint64_t, int>;
  static Across left(const std::vector<int>& row) { return digest_of(row); }
  static Down above(const std::vector<int>& column) { return {1, static_cast<int>(column.size())}; }
  static void weave(const std::vector<int>& row, const std::vector<int>& column, int bias,
                    Across& left, Down& above) {
    left = sac::mix(left + 3 * above.first + digest_of(column));
    above = {sac::mix(above.first ^ (left + digest_of(row))), above.second + bias};
  }
  static void block(auto& s, const std::vector<int>& row, const std::vector<int>& column,
                    Across& left, Down& above) {
    weave(row, column, column[0] % 4 == 0 ? bias_of(s) : 1, left, above);
  }
};
struct OtherWeave : Weave {};
struct WovenBelow {
  static constexpr std::string_view kName = "woven_below";
  std::uint64_t operator()(auto& s, const auto& column) const {
    const auto& [digest, sum] = s.read(column.border);
    return digest + static_cast<std::uint64_t>(sum);
  }
};
struct Grid {
  static constexpr const char* kName = "grid";
  static auto make(auto& s, auto in) {
    const auto rows = sac::chunks(s, sac::filter<&is_odd>(s, in), 20);
    const auto columns = sac::chunks(s, in, 33);
    static_cast<void>(sac::grid<OtherWeave>(s, rows, columns));  // does not disturb
    return sac::map<WovenBelow{}>(s, sac::grid<Weave>(s, rows, columns));
  }
  static auto oracle(const Items& items, int bias) {
    const auto rows = Chunks<20>::cut(Filter::oracle(items, bias));
    const auto columns = Chunks<33>::cut(items);
    std::vector<Weave::Down> below;
    for (const auto& [id, column] : columns) below.push_back(Weave::above(column));
    for (const auto& [id, row] : rows) {
      Weave::Across left = Weave::left(row);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto& column = columns[i].second;
        Weave::weave(row, column, column[0] % 4 == 0 ? bias : 1, left, below[i]);
      }
    }
    std::list<std::pair<ElementId, std::uint64_t>> out;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      out.emplace_back(columns[i].first,
                       below[i].first + static_cast<std::uint64_t>(below[i].second));
    }
    return out;
  }
};

// From a list to numbers.
struct Reductions {
  static constexpr const char* kName = "reductions";
  static Numbers make(auto& s, auto in) {
    const Affine composed = sac::fetch(s, sac::reduce<Compose{}>(s, in, Affine()));
    const std::int64_t sum = sac::fetch(s, sac::reduce<std::plus<>{}>(s, in, std::int64_t{-7}));
    const std::int64_t twice_sum =
        sac::fetch(s, sac::map_reduce<&twice, std::plus<>{}>(s, in, std::int64_t{0}));
    const int biased = sac::fetch(s, sac::reduce<AddWithBias{}>(s, in, 1));
    const int other = sac::fetch(s, sac::map_reduce<AddBias{}, AddWithBias{}>(s, in, 1));
    const std::size_t count = sac::fetch(s, sac::size(s, in));
    const auto* found = sac::fetch(s, sac::find_if<AboveBias{}>(s, in));
    Numbers numbers{composed.a,
                    composed.b,
                    static_cast<std::uint64_t>(sum),
                    static_cast<std::uint64_t>(twice_sum),
                    static_cast<std::uint64_t>(biased),
                    static_cast<std::uint64_t>(other),
                    count};
    numbers.push_back(found == nullptr ? 0 : found->id().value);
    return numbers;
  }
  static Numbers oracle(const Items& items, int bias) {
    Affine composed;
    std::int64_t sum = -7, twice_sum = 0;
    int biased = 1, other = 1;
    std::uint64_t found = 0;
    for (const Item& i : items) {
      composed = Compose{}(composed, Affine(i.value));
      sum += i.value;
      twice_sum += 2 * i.value;
      biased += i.value + bias;
      other += i.value + (i.value % 3 == 0 ? 0 : bias) + bias;
      if (found == 0 && i.value % 6 > bias) found = i.id.value;
    }
    return {composed.a,
            composed.b,
            static_cast<std::uint64_t>(sum),
            static_cast<std::uint64_t>(twice_sum),
            static_cast<std::uint64_t>(biased),
            static_cast<std::uint64_t>(other),
            items.size(),
            found};
  }
};
struct DigestOfAll {
  static constexpr const char* kName = "for_each";
  static Numbers make(auto& s, auto in) {
    using S = std::decay_t<decltype(s)>;
    const auto digest = s.template environment<Environment<S>>().digest;
    s.write(digest, std::uint64_t{1});
    sac::for_each<Digest{}>(s, in);
    return {sac::fetch(s, digest)};
  }
  static Numbers oracle(const Items& items, int) {
    std::uint64_t digest = 1;
    for (const Item& i : items) digest = sac::mix(digest + static_cast<std::uint64_t>(i.value));
    return {digest};
  }
};

// --- Programs on a host --------------------------------------------------------------------------

template <class P>
struct Root {
  template <class S, class Out>
  void operator()(S& s, sac::List<int, S> in, Out out) const {
    s.write(out, P::make(s, in));
  }
};

template <class P, class Host>
class World {
 public:
  using S = sac::ScopeOf<Host>;
  using Result = decltype(P::make(std::declval<S&>(), std::declval<sac::List<int, S>>()));

  World(Host& host, const Input& input) : host_(host), sequence_(host, saved(input)) {
    environment_.bias = host.template input<int>(input.bias);
    environment_.digest = host.template cell<std::uint64_t>();
    host.set_environment(&environment_);
    host.template run<Root<P>{}>(sequence_.list(), result_);
  }
  void edit(const Edit& e) {
    if (e.kind == Edit::bias) return host_.set(environment_.bias, e.value);
    edit_sequence(sequence_, e);
  }
  Numbers result() {
    sequence_.check_invariants();
    if constexpr (std::is_same_v<Result, Numbers>) {
      return host_.get(result_);
    } else {
      Numbers numbers;
      for (const auto& e : host_.get(result_).view(host_)) {
        numbers.push_back(e.id().value);
        numbers.push_back(static_cast<std::uint64_t>(e.value()));
      }
      return numbers;
    }
  }
  sac::Sequence<int, Host>& sequence() { return sequence_; }

 private:
  static auto saved(const Input& input) {
    std::vector<typename sac::Sequence<int, Host>::Saved> elements;
    for (const Item& i : input.items) elements.push_back({i.id, i.value});
    return elements;
  }

  Host& host_;
  sac::Sequence<int, Host> sequence_;
  Environment<S> environment_;
  typename S::template ModType<Result> result_ = host_.template cell<Result>();
};

template <class P>
struct App {
  static constexpr const char* kName = P::kName;
  using Input = ::Input;
  template <class Host>
  using World = ::World<P, Host>;
  static Numbers oracle(const Input& input) {
    if constexpr (std::is_same_v<decltype(P::oracle(input.items, 0)), Numbers>) {
      return P::oracle(input.items, input.bias);
    } else {
      return numbers_of(P::oracle(input.items, input.bias));
    }
  }
};

template <class P>
concept NotMonotone = requires {
  P::kMonotone;
};

// Random edits; after every propagation all that example_harness.hpp knows is checked.
template <class P>
void check_program(std::uint64_t seed, int size, int steps) {
  CAPTURE(P::kName, seed, size);
  Random random(seed);
  Input input = random_input(random, size);
  sac::Engine engine;
  engine.set_audit(!NotMonotone<P>);
  World<P, sac::Engine> world(engine, input);
  const auto edit = [&](const Edit& e) {
    input.apply(e);
    world.edit(e);
  };
  const auto fault = [&] {
    engine.propagate();
    REQUIRE(world.sequence().size() == input.items.size());
    return support::example::traced_fault<App<P>>(engine, world, input);
  };
  REQUIRE(support::example::traced_fault<App<P>>(engine, world, input) == "");
  for (int step = 0; step < steps; ++step) {
    CAPTURE(step);
    for (int k = 1 + random(3); k > 0; --k) edit(random_edit(random, input));
    REQUIRE(fault() == "");
    const std::string before = support::example::sizes(engine);
    const Edit there = random_edit(random, input);
    const std::optional<Edit> back = inverse(input, there);
    edit(there);
    REQUIRE(fault() == "");
    if (!back) continue;
    edit(*back);
    REQUIRE(fault() == "");
    REQUIRE(support::example::sizes(engine) == before);
  }
}

}  // namespace

#define LIST_PROGRAMS                                                                    \
  MapOfValue, MapInScope, MapWithIds, Filter, FilterInScope, Reverse, Sort, SortInScope, \
      SortFilterMap, SortOfSort, ManyOfOne, Chunks<1>, Chunks<7>, Grid, Reductions, DigestOfAll

TEMPLATE_TEST_CASE("operations on a sequence follow random edits as if run from scratch", "",
                   LIST_PROGRAMS) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    check_program<TestType>(seed, static_cast<int>(seed * seed / 4), 8);
  }
}

TEMPLATE_TEST_CASE("operations on a long sequence follow random edits", "", LIST_PROGRAMS) {
  check_program<TestType>(100, 5000, 3);
}

TEMPLATE_TEST_CASE("operations on a sequence follow many random edits", "[.soak]", LIST_PROGRAMS) {
  for (std::uint64_t seed = 1000; seed < 2000; ++seed) {
    check_program<TestType>(seed, static_cast<int>(seed % 400), 20);
  }
}

namespace {

void empty_chunks(sac::Scope& s, sac::List<int> list) {
  static_cast<void>(sac::chunks(s, list, 0));
}
void negative_band(sac::Scope& s, sac::List<int> list) {
  const auto chunks = sac::chunks(s, list, 2);
  static_cast<void>(sac::grid<Weave>(s, chunks, chunks, -1));
}
void band_without_rise(sac::Scope& s, sac::List<int> list) {
  const auto chunks = sac::chunks(s, list, 2);
  static_cast<void>(sac::grid<Weave>(s, chunks, chunks, 9));
}

}  // namespace

TEST_CASE("chunks without elements, and bands that a grid cannot have, are refused") {
  sac::Engine engine;
  sac::Sequence<int> numbers(engine, {1, 2, 3});
  CHECK_THROWS_AS(engine.run<empty_chunks>(numbers.list()), sac::UsageError);
  CHECK_THROWS_AS(engine.run<negative_band>(numbers.list()), sac::UsageError);
  CHECK_THROWS_AS(engine.run<band_without_rise>(numbers.list()), sac::UsageError);
  CHECK(engine.live_calls() == 0);
}
