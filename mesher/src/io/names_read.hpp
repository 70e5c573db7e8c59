// Names of groups as files give them: what a name cannot be is replaced or left out, with a note.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "io/note_counter.hpp"
#include "mesher/names.hpp"
#include "text/text.hpp"

namespace mesher {

/// `name` without outer blanks, cut to the longest name, and with '_' for what no name has.
[[nodiscard]] std::string allowed_name(std::string_view name);

/// Whether it is `marker_N`, `line_N` or `region_N`, with '_' or, as older files have, a blank.
[[nodiscard]] bool is_name_of_number(std::string_view name);

/// Gives number `number` a name, unless it is empty, or that of a number, or another group has it.
/// `names`: all; `of`: of one kind of groups, a part of it.
template <class Number>
void add_name(const GroupNames& names, std::map<Number, std::string>& of, Number number,
              std::string_view name, const FileLocation& place, NoteCounter& notes) {
  const std::string allowed = allowed_name(name);
  if (allowed.empty() || is_name_of_number(name)) return;
  if (of.contains(number) && of[number] == allowed) return;
  const auto is_it = [&](const auto& entry) { return entry.second == allowed; };
  const auto has_it = [&](const auto& map) { return std::any_of(map.begin(), map.end(), is_it); };
  if (of.contains(number) || has_it(names.facets) || has_it(names.lines) || has_it(names.regions)) {
    notes.add("a name that its group, or another group, has already is not used", place);
    return;
  }
  if (allowed != name) notes.add("a name with blanks or quotes gets _ in their place", place);
  of[number] = allowed;
}

}  // namespace mesher
