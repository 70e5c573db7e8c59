// Two versions of a table, and the keys at which they differ, with their number and a checksum.
//
// An edit of a row makes the calls of the row and of the one before it run again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sac/sac.hpp"

namespace examples::differences {

// Of the differing keys, in order: a fold that is associative, and not commutative.
struct Checksum {
  struct Value {
    std::uint64_t factor = 1, sum = 0;
    friend bool operator==(const Value&, const Value&) = default;
    friend void label_bytes(sac::LabelSink& sink, const Value& v) {
      sink.number(v.factor), sink.number(v.sum);
    }
  };
  static Value none() { return {}; }
  static Value of(int key, int) { return {31, static_cast<std::uint64_t>(key)}; }
  static Value join(const Value& a, const Value& b) {
    return {a.factor * b.factor, a.sum * b.factor + b.sum};
  }
};

template <class S>
struct Versions {
  template <class Host>
  explicit Versions(Host& host)
      : left(host, "left"), right(host, "right"), differing(host, "differing") {
    host.set_environment(this);
  }
  sac::Map<int, int, S> left, right;
  sac::Map<int, int, Checksum, S> differing;  // to how many of the two have the key
};

struct Compare {
  static constexpr std::string_view kName = "compare";
  template <class S>
  void operator()(S& s, int key) const {
    auto& v = s.template environment<Versions<S>>();
    const auto left = v.left.find(s, key), right = v.right.find(s, key);
    if (left != right) v.differing.put(s, key, left.has_value() + right.has_value());
  }
};

struct CompareAll {
  static constexpr std::string_view kName = "compare_all";
  template <class S, class Size, class Sum>
  void operator()(S& s, Size size, Sum checksum) const {
    auto& v = s.template environment<Versions<S>>();
    sac::merge<Compare{}>(s, v.left, v.right);
    s.write(size, v.differing.size(s));
    s.write(checksum, v.differing.template fold<Checksum>(s, {}).sum);
  }
};
inline constexpr CompareAll compare_all{};

}  // namespace examples::differences
