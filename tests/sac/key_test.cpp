// Keys of posted calls: their widths on an agenda, and what does not fit.
#include "sac/key.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "sac/sac.hpp"

namespace {

using sac::Key;
using sac::KeyWidths;
using sac::UsageError;

// The message of what body() throws.
std::string message_of(auto&& body) {
  try {
    body();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST_CASE("ranks are ordered as keys are, up to the ends of every width") {
  for (const KeyWidths widths : {KeyWidths{}, KeyWidths{16, 4, 12}, KeyWidths{32, 0, 0},
                                 KeyWidths{1, 31, 0}, KeyWidths{1, 0, 31}, KeyWidths{2, 3, 4}}) {
    widths.require_possible("a");
    const std::int64_t half = std::int64_t{1} << (widths.bucket - 1);
    const std::uint64_t phases = std::uint64_t{1} << widths.phase;
    const std::uint64_t colours = std::uint64_t{1} << widths.colour;
    std::uint64_t previous = 0;
    for (const std::int64_t bucket : {-half, half - 1}) {
      for (const std::uint64_t phase : std::set<std::uint64_t>{0, phases - 1}) {
        for (const std::uint64_t colour : std::set<std::uint64_t>{0, colours - 1}) {
          const Key key{.bucket = static_cast<int>(bucket),
                        .phase = static_cast<unsigned>(phase),
                        .colour = static_cast<unsigned>(colour)};
          REQUIRE(widths.fits(key));
          REQUIRE(widths.rank(key) >= previous);
          previous = widths.rank(key);
        }
      }
    }
    CHECK(previous == (std::uint64_t{1} << (widths.bucket + widths.phase + widths.colour)) - 1);
    if (widths.bucket < 32) {
      CHECK_FALSE(widths.fits({.bucket = static_cast<int>(half)}));
      CHECK_FALSE(widths.fits({.bucket = static_cast<int>(-half - 1)}));
    }
    CHECK_FALSE(widths.fits({.phase = static_cast<unsigned>(phases)}));
    CHECK_FALSE(widths.fits({.colour = static_cast<unsigned>(colours)}));
  }
}

struct Visit {
  static constexpr std::string_view kName = "visit";
  template <class S>
  void operator()(S&, std::string, int) const {}
};
inline constexpr Visit visit{};

template <class S>
struct Posts {
  typename S::AgendaType& agenda;
  Key key;
};
struct PostOne {
  static constexpr std::string_view kName = "post_one";
  template <class S>
  void operator()(S& s) const {
    auto& p = s.template environment<Posts<S>>();
    p.agenda.template post<visit>(s, p.key, std::string("me"), 7);
  }
};
inline constexpr PostOne post_one{};

template <class S, class Host>
std::vector<std::string> refusals() {
  Host host;
  auto& agenda = host.make_agenda("levels", KeyWidths{.bucket = 16, .phase = 4, .colour = 12});
  Posts<S> posts{agenda, {}};
  host.set_environment(&posts);
  std::vector<std::string> all;
  for (const Key key :
       {Key{.bucket = 32768}, Key{.bucket = -32769}, Key{.phase = 16}, Key{.colour = 4096}}) {
    posts.key = key;
    all.push_back(message_of([&] { host.template run<post_one>(); }));
    all.push_back(
        message_of([&] { agenda.template post_from_outside<visit>(key, std::string("you"), 8); }));
  }
  for (const Key key : {Key{.bucket = 32767, .phase = 15, .colour = 4095}, Key{.bucket = -32768}}) {
    posts.key = key;
    CHECK(message_of([&] {
            agenda.template post_from_outside<visit>(key, std::string("you"), posts.key.bucket);
          }) == "");
  }
  if constexpr (S::kTraced) host.check_invariants();
  return all;
}

TEST_CASE("a key that does not fit names the call, the part, its value and the range") {
  const auto traced = refusals<sac::Scope, sac::Engine>();
  const std::string rest = ": KeyWidths of make_agenda sets the ranges";
  const std::string mine = "agenda 'levels': visit(me, 7) is posted at ";
  const std::string yours = "agenda 'levels': visit(you, 8) is posted at ";
  CHECK(traced ==
        std::vector<std::string>{mine + "bucket 32768, which is not in -32768 .. 32767" + rest,
                                 yours + "bucket 32768, which is not in -32768 .. 32767" + rest,
                                 mine + "bucket -32769, which is not in -32768 .. 32767" + rest,
                                 yours + "bucket -32769, which is not in -32768 .. 32767" + rest,
                                 mine + "phase 16, which is not in 0 .. 15" + rest,
                                 yours + "phase 16, which is not in 0 .. 15" + rest,
                                 mine + "colour 4096, which is not in 0 .. 4095" + rest,
                                 yours + "colour 4096, which is not in 0 .. 4095" + rest});
  CHECK(refusals<sac::PlainScope, sac::PlainScope>() == traced);
}

TEST_CASE("widths that are not possible are refused, and nothing is made") {
  sac::Engine e;
  sac::PlainScope plain;
  for (const KeyWidths widths : {KeyWidths{0, 4, 4}, KeyWidths{20, 8, 5}, KeyWidths{33, 0, 0},
                                 KeyWidths{1, 32, 0}, KeyWidths{4294967295u, 1, 2}}) {
    const std::string refusal = message_of([&] { static_cast<void>(e.make_agenda("a", widths)); });
    CHECK(refusal.find("agenda 'a' cannot have keys of ") == 0);
    CHECK(message_of([&] { static_cast<void>(plain.make_agenda("a", widths)); }) == refusal);
  }
  for (int i = 0; i < 254; ++i) static_cast<void>(e.make_agenda("one of many"));
}

// --- Many levels -----------------------------------------------------------------------------

template <class S>
struct Levels {
  typename S::AgendaType& agenda;
  typename S::template ModType<int> first;
  typename S::template ModType<int> last;
  int most;
};
struct Climb {
  static constexpr std::string_view kName = "climb";
  template <class S>
  void operator()(S& s, int level) const {
    auto& w = s.template environment<Levels<S>>();
    if (level == w.most) return s.write(w.last, level);
    w.agenda.template post<Climb{}>(s, Key{.bucket = level + 1}, level + 1);
  }
};
struct Begin {
  static constexpr std::string_view kName = "begin";
  template <class S>
  void operator()(S& s) const {
    auto& w = s.template environment<Levels<S>>();
    s.write(w.last, -1);
    w.agenda.template post<Climb{}>(s, Key{.bucket = s.read(w.first)}, s.read(w.first));
    w.agenda.drain(s);
  }
};
inline constexpr Begin begin{};

template <class S, class Host>
void climb(int most, auto&& check) {
  Host host;
  Levels<S> levels{host.make_agenda("levels"), host.input(0), host.template cell<int>(), most};
  host.set_environment(&levels);
  host.template run<begin>();
  CHECK(host.get(levels.last) == most);
  check(host, levels);
}

constexpr int kMost = 1000000;

TEST_CASE("a chain of a million levels is one bucket for each") {
  climb<sac::Scope, sac::Engine>(kMost, [](auto& e, const auto& levels) {
    e.set(levels.first, -3);
    CHECK(e.propagate().executed == 4);
    CHECK(e.get(levels.last) == kMost);
    e.check_invariants();
  });
  climb<sac::PlainScope, sac::PlainScope>(kMost, [](auto&, const auto&) {});
}

}  // namespace
