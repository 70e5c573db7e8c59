// The examples on words, strings and formulas (sac/examples): from scratch and under edits.
//
//   text_examples_bench [SCALE [EXAMPLE]]     default 1 and all; 0.1: with a tenth of the elements
//
// The figures are explained in measure_example.hpp.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "../examples/spell_check.hpp"
#include "../examples/spreadsheet.hpp"
#include "../examples/string_hash.hpp"
#include "bench_help.hpp"
#include "measure_example.hpp"
#include "sac/sac.hpp"

namespace {

using namespace examples;
using bench::IntRandom;
using bench::ScopeOf;

// --- Spell check: n words of 4 to 9 letters ------------------------------------------------------

template <bool kWord>  // the word changes, or an entry
struct Spelling {
  static constexpr const char* kName = kWord ? "spell_check_word" : "spell_check_entry";

  static std::string random_word(IntRandom& random) {
    std::string word;
    for (int i = 4 + random(6); i > 0; --i) word += static_cast<char>('a' + random(26));
    return word;
  }
  struct Input {
    std::string word;
    std::vector<std::string> entries;
    explicit Input(int n) {
      IntRandom random;
      word = random_word(random);
      for (int i = 0; i < n; ++i) entries.push_back(random_word(random));
    }
    std::uint64_t baseline() const {
      spell_check::Match best;
      for (int i = 0; i < static_cast<int>(entries.size()); ++i) {
        const auto& entry = entries[static_cast<std::size_t>(i)];
        best = std::min(best, {spell_check::edit_distance(word, entry), i});
      }
      return (static_cast<std::uint64_t>(best.distance) << 32) + static_cast<unsigned>(best.entry);
    }
  };
  template <class Host>
  struct World {
    Host& host;
    spell_check::Dictionary<ScopeOf<Host>> dictionary;

    World(Host& h, const Input& input)
        : host(h), dictionary(h, static_cast<int>(input.entries.size())) {
      host.set(dictionary.word, input.word);
      for (std::size_t i = 0; i < input.entries.size(); ++i) {
        host.set(dictionary.entries[i], input.entries[i]);
      }
    }
    void run() { host.template run<spell_check::check>(); }
    std::uint64_t result() {
      const auto best = host.get(dictionary.nearest)[0];
      return (static_cast<std::uint64_t>(best.distance) << 32) + static_cast<unsigned>(best.entry);
    }
    void edit(Input& input, IntRandom& random) {
      if (kWord) {
        input.word[random.next() % input.word.size()] = static_cast<char>('a' + random(26));
        return host.set(dictionary.word, input.word);
      }
      const std::size_t i = random.next() % input.entries.size();
      input.entries[i] = random_word(random);
      host.set(dictionary.entries[i], input.entries[i]);
    }
  };
};

// --- String hash: n letters; one is inserted or erased -------------------------------------------

struct StringHash {
  static constexpr const char* kName = "string_hash";

  // A list, so that edits are cheap here too.
  struct Input {
    std::vector<char> letters;
    std::vector<int> next;            // of each letter; 0 stands before the first
    std::pair<int, int> out{-1, -1};  // taken from behind the first

    explicit Input(int n) : letters(1), next(1, 1) {
      IntRandom random;
      for (int i = 1; i <= n; ++i) {
        letters.push_back(static_cast<char>('a' + random(26)));
        next.push_back(i < n ? i + 1 : -1);
      }
    }
    std::uint64_t baseline() const {
      std::vector<std::uint64_t> items, chunks;
      for (int i = next[0]; i >= 0; i = next[static_cast<std::size_t>(i)]) {
        items.push_back(string_hash::hash_of(letters[static_cast<std::size_t>(i)]));
      }
      while (items.size() > 1) {
        chunks.assign(1, sac::mix(items[0]));
        bool falling = false;
        for (std::size_t i = 1; i < items.size(); ++i) {
          const bool begins = falling && items[i] > items[i - 1];
          if (begins) chunks.push_back(0);
          chunks.back() = sac::mix(chunks.back() + items[i]);
          if (items[i] != items[i - 1]) falling = items[i] < items[i - 1];
        }
        items.swap(chunks);
      }
      return items[0];
    }
  };
  template <class Host>
  struct World {
    using S = ScopeOf<Host>;
    using Item = string_hash::Item<S>;
    using Content = string_hash::Content<S>;
    Host& host;
    std::vector<Item*> letters{nullptr};
    typename S::template ModType<const Item*> head;
    typename S::template ModType<std::uint64_t> out;

    World(Host& h, const Input& input)
        : host(h),
          head(h.template input<const Item*>(nullptr)),
          out(h.template cell<std::uint64_t>()) {
      for (std::size_t i = 1; i < input.letters.size(); ++i) {
        letters.push_back(&host.template make<Item>());
      }
      for (int i = 0; i < static_cast<int>(letters.size()); ++i) set(input, i);
    }
    void set(const Input& input, int i) {
      const int next = input.next[static_cast<std::size_t>(i)];
      const Item* item = next < 0 ? nullptr : letters[static_cast<std::size_t>(next)];
      if (i == 0) return host.set(head, item);
      host.set(letters[static_cast<std::size_t>(i)]->content,
               Content{string_hash::hash_of(input.letters[static_cast<std::size_t>(i)]), item});
    }
    void run() { host.template run<string_hash::hash>(head, out); }
    std::uint64_t result() { return host.get(out); }
    void edit(Input& input, IntRandom& random) {
      auto& next = input.next;
      if (input.out.first >= 0) {
        next[static_cast<std::size_t>(input.out.first)] = input.out.second;
        set(input, std::exchange(input.out.first, -1));
        return;
      }
      int before;
      do {
        before = random(static_cast<int>(next.size()));
      } while (next[static_cast<std::size_t>(before)] < 0);
      const int taken = next[static_cast<std::size_t>(before)];
      input.out = {before, taken};
      next[static_cast<std::size_t>(before)] = next[static_cast<std::size_t>(taken)];
      set(input, before);
    }
  };
};

// --- Spreadsheet: n cells ------------------------------------------------------------------------

// Each row: A, B numbers, C = A * B, D = SUM(A:C), E = D - C; F sums up ten rows of E, G ten cells
// of F, ...; the rest is numbers. A number changes, or the formula of a C.
template <bool kFormula>
struct Sheet {
  static constexpr const char* kName = kFormula ? "spreadsheet_formula" : "spreadsheet_number";

  struct Input {
    int rows;
    std::vector<std::string> texts;

    explicit Input(int n)
        : rows(n / spreadsheet::kColumns),
          texts(static_cast<std::size_t>(rows * spreadsheet::kColumns)) {
      IntRandom random;
      for (int row = 1; row <= rows; ++row) {
        const std::string r = std::to_string(row);
        for (const char column : {'A', 'B'}) at(column, row) = std::to_string(random(1000));
        at('C', row) = "=A" + r + "*B" + r;
        at('D', row) = "=SUM(A" + r + ":C" + r + ")";
        at('E', row) = "=D" + r + "-C" + r;
        for (char c = 'J'; c <= 'Z'; ++c) at(c, row) = std::to_string(random(1000));
      }
      for (int step = 10, column = 'F'; step <= rows && column < 'J'; step *= 10, ++column) {
        for (int row = step; row <= rows; row += step) {
          std::string sum;
          for (int k = 9; k >= 0; --k) {
            sum += std::string(sum.empty() ? "=" : "+") + static_cast<char>(column - 1) +
                   std::to_string(row - k * step / 10);
          }
          at(static_cast<char>(column), row) = sum;
        }
      }
    }
    std::string& at(char column, int row) {
      return texts[static_cast<std::size_t>((row - 1) * spreadsheet::kColumns + column - 'A')];
    }
    // Evaluates by recursion, each cell once.
    std::uint64_t baseline() const {
      std::vector<spreadsheet::Value> values(texts.size());
      std::vector<char> done(texts.size(), 0);
      const std::function<spreadsheet::Value(int)> value = [&](int cell) {
        const auto c = static_cast<std::size_t>(cell);
        if (done[c] == 0) values[c] = spreadsheet::value_of(texts[c], rows, value);
        done[c] = 1;
        return values[c];
      };
      std::uint64_t sum = 0;
      for (int c = 0; c < static_cast<int>(texts.size()); ++c) {
        sum = sac::mix(sum + static_cast<std::uint64_t>(value(c).number));
      }
      return sum;
    }
  };
  template <class Host>
  struct World {
    Host& host;
    spreadsheet::Sheet<ScopeOf<Host>> sheet;

    World(Host& h, const Input& input) : host(h), sheet(h, input.rows) {
      for (int c = 0; c < static_cast<int>(input.texts.size()); ++c) {
        sheet.set(host, c, input.texts[static_cast<std::size_t>(c)]);
      }
    }
    void run() { host.template run<spreadsheet::calculate>(); }
    std::uint64_t result() {
      std::uint64_t sum = 0;
      for (const auto& v : sheet.values) {
        sum = sac::mix(sum + static_cast<std::uint64_t>(host.get(v).number));
      }
      return sum;
    }
    void edit(Input& input, IntRandom& random) {
      const int row = 1 + random(input.rows);
      const std::string r = std::to_string(row);
      const char column = kFormula ? 'C' : "AB"[random(2)];
      std::string& text = input.at(column, row);
      text = !kFormula ? std::to_string(random(1000))
                       : "=A" + r + "+*-"[random(3)] + "B" + std::to_string(1 + random(input.rows));
      sheet.set(host, (row - 1) * spreadsheet::kColumns + column - 'A', text);
    }
  };
};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const bench::Selection selection(argc, argv);
  selection.run<Spelling<false>>(100000, 20000);
  selection.run<Spelling<true>>(100000, 10);
  selection.run<StringHash>(1000000, 20000);
  selection.run<Sheet<false>>(104000, 20000);
  selection.run<Sheet<true>>(104000, 20000);
}
