// The words of a dictionary nearest to a given one, while the dictionary and the word change.
//
// Idea: the entries are the leaves of a balanced binary tree; each leaf finds the distance of its
// entry from the word, each inner node merges the nearest of its two halves.
//
// Source: the distance is that of Wagner, Fischer, *The string-to-string correction problem*
// (1974). Cost of an update: for one entry, one distance and O(log n) merges, up to the first with
// an unchanged result. For the word, n distances, since all of them read it; the merges run again
// where a distance among the nearest changed. Stable because: a call is named by its range of
// entries, and every range is halved alike.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "sac/sac.hpp"

namespace examples::spell_check {

/// Insertions, deletions and replacements of a letter that make `b` of `a`. Cost: O(|a| |b|).
inline int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);  // distances of a's first letters from all beginnings of b
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = std::exchange(row[0], static_cast<int>(i) + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// An entry with its distance; by default none.
struct Match {
  int distance = std::numeric_limits<int>::max();
  int entry = -1;
  friend auto operator<=>(const Match&, const Match&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Match& m) {
    sac::label_arguments(sink, std::tie(m.distance, m.entry));
  }
};
/// The nearest entries, nearest first, equals by number.
using Nearest = std::array<Match, 4>;

inline Nearest merge(const Nearest& a, const Nearest& b) {
  std::array<Match, 2 * std::tuple_size_v<Nearest>> all;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), all.begin());
  Nearest nearest;
  std::copy_n(all.begin(), nearest.size(), nearest.begin());
  return nearest;
}

template <class S>
struct Dictionary {
  template <class T>
  using Mod = typename S::template ModType<T>;

  Mod<std::string> word;                  // input
  std::vector<Mod<std::string>> entries;  // inputs; an empty one is none
  Mod<Nearest> nearest;

  /// Empty entries, and an empty word.
  template <class Host>
  Dictionary(Host& host, int size)
      : word(host.input(std::string())), nearest(host.template cell<Nearest>()) {
    for (int i = 0; i < size; ++i) entries.push_back(host.input(std::string()));
    host.set_environment(this);
  }
  Dictionary(const Dictionary&) = delete;  // it is the environment
  Dictionary& operator=(const Dictionary&) = delete;
};

struct Search {
  static constexpr std::string_view kName = "search";
  template <class S>
  Nearest operator()(S& s, int begin, int end) const;
};
inline constexpr Search search{};

template <class S>
Nearest Search::operator()(S& s, int begin, int end) const {
  if (end - begin > 1) {
    const int middle = std::midpoint(begin, end);
    const Nearest& first = s.template call<search>(begin, middle);
    return merge(first, s.template call<search>(middle, end));
  }
  Nearest nearest;
  if (begin == end) return nearest;
  auto& dictionary = s.template environment<Dictionary<S>>();
  const std::string& entry = s.read(dictionary.entries[begin]);
  if (entry.empty()) return nearest;
  const std::string& word = s.read(dictionary.word);
  s.weigh(word.size() * entry.size());
  nearest[0] = {edit_distance(word, entry), begin};
  return nearest;
}

struct Check {
  static constexpr std::string_view kName = "check";
  template <class S>
  void operator()(S& s) const {
    auto& dictionary = s.template environment<Dictionary<S>>();
    const int size = static_cast<int>(dictionary.entries.size());
    s.write(dictionary.nearest, s.template call<search>(0, size));
  }
};
/// The program: looks for the word of the environment's dictionary.
inline constexpr Check check{};

}  // namespace examples::spell_check
