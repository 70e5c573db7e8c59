// The examples on trees, graphs and text, recorded: propagated traces are those of fresh runs, and
// work follows the distance [Theorem 1.4.4].
#include "graph_examples.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>

#include "text_examples.hpp"
#include "traces/recorder.hpp"
#include "traces/stability.hpp"

namespace {

using namespace support;

template <class App>
struct Run {
  sac::Engine engine;
  typename App::template World<sac::Engine> world;

  explicit Run(const typename App::Input& input) : world(engine, input) {}
  [[nodiscard]] traces::Trace trace() const {
    traces::Recorder recorder(engine);
    world.name(recorder);
    return recorder.trace();
  }
};

// An App of example_harness.hpp under its random edits.
template <class App>
class AppSubject final : public traces::Subject {
 public:
  AppSubject(std::uint64_t seed, int size)
      : random_(seed), input_(App::random_input(random_, size)), run_(input_) {}

  Edit edit() override {
    const auto e = App::random_edit(random_, input_);
    App::apply(input_, e);
    run_.world.edit(e);
    return {run_.engine.propagate(), {}};
  }
  [[nodiscard]] traces::Trace trace() const override { return run_.trace(); }
  [[nodiscard]] traces::Trace fresh_trace() const override { return Run<App>(input_).trace(); }

 private:
  Random random_;
  typename App::Input input_;
  Run<App> run_;
};

// `bound`: of work over distance for each edit.
template <class App>
void check_stability(double bound) {
  std::uint64_t work = 0;
  std::uint64_t distance = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const int size = seed % 4 == 0 ? 3 : 60;
    AppSubject<App> subject(seed, size);
    CHECK(subject.trace().unnamed == 0);
    for (const traces::StabilityRow& row : traces::stability(subject, 60)) {
      INFO(App::kName << ", size " << size << ", seed " << seed);
      REQUIRE(row.drift == 0);
      CAPTURE(row.work(), row.distance);
      CHECK(row.ratio() <= bound);
      work += row.work();
      distance += row.distance;
    }
  }
  INFO(App::kName << ": " << work << " for " << distance);
  CHECK(work <= distance * 3 / 2);
}

}  // namespace

TEST_CASE("Examples on graphs and text: work follows distance [Thm 1.4.4]") {
  check_stability<ExpressionApp>(2);
  check_stability<ForestApp>(2);
  check_stability<SearchApp>(2);
  check_stability<SpellApp>(2);
  check_stability<StringApp>(2);
  check_stability<SheetApp>(2);
  // In the mean only: see the header of the example.
  check_stability<ComponentsApp>(std::numeric_limits<double>::infinity());
}
