// The snippets of sac/docs/errors.md as one program; check() throws where a snippet is not true.
//
// tests/sac/errors_snippets_test.cpp runs it, and compares text and output with the document.
// clang-format off
#include <new>
#include <ostream>
#include <stdexcept>
#include <string>

#include <sac/sac.hpp>

namespace errors {

void check(bool holds, int line = __builtin_LINE()) {
  if (!holds) throw std::logic_error("not true: line " + std::to_string(line));
}

// --- A program that throws -------------------------------------------------------------------

void divide(sac::Scope& s, sac::Mod<int> a, sac::Mod<int> b, sac::Mod<int> out) {
  if (s.read(b) == 0) throw std::domain_error("division by zero");
  s.write(out, s.read(a) / s.read(b));
}

void throwing(std::ostream& print) {
  sac::Engine e;
  const auto a = e.input(12), b = e.input(4), out = e.cell<int>();
  e.run<divide>(a, b, out);

  e.set(a, 100);
  e.set(b, 0);
  try {
    e.propagate();
  } catch (const std::domain_error& error) {
    print << error.what() << ": a is " << e.get(a) << ", b is " << e.get(b) << ", out is "
          << e.get(out) << '\n';
  }
  e.set(b, 3);  // and on
  e.propagate();
  check(e.get(out) == 4);
}

// --- A mistake in the program ----------------------------------------------------------------

void one(sac::Scope& s, sac::Mod<int> x) { s.write(x, 1); }

void read_first(sac::Scope& s, sac::Mod<int> x, sac::Mod<int> out) {
  s.write(out, s.read(x));
  s.call<one>(x);
}

void mistake(std::ostream& print) {
  sac::Engine e;
  const auto x = e.cell<int>(), out = e.cell<int>();
  e.name(x, "counter");
  try {
    e.run<read_first>(x, out);
  } catch (const sac::UsageError& error) {
    print << error.what() << '\n';
  }
  check(e.live_calls() == 0);  // the run is taken back
}

// --- Giving up -------------------------------------------------------------------------------

void count_up(sac::Scope& s, sac::Mod<int> to, int i) {
  if (i < s.read(to)) s.tail<count_up>(to, i + 1);
}

void giving_up() {
  sac::Engine e;
  const auto to = e.input(10);
  e.run<count_up>(to, 0);

  e.set_progress([](const sac::Progress& p) { return p.executed < 5000; }, 100);
  e.set(to, 1'000'000);
  bool cancelled = false;
  try {
    e.propagate();
  } catch (const sac::Cancelled&) {
    cancelled = true;
  }
  check(cancelled && e.get(to) == 10 && e.live_calls() == 11);

  e.set_progress(nullptr);
  e.set_memory_limit(e.memory().calls_and_edges_held + 1'000'000);
  e.set(to, 1'000'000);
  bool out_of_memory = false;
  try {
    e.propagate();
  } catch (const std::bad_alloc&) {
    out_of_memory = true;
  }
  check(out_of_memory && e.get(to) == 10 && e.live_calls() == 11);
}

// --- Edits that are not to be ----------------------------------------------------------------

void taking_back() {
  sac::Engine e;
  const auto a = e.input(12), b = e.input(4), out = e.cell<int>();
  e.run<divide>(a, b, out);

  e.set(a, 5);
  e.set(b, 0);
  e.undo_edits();
  check(e.get(a) == 12 && e.get(b) == 4 && e.propagate().executed == 0);
}

/// Prints what the document shows.
void run_all(std::ostream& print) {
  throwing(print);
  mistake(print);
  giving_up();
  taking_back();
}

}  // namespace errors
