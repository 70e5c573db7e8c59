// Failures injected at every allocation and every client call: the engine is as before the edits,
// and goes on working.
#include <catch2/catch.hpp>
#include <compare>
#include <cstdint>
#include <functional>
#include <new>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "failing_new.hpp"
#include "random_program.hpp"

namespace {

using namespace support;

struct ClientFailure : std::runtime_error {
  ClientFailure() : std::runtime_error("client code") {}
};

// A number of the client: copying, comparing, ordering, hashing it and making it may throw.
class Fragile {
 public:
  static inline Fuse fuse;

  Fragile() { burn(); }
  explicit Fragile(int value) : value_(value) { burn(); }
  Fragile(const Fragile& other) : value_(other.value_) { burn(); }
  Fragile(Fragile&& other) noexcept = default;
  Fragile& operator=(const Fragile& other) {
    burn();
    value_ = other.value_;
    return *this;
  }
  Fragile& operator=(Fragile&&) noexcept = default;

  explicit operator int() const { return value_; }
  friend bool operator==(const Fragile& a, const Fragile& b) {
    burn();
    return a.value_ == b.value_;
  }
  friend std::strong_ordering operator<=>(const Fragile& a, const Fragile& b) {
    burn();
    return a.value_ <=> b.value_;
  }
  friend std::uint64_t hash_value(const Fragile& f) {
    burn();
    return static_cast<std::uint64_t>(f.value_);
  }
  friend std::ostream& operator<<(std::ostream& out, const Fragile& f) { return out << f.value_; }

 private:
  static void burn() {
    if (fuse.burns()) throw ClientFailure();
  }
  int value_ = 0;
};

using World = RandomWorld<sac::Scope, Fragile>;

struct Edit {
  std::vector<std::pair<std::size_t, int>> sets;
  int post = 0;     // node to be posted from outside; 0: none
  bool retract = false;  // or taken back
};

struct Program {
  const RandomProgram text;
  std::vector<int> inputs;
  std::vector<int> posts;
  World world;
  sac::Engine engine;

  Program(std::uint64_t seed, int nodes, std::vector<int> values, std::vector<int> posted)
      : text(seed, nodes), inputs(std::move(values)), posts(std::move(posted)) {
    world.program = &text;
    world.start(engine, inputs);
    for (const int n : posts) post(n);
  }
  void run() { engine.run<random_root<Fragile>>(); }
  void post(int n) {
    world.agenda->post_from_outside<node<Fragile>>(node_key(n, 9), n, Fragile(9));
  }
  void make(const Edit& edit) {
    for (const auto& [input, value] : edit.sets) {
      engine.set(world.inputs[input], Fragile(value));
    }
    if (edit.post == 0) return;
    if (edit.retract) {
      world.agenda->retract_from_outside<node<Fragile>>(edit.post, Fragile(9));
    } else {
      post(edit.post);
    }
  }
  // What can be seen: values, calls in order, number of edges.
  std::string state() const {
    std::ostringstream out;
    for (const auto& c : world.cells) out << int(engine.get(c)) << ' ';
    engine.walk([&](const sac::Call& c, std::size_t depth) {
      out << depth << c.function().name;
      if (c.function().name != "pass") c.function().print(c, out);
      out << ' ';
    });
    out << engine.live_calls() << ' ' << engine.live_edges();
    return out.str();
  }
};

// Where failures come from.
struct Source {
  const char* name;
  void (*arm)(Program&, std::uint64_t count);
};
constexpr Source kSources[] = {
    {"client", [](Program&, std::uint64_t count) { Fragile::fuse.left = count; }},
    {"operator new", [](Program&, std::uint64_t count) { allocation_fuse.left = count; }},
    {"arena", [](Program& p, std::uint64_t count) { p.engine.arena().fail_after(count); }},
};

// Whether `act` failed when the count-th event of the source does.
bool fails(Program& p, const Source& source, std::uint64_t count,
           const std::function<void()>& act) {
  source.arm(p, count);
  bool failed = false;
  try {
    act();
  } catch (const ClientFailure&) {
    failed = true;
  } catch (const std::bad_alloc&) {
    failed = true;
  }
  source.arm(p, 0);
  return failed;
}

Edit random_edit(Random& random, int nodes, std::vector<int>& posts) {
  Edit edit;
  for (int k = 1 + random(3); k > 0; --k) {
    edit.sets.emplace_back(static_cast<std::size_t>(random(4)), random(5));
  }
  if (!posts.empty() && random(3) == 0) {
    edit.post = posts.back();
    edit.retract = true;
    posts.pop_back();
  } else if (random(2) == 0) {
    edit.post = 3 + random(nodes - 3);
    posts.push_back(edit.post);
  }
  return edit;
}

// Edits and propagates; each time with every failure of the source in turn. Returns their number.
std::uint64_t check_failures(std::uint64_t seed, const Source& source, int edits) {
  CAPTURE(seed, source.name);
  Random random(seed ^ 0x5eed);
  const int nodes = 5 + random(6);
  Program p(seed, nodes, {1, 1, 1, 1}, {});
  p.run();
  std::uint64_t failures = 0;
  for (int i = 0; i < edits; ++i) {
    CAPTURE(i);
    const Edit edit = random_edit(random, nodes, p.posts);
    const std::string before = p.state();
    for (std::uint64_t count = 1;; ++count) {
      CAPTURE(count);
      const bool failed = fails(p, source, count, [&] {
        p.make(edit);
        p.engine.propagate();
      });
      if (!failed) break;
      ++failures;
      p.engine.undo_edits();
      p.engine.propagate();
      p.engine.check_invariants();
      REQUIRE(p.state() == before);
    }
    p.engine.check_invariants();
    for (const auto& [input, value] : edit.sets) p.inputs[input] = value;
    Program fresh(seed, nodes, p.inputs, p.posts);
    fresh.run();
    REQUIRE(p.state() == fresh.state());
  }
  return failures;
}

TEST_CASE("a propagation that fails anywhere leaves the engine as before the edits") {
  std::uint64_t failures = 0;
  for (const Source& source : kSources) {
    for (std::uint64_t seed = 0; seed < 150; ++seed) failures += check_failures(seed, source, 4);
  }
  CHECK(failures > 20000);
}

TEST_CASE("many propagations fail anywhere", "[.soak]") {
  for (const Source& source : kSources) {
    for (std::uint64_t seed = 1000; seed < 2000; ++seed) check_failures(seed, source, 12);
  }
}

TEST_CASE("a run that fails anywhere leaves nothing, and may be tried again") {
  std::uint64_t failures = 0;
  for (const Source& source : kSources) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      CAPTURE(seed, source.name);
      Program p(seed, 8, {2, 1, 3, 0}, {4, 4, 6});
      Program good(seed, 8, {2, 1, 3, 0}, {4, 4, 6});
      good.run();
      for (std::uint64_t count = 1; fails(p, source, count, [&] { p.run(); }); ++count) {
        ++failures;
        REQUIRE(p.engine.live_edges() == 0);
        p.engine.check_invariants();
      }
      REQUIRE(p.state() == good.state());
      p.engine.check_invariants();
    }
  }
  CHECK(failures > 1000);
}

}  // namespace
