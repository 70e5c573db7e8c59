#!/usr/bin/env bash
# What does not fit is refused by the compiler, and the first error says why.
#   compile_errors.sh COMPILER INCLUDE_DIRECTORY
set -euo pipefail
compiler=$1
include=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# What all programs include. It is compiled once, but not by clang++: version 14 crashes on it.
cat >"$work/common.hpp" <<END
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>
#include <sac/sac.hpp>
END
if ! "$compiler" --version | grep -q clang; then
  "$compiler" -std=c++20 -I"$include" -x c++-header "$work/common.hpp" -o "$work/common.hpp.gch"
fi

# compile DECLARATIONS STATEMENTS
compile() {
  cat >"$work/program.cpp" <<END
struct Bare { int x; };
struct Equal { int x; bool operator==(const Equal&) const = default; };
struct Ordered { int x; auto operator<=>(const Ordered&) const = default; };
struct AnySame { template <class T> bool operator()(const T&, const T&) const { return false; } };
$1
int main() {
  sac::Engine e;
  auto& agenda = e.make_agenda("work");
  static_cast<void>(agenda);
  $2
}
END
  "$compiler" -std=c++20 -fsyntax-only -I"$include" -include "$work/common.hpp" \
    "$work/program.cpp" 2>"$work/errors"
}
fail() {
  echo "$1" >&2
  cat "$work/program.cpp" "$work/errors" >&2
  failures=$((failures + 1))
}
# accepted DECLARATIONS STATEMENTS: what is like that which is refused below, and right.
accepted() {
  compile "$@" || fail "refused:"
}
# refused MESSAGE DECLARATIONS STATEMENTS
refused() {
  local message=$1
  shift
  if compile "$@"; then fail "accepted:"; return; fi
  [[ $(grep -m1 'error' "$work/errors") == *"$message"* ]] || fail "the first error is not '$message':"
}

# names TYPE: what the compiler says with its first error, and on the way to it, names this type.
names() {
  grep -m1 -B40 -A8 'error' "$work/errors" | grep -qF "$1" || fail "no '$1' at the first error:"
}

accepted 'void f(sac::Scope& s, Equal a, sac::Mod<Equal> m) { s.write(m, a); }' \
  'e.run<f>(Equal{1}, e.cell<Equal>());'
accepted 'void f(sac::Scope&, Ordered) {}' 'agenda.post_from_outside<f>({}, Ordered{1});'
accepted '' 'e.set(e.cell<Bare, AnySame>(), Bare{1});'
accepted 'void f(sac::Scope& s, sac::Mod<std::unique_ptr<int>> m) { s.write(m, nullptr); }' \
  'e.run<f>(e.cell<std::unique_ptr<int>>()); static_cast<void>(e.input(std::make_unique<int>(1)));'
refused 'set keeps a copy of the old value' '' 'e.set(e.input(std::make_unique<int>(1)), nullptr);'
accepted 'struct F { void operator()(sac::Scope&, int) const {} };' 'e.run<F{}>(1);'
accepted 'void f(sac::Scope&, const std::string&) {}' 'e.run<f>("text");'

same='a value or result needs ==, or a Same of its own'
refused "$same" '' 'static_cast<void>(e.input(Bare{1}));'
names 'Bare'
refused "$same" '' 'e.set(e.cell<Bare>(), Bare{1});'
refused "$same" 'void f(sac::Scope& s, sac::Mod<Bare> m) { s.write(m, Bare{1}); }' \
  'e.run<f>(e.cell<Bare>());'
refused "$same" 'Bare g(sac::Scope&) { return {1}; } void f(sac::Scope& s) { s.call<g>(); }' \
  'e.run<f>();'
needs_equality='an argument of a call needs =='
refused "$needs_equality" 'void f(sac::Scope&, Bare) {}' 'e.run<f>(Bare{1});'
names 'Bare'
refused "$needs_equality" 'void f(sac::Scope&, std::vector<Bare>) {}' \
  'e.run<f>(std::vector<Bare>());'
names 'Bare'
refused "$needs_equality" 'void f(sac::Scope&, std::optional<std::pair<int, Bare>>) {}' \
  'e.run<f>(std::optional<std::pair<int, Bare>>());'
names 'Bare'
opaque='class Opaque { public: bool operator==(const Opaque&) const = default; private: double d; };'
needs_hash='a type of arguments needs a hash: write'
refused "$needs_hash" "$opaque void f(sac::Scope&, Opaque) {}" 'e.run<f>(Opaque());'
names 'Opaque'
refused "$needs_hash" "$opaque struct S { std::vector<Opaque> all;
    bool operator==(const S&) const = default; }; void f(sac::Scope&, S) {}" 'e.run<f>(S());'
names 'Opaque'
refused "$needs_hash" 'struct Many { double a, b, c, d, e, f, g, h, i, j, k, l, m;
    bool operator==(const Many&) const = default; }; void f(sac::Scope&, Many) {}' \
  'e.run<f>(Many());'
names 'Many'
refused "$needs_hash" 'struct Base { double a; bool operator==(const Base&) const = default; };
  struct Derived : Base { double b; bool operator==(const Derived&) const = default; };
  void f(sac::Scope&, Derived) {}' 'e.run<f>(Derived());'
names 'Derived'
accepted 'struct Parts { std::vector<std::optional<std::pair<int, std::string>>> a; double b[2];
    std::variant<int, double> c; bool operator==(const Parts&) const = default; };
  void f(sac::Scope&, Parts, std::tuple<std::vector<int>, std::array<double, 2>>) {}' \
  'e.run<f>(Parts(), std::tuple<std::vector<int>, std::array<double, 2>>());'
refused 'an argument of a posted call needs <=> or <' 'void f(sac::Scope&, Equal) {}' \
  'agenda.post_from_outside<f>({}, Equal{1});'
names 'Equal'
address='calls of one key run in the order of their arguments, and addresses have another order'
refused "$address" 'void f(sac::Scope&, sac::Mod<int>) {}' \
  'agenda.post_from_outside<f>({}, e.input(1));'
refused "$address" 'void f(sac::Scope&, const int*) {}' \
  'agenda.post_from_outside<f>({}, static_cast<const int*>(nullptr));'
refused "$address" 'void f(sac::Scope&, std::vector<std::pair<int, sac::Mod<int>>>) {}
  namespace std { template <> struct hash<std::vector<std::pair<int, sac::Mod<int>>>> {
    std::size_t operator()(const auto&) const { return 0; } }; }' \
  'agenda.post_from_outside<f>({}, std::vector<std::pair<int, sac::Mod<int>>>());'
refused "$address" 'void f(sac::Scope&, std::variant<int, const int*>) {}' \
  'agenda.post_from_outside<f>({}, std::variant<int, const int*>());'
names 'variant<int, const int'
accepted 'struct Named { const int* p; int id;
    bool operator==(const Named& o) const { return p == o.p && id == o.id; }
    auto operator<=>(const Named& o) const { return id <=> o.id; }
    friend std::uint64_t hash_value(const Named& n) { return n.id; } };
  void f(sac::Scope&, Named) {}' 'agenda.post_from_outside<f>({}, Named{nullptr, 1});'
refused 'a value with a Same of its own is copied' '' \
  'static_cast<void>(e.input<std::unique_ptr<int>, AnySame>(nullptr));'
refused 'a traced function has no state' 'struct F { void operator()(sac::Scope&, int) {} };' \
  'e.run<F{}>(1);'
refused 'a traced function takes a Scope&' 'void f(int) {}' 'e.run<f>(1);'
refused 'takes another number of arguments' 'void f(sac::Scope&, int) {}' 'e.run<f>();'
refused 'an argument is not of the type' 'void f(sac::Scope&, std::unique_ptr<int>) {}' \
  'e.run<f>(1);'
refused 'a traced function changes modifiables, not its arguments' \
  'void f(sac::Scope&, int&) {}' 'e.run<f>(1);'
refused 'a tail call has nobody to return to' \
  'int g(sac::Scope&) { return 1; } void f(sac::Scope& s) { s.tail<g>(); }' 'e.run<f>();'
refused 'a posted call has nobody to return to' 'int f(sac::Scope&) { return 1; }' \
  'agenda.post_from_outside<f>({});'
refused 'what a program computes is in modifiables' 'int f(sac::Scope&) { return 1; }' 'e.run<f>();'
refused 'a value that may throw when it is moved would be lost' \
  'struct Throws { Throws(int); Throws(const Throws&); bool operator==(const Throws&) const; };' \
  'static_cast<void>(e.input(Throws(1)));'

accepted '' 'sac::Map<int, long, sac::Sum> m(e, "m"); m.set(1, 2);'
refused 'sums of floating-point numbers depend on the order' '' \
  'sac::Map<int, double, sac::Sum> m(e, "m");'
refused 'the order of addresses is another one in every run' '' \
  'sac::Map<const int*, int> m(e, "m");'
refused 'an option of a map is a scope, a group' '' 'sac::Map<int, int, Bare> m(e, "m");'
refused 'the type of a map names the monoids of its folds' \
  'void f(sac::Scope& s) { static_cast<void>(
     s.environment<sac::Map<int, int>>().fold<AnySame>(s, {})); }' 'e.run<f>();'

((failures == 0))
