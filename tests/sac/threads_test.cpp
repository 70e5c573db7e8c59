// Engines in several threads at once do what each does alone: they share nothing.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "breadth_first_search.hpp"
#include "list_map.hpp"
#include "random_program.hpp"
#include "sac/event_log.hpp"
#include "sac/sac.hpp"

namespace {

using namespace support;
using sac::Engine;
using sac::Mod;
using sac::Scope;

// A session edits an engine of its own at random and writes down what it sees.
using Session = std::string (*)(std::uint64_t seed);

void print_trace(std::ostream& out, const Engine& e) {
  e.walk(
      [&](const sac::Call& c, std::size_t depth) { out << depth << Engine::describe(c) << ' '; });
  out << e.live_edges() << '\n';
}

// Programs that fail now and then, watched by a log.
std::string random_program(std::uint64_t seed) {
  std::ostringstream out;
  Random random(seed ^ 0x7e57);
  const RandomProgram program(seed, 4 + random(10));
  RandomWorld<Scope> world;
  Engine e;
  sac::EventLog log(e);
  world.start(e, program, {});
  world.run(e, {});
  for (int step = 0; step < 12; ++step) {
    const auto input = static_cast<std::size_t>(random(4));
    e.set(world.inputs[input], random(5));
    world.fuse = random(4) == 0 ? random(12) : -1;
    try {
      out << e.propagate().executed << ' ';
    } catch (const Failure& failure) {
      out << failure.what() << ' ';
    }
    world.fuse = -1;
    for (const auto& cell : world.cells) out << e.get(cell) << ' ';
    out << log.explain("node");
    print_trace(out, e);
  }
  e.check_invariants();
  return out.str();
}

std::string search(std::uint64_t seed) {
  namespace bfs = examples::breadth_first_search;
  constexpr int kSize = 60;
  std::ostringstream out;
  Random random(seed);
  Engine e;
  bfs::Graph<Scope> graph(e, kSize);
  const auto edit = [&] {
    std::vector<int> to;
    for (int i = random(4); i > 0; --i) to.push_back(random(kSize));
    e.set(graph.edges[static_cast<std::size_t>(random(kSize))], to);
  };
  for (int i = 0; i < kSize; ++i) edit();
  e.propagate();
  e.run<bfs::search>();
  for (int step = 0; step < 20; ++step) {
    edit();
    out << e.propagate().executed << ": ";
    for (const auto hops : graph.hops) out << e.get(hops) << ' ';
  }
  print_trace(out, e);
  e.check_invariants();
  return out.str();
}

// Memory is given back now and then.
std::string map_list(std::uint64_t seed) {
  using Node = examples::Node<Scope>;
  std::ostringstream out;
  Random random(seed);
  Engine e;
  std::vector<Node*> nodes{&e.make<Node>()};
  e.set(nodes[0]->next, nullptr);
  const auto insert = [&] {
    Node& node = e.make<Node>();
    node.element = {random(1000), static_cast<std::uint32_t>(nodes.size())};
    const auto place = static_cast<std::size_t>(random(static_cast<int>(nodes.size())));
    e.set(node.next, e.get(nodes[place]->next));
    e.set(nodes[place]->next, &node);
    nodes.push_back(&node);
  };
  for (int i = 0; i < 200; ++i) insert();
  e.propagate();
  const auto result = e.cell<const Node*>();
  e.run<examples::map_list>(static_cast<const Node*>(nodes[0]), result);
  for (int step = 0; step < 20; ++step) {
    insert();
    out << e.propagate().executed << ": ";
    for (const auto& element : examples::elements_behind(e, e.get(result))) out << element << ' ';
    if (step % 8 == 0) e.shrink();
  }
  e.check_invariants();
  return out.str();
}

constexpr Session kSessions[] = {random_program, search, map_list};
constexpr std::uint64_t kSeeds = 12;
constexpr std::size_t kJobs = kSeeds * std::size(kSessions);

std::string do_job(std::size_t job) {
  return kSessions[job % std::size(kSessions)](job / std::size(kSessions));
}

TEST_CASE("engines in several threads at once give the results of one thread") {
  std::vector<std::string> expected;
  for (std::size_t job = 0; job < kJobs; ++job) expected.push_back(do_job(job));
  constexpr std::size_t kThreads = 4;
  std::vector<std::vector<std::string>> seen(kThreads, std::vector<std::string>(kJobs));
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {  // all jobs, each thread from another one on
      for (std::size_t i = 0; i < kJobs; ++i) {
        const std::size_t job = (i + t * kJobs / kThreads) % kJobs;
        seen[t][job] = do_job(job);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  for (std::size_t t = 0; t < kThreads; ++t) {
    for (std::size_t job = 0; job < kJobs; ++job) {
      CAPTURE(t, job);
      CHECK(seen[t][job] == expected[job]);
    }
  }
}

void copy(Scope& s, Mod<int> from, Mod<int> to) { s.write(to, s.read(from)); }
void dig(Scope& s, Mod<int> depth, int level) {
  if (level < s.read(depth)) s.call<dig>(depth, level + 1);
}

TEST_CASE("an engine may go from thread to thread") {
  Engine e;
  const auto in = e.input(0), out = e.cell<int>();
  const auto in_a_thread = [](const std::function<void()>& act) { std::thread(act).join(); };
  in_a_thread([&] { e.run<copy>(in, out); });
  int sum = 0;
  for (int i = 1; i <= 10; ++i) {
    in_a_thread([&] {
      e.set(in, i);
      e.propagate();
    });
    sum += e.get(out);
  }
  CHECK(sum == 55);
  e.check_invariants();
}

TEST_CASE("calls that go too deep are an error on the stack of any thread") {
  Engine e;
  const auto depth = e.input(100'000);
  std::string text;
  std::thread([&] {
    try {
      e.run<dig>(depth, 0);
    } catch (const sac::UsageError& error) {
      text = error.what();
    }
  }).join();
  CHECK_THAT(text, Catch::Contains("calls dig too deep"));
  e.set(depth, 10);
  e.propagate();
  e.run<dig>(depth, 0);
  CHECK(e.live_calls() == 11);
}

}  // namespace
