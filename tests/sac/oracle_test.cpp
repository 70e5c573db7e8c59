// Random programs under random edits, compared with a run from scratch after every propagation.
#include <catch2/catch.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "random_program.hpp"

namespace {

using namespace support;

struct Edit {
  std::vector<std::pair<int, int>> sets;    // input, value
  std::vector<std::pair<int, bool>> posts;  // node 3 .. with argument 9; posted or taken back
  int fuse = -1;
};
struct Case {
  std::uint64_t seed;
  int nodes;
  std::vector<Edit> edits;
};

struct Traced {
  RandomWorld<sac::Scope> world;
  sac::Engine engine;
  Traced(const RandomProgram& program, const std::vector<int>& inputs,
         const std::multiset<int>& posts) {
    world.program = &program;
    world.start(engine, inputs);
    for (const int n : posts) world.agenda->post_from_outside<node<int>>(node_key(n, 9), n, 9);
    engine.run<random_root<int>>();
  }
  // Label, depth and number of edges of every call, in order.
  std::string shape() const {
    std::ostringstream out;
    engine.walk([&](const sac::Call& c, std::size_t depth) {
      out << depth << c.function().name;
      if (c.function().name != "pass") c.function().print(c, out);
      out << ' ';
    });
    return out.str();
  }
};

std::vector<int> plain_values(const RandomProgram& program, const std::vector<int>& inputs,
                              const std::multiset<int>& posts) {
  RandomWorld<sac::PlainScope> world;
  sac::PlainScope scope;
  world.program = &program;
  world.start(scope, inputs);
  for (const int n : posts) world.agenda->post_from_outside<node<int>>(node_key(n, 9), n, 9);
  scope.run<random_root<int>>();
  std::vector<int> values;
  for (const auto& c : world.cells) values.push_back(scope.get(c));
  return values;
}

std::vector<int> values_of(const Traced& t) {
  std::vector<int> values;
  for (const auto& c : t.world.cells) values.push_back(t.engine.get(c));
  return values;
}

// What is wrong after some edit; empty if nothing.
std::string run(const Case& c) {
  const RandomProgram program(c.seed, c.nodes);
  std::vector<int> inputs(static_cast<std::size_t>(program.inputs), 1);
  std::multiset<int> posts;
  Traced t(program, inputs, posts);
  for (std::size_t i = 0; i < c.edits.size(); ++i) {
    const std::string where = "edit " + std::to_string(i) + ": ";
    const Edit& edit = c.edits[i];
    auto new_inputs = inputs;
    auto new_posts = posts;
    try {
      for (const auto& [input, value] : edit.sets) {
        new_inputs[static_cast<std::size_t>(input)] = value;
        t.engine.set(t.world.inputs[static_cast<std::size_t>(input)], value);
      }
      for (const auto& [n, on] : edit.posts) {
        if (on) {
          new_posts.insert(n);
          t.world.agenda->post_from_outside<node<int>>(node_key(n, 9), n, 9);
        } else if (const auto it = new_posts.find(n); it != new_posts.end()) {
          new_posts.erase(it);
          t.world.agenda->retract_from_outside<node<int>>(n, 9);
        }
      }
      t.world.fuse = edit.fuse;
      t.engine.propagate();
      inputs = new_inputs;
      posts = new_posts;
    } catch (const Failure&) {
    } catch (const std::exception& error) {
      return where + error.what();
    }
    t.world.fuse = -1;
    try {
      t.engine.check_invariants();
    } catch (const std::exception& error) {
      return where + error.what();
    }
    const Traced fresh(program, inputs, posts);
    if (values_of(t) != values_of(fresh)) return where + "values differ from a run from scratch";
    if (values_of(t) != plain_values(program, inputs, posts))
      return where + "values differ from plain";
    if (t.engine.live_calls() != fresh.engine.live_calls()) {
      return where + "calls: " + std::to_string(t.engine.live_calls()) + " for " +
             std::to_string(fresh.engine.live_calls()) + "\n" + t.shape() + "\n" + fresh.shape();
    }
    if (t.engine.live_edges() != fresh.engine.live_edges()) return where + "number of edges";
  }
  return "";
}

Case random_case(std::uint64_t seed) {
  Random random(seed ^ 0xabcdef);
  Case c{seed, 4 + random(10), {}};
  for (int i = 0; i < 25; ++i) {
    Edit edit;
    for (int k = 1 + random(3); k > 0; --k) edit.sets.push_back({random(4), random(5)});
    if (random(3) == 0) {
      for (int k = 1 + random(2); k > 0; --k)
        edit.posts.push_back({3 % c.nodes + random(c.nodes - 3), random(2) == 0});
    }
    if (random(4) == 0) edit.fuse = random(12);
    c.edits.push_back(edit);
  }
  return c;
}

// A smaller case that fails as well: fewer edits, then simpler ones, then fewer nodes.
Case shrink(Case c) {
  for (bool smaller = true; smaller;) {
    smaller = false;
    const auto keep = [&](const Case& other) {
      if (run(other).empty()) return false;
      c = other;
      return smaller = true;
    };
    for (std::size_t i = c.edits.size(); i-- > 0;) {
      Case other = c;
      other.edits.erase(other.edits.begin() + static_cast<std::ptrdiff_t>(i));
      if (keep(other)) continue;
      for (std::size_t k = c.edits[i].sets.size(); k-- > 0;) {
        other = c;
        other.edits[i].sets.erase(other.edits[i].sets.begin() + static_cast<std::ptrdiff_t>(k));
        keep(other);
      }
      other = c;
      other.edits[i].posts.clear();
      if (!c.edits[i].posts.empty()) keep(other);
      other = c;
      other.edits[i].fuse = -1;
      if (c.edits[i].fuse >= 0) keep(other);
    }
    if (c.nodes > 4) {
      Case other = c;
      --other.nodes;
      for (auto& edit : other.edits) {
        std::erase_if(edit.posts, [&](const auto& p) { return p.first >= other.nodes; });
      }
      keep(other);
    }
  }
  return c;
}

std::string describe(const Case& c) {
  std::ostringstream out;
  out << "seed " << c.seed << ", " << c.nodes << " nodes\n";
  for (const Edit& edit : c.edits) {
    for (const auto& [input, value] : edit.sets) out << "set " << input << ' ' << value << "; ";
    for (const auto& [n, on] : edit.posts) out << (on ? "post " : "retract ") << n << "; ";
    out << "fuse " << edit.fuse << '\n';
  }
  return out.str();
}

void check_seeds(std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t seed = from; seed < to; ++seed) {
    const Case c = random_case(seed);
    if (run(c).empty()) continue;
    const Case small = shrink(c);
    FAIL(describe(small) << run(small));
  }
}

TEST_CASE(
    "random programs under random edits and failures equal a run from scratch and a plain run") {
  check_seeds(0, 400);
}

TEST_CASE("many random programs equal a run from scratch and a plain run", "[.soak]") {
  check_seeds(1000, 40000);
}

}  // namespace
