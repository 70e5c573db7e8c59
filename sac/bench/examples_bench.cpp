// The list examples: what a trace costs, and what an update of it.
//
//   examples_bench [APP|all [N...]]     default: all, lists at 10^4, 10^5, 10^6, sorts and hulls
//                                       at 10^4, 10^5
//
// Hulls are of points in a disc, where many are corners, and of points in a square, where few are
// and the benchmarks of CEAL are (..._square). Sorts take chunks of 16 elements in the mean to a
// call, where those of CEAL take one.
//
// One JSON line per figure. Each application runs in a process of its own:
//   from_scratch      ms of processor time, as all of the runs; the first run on an engine, median
//                     of 3
//   static            ms; the same text on sac::PlainScope, median of 5
//   plain_arena       ms; the program as a loop over a linked list, nodes from an arena whose pages
//                     have been touched before
//   plain_malloc      ms; the same, nodes from malloc
//   over_static, over_arena             from_scratch divided by these
//   update            us; median, mean and 99th percentile of: take a random element out, or put it
//                     back, and propagate; the mean is of processor time, timers included
//   update_in_order   the same for one element after the other
//   work              calls executed, created and discarded in an update, means; and their sum's
//                     median and 99th percentile
//   weight            steps that bodies make inside (Scope::weigh) in an update, mean and most; in
//                     updates of their own
//   trace             per element: bytes of trace and result, the same with the input, calls and
//                     edges; resident bytes of the process, inputs included
//   batch             us; that many values of an array changed, and a propagation
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "../examples/array_map.hpp"
#include "../examples/diameter.hpp"
#include "../examples/distance.hpp"
#include "../examples/list_filter.hpp"
#include "../examples/list_map.hpp"
#include "../examples/list_minimum.hpp"
#include "../examples/list_reverse.hpp"
#include "../examples/list_sum.hpp"
#include "../examples/mergesort.hpp"
#include "../examples/quickhull.hpp"
#include "../examples/quicksort.hpp"
#include "bench_help.hpp"
#include "bench_support.hpp"
#include "plain_lists.hpp"

namespace {

using namespace examples;
using bench::cpu_nanoseconds;
using bench::median;
using bench::nanoseconds;

struct Report {
  const char* app;
  std::size_t n;

  template <class... Values>
  void operator()(const char* figure, const char* format, Values... values) const {
    std::printf("{\"bench\":\"examples\",\"app\":\"%s\",\"n\":%zu,\"figure\":\"%s\",", app, n,
                figure);
    std::printf(format, values...);
    std::printf("}\n");
  }
  [[nodiscard]] double per_element(double x) const { return x / static_cast<double>(n); }
};

// --- Inputs ----------------------------------------------------------------------------------

std::vector<Element> random_elements(std::size_t n) {
  bench::Random random;
  std::vector<Element> elements;
  for (std::size_t i = 0; i < n; ++i) {
    elements.push_back({static_cast<int>(random.next() >> 33), static_cast<std::uint32_t>(i + 1)});
  }
  return elements;
}

enum class Shape { disc, square };

// Uniform in a disc of radius 2^20 around (x, 0), or in the square around it.
std::vector<Point> random_points(Shape shape, std::size_t n, int x, std::uint32_t first_id) {
  bench::Random random;
  const auto coordinate = [&] { return static_cast<int>(random.below(1 << 21)) - (1 << 20); };
  std::vector<Point> points;
  while (points.size() < n) {
    const Point p{coordinate(), coordinate(), static_cast<std::uint32_t>(points.size())};
    const bool outside = squared_distance(p, Point{}) > std::int64_t{1} << 40;
    if (shape == Shape::disc && outside) continue;
    points.push_back({p.x + x, p.y, p.id + first_id});
  }
  return points;
}

// The nodes of a list of the host's, the header first.
template <class Host, class N, class T>
std::vector<N*> make_list(Host& host, const std::vector<T>& elements) {
  std::vector<N*> nodes;
  for (std::size_t i = 0; i <= elements.size(); ++i) {
    nodes.push_back(&host.template make<N>());
    if (i > 0) nodes.back()->element = elements[i - 1];
  }
  for (std::size_t i = 0; i <= elements.size(); ++i) {
    host.set(nodes[i]->next, i < elements.size() ? static_cast<const N*>(nodes[i + 1]) : nullptr);
  }
  return nodes;
}

// A program on a host, with one list or two and a result.
template <class App, class Host>
struct World {
  using S = std::conditional_t<std::is_same_v<Host, sac::Engine>, sac::Scope, sac::PlainScope>;
  using N = Node<S, typename App::Item>;
  using Result = typename App::template Result<S>;

  std::unique_ptr<Host> host = std::make_unique<Host>();
  std::vector<std::vector<N*>> lists;
  typename S::template ModType<Result> result = host->template cell<Result>();

  explicit World(std::size_t n) {
    for (const auto& input : App::inputs(n)) lists.push_back(make_list<Host, N>(*host, input));
  }
  void run() {
    const N* const first = lists.front().front();
    if constexpr (App::kLists == 1) {
      host->template run<App::program>(first, result);
    } else {
      host->template run<App::program>(first, static_cast<const N*>(lists.back().front()), result);
    }
  }
};

// --- Applications ----------------------------------------------------------------------------

struct ElementApp {
  using Item = Element;
  static constexpr int kLists = 1;
  static std::vector<std::vector<Element>> inputs(std::size_t n) { return {random_elements(n)}; }
};
struct ListApp : ElementApp {
  template <class S>
  using Result = const Node<S>*;
};
template <Shape shape>
struct PointApp {
  using Item = Point;
  static constexpr int kLists = 1;
  static std::vector<std::vector<Point>> inputs(std::size_t n) {
    return {random_points(shape, n, 0, 1)};
  }
};

struct MapApp : ListApp {
  static constexpr auto program = map_list;
  static auto plain(auto& nodes, const plain_lists::Node* in) {
    return plain_lists::map(nodes, in)->element.value;
  }
};
struct FilterApp : ListApp {
  static constexpr auto program = filter_list;
  static auto plain(auto& nodes, const plain_lists::Node* in) {
    return plain_lists::filter(nodes, in)->element.value;
  }
};
struct ReverseApp : ListApp {
  static constexpr auto program = reverse_list;
  static auto plain(auto& nodes, const plain_lists::Node* in) {
    return plain_lists::reverse(nodes, in)->element.value;
  }
};
struct SumApp : ElementApp {
  template <class S>
  using Result = Sum::Value;
  static constexpr auto program = sum_list;
  static auto plain(auto&, const plain_lists::Node* in) { return plain_lists::sum(in); }
};
struct MinimumApp : ElementApp {
  template <class S>
  using Result = Minimum::Value;
  static constexpr auto program = minimum_list;
  static auto plain(auto&, const plain_lists::Node* in) { return plain_lists::minimum(in); }
};
struct QuicksortApp : ListApp {
  static constexpr auto program = quicksort;
  static auto plain(auto& nodes, const plain_lists::Node* in) {
    return plain_lists::quicksort(nodes, in)->element.value;
  }
};
struct MergesortApp : ListApp {
  static constexpr auto program = mergesort;
  static auto plain(auto& nodes, const plain_lists::Node* in) {
    return plain_lists::mergesort(nodes, in)->element.value;
  }
};
template <Shape shape>
struct QuickhullApp : PointApp<shape> {
  template <class S>
  using Result = Hull<S>;
  static constexpr auto program = quickhull;
};
template <Shape shape>
struct DiameterApp : PointApp<shape> {
  template <class S>
  using Result = std::int64_t;
  static constexpr auto program = diameter;
};
template <Shape shape>
struct DistanceApp {
  using Item = Point;
  template <class S>
  using Result = double;
  static constexpr int kLists = 2;
  static constexpr auto program = distance;
  static std::vector<std::vector<Point>> inputs(std::size_t n) {
    return {random_points(shape, n / 2, 0, 1), random_points(shape, n - n / 2, 1 << 22, 1u << 30)};
  }
};

// --- Measurements ----------------------------------------------------------------------------

template <class App>
double static_ms(const Report& report) {
  std::vector<double> times;
  for (int round = 0; round < 5; ++round) {
    World<App, sac::PlainScope> world(report.n);
    times.push_back(cpu_nanoseconds([&] { world.run(); }) / 1e6);
  }
  report("static", "\"ms\":%.2f", median(times));
  return median(times);
}

template <class App, class Nodes>
double plain_ms(const Report& report, const char* figure) {
  plain_lists::ArenaNodes input;
  plain_lists::Appender<plain_lists::ArenaNodes> list(input);
  for (const Element& e : random_elements(report.n)) list.append(e);
  std::vector<double> times;
  Nodes nodes;
  for (int round = 0; round < 5; ++round) {
    nodes.clear();
    times.push_back(cpu_nanoseconds([&] {
                      bench::sink = static_cast<std::uint64_t>(App::plain(nodes, list.list()));
                    }) /
                    1e6);
  }
  report(figure, "\"ms\":%.3f", median(times));
  return median(times);
}

struct Updates {
  std::vector<double> microseconds, work;
  double executed = 0, created = 0, discarded = 0, edges = 0, weight = 0, most_weight = 0;

  template <class Edit>
  void add(sac::Engine& engine, Edit&& edit) {
    sac::Counts counts;
    microseconds.push_back(nanoseconds([&] {
                             edit();
                             counts = engine.propagate();
                           }) /
                           1e3);
    const auto real = [](std::uint64_t x) { return static_cast<double>(x); };
    executed += real(counts.executed);
    created += real(counts.created);
    discarded += real(counts.discarded);
    edges += real(counts.edges_made + counts.edges_removed);
    weight += real(counts.weight);
    most_weight = std::max(most_weight, real(counts.weight));
    work.push_back(real(counts.executed + counts.created + counts.discarded));
  }
  void print_times(const Report& report, const char* figure, double cpu_nanoseconds) const {
    report(figure, "\"median_us\":%.3f,\"mean_us\":%.3f,\"p99_us\":%.3f", median(microseconds),
           cpu_nanoseconds / 1e3 / static_cast<double>(microseconds.size()),
           bench::quantile(microseconds, 0.99));
  }
  void print(const Report& report, double cpu_nanoseconds) const {
    const auto n = static_cast<double>(microseconds.size());
    print_times(report, "update", cpu_nanoseconds);
    report("work",
           "\"executed\":%.2f,\"created\":%.2f,\"discarded\":%.2f,\"edges\":%.2f,"
           "\"median\":%.0f,\"p99\":%.0f",
           executed / n, created / n, discarded / n, edges / n, median(work),
           bench::quantile(work, 0.99));
  }
};

template <class World>
void take_out_and_put_back(Updates& updates, World& world, std::size_t list, std::size_t i) {
  sac::Engine& engine = *world.host;
  const auto& nodes = world.lists[list];
  const typename World::N* const taken = nodes[i + 1];
  const typename World::N* const behind = engine.get(taken->next);
  updates.add(engine, [&] { engine.set(nodes[i]->next, behind); });
  updates.add(engine, [&] { engine.set(nodes[i]->next, taken); });
}

template <class World>
void update_at_random(Updates& updates, World& world) {
  bench::Random random;
  for (int k = 0; k < 5000; ++k) {
    const std::size_t list = random.below(world.lists.size());
    take_out_and_put_back(updates, world, list, random.below(world.lists[list].size() - 1));
  }
}

// At random places; then at places one behind the other, where what an update touches is in cache.
template <class App>
void bench_updates(const Report& report, World<App, sac::Engine>& world) {
  Updates updates, in_order;
  const double total = cpu_nanoseconds([&] { update_at_random(updates, world); });
  updates.print(report, total);
  const double total_in_order = cpu_nanoseconds([&] {
    const std::size_t size = world.lists[0].size(), middle = size / 2;
    for (std::size_t i = middle; i < std::min(middle + 5000, size - 1); ++i) {
      take_out_and_put_back(in_order, world, 0, i);
    }
  });
  in_order.print_times(report, "update_in_order", total_in_order);
}

template <class App>
void count_weights(const Report& report) {
  World<App, sac::Engine> world(report.n);
  world.host->record_weights();
  world.run();
  Updates updates;
  update_at_random(updates, world);
  report("weight", "\"mean\":%.1f,\"most\":%.0f",
         updates.weight / static_cast<double>(updates.work.size()), updates.most_weight);
}

template <class App>
double traced_ms(const Report& report) {
  std::vector<double> times;
  for (int round = 0; round < 3; ++round) {
    const double resident = bench::resident_bytes();
    World<App, sac::Engine> world(report.n);
    sac::Engine& engine = *world.host;
    engine.propagate();  // the edits are final: what would undo them goes
    const auto bytes = static_cast<double>(engine.bytes());
    times.push_back(cpu_nanoseconds([&] { world.run(); }) / 1e6);
    if (round > 0) continue;
    report("trace",
           "\"bytes\":%.1f,\"bytes_with_input\":%.1f,\"calls\":%.3f,\"edges\":%.3f,"
           "\"resident_bytes\":%.1f",
           report.per_element(static_cast<double>(engine.bytes()) - bytes),
           report.per_element(static_cast<double>(engine.bytes())),
           report.per_element(static_cast<double>(engine.live_calls())),
           report.per_element(static_cast<double>(engine.live_edges())),
           report.per_element(bench::resident_bytes() - resident));
    bench_updates<App>(report, world);
  }
  report("from_scratch", "\"ms\":%.2f", median(times));
  return median(times);
}

template <class App>
void bench_app(const Report& report) {
  const double traced = traced_ms<App>(report);
  count_weights<App>(report);
  report("over_static", "\"ratio\":%.2f", traced / static_ms<App>(report));
  if constexpr (std::is_same_v<typename App::Item, Element>) {
    const double arena = plain_ms<App, plain_lists::ArenaNodes>(report, "plain_arena");
    report("over_arena", "\"ratio\":%.2f", traced / arena);
    plain_ms<App, plain_lists::MallocNodes>(report, "plain_malloc");
  }
}

template <class S, class Host>
void fill(Host& host, Array<S>& array, std::size_t n) {
  bench::Random random;
  for (std::size_t i = 0; i < n; ++i) {
    array.in.push_back(host.template input<int>(static_cast<int>(random.next() >> 33)));
    array.out.push_back(host.template cell<int>());
  }
  host.set_environment(&array);
}

// `size` values changed, and a propagation.
double batch_us(sac::Engine& engine, const Array<sac::Scope>& array, std::size_t size) {
  bench::Random random;
  std::vector<double> times;
  for (int round = 0; round < (size < 10000 ? 1000 : 50); ++round) {
    times.push_back(nanoseconds([&] {
                      for (std::size_t k = 0; k < size; ++k) {
                        engine.set(array.in[random.below(array.in.size())],
                                   static_cast<int>(random.next() >> 33));
                      }
                      engine.propagate();
                    }) /
                    1e3);
  }
  return median(times);
}

void bench_array_map(const Report& report) {
  std::vector<double> traced, plain;
  for (int round = 0; round < 3; ++round) {
    sac::Engine engine;
    Array<sac::Scope> array;
    fill(engine, array, report.n);
    engine.propagate();
    const auto bytes = static_cast<double>(engine.bytes());
    traced.push_back(cpu_nanoseconds([&] { engine.run<map_array>(); }) / 1e6);
    if (round > 0) continue;
    report("trace", "\"bytes\":%.1f,\"calls\":%.3f,\"edges\":%.3f",
           report.per_element(static_cast<double>(engine.bytes()) - bytes),
           report.per_element(static_cast<double>(engine.live_calls())),
           report.per_element(static_cast<double>(engine.live_edges())));
    for (const std::size_t size : {1, 100, 10000}) {
      const double us = batch_us(engine, array, size);
      report("batch", "\"changes\":%zu,\"us\":%.2f,\"us_per_change\":%.3f", size, us,
             us / static_cast<double>(size));
    }
  }
  for (int round = 0; round < 5; ++round) {
    sac::PlainScope scope;
    Array<sac::PlainScope> array;
    fill(scope, array, report.n);
    plain.push_back(cpu_nanoseconds([&] { scope.run<map_array>(); }) / 1e6);
  }
  report("from_scratch", "\"ms\":%.2f", median(traced));
  report("static", "\"ms\":%.2f", median(plain));
  report("over_static", "\"ratio\":%.2f", median(traced) / median(plain));
}

// In a process of its own, so that memory is that of this application.
void in_child(const Report& report, void (*body)(const Report&)) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    body(report);
    std::fflush(stdout);
    std::_Exit(0);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0) {
    std::fprintf(stderr, "%s %zu: failed\n", report.app, report.n);
    std::exit(1);
  }
}

struct Application {
  const char* name;
  std::size_t most;  // default sizes up to this
  void (*body)(const Report&);
};

const Application kApplications[] = {
    {"array_map", 1000000, &bench_array_map},
    {"list_map", 1000000, &bench_app<MapApp>},
    {"list_filter", 1000000, &bench_app<FilterApp>},
    {"list_reverse", 1000000, &bench_app<ReverseApp>},
    {"list_minimum", 1000000, &bench_app<MinimumApp>},
    {"list_sum", 1000000, &bench_app<SumApp>},
    {"quicksort", 100000, &bench_app<QuicksortApp>},
    {"mergesort", 100000, &bench_app<MergesortApp>},
    {"quickhull", 100000, &bench_app<QuickhullApp<Shape::disc>>},
    {"diameter", 100000, &bench_app<DiameterApp<Shape::disc>>},
    {"distance", 100000, &bench_app<DistanceApp<Shape::disc>>},
    {"quickhull_square", 100000, &bench_app<QuickhullApp<Shape::square>>},
    {"diameter_square", 100000, &bench_app<DiameterApp<Shape::square>>},
    {"distance_square", 100000, &bench_app<DistanceApp<Shape::square>>},
};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::string name = argc > 1 ? argv[1] : "all";
  bool known = false;
  for (const Application& app : kApplications) {
    if (name != "all" && name != app.name) continue;
    known = true;
    for (int i = 2; i < argc; ++i) {
      in_child({app.name, std::strtoull(argv[i], nullptr, 10)}, app.body);
    }
    for (std::size_t n = 10000; argc < 3 && n <= app.most; n *= 10) {
      in_child({app.name, n}, app.body);
    }
  }
  if (!known) std::fprintf(stderr, "examples_bench: no application %s\n", name.c_str());
  return known ? 0 : 2;
}
