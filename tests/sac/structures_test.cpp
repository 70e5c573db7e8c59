// The engine's containers: arena, memo table, propagation queue; names of labels.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "failing_new.hpp"
#include "sac/internal/chain.hpp"
#include "sac/sac.hpp"

namespace {

using sac::Handle;
using sac::Place;
using CallRef = sac::Ref<sac::Call>;

struct Random {
  std::uint64_t state = 11;
  std::size_t operator()(std::size_t n) {
    state = sac::mix(state + 0x9e3779b97f4a7c15u);
    return state % n;
  }
};

TEST_CASE("arena blocks do not overlap, keep their address, and are handed out again") {
  sac::Arena arena;
  Random random;
  std::map<Handle, std::size_t> live;
  for (int step = 0; step < 20000; ++step) {
    if (live.empty() || random(2) == 0) {
      const std::size_t bytes = random(20) == 0 ? 1000 + random(3000) : 8 + random(200);
      const Handle h = arena.allocate(bytes);
      REQUIRE(h != 0);
      REQUIRE(reinterpret_cast<std::uintptr_t>(arena.at<char>(h)) % 8 == 0);
      REQUIRE(arena.handle_of(arena.at<char>(h)) == h);
      const auto next = live.lower_bound(h);
      const std::size_t granules = (bytes + 7) / 8;
      REQUIRE((next == live.end() || h + granules <= next->first));
      REQUIRE((next == live.begin() ||
               std::prev(next)->first + (std::prev(next)->second + 7) / 8 <= h));
      live[h] = bytes;
    } else {
      const auto it = std::next(live.begin(), static_cast<std::ptrdiff_t>(random(live.size())));
      arena.release(it->first, it->second);
      live.erase(it);
    }
  }
  arena.check_invariants();
  const auto held = arena.bytes_held();
  for (int round = 0; round < 1000; ++round) arena.release(arena.allocate(64), 64);
  CHECK(arena.bytes_held() == held);
}

// Calls that lie in a timeline without an engine.
struct Calls {
  sac::Arena arena;
  sac::Timeline timeline{arena};
  CallRef make(Place after) {
    const CallRef call = arena.make<sac::Call>();
    timeline.insert_after(after, call);
    return call;
  }
};

TEST_CASE("the handle of a record converts to that of its base, and to no other") {
  STATIC_REQUIRE(sizeof(CallRef) == 4);
  STATIC_REQUIRE(std::is_trivially_copyable_v<CallRef>);
  STATIC_REQUIRE(std::is_convertible_v<CallRef, Place>);
  STATIC_REQUIRE(std::is_convertible_v<sac::Ref<sac::Segment>, Place>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<Place, CallRef>);
  STATIC_REQUIRE_FALSE(std::is_constructible_v<CallRef, Place>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<CallRef, sac::Ref<sac::Edge>>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<Handle, CallRef>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<CallRef, Handle>);
  Calls calls;
  const CallRef call = calls.make(calls.timeline.front());
  const Place place = call;
  CHECK(place == call);
  CHECK(&calls.arena[place] == &calls.arena[call]);
  CHECK(sac::Arena::ref(calls.arena[call]) == call);
  CHECK(calls.arena.contains(call));
  CHECK_FALSE(calls.arena.contains(CallRef()));
  CHECK_FALSE(calls.arena.contains(CallRef(call.handle() + 1000)));
}

struct Member {
  explicit Member(int number) : n(number) {}
  int n;
  sac::Ref<Member> previous, next;
};

TEST_CASE("a chain has the newest record first, and a visit may remove its record") {
  using Chain = sac::detail::Chain<Member, &Member::previous, &Member::next>;
  sac::Arena arena;
  sac::Ref<Member> first;
  std::vector<sac::Ref<Member>> all;
  for (int i = 0; i < 6; ++i) {
    all.push_back(arena.make<Member>(i));
    Chain::push(arena, first, arena[all.back()]);
  }
  const auto numbers = [&] {
    std::vector<int> found;
    Chain::for_each(arena, first, [&](const Member& m) { found.push_back(m.n); });
    return found;
  };
  CHECK(numbers() == std::vector{5, 4, 3, 2, 1, 0});
  Chain::remove(arena, first, arena[all[5]]);
  Chain::remove(arena, first, arena[all[0]]);
  Chain::remove(arena, first, arena[all[2]]);
  CHECK(numbers() == std::vector{4, 3, 1});
  Chain::for_each(arena, first, [&](const Member& m) { Chain::remove(arena, first, m); });
  CHECK(first == nullptr);
}

TEST_CASE("the propagation queue pops calls in trace order, whatever was pushed and taken out") {
  Calls calls;
  sac::PropagationQueue queue(calls.arena, calls.timeline);
  queue.reserve(500);
  Random random;
  std::vector<CallRef> order;
  for (int i = 0; i < 500; ++i)
    order.push_back(calls.make(order.empty() ? calls.timeline.front() : Place(order.back())));
  std::set<std::size_t> queued;
  for (int step = 0; step < 5000; ++step) {
    const std::size_t i = random(order.size());
    auto& call = calls.arena[order[i]];
    if (step % 500 == 499) queue.sort();
    if (random(3) == 0 && !queued.empty()) {
      REQUIRE(queue.front().call == order[*queued.begin()]);
      REQUIRE(queue.pop().call == order[*queued.begin()]);
      queued.erase(queued.begin());
    } else if (call.queue != 0) {
      queue.erase(call);
      queued.erase(i);
    } else {
      queue.push({order[i], order[i]});
      queued.insert(i);
    }
    queue.check_invariants();
    REQUIRE(queue.size() == queued.size());
  }
}

TEST_CASE("a shrunk arena keeps what is live, gives pages back, and hands their memory out again") {
  sac::Arena arena;
  Random random;
  std::vector<std::pair<Handle, std::size_t>> live;
  const auto fill = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const std::size_t bytes = 8 * (1 + random(40));
      live.emplace_back(arena.allocate(bytes), bytes);
      std::memset(arena.at<void>(live.back().first), static_cast<int>(live.size()), bytes);
    }
  };
  for (int round = 0; round < 6; ++round) {
    fill(20000);
    const std::size_t keep = random(3) == 0 ? 0 : live.size() / (2 + random(20));
    for (std::size_t i = live.size(); i-- > keep;) {
      std::swap(live[i], live[random(i + 1)]);
      arena.release(live[i].first, live[i].second);
      live.pop_back();
    }
    std::vector<std::vector<char>> contents;
    for (const auto& [h, bytes] : live)
      contents.emplace_back(arena.at<char>(h), arena.at<char>(h) + bytes);
    const std::size_t before = arena.bytes_held();
    arena.shrink();
    arena.check_invariants();
    CHECK(arena.bytes_held() <= before);
    if (live.empty() && sac::platform::kReturnsPages) CHECK(arena.bytes_held() < 4096);
    for (std::size_t i = 0; i < live.size(); ++i) {
      const char* bytes = arena.at<char>(live[i].first);
      REQUIRE(std::equal(contents[i].begin(), contents[i].end(), bytes));
    }
  }
  const std::size_t held = arena.bytes_held();
  fill(1000);
  arena.check_invariants();
  CHECK(arena.bytes_held() >= held);
}

TEST_CASE("the n-th allocation of an arena fails once, and a limit holds") {
  sac::Arena arena;
  arena.fail_after(3);
  static_cast<void>(arena.allocate(8));
  static_cast<void>(arena.allocate(8));
  const std::size_t used = arena.bytes_used();
  CHECK_THROWS_AS(static_cast<void>(arena.allocate(8)), std::bad_alloc);
  CHECK(arena.bytes_used() == used);
  static_cast<void>(arena.allocate(8));
  arena.set_limit(1 << 16);
  const auto exhaust = [&] {
    while (true) static_cast<void>(arena.allocate(64));
  };
  CHECK_THROWS_AS(exhaust(), std::bad_alloc);
  CHECK(arena.bytes_held() <= 1 << 16);
  CHECK(arena.bytes_held() > (1 << 16) - 64);
  arena.check_invariants();
}

void check_memo_table(const std::function<std::uint32_t(std::uint32_t)>& hash_of, bool soon) {
  Calls calls;
  sac::MemoTable memo(calls.arena, calls.timeline);
  std::vector<CallRef> all;
  const auto erase = [&](std::size_t i) {
    const std::uint32_t hash = hash_of(static_cast<std::uint32_t>(i));
    memo.leaves(all[i], hash);
    memo.erase(all[i], hash);
  };
  const auto found = [&](std::size_t i) {
    const auto is_it = [&](const sac::Call& c) { return calls.arena.ref(c) == all[i]; };
    return memo.find_between(hash_of(static_cast<std::uint32_t>(i)), calls.timeline.front(),
                             nullptr, is_it) == all[i];
  };
  for (std::uint32_t i = 0; i < 5000; ++i) {
    all.push_back(calls.make(calls.timeline.back()));
    soon ? memo.insert_soon(all.back(), hash_of(i)) : memo.insert(all.back(), hash_of(i));
    REQUIRE(memo.contains(all.back(), hash_of(i)));
    if (i % 100 == 99) REQUIRE(found(i - 3));
    if (i % 100 == 50) {
      memo.settle();
      erase(i);
      REQUIRE_FALSE(memo.contains(all[i], hash_of(i)));
      memo.insert(all[i], hash_of(i));
    }
  }
  memo.check_invariants();
  memo.settle();
  memo.check_invariants();
  for (std::uint32_t i = 0; i < all.size(); i += 2) erase(i);
  memo.check_invariants();
  memo.shrink();
  memo.check_invariants();
  CHECK(memo.size() == all.size() / 2);
  for (std::size_t i = 0; i < all.size(); ++i) REQUIRE(found(i) == (i % 2 == 1));
  std::size_t visited = 0;
  memo.for_each([&](const sac::Call&) { ++visited; });
  CHECK(visited == memo.size());
}

TEST_CASE("what waits for its place in the memo table is found in the order in which it came") {
  Calls calls;
  sac::MemoTable memo(calls.arena, calls.timeline);
  std::vector<CallRef> all;
  const auto hash_of = [](std::size_t i) { return static_cast<std::uint32_t>(sac::mix(i / 3)); };
  for (std::size_t i = 0; i < 3000; ++i) {
    all.push_back(calls.make(calls.timeline.back()));
    memo.insert_soon(all.back(), hash_of(i));
  }
  support::memory_is_out = true;
  bool settled = true;
  try {
    memo.settle();
  } catch (const std::bad_alloc&) {
    settled = false;
  }
  support::memory_is_out = false;
  CHECK_FALSE(settled);
  memo.check_invariants();
  memo.settle();
  for (std::size_t i = 0; i < 3000; i += 5) memo.erase(all[i], hash_of(i));
  memo.check_invariants();
  for (std::size_t i = 0; i < 3000; i += 3) {
    std::vector<CallRef> expected, found;
    for (std::size_t k = i; k < i + 3; ++k) {
      if (k % 5 != 0) expected.push_back(all[k]);
    }
    const CallRef last = memo.find(hash_of(i), [&](const sac::Call& c) {
      found.push_back(calls.arena.ref(c));
      return false;
    });
    REQUIRE(last == nullptr);
    REQUIRE(found == expected);
  }
  memo.check_invariants();
  CHECK(memo.size() == 2400);
  memo.insert_soon(all[0], hash_of(0));
  memo.insert_soon(all[5], hash_of(5));
  memo.forget_waiting();
  CHECK(memo.size() == 2400);
  memo.erase(all[5], hash_of(5));
  CHECK(memo.size() == 2400);
  memo.check_invariants();
}

TEST_CASE("the memo table finds every call by its hash, through growth and erasure") {
  const auto random = [](std::uint32_t i) { return static_cast<std::uint32_t>(sac::mix(i)); };
  const auto repeated = [](std::uint32_t i) {
    return static_cast<std::uint32_t>(sac::mix(i % 700));
  };
  const auto close = [](std::uint32_t i) { return 0xfffffff0u + i % 16; };
  const auto all_alike = [](std::uint32_t) { return 0xffffffffu; };
  for (const bool soon : {false, true}) {
    check_memo_table(random, soon);
    check_memo_table(repeated, soon);
    check_memo_table(close, soon);
    check_memo_table(all_alike, soon);
  }
}

void some_function(sac::Scope&, int) {}
struct Object {
  static constexpr std::string_view kName = "an object";
  void operator()(sac::Scope&) const {}
};
struct Plain {
  void operator()(sac::Scope&) const {}
};
template <class T>
struct Of {
  void operator()(sac::Scope&) const {}
};

TEST_CASE("a function's name comes from the function itself") {
  CHECK(sac::function_name<&some_function>() == "some_function");
  CHECK(sac::function_name<some_function>() == "some_function");
  CHECK(sac::function_name<Object{}>() == "an object");
  CHECK(sac::function_name<Plain{}>() == "Plain");
  CHECK(sac::function_name<Of<sac::Scope>{}>() == "Of<sac::Scope>");
  CHECK(sac::function_name<[](sac::Scope&) {}>() == "lambda");
}

TEST_CASE("a call is described by its name and arguments") {
  sac::Engine e;
  e.run<some_function>(42);
  e.walk([](const sac::Call& c, std::size_t) {
    CHECK(sac::Engine::describe(c) == "some_function(42)");
  });
}

}  // namespace
