// Operations on a sac::Sequence: what a trace costs, what an edit; and the same programs as written
// by hand in sac/examples.
//
//   sequence_bench [OPERATION|all [N...]]     default: all, lists at 10^4, 10^5, 10^6, sort at
//                                             10^4, 10^5
//
// One JSON line per operation, size and form, "sequence" or "example":
//   from_scratch_ms   processor time of the first run, median of 3
//   static_ms         the same text on a sac::PlainScope, median of 3
//   update_us         processor time of an edit and its propagation: a random element goes, and
//                     comes back (in a sequence, another in its place); mean of 20000
//   work              calls executed, created and discarded in an update, mean
//   bytes             of trace and values per element, without the inputs
// and one with the ratios of the two. Operation `edits` measures the sequence alone:
//   push_back_ns, insert_erase_ns, set_ns     an edit and its part of the propagation, without a
//                     program; input_bytes    of the engine per element
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../examples/list_filter.hpp"
#include "../examples/list_map.hpp"
#include "../examples/list_reverse.hpp"
#include "../examples/list_sum.hpp"
#include "../examples/mergesort.hpp"
#include "bench_help.hpp"
#include "bench_support.hpp"
#include "sac/sac.hpp"

namespace {

using bench::cpu_nanoseconds;
using bench::median;

constexpr int kUpdates = 10000;  // pairs of edits

std::vector<int> random_values(std::size_t n) {
  bench::Random random;
  std::vector<int> values;
  while (values.size() < n) values.push_back(static_cast<int>(random.next() >> 33));
  return values;
}

// --- The two forms ---------------------------------------------------------------------------

// A program on a list of the example's, whose elements are taken out and put back.
template <class App, class Host>
class ExampleForm {
 public:
  using S = sac::ScopeOf<Host>;
  using N = examples::Node<S>;
  using Result = typename App::template ExampleResult<S>;

  explicit ExampleForm(const std::vector<int>& values) {
    for (std::size_t i = 0; i <= values.size(); ++i) {
      nodes_.push_back(&host_.template make<N>());
      if (i > 0) nodes_[i]->element = {values[i - 1], static_cast<std::uint32_t>(i)};
    }
    for (std::size_t i = 0; i <= values.size(); ++i) link(i, i + 1);
    result_ = host_.template cell<Result>();
  }
  void run() { host_.template run<App::example>(static_cast<const N*>(nodes_[0]), result_); }
  void take_out(std::size_t i) { link(i, i + 2); }
  void put_back(std::size_t i) { link(i, i + 1); }
  [[nodiscard]] Host& host() { return host_; }

 private:
  void link(std::size_t i, std::size_t j) {
    const N* const to = j < nodes_.size() ? nodes_[j] : nullptr;
    host_.set(nodes_[i]->next, to);
  }

  Host host_;
  std::vector<N*> nodes_;
  typename S::template ModType<Result> result_;
};

template <class App, class Host>
class SequenceForm {
 public:
  explicit SequenceForm(const std::vector<int>& values)
      : values_(values), sequence_(host_, values) {
    for (const auto& e : sequence_) ids_.push_back(e.id());
  }
  void run() { host_.template run<App::program>(sequence_.list()); }
  void take_out(std::size_t i) { sequence_.erase(ids_[i]); }
  void put_back(std::size_t i) {
    ids_[i] =
        i == 0 ? sequence_.push_front(values_[0]) : sequence_.insert_after(ids_[i - 1], values_[i]);
  }
  [[nodiscard]] Host& host() { return host_; }

 private:
  const std::vector<int>& values_;
  Host host_;
  sac::Sequence<int, Host> sequence_;
  std::vector<sac::ElementId> ids_;
};

// --- Programs --------------------------------------------------------------------------------

int image(int x) { return x / 3 + x / 7 + x / 9; }
bool is_kept(int x) { return x % 2 == 0; }

template <class Body>
struct Program {
  template <class S>
  void operator()(S& s, sac::List<int, S> list) const {
    static_cast<void>(Body{}(s, list));
  }
};

struct ToList {
  template <class S>
  using ExampleResult = const examples::Node<S>*;
};
struct MapApp : ToList {
  static constexpr auto example = examples::map_list;
  static constexpr Program<decltype([](auto& s, auto in) { return sac::map<&image>(s, in); })>
      program{};
};
struct FilterApp : ToList {
  static constexpr auto example = examples::filter_list;
  static constexpr Program<decltype([](auto& s, auto in) { return sac::filter<&is_kept>(s, in); })>
      program{};
};
struct ReverseApp : ToList {
  static constexpr auto example = examples::reverse_list;
  static constexpr Program<decltype([](auto& s, auto in) { return sac::reverse(s, in); })>
      program{};
};
struct SortApp : ToList {
  static constexpr auto example = examples::mergesort;
  static constexpr Program<decltype(
      [](auto& s, auto in) { return sac::sort<std::less<>{}>(s, in); })>
      program{};
};
struct ReduceApp {
  template <class S>
  using ExampleResult = examples::Sum::Value;
  static constexpr auto example = examples::sum_list;
  static constexpr Program<decltype(
      [](auto& s, auto in) { return sac::reduce<std::plus<>{}>(s, in, examples::Sum::Value{0}); })>
      program{};
};

// --- Measurements ----------------------------------------------------------------------------

struct Figures {
  double from_scratch, plain, update, work, bytes;
};

template <template <class, class> class Form, class App>
Figures measure(const char* operation, const char* form, std::size_t n) {
  const std::vector<int> values = random_values(n);
  Figures f{};
  std::vector<double> traced, plain;
  for (int round = 0; round < 3; ++round) {
    const auto untraced = std::make_unique<Form<App, sac::PlainScope>>(values);
    plain.push_back(cpu_nanoseconds([&] { untraced->run(); }) / 1e6);
    const auto world = std::make_unique<Form<App, sac::Engine>>(values);
    sac::Engine& engine = world->host();
    const std::size_t input = engine.bytes();
    traced.push_back(cpu_nanoseconds([&] { world->run(); }) / 1e6);
    if (round > 0) continue;
    f.bytes = static_cast<double>(engine.bytes() - input) / static_cast<double>(n);
    bench::Random random;
    std::uint64_t calls = 0;
    const auto propagate = [&] {
      const sac::Counts c = engine.propagate();
      calls += c.executed + c.created + c.discarded;
    };
    f.update = cpu_nanoseconds([&] {
                 for (int k = 0; k < kUpdates; ++k) {
                   const std::size_t i = random.below(n);
                   world->take_out(i);
                   propagate();
                   world->put_back(i);
                   propagate();
                 }
               }) /
               (2e3 * kUpdates);
    f.work = static_cast<double>(calls) / (2 * kUpdates);
  }
  f.from_scratch = median(traced);
  f.plain = median(plain);
  std::printf(
      "{\"bench\":\"sequence\",\"operation\":\"%s\",\"n\":%zu,\"form\":\"%s\","
      "\"from_scratch_ms\":%.2f,\"static_ms\":%.2f,\"update_us\":%.2f,\"work\":%.2f,"
      "\"bytes\":%.1f}\n",
      operation, n, form, f.from_scratch, f.plain, f.update, f.work, f.bytes);
  std::fflush(stdout);
  return f;
}

template <class App>
void bench_operation(const char* operation, std::size_t n) {
  const Figures a = measure<SequenceForm, App>(operation, "sequence", n);
  const Figures b = measure<ExampleForm, App>(operation, "example", n);
  std::printf(
      "{\"bench\":\"sequence\",\"operation\":\"%s\",\"n\":%zu,\"form\":\"ratio\","
      "\"from_scratch\":%.2f,\"static\":%.2f,\"update\":%.2f,\"work\":%.2f,"
      "\"bytes\":%.2f}\n",
      operation, n, a.from_scratch / b.from_scratch, a.plain / b.plain, a.update / b.update,
      a.work / b.work, a.bytes / b.bytes);
}

void bench_edits(const char* operation, std::size_t n) {
  sac::Engine engine;
  const std::size_t before = engine.bytes();
  sac::Sequence<int> sequence(engine);
  std::vector<sac::ElementId> ids;
  const auto each = [&](auto&& edit) {
    const double time = cpu_nanoseconds([&] {
      for (std::size_t i = 0; i < n; ++i) {
        edit(static_cast<int>(i));
        if (i % 1000 == 999) engine.propagate();
      }
      engine.propagate();
    });
    return time / static_cast<double>(n);
  };
  bench::Random random;
  const double push = each([&](int i) { ids.push_back(sequence.push_back(i)); });
  const double bytes = static_cast<double>(engine.bytes() - before) / static_cast<double>(n);
  const double exchange = each([&](int i) {
    const std::size_t at = random.below(n);
    const sac::ElementId old = std::exchange(ids[at], sequence.insert_after(ids[at], i));
    sequence.erase(old);
  });
  const double set = each([&](int i) { sequence.set(ids[random.below(n)], -i - 1); });
  std::printf(
      "{\"bench\":\"sequence\",\"operation\":\"%s\",\"n\":%zu,\"push_back_ns\":%.0f,"
      "\"insert_erase_ns\":%.0f,\"set_ns\":%.0f,\"input_bytes\":%.1f}\n",
      operation, n, push, exchange, set, bytes);
  std::fflush(stdout);
}

struct Operation {
  const char* name;
  std::size_t most;  // default sizes up to this
  void (*body)(const char*, std::size_t);
};

const Operation kOperations[] = {
    {"edits", 1000000, &bench_edits},
    {"map", 1000000, &bench_operation<MapApp>},
    {"filter", 1000000, &bench_operation<FilterApp>},
    {"reverse", 1000000, &bench_operation<ReverseApp>},
    {"reduce", 1000000, &bench_operation<ReduceApp>},
    {"sort", 100000, &bench_operation<SortApp>},
};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::string name = argc > 1 ? argv[1] : "all";
  bool known = false;
  for (const Operation& operation : kOperations) {
    if (name != "all" && name != operation.name) continue;
    known = true;
    for (int i = 2; i < argc; ++i) {
      operation.body(operation.name, std::strtoull(argv[i], nullptr, 10));
    }
    for (std::size_t n = 10000; argc < 3 && n <= operation.most; n *= 10) {
      operation.body(operation.name, n);
    }
  }
  if (!known) std::fprintf(stderr, "sequence_bench: no operation %s\n", name.c_str());
  return known ? 0 : 2;
}
