// Notes on unused data in a file: one for each kind of data, with its count.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "mesher/error.hpp"

namespace mesher {

class NoteCounter {
 public:
  /// One more thing of the kind `what`. Cost: O(kinds).
  void add(const std::string& what, const FileLocation& place) {
    const auto is_it = [&](const Kind& kind) { return kind.what == what; };
    const auto found = std::find_if(kinds_.begin(), kinds_.end(), is_it);
    if (found != kinds_.end()) {
      ++found->count;
    } else {
      kinds_.push_back({what, place, 1});
    }
  }

  /// In the order of the first thing of each kind.
  [[nodiscard]] std::vector<Note> notes() const {
    std::vector<Note> notes;
    for (const Kind& kind : kinds_) {
      const std::string times = kind.count > 1 ? " (" + std::to_string(kind.count) + " times)" : "";
      notes.push_back({kind.what + times, kind.first});
    }
    return notes;
  }

 private:
  struct Kind {
    std::string what;
    FileLocation first;
    long count;
  };
  std::vector<Kind> kinds_;
};

}  // namespace mesher
