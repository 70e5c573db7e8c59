// A program that uses a traceable data type of its own, claims.hpp: a list without repetitions.
//
// With the header, it is the code of docs/traceable_types.md; tests/sac/traceable_types_test.cpp
// runs it and compares them line by line.
// clang-format off
#include <stdexcept>
#include <string>

#include <sac/sac.hpp>

#include "claims.hpp"

namespace traceable_types {

void check(bool holds, int line = __builtin_LINE()) {
  if (!holds) throw std::logic_error("not true: line " + std::to_string(line));
}

// --- The program -----------------------------------------------------------------------------

struct IsFirst {
  template <class S>
  bool operator()(S& s, const std::string& word) const {
    return s.template environment<examples::Claims<std::string, S>>().claim(s, word);
  }
};

struct Unique {
  template <class S, class Words>
  void operator()(S& s, Words words, typename S::template ModType<Words> result) const {
    s.write(result, sac::filter<IsFirst{}>(s, words));
  }
};
inline constexpr Unique unique{};

// --- Traced ----------------------------------------------------------------------------------

template <class Host, class Words>
std::string text_of(Host& host, const Words& words) {
  std::string text;
  for (const auto& e : words.view(host)) text += e.value() + ' ';
  return text;
}

void traced() {
  sac::Engine e;
  examples::Claims<std::string> claims(e);
  e.set_environment(&claims);
  sac::Sequence<std::string> words(e, {"to", "be", "or", "not", "to", "be"});
  const auto result = e.cell<sac::List<std::string>>();
  e.run<unique>(words.list(), result);
  check(text_of(e, e.get(result)) == "to be or not ");

  words.erase(words.first());  // now the other "to" is the first
  check(e.propagate().executed == 4);  // before the one, before the other, itself, and "be"
  check(text_of(e, e.get(result)) == "be or not to ");

  words.push_front("be");
  e.propagate();
  check(text_of(e, e.get(result)) == "be or not to ");
  claims.check_invariants();
}

// --- Plain -----------------------------------------------------------------------------------

void plain() {
  sac::PlainScope scope;
  examples::Claims<std::string, sac::PlainScope> claims(scope);
  scope.set_environment(&claims);
  sac::Sequence<std::string, sac::PlainScope> words(scope, {"or", "not", "or"});
  const auto result = scope.cell<sac::List<std::string, sac::PlainScope>>();
  scope.run<unique>(words.list(), result);
  check(text_of(scope, scope.get(result)) == "or not ");
}

void run_all() {
  traced();
  plain();
}

}  // namespace traceable_types

#ifndef TRACEABLE_TYPES_WITHOUT_MAIN
int main() { traceable_types::run_all(); }
#endif
