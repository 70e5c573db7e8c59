// The examples on words, strings and formulas (sac/examples), as Apps (app.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../edit_distance.hpp"
#include "../spell_check.hpp"
#include "../spreadsheet.hpp"
#include "../string_hash.hpp"
#include "app.hpp"

namespace apps {

// --- Spell check ---------------------------------------------------------------------------------

struct SpellApp {
  static constexpr const char* kName = "spell check";
  struct Input {
    std::string word;
    std::vector<std::string> entries;
  };
  struct Edit {
    int entry;  // -1: the word
    std::string text;
  };
  static std::string random_word(Random& random) {
    std::string word;
    for (int i = random(7); i > 0; --i) word += static_cast<char>('a' + random(3));
    return word;
  }
  static Input random_input(Random& random, int size) {
    Input input{random_word(random), {}};
    for (int i = 0; i < size; ++i) input.entries.push_back(random_word(random));
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    return {random(static_cast<int>(input.entries.size()) + 1) - 1, random_word(random)};
  }
  static std::string& text_at(Input& input, int entry) {
    return entry < 0 ? input.word : input.entries[static_cast<std::size_t>(entry)];
  }
  static Edit inverse(Input before, const Edit& edit) {
    return {edit.entry, text_at(before, edit.entry)};
  }
  static void apply(Input& input, const Edit& edit) { text_at(input, edit.entry) = edit.text; }

  static int distance(std::string_view a, std::string_view b) {
    if (a.empty() || b.empty()) return static_cast<int>(a.size() + b.size());
    const auto [a2, b2] = std::pair{a.substr(1), b.substr(1)};
    if (a[0] == b[0]) return distance(a2, b2);
    return 1 + std::min({distance(a2, b), distance(a, b2), distance(a2, b2)});
  }
  static std::vector<std::pair<int, int>> oracle(const Input& input) {
    std::vector<std::pair<int, int>> all;
    for (int i = 0; i < static_cast<int>(input.entries.size()); ++i) {
      const std::string& entry = input.entries[static_cast<std::size_t>(i)];
      if (!entry.empty()) all.emplace_back(distance(input.word, entry), i);
    }
    std::sort(all.begin(), all.end());
    if (all.size() > 4) all.resize(4);
    return all;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host), dictionary_(host, static_cast<int>(input.entries.size())) {
      edit({-1, input.word});
      for (std::size_t i = 0; i < input.entries.size(); ++i) {
        edit({static_cast<int>(i), input.entries[i]});
      }
      host.template run<examples::spell_check::check>();
    }
    void edit(const Edit& e) {
      host_.set(
          e.entry < 0 ? dictionary_.word : dictionary_.entries[static_cast<std::size_t>(e.entry)],
          std::string(e.text));
    }
    std::vector<std::pair<int, int>> result() {
      std::vector<std::pair<int, int>> found;
      for (const auto& match : host_.get(dictionary_.nearest)) {
        if (match.entry >= 0) found.emplace_back(match.distance, match.entry);
      }
      return found;
    }

    template <class Recorder>
    void name(Recorder& recorder) const {
      recorder.name(dictionary_.word, "word");
      recorder.name(dictionary_.nearest, "nearest");
      name_all(recorder, dictionary_.entries, "entry");
    }

   private:
    Host& host_;
    examples::spell_check::Dictionary<ScopeOf<Host>> dictionary_;
  };
};

// --- Hash of a string ----------------------------------------------------------------------------

struct StringApp {
  static constexpr const char* kName = "string hash";
  struct Letter {
    char letter;
    int id;  // of its own
  };
  struct Input {
    std::vector<Letter> letters;
    int next_id = 0;
  };
  struct Edit {
    enum Kind { insert, erase, replace } kind;
    int place;
    Letter letter;
  };
  // Few letters: runs and periods.
  static char random_letter(Random& random) { return static_cast<char>('a' + random(3)); }
  static Input random_input(Random& random, int size) {
    Input input;
    for (int i = 0; i < size; ++i) {
      const bool repeat = i > 0 && random(4) == 0;
      const char letter = repeat ? input.letters.back().letter : random_letter(random);
      apply(input, {Edit::insert, i, {letter, i}});
    }
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    const int n = static_cast<int>(input.letters.size());
    const int kind = n == 0 ? 0 : random(3);
    if (kind == 0) return {Edit::insert, random(n + 1), {random_letter(random), input.next_id}};
    const int place = random(n);
    const Letter& old = input.letters[static_cast<std::size_t>(place)];
    if (kind == 1) return {Edit::erase, place, old};
    return {Edit::replace, place, {random_letter(random), old.id}};
  }
  static Edit inverse(const Input& before, Edit edit) {
    if (edit.kind == Edit::replace) {
      edit.letter = before.letters[static_cast<std::size_t>(edit.place)];
    } else {
      edit.kind = edit.kind == Edit::insert ? Edit::erase : Edit::insert;
    }
    return edit;
  }
  static void apply(Input& input, const Edit& edit) {
    const auto at = input.letters.begin() + edit.place;
    input.next_id = std::max(input.next_id, edit.letter.id + 1);
    switch (edit.kind) {
      case Edit::insert:
        input.letters.insert(at, edit.letter);
        break;
      case Edit::erase:
        input.letters.erase(at);
        break;
      case Edit::replace:
        *at = edit.letter;
        break;
    }
  }
  // Cuts between `i` and `i + 1` where, runs of equals aside, hashes have fallen and rise.
  static bool valley(const std::vector<std::uint64_t>& hashes, std::size_t i) {
    if (hashes[i + 1] <= hashes[i]) return false;
    std::size_t before = i;
    while (before > 0 && hashes[before] == hashes[i]) --before;
    return hashes[before] > hashes[i];
  }
  static std::uint64_t oracle(const Input& input) {
    std::vector<std::uint64_t> hashes;
    for (const Letter& l : input.letters) {
      hashes.push_back(examples::string_hash::hash_of(l.letter));
    }
    while (hashes.size() > 1) {
      std::vector<std::uint64_t> chunks;
      bool begins = true;
      for (std::size_t i = 0; i < hashes.size(); ++i) {
        if (begins) chunks.push_back(0);
        chunks.back() = sac::mix(chunks.back() + hashes[i]);
        begins = i + 1 < hashes.size() && valley(hashes, i);
      }
      hashes = chunks;
    }
    return hashes.empty() ? 0 : hashes[0];
  }

  template <class Host>
  class World {
   public:
    using S = ScopeOf<Host>;
    using Item = examples::string_hash::Item<S>;
    using Content = examples::string_hash::Content<S>;

    World(Host& host, const Input& input)
        : host_(host),
          head_(host.template input<const Item*>(nullptr)),
          hash_(host.template cell<std::uint64_t>()) {
      for (const Letter& letter : input.letters) {
        edit({Edit::insert, static_cast<int>(letters_.size()), letter});
      }
      host.template run<examples::string_hash::hash>(head_, hash_);
    }
    void edit(const Edit& e) {
      const auto place = static_cast<std::size_t>(e.place);
      const auto at = letters_.begin() + e.place;
      const std::uint64_t hash = examples::string_hash::hash_of(e.letter.letter);
      if (e.kind == Edit::replace) {
        host_.set(at->first->content, Content{hash, host_.get(at->first->content).next});
      } else if (e.kind == Edit::insert) {
        Item& item = host_.template make<Item>();
        host_.set(item.content, Content{hash, at == letters_.end() ? nullptr : at->first});
        letters_.insert(at, {&item, e.letter.id});
        lead_to(place, &item);
      } else {
        Item& item = *at->first;
        lead_to(place, host_.get(item.content).next);
        letters_.erase(at);
        if constexpr (S::kTraced) host_.release(item);
      }
    }
    std::uint64_t result() { return host_.get(hash_); }

    template <class Recorder>
    void name(Recorder& recorder) const {
      recorder.name(head_, "head");
      recorder.name(hash_, "hash");
      for (const auto& [item, id] : letters_) recorder.name(item, "letter", id);
    }

   private:
    // What stands before `place` leads to `item`.
    void lead_to(std::size_t place, const Item* item) {
      if (place == 0) return host_.set(head_, item);
      const auto& content = letters_[place - 1].first->content;
      host_.set(content, Content{host_.get(content).hash, item});
    }

    Host& host_;
    std::vector<std::pair<Item*, int>> letters_;  // with their ids
    typename S::template ModType<const Item*> head_;
    typename S::template ModType<std::uint64_t> hash_;
  };
};

// --- Edit distance -------------------------------------------------------------------------------

// Of two strings with at first half of `size` letters each, the second a changed copy of the first;
// with a band and chunks of at most kMost letters.
template <int kBand, int kMost>
struct EditDistanceApp {
  static constexpr const char* kName =
      kBand == sac::kNoBand ? "edit distance" : "edit distance, in a band";
  struct Input {
    StringApp::Input strings[2];
  };
  struct Edit {
    int string;
    StringApp::Edit edit;
  };
  static Input random_input(Random& random, int size) {
    Input input{{StringApp::random_input(random, size / 2), {}}};
    input.strings[1] = input.strings[0];
    for (int i = 0; i < size / 16; ++i) {
      StringApp::apply(input.strings[1], StringApp::random_edit(random, input.strings[1]));
    }
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    const int string = random(2);
    return {string, StringApp::random_edit(random, input.strings[string])};
  }
  static Edit inverse(const Input& before, const Edit& e) {
    return {e.string, StringApp::inverse(before.strings[e.string], e.edit)};
  }
  static void apply(Input& input, const Edit& e) {
    StringApp::apply(input.strings[e.string], e.edit);
  }
  static std::int64_t oracle(const Input& input) {
    std::string words[2];
    for (int i = 0; i < 2; ++i) {
      for (const auto& l : input.strings[i].letters) words[i] += l.letter;
    }
    const int distance = examples::spell_check::edit_distance(words[0], words[1]);
    if (distance <= kBand) return distance;
    sac::PlainScope scope;
    const std::int64_t in_band = World<sac::PlainScope>(scope, input).result();
    return in_band < distance ? -1 : in_band;
  }

  template <class Host>
  class World {
   public:
    using S = ScopeOf<Host>;
    World(Host& host, const Input& input)
        : strings_{String(host), String(host)},
          host_(host),
          distance_(host.template cell<std::int64_t>()) {
      for (int i = 0; i < 2; ++i) {
        int place = 0;
        for (const auto& l : input.strings[i].letters) {
          edit({i, {StringApp::Edit::insert, place++, l}});
        }
      }
      host.template run<examples::edit_distance::edit_distance>(
          strings_[0].list(), strings_[1].list(), kBand, kMost, distance_);
    }
    void edit(const Edit& e) { strings_[e.string].edit(e.edit); }
    std::int64_t result() { return host_.get(distance_); }

    template <class Recorder>
    void name(Recorder& recorder) const {
      recorder.name(distance_, "distance");
      for (int i = 0; i < 2; ++i) strings_[i].name(recorder, i);
    }

   private:
    // A list whose letters may come back with their ids, which those of a sac::Sequence do not.
    class String {
     public:
      using Node = sac::ListNode<char, S>;
      explicit String(Host& host) : host_(host), nodes_{&host.template make<Node>()} {
        host.set(nodes_[0]->next, nullptr);
      }
      sac::List<char, S> list() const { return sac::List<char, S>(*nodes_[0]); }
      void edit(const StringApp::Edit& e) {
        const auto at = nodes_.begin() + e.place + 1;
        if (e.kind == StringApp::Edit::replace && (*at)->value() == e.letter.letter) return;
        const Node* behind = at == nodes_.end() ? nullptr : *at;
        if (e.kind != StringApp::Edit::insert) {
          Node& old = **at;
          behind = host_.get(old.next);
          nodes_.erase(at);
          if constexpr (S::kTraced) host_.release(old);
        }
        Node* node = nullptr;
        if (e.kind != StringApp::Edit::erase) {
          node = &host_.template make<Node>();
          node->hold(sac::ElementId{static_cast<std::uint64_t>(e.letter.id) + 1}, e.letter.letter);
          host_.set(node->next, behind);
          nodes_.insert(nodes_.begin() + e.place + 1, node);
        }
        host_.set(nodes_[static_cast<std::size_t>(e.place)]->next, node != nullptr ? node : behind);
      }
      template <class Recorder>
      void name(Recorder& recorder, int string) const {
        for (const Node* node : nodes_) {
          recorder.name(node, "letter", string, node->id().value,
                        node->holds() ? node->value() : 0);
        }
      }

     private:
      Host& host_;
      std::vector<Node*> nodes_;  // the header first
    };

    String strings_[2];
    Host& host_;
    typename S::template ModType<std::int64_t> distance_;
  };
};

// --- Spreadsheet ---------------------------------------------------------------------------------

// A sheet evaluated from its text by recursion, with nothing of the example but the fault codes.
class NaiveSheet {
 public:
  using Fault = examples::spreadsheet::Fault;
  using Value = examples::spreadsheet::Value;
  explicit NaiveSheet(const std::vector<std::string>& texts) : texts_(texts) {}

  Value value(int cell) const {
    if (reaches_cycle(cell)) return {0, Fault::cycle};
    const std::string& text = texts_[static_cast<std::size_t>(cell)];
    if (text == "=1+" || text == "word") return {0, Fault::syntax};
    if (text.empty()) return {};
    std::string_view rest = text[0] == '=' ? std::string_view(text).substr(1) : text;
    Fault fault = Fault::none;
    const double number = sum(rest, fault);
    if (fault == Fault::none && !std::isfinite(number)) fault = Fault::number;
    return {fault == Fault::none ? number + 0.0 : 0, fault};
  }

 private:
  // Corners of the rectangles that a text names, single cells too.
  static std::vector<std::pair<int, int>> rectangles(std::string_view text) {
    std::vector<std::pair<int, int>> found;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
      if (text[i] < 'A' || text[i] > 'Z' || text[i + 1] < '1' || text[i + 1] > '9') continue;
      const int cell = (text[i + 1] - '1') * 26 + text[i] - 'A';
      if (i > 0 && text[i - 1] == ':') {
        found.back().second = cell;
      } else {
        found.emplace_back(cell, cell);
      }
    }
    return found;
  }
  static std::vector<int> cells_of(std::pair<int, int> corners) {
    std::vector<int> cells;
    for (int c = corners.first; c <= corners.second; ++c) {
      if (c % 26 >= corners.first % 26 && c % 26 <= corners.second % 26) cells.push_back(c);
    }
    return cells;
  }
  bool reaches_cycle(int cell) const {
    std::vector<int> path;
    std::set<int> clean;
    return on_cycle(cell, path, clean);
  }
  bool on_cycle(int cell, std::vector<int>& path, std::set<int>& clean) const {
    if (clean.count(cell) != 0) return false;
    if (std::find(path.begin(), path.end(), cell) != path.end()) return true;
    path.push_back(cell);
    for (const auto& corners : rectangles(texts_[static_cast<std::size_t>(cell)])) {
      for (const int c : cells_of(corners)) {
        if (on_cycle(c, path, clean)) return true;
      }
    }
    path.pop_back();
    clean.insert(cell);
    return false;
  }
  static bool take(std::string_view& rest, std::string_view what) {
    if (!rest.starts_with(what)) return false;
    rest.remove_prefix(what.size());
    return true;
  }
  double number_of(int cell, Fault& fault) const {
    if (fault != Fault::none) return 0;
    const Value v = value(cell);
    fault = v.fault;
    return v.number;
  }
  double sum(std::string_view& rest, Fault& fault) const {
    double x = product(rest, fault);
    for (;;) {
      if (take(rest, "+")) {
        x += product(rest, fault);
      } else if (take(rest, "-")) {
        x -= product(rest, fault);
      } else {
        return x;
      }
    }
  }
  double product(std::string_view& rest, Fault& fault) const {
    double x = factor(rest, fault);
    for (;;) {
      if (take(rest, "*")) {
        x *= factor(rest, fault);
      } else if (take(rest, "/")) {
        x /= factor(rest, fault);
      } else {
        return x;
      }
    }
  }
  double factor(std::string_view& rest, Fault& fault) const {
    if (take(rest, "-")) return -factor(rest, fault);
    if (take(rest, "(")) {
      const double x = sum(rest, fault);
      take(rest, ")");
      return x;
    }
    for (const char* name : {"SUM(", "MIN(", "MAX("}) {
      if (!take(rest, name)) continue;
      const auto cells = cells_of(rectangles(rest.substr(0, rest.find(')')))[0]);
      rest.remove_prefix(rest.find(')') + 1);
      double x = number_of(cells[0], fault);
      for (std::size_t i = 1; i < cells.size(); ++i) {
        const double y = number_of(cells[i], fault);
        x = name[0] == 'S' ? x + y : name[1] == 'I' ? std::min(x, y) : std::max(x, y);
      }
      return x;
    }
    if (rest[0] >= 'A' && rest[0] <= 'Z') {
      const int cell = rectangles(rest.substr(0, 2))[0].first;
      rest.remove_prefix(2);
      return number_of(cell, fault);
    }
    const double x = rest[0] - '0';
    rest.remove_prefix(1);
    return x;
  }

  const std::vector<std::string>& texts_;
};

struct SheetApp {
  static constexpr const char* kName = "spreadsheet";
  static constexpr int kRows = 4;
  using Input = std::vector<std::string>;
  struct Edit {
    int cell;
    std::string text;
  };

  static std::string name_of(int cell) {
    std::string name(1, static_cast<char>('A' + cell % 26));
    return name.append(std::to_string(cell / 26 + 1));
  }
  // Cells in use: a block of 3 columns.
  static int random_cell(Random& random) {
    const int row = random(kRows);
    return row * 26 + random(3);
  }
  static std::string random_factor(Random& random) {
    switch (random(6)) {
      case 0:
        return std::to_string(random(4));
      case 1:
        return "-" + random_factor(random);
      case 2: {
        const std::string left = random_factor(random);
        return "(" + left + "-" + random_factor(random) + ")";
      }
      case 3: {
        const int a = random_cell(random);
        const int b = random_cell(random);
        const int first = std::min(a / 26, b / 26) * 26 + std::min(a % 26, b % 26);
        const int last = std::max(a / 26, b / 26) * 26 + std::max(a % 26, b % 26);
        const char* names[] = {"SUM(", "MIN(", "MAX("};
        if (last - first > 27) return "2";
        return names[random(3)] + name_of(first) + ":" + name_of(last) + ")";
      }
      default:
        return name_of(random_cell(random));
    }
  }
  static std::string random_text(Random& random) {
    switch (random(12)) {
      case 0:
        return "";
      case 1:
        return "word";
      case 2:
        return "=1+";
      case 3:
      case 4:
      case 5:
        return std::to_string(random(9));
      default:
        break;
    }
    std::string text("=");
    text += random_factor(random);
    for (int i = random(3); i > 0; --i) {
      text += "+-*/"[random(4)];
      text += random_factor(random);
    }
    return text;
  }
  static Edit random_edit(Random& random, const Input&) {
    return {random_cell(random), random_text(random)};
  }
  static Input random_input(Random& random, int size) {
    Input input(kRows * 26);
    for (int i = 0; i < size; ++i) apply(input, random_edit(random, input));
    return input;
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    return {edit.cell, before[static_cast<std::size_t>(edit.cell)]};
  }
  static void apply(Input& input, const Edit& edit) {
    input[static_cast<std::size_t>(edit.cell)] = edit.text;
  }
  static std::vector<std::string> oracle(const Input& input) {
    const NaiveSheet sheet(input);
    std::vector<std::string> texts;
    for (int c = 0; c < kRows * 26; ++c) {
      texts.push_back(examples::spreadsheet::to_text(sheet.value(c)));
    }
    return texts;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input) : host_(host), sheet_(host, kRows) {
      for (std::size_t c = 0; c < input.size(); ++c) edit({static_cast<int>(c), input[c]});
      host.template run<examples::spreadsheet::calculate>();
    }
    void edit(const Edit& e) { sheet_.set(host_, e.cell, e.text); }
    std::vector<std::string> result() {
      std::vector<std::string> texts;
      for (const auto& v : sheet_.values) {
        texts.push_back(examples::spreadsheet::to_text(host_.get(v)));
      }
      return texts;
    }

    template <class Recorder>
    void name(Recorder& recorder) const {
      name_all(recorder, sheet_.texts, "text");
      name_all(recorder, sheet_.refers_to, "refers to");
      name_all(recorder, sheet_.used_by, "used by");
      name_all(recorder, sheet_.levels, "level");
      name_all(recorder, sheet_.values, "value");
    }

   private:
    Host& host_;
    examples::spreadsheet::Sheet<ScopeOf<Host>> sheet_;
  };
};

}  // namespace apps
