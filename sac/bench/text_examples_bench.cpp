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

#include "../examples/edit_distance.hpp"
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

// --- Edit distance: two strings of n letters, the one with n / 250 changes made of the other -----

// A letter of either is erased, or replaced; the next update takes that back.
constexpr int kBand = 400;  // no distance is greater

template <bool kBits>  // the baseline computes 64 distances at a time, or each alone
struct EditDistance {
  static constexpr const char* kName = kBits ? "edit_distance" : "edit_distance_by_letters";

  struct Input {
    std::vector<char> letters[2];
    int changed = 0;      // string
    int at = -1;          // a letter that differs from what it was; -1: none
    bool is_out = false;  // it is erased
    char old = 0;         // what it was

    explicit Input(int n) {
      IntRandom random;
      for (int i = 0; i < n; ++i) letters[0].push_back(random_letter(random));
      for (const char letter : letters[0]) {
        const int kind = random(250) == 0 ? random(3) : 3;
        if (kind != 0) letters[1].push_back(kind == 3 ? letter : random_letter(random));
        if (kind == 1) letters[1].push_back(letter);
      }
    }
    static char random_letter(IntRandom& random) { return static_cast<char>('a' + random(26)); }
    std::vector<char> text(int string) const {
      std::vector<char> all = letters[string];
      if (is_out && changed == string) all.erase(all.begin() + at);
      return all;
    }
    std::uint64_t baseline() const {
      const auto a = text(0), b = text(1);
      return static_cast<std::uint64_t>(kBits ? by_blocks(a, b) : by_letters(a, b));
    }
    // In a band around the diagonal.
    static std::int64_t by_letters(const std::vector<char>& a, const std::vector<char>& b) {
      constexpr int kFar = 1 << 29;
      const int m = static_cast<int>(b.size());
      std::vector<int> row(b.size() + 1, kFar);
      for (int j = 0; j <= std::min(m, kBand); ++j) row[static_cast<std::size_t>(j)] = j;
      for (int i = 1; i <= static_cast<int>(a.size()); ++i) {
        const auto first = static_cast<std::size_t>(std::max(1, i - kBand));
        const auto last = static_cast<std::size_t>(std::min(m, i + kBand));
        const char letter = a[static_cast<std::size_t>(i - 1)];
        int diagonal = std::exchange(row[first - 1], first == 1 ? i : kFar);
        int left = row[first - 1];
        for (std::size_t j = first; j <= last; ++j) {
          const int replaced = diagonal + static_cast<int>(letter != b[j - 1]);
          diagonal = row[j];
          row[j] = left = std::min(replaced, 1 + std::min(diagonal, left));
        }
      }
      return row.back();
    }
    static std::vector<std::vector<char>> cut(const std::vector<char>& text) {
      std::vector<std::vector<char>> chunks;
      for (std::size_t i = 0; i < text.size(); i += 64) {
        const auto begin = text.begin() + static_cast<std::ptrdiff_t>(i);
        chunks.emplace_back(begin, i + 64 < text.size() ? begin + 64 : text.end());
      }
      return chunks;
    }
    static std::int64_t by_blocks(const std::vector<char>& a, const std::vector<char>& b) {
      constexpr std::size_t kWidth = kBand / 64 + 1;
      const auto rows = cut(a), columns = cut(b);
      std::vector<Differences> below;
      for (const auto& column : columns) below.push_back(rising(column.size()));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        Differences left = rising(rows[i].size());
        const std::size_t end = std::min(columns.size(), i + kWidth + 1);
        for (std::size_t j = i < kWidth ? 0 : i - kWidth; j < end; ++j) {
          cross_block(rows[i], columns[j], left, below[j]);
        }
      }
      auto distance = static_cast<std::int64_t>(a.size());
      for (const Differences& d : below) distance += sum(d);
      return distance;
    }
  };
  template <class Host>
  struct World {
    using S = ScopeOf<Host>;
    Host& host;
    sac::Sequence<char, Host> strings[2];
    std::vector<sac::ElementId> ids[2];  // of the letters
    typename S::template ModType<std::int64_t> out;

    World(Host& h, const Input& input)
        : host(h),
          strings{sac::Sequence<char, Host>(h, input.letters[0]),
                  sac::Sequence<char, Host>(h, input.letters[1])},
          out(h.template cell<std::int64_t>()) {
      for (int i = 0; i < 2; ++i) {
        for (const auto& letter : strings[i]) ids[i].push_back(letter.id());
      }
    }
    void run() {
      host.template run<edit_distance::edit_distance>(strings[0].list(), strings[1].list(), kBand,
                                                      64, out);
    }
    std::uint64_t result() { return static_cast<std::uint64_t>(host.get(out)); }
    void edit(Input& input, IntRandom& random) {
      const bool is_back = input.at >= 0;
      if (!is_back) {
        input.changed = random(2);
        input.at = 1 + random(static_cast<int>(input.letters[input.changed].size()) - 1);
        input.is_out = random(2) == 0;
      }
      const auto at = static_cast<std::size_t>(input.at);
      auto& string = strings[input.changed];
      auto& letter = input.letters[input.changed][at];
      auto& id = ids[input.changed][at];
      if (!input.is_out) {
        if (!is_back) input.old = letter;
        letter = is_back ? input.old : Input::random_letter(random);
        string.set(id, letter);
      } else if (is_back) {
        id = string.insert_after(ids[input.changed][at - 1], letter);
      } else {
        string.erase(id);
      }
      if (is_back) {
        input.at = -1;
        input.is_out = false;
      }
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
  selection.run<EditDistance<true>>(10000, 20000);
  selection.run<EditDistance<true>>(100000, 20000);
  selection.run<EditDistance<false>>(10000, 200);
  selection.run<EditDistance<false>>(100000, 200);
  selection.run<Sheet<false>>(104000, 20000);
  selection.run<Sheet<true>>(104000, 20000);
}
