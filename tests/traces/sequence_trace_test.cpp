// Operations on sequences, recorded: their calls have names throughout, propagated traces are those
// of fresh runs, and work follows the distance [Theorem 1.4.4].
#include <catch2/catch.hpp>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "sac/sac.hpp"
#include "traces/recorder.hpp"
#include "traces/stability.hpp"

namespace {

using sac::ElementId;
using Sequence = sac::Sequence<int>;

bool is_even(int x) { return x % 2 == 0; }
int halved(int x) { return x / 2; }
struct Less {
  static constexpr std::string_view kName = "less";
  bool operator()(int a, int b) const { return a / 10 < b / 10; }
};
struct Plus {
  static constexpr std::string_view kName = "plus";
  int operator()(int a, int b) const { return a + b; }
};
struct Successor {
  static constexpr std::string_view kName = "successor";
  template <class S>
  int operator()(S&, int x) const {
    return x + 1;
  }
};
struct Ignore {
  static constexpr std::string_view kName = "ignore";
  template <class S>
  void operator()(S&, int) const {}
};

void simple_operations(sac::Scope& s, sac::List<int> in) {
  sac::for_each<Ignore{}>(s, in);
  const auto images = sac::map<Successor{}>(s, sac::map<&halved>(s, in));
  static_cast<void>(sac::reverse(s, sac::filter<&is_even>(s, images)));
}
void sorting(sac::Scope& s, sac::List<int> in) {
  static_cast<void>(sac::sort<Less{}>(s, sac::sort<std::less<>{}>(s, in)));
}
void reducing(sac::Scope& s, sac::List<int> in) {
  static_cast<void>(sac::reduce<Plus{}>(s, in, 0));
  static_cast<void>(sac::size(s, in));
  static_cast<void>(sac::find_if<&is_even>(s, in));
}

// A program on a sequence, in an engine of its own.
template <auto Program>
struct Run {
  sac::Engine engine;
  traces::Recorder recorder{engine};
  Sequence sequence;

  explicit Run(const std::vector<Sequence::Saved>& elements) : sequence(engine, elements) {
    engine.template run<Program>(sequence.list());
  }
  [[nodiscard]] traces::Trace trace() {
    recorder.name(sequence.list().header(), "header");
    for (const auto& node : sequence) recorder.name(&node, node.id().value, node.value());
    return recorder.trace();
  }
};

// The same under random insertions, erasures and new values.
template <auto Program>
class Subject final : public traces::Subject {
 public:
  Subject(int size, unsigned seed) : random_(seed), run_({}) {
    for (int i = 0; i < size; ++i) run_.sequence.push_back(value());
    run_.engine.propagate();
  }
  Edit edit() override {
    Sequence& sequence = run_.sequence;
    const std::size_t place = random_() % (sequence.size() + 1);
    if (place == sequence.size()) {
      sequence.push_back(value());
    } else {
      const ElementId id = std::next(sequence.begin(), static_cast<int>(place))->id();
      switch (random_() % 4) {
        case 0:
          sequence.insert_before(id, value());
          break;
        case 1:
          sequence.set(id, value());
          break;
        default:
          sequence.erase(id);
      }
    }
    return {run_.engine.propagate(), {}};
  }
  [[nodiscard]] traces::Trace trace() const override { return run_.trace(); }
  [[nodiscard]] traces::Trace fresh_trace() const override {
    std::vector<Sequence::Saved> elements;
    for (const auto& node : run_.sequence) elements.push_back({node.id(), node.value()});
    return Run<Program>(elements).trace();
  }

 private:
  int value() { return static_cast<int>(random_() % 100); }

  std::mt19937 random_;
  mutable Run<Program> run_;  // to be recorded, its nodes are named
};

template <auto Program>
void check_operations(const std::string& name) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    for (const int size : {0, 3, 60, 300}) {
      Subject<Program> subject(size, seed);
      for (const traces::StabilityRow& row : traces::stability(subject, 30)) {
        INFO(name << ", size " << size << ", seed " << seed);
        REQUIRE(row.drift == 0);
        CAPTURE(row.work(), row.distance);
        REQUIRE(row.ratio() <= 2);
      }
    }
  }
}

}  // namespace

TEST_CASE("Sequences: propagated traces are fresh ones, and work follows distance [Thm 1.4.4]") {
  check_operations<&simple_operations>("simple operations");
  check_operations<&sorting>("sorting");
  check_operations<&reducing>("reducing");
}
