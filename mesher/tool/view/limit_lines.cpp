// Limits of size as lines and as JSON.
#include "limit_lines.hpp"

#include <algorithm>

namespace tool::view {
namespace {

using mesher::Box;
using mesher::BoxLimits;
using mesher::Options;
using mesher::SizeLimits;

template <int D>
SizeLimits<D> everywhere(const Options<D>& options) {
  return {options.max_measure, options.sizes};
}

template <int D>
std::string measure_words(double largest) {
  if (largest == 0) return "limit none";
  return std::string(D == 2 ? "limit area " : "limit volume ") + script_number(largest);
}
template <int D>
std::string box_words(const Box<D>& box) {
  return " in" + place_words<D>(box.lo) + place_words<D>(box.hi);
}

template <int D>
Json json_of_largest(const SizeLimits<D>& limits) {
  if (limits.sizes) return "background";
  return limits.max_measure == 0 ? Json() : Json(limits.max_measure);
}

template <int D>
Box<D> box_of(const Json& value) {
  if (!value.is_array() || value.size() != 2) throw refusal("a box is two positions");
  return {position_of_json<D>(value[0]), position_of_json<D>(value[1])};
}

template <int D>
bool meet(const Box<D>& a, const Box<D>& b) {
  for (int i = 0; i < D; ++i) {
    if (a.hi[i] < b.lo[i] || b.hi[i] < a.lo[i]) return false;
  }
  return true;
}

// As if the limits in that box had not been given. What is alone in its place costs that place.
template <int D>
std::vector<std::string> unlimit_lines(const Box<D>& box, const Options<D>& now) {
  Options<D> without = now;
  std::erase_if(without.box_limits, [&](const BoxLimits<D>& b) { return b.box == box; });
  if (without.box_limits.size() == now.box_limits.size()) {
    throw refusal("there are no limits of this box");
  }
  const bool alone = std::none_of(without.box_limits.begin(), without.box_limits.end(),
                                  [&](const BoxLimits<D>& b) { return meet<D>(b.box, box); });
  if (alone && !now.sizes) return {measure_words<D>(now.max_measure) + box_words<D>(box)};
  if (auto lines = limit_lines(without)) return *lines;
  throw refusal("limits of a background or a function stay: they cannot be given again here");
}

}  // namespace

template <int D>
std::optional<std::vector<std::string>> limit_lines(const Options<D>& options) {
  if (options.sizes) return std::nullopt;
  std::vector<std::string> lines{measure_words<D>(options.max_measure)};
  for (const auto& [box, limits] : options.box_limits) {
    if (limits.sizes) return std::nullopt;
    lines.push_back(measure_words<D>(limits.max_measure) + box_words<D>(box));
  }
  return lines;
}

template <int D>
Json json_of_limits(const Options<D>& options) {
  Json boxes = Json::array();
  for (const auto& [box, limits] : options.box_limits) {
    boxes.push_back({{"lo", box.lo}, {"hi", box.hi}, {"largest", json_of_largest(limits)}});
  }
  return {{"everywhere", json_of_largest(everywhere(options))}, {"boxes", std::move(boxes)}};
}

template <int D>
std::vector<std::string> limit_lines_of(const Json& command, const Options<D>& now) {
  if (command["do"] == "unlimit") {
    return unlimit_lines<D>(box_of<D>(field(command, "box")), now);
  }
  const bool by_size = command.contains("size"), by_measure = command.contains("largest");
  if (by_size && by_measure) throw refusal("a limit is a size or a largest area, not both");
  std::string line = "limit none";
  if (by_size) line = "limit size " + script_number(number_of(command["size"], "the size"));
  if (by_measure) line = measure_words<D>(number_of(command["largest"], "the limit"));
  if (command.contains("box")) line += box_words<D>(box_of<D>(command["box"]));
  return {line};
}

template <int D>
void announce_limits(const Options<D>& options, mesher::Mesher<D>& mesher) {
  mesher.limit(everywhere(options));
  for (const auto& [box, limits] : options.box_limits) mesher.limit(box, limits);
}

template std::optional<std::vector<std::string>> limit_lines(const Options<2>&);
template std::optional<std::vector<std::string>> limit_lines(const Options<3>&);
template Json json_of_limits(const Options<2>&);
template Json json_of_limits(const Options<3>&);
template std::vector<std::string> limit_lines_of(const Json&, const Options<2>&);
template std::vector<std::string> limit_lines_of(const Json&, const Options<3>&);
template void announce_limits(const Options<2>&, mesher::Mesher<2>&);
template void announce_limits(const Options<3>&, mesher::Mesher<3>&);

}  // namespace tool::view
