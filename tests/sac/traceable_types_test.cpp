// sac/docs/traceable_types.md tells the truth: its snippets are those of sac/examples, which hold;
// and the data type that it goes through follows random edits.
#define TRACEABLE_TYPES_WITHOUT_MAIN
#include "../../sac/examples/traceable_types.cpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <new>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "example_harness.hpp"
#include "failing_new.hpp"
#include "random.hpp"
#include "snippets.hpp"

namespace {

using sac::ElementId;
using support::Random;

// --- The document --------------------------------------------------------------------------------

TEST_CASE("the program of the document on traceable data types holds") {
  CHECK_NOTHROW(traceable_types::run_all());
}

TEST_CASE("every snippet in the document on traceable data types is a part of the example") {
  CHECK(support::require_snippets("docs/traceable_types.md", "examples/claims.hpp",
                                  "examples/traceable_types.cpp") > 8);
}

// --- The type ------------------------------------------------------------------------------------

struct Input {
  std::vector<std::pair<ElementId, std::string>> words;
  std::uint64_t next_id = 1;

  void insert(int place, std::string word) {
    words.insert(words.begin() + place, {ElementId{next_id++}, std::move(word)});
  }
};

// Few words, so that most are repetitions.
std::string random_word(Random& random) {
  return std::string(static_cast<std::size_t>(1 + random(3)), static_cast<char>('a' + random(4)));
}

template <class Host>
class World {
 public:
  using S = sac::ScopeOf<Host>;
  using Words = sac::List<std::string, S>;
  using Sequence = sac::Sequence<std::string, Host>;

  World(Host& host, const Input& input) : host_(host), claims_(host), words_(host, saved(input)) {
    host_.set_environment(&claims_);
    host_.template run<traceable_types::unique>(words_.list(), result_);
  }
  std::vector<ElementId> result() {
    if constexpr (S::kTraced) claims_.check_invariants();
    std::vector<ElementId> ids;
    for (const auto& e : host_.get(result_).view(host_)) ids.push_back(e.id());
    return ids;
  }
  Sequence& words() { return words_; }

 private:
  static auto saved(const Input& input) {
    std::vector<typename Sequence::Saved> words;
    for (const auto& [id, word] : input.words) words.push_back({id, word});
    return words;
  }

  Host& host_;
  examples::Claims<std::string, S> claims_;
  Sequence words_;
  typename S::template ModType<Words> result_ = host_.template cell<Words>();
};

struct App {
  using Input = ::Input;
  template <class Host>
  using World = ::World<Host>;
  static std::vector<ElementId> oracle(const Input& input) {
    std::set<std::string> seen;
    std::vector<ElementId> ids;
    for (const auto& [id, word] : input.words) {
      if (seen.insert(word).second) ids.push_back(id);
    }
    return ids;
  }
};

void random_edit(Random& random, Input& input, World<sac::Engine>& world) {
  const int size = static_cast<int>(input.words.size());
  const int place = random(size + 1);
  const std::string word = random_word(random);
  if (place == size) {
    world.words().push_back(word);
    return input.insert(size, word);
  }
  const auto at = input.words.begin() + place;
  switch (random(4)) {
    case 0:
      world.words().insert_before(at->first, word);
      return input.insert(place, word);
    case 1:
      world.words().set(at->first, word);
      at->second = word;
      return;
    default:
      world.words().erase(at->first);
      input.words.erase(at);
  }
}

TEST_CASE("claims of a list's words follow random edits as if run from scratch") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Input input;
    for (int i = 0; i < static_cast<int>(seed); ++i) input.insert(i, random_word(random));
    sac::Engine engine;
    engine.set_audit(true);
    World<sac::Engine> world(engine, input);
    REQUIRE(support::example::traced_fault<App>(engine, world, input) == "");
    for (int step = 0; step < 20; ++step) {
      CAPTURE(step);
      for (int k = 1 + random(3); k > 0; --k) random_edit(random, input, world);
      engine.propagate();
      REQUIRE(support::example::traced_fault<App>(engine, world, input) == "");
    }
  }
}

TEST_CASE("a propagation of claims that runs out of memory anywhere leaves them as before") {
  Random random(7);
  Input input;
  for (int i = 0; i < 20; ++i) input.insert(i, random_word(random));
  sac::Engine engine;
  World<sac::Engine> world(engine, input);
  int failures = 0;
  for (int step = 0; step < 100; ++step) {
    for (std::uint64_t count = 1;; ++count) {
      CAPTURE(step, count);
      const bool of_arena = step % 2 == 0;
      Input next = input;
      random_edit(random, next, world);
      of_arena ? engine.arena().fail_after(count)
               : static_cast<void>(support::allocation_fuse.left = count);
      bool failed = false;
      try {
        engine.propagate();
      } catch (const std::bad_alloc&) {
        failed = true;
      }
      support::allocation_fuse.left = 0;
      engine.arena().fail_after(0);
      if (failed) {
        input.next_id = next.next_id;  // ids are not given again
        ++failures;
      } else {
        input = next;
      }
      REQUIRE(support::example::traced_fault<App>(engine, world, input) == "");
      if (!failed) break;
    }
  }
  CHECK(failures > 100);
}

// --- Calls that claim more than once -------------------------------------------------------------

using Numbers = examples::Claims<int>;

struct Claiming {
  Numbers& claims;
  sac::Mod<int> key;
  std::vector<sac::Mod<bool>> got;
};

void claim_twice(sac::Scope& s, int from) {
  auto& c = s.environment<Claiming>();
  const auto i = static_cast<std::size_t>(2 * from);
  const int key = s.read(c.key);
  s.write(c.got[i], c.claims.claim(s, from == 0 ? key : 5));
  s.write(c.got[i + 1], c.claims.claim(s, 5));
}
void claim_in_two_calls(sac::Scope& s) {
  s.call<claim_twice>(0);
  s.call<claim_twice>(1);
}
void claim_late(sac::Scope& s) {
  s.call<claim_twice>(0);
  s.environment<Claiming>().claims.claim(s, 5);
}

TEST_CASE("a second claim of a call is too late; claims are in the order of the text") {
  sac::Engine e;
  Numbers claims(e);
  Claiming world{claims, e.input(5), {}};
  for (int i = 0; i < 4; ++i) world.got.push_back(e.cell<bool>());
  e.set_environment(&world);
  e.run<claim_in_two_calls>();
  const auto got = [&] {
    std::vector<bool> all;
    for (const auto& g : world.got) all.push_back(e.get(g));
    return all;
  };
  CHECK(got() == std::vector{true, false, false, false});
  e.set(world.key, 4);
  e.propagate();
  CHECK(got() == std::vector{true, true, false, false});
  e.set(world.key, 5);
  e.propagate();
  CHECK(got() == std::vector{true, false, false, false});
  claims.check_invariants();
  e.run<claim_late>();
  claims.check_invariants();
  e.check_invariants();
}

}  // namespace
