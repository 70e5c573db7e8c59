// Names of groups: those given, those that follow from numbers, and which are refused.
#include "mesher/names.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "mesher/error.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

constexpr std::string_view kNumbered[] = {"marker_", "line_", "region_"};

bool is_number(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  return read.ec == std::errc{} && read.ptr == end;
}

bool is_numbered(std::string_view name) {
  return std::any_of(std::begin(kNumbered), std::end(kNumbered), [&](std::string_view prefix) {
    return name.substr(0, prefix.size()) == prefix && is_number(name.substr(prefix.size()));
  });
}

template <class Number>
std::string name_in(const std::map<Number, std::string>& names, Number number,
                    const std::string& numbered) {
  const auto found = names.find(number);
  return found == names.end() ? numbered : found->second;
}

Error bad_name(std::string_view name, const std::string& fault) {
  return {ErrorCode::bad_option, "the name " + text::quoted(name) + ' ' + fault};
}

void require_name(const std::string& name, std::set<std::string>& taken) {
  if (const std::string fault = fault_of_name(name); !fault.empty()) throw bad_name(name, fault);
  if (is_numbered(name)) {
    throw bad_name(name, "is that of a group without a name: choose one of another form");
  }
  if (!taken.insert(name).second) throw bad_name(name, "is given to two groups");
}

template <class Number>
void replace(std::map<Number, std::string>& names, const std::map<Number, std::string>& by) {
  for (const auto& [number, name] : by) names[number] = name;
}

}  // namespace

std::string GroupNames::of_facets(std::int64_t marker) const {
  return name_in(facets, marker, "marker_" + std::to_string(marker));
}
std::string GroupNames::of_lines(std::int64_t marker) const {
  return name_in(lines, marker, "line_" + std::to_string(marker));
}
std::string GroupNames::of_region(double attribute) const {
  return name_in(regions, attribute + 0.0, "region_" + text::to_text(attribute + 0.0));
}

void GroupNames::add(const GroupNames& other) {
  replace(facets, other.facets);
  replace(lines, other.lines);
  replace(regions, other.regions);
}

std::string fault_of_name(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.size() > GroupNames::kLongestName) {
    return "has more than " + std::to_string(GroupNames::kLongestName) + " characters";
  }
  for (const char c : name) {
    if (c == ' ') return "has a blank: write _ instead";
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') return "has a control character";
    if (c == '"' || c == '\'') return "has a quote";
  }
  return "";
}

void require_names(const GroupNames& names) {
  std::set<std::string> taken;
  for (const auto& [number, name] : names.facets) require_name(name, taken);
  for (const auto& [number, name] : names.lines) require_name(name, taken);
  for (const auto& [number, name] : names.regions) require_name(name, taken);
}

}  // namespace mesher
