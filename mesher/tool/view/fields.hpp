// The fields of commands, which are JSON, and errors as answers. What is wrong is refused by an
// Error (bad_edit) that says what.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "graph_edits.hpp"
#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace tool::view {

using Json = nlohmann::json;

inline constexpr std::int64_t kLargestId = std::int64_t{1} << 53;  // JavaScript's numbers: doubles
inline constexpr std::size_t kMostFeatures = 100000;               // of one command

[[nodiscard]] mesher::Error refusal(const std::string& what);

/// A field that the command must have.
[[nodiscard]] const Json& field(const Json& command, const char* name);
[[nodiscard]] std::int64_t id_of(const Json& value);
[[nodiscard]] double number_of(const Json& value, const char* what);
/// Fields that may be missing: then false, and 0.
[[nodiscard]] bool flag_of(const Json& command, const char* name);
[[nodiscard]] std::int64_t marker_of(const Json& command);
/// [kind, id]
[[nodiscard]] mesher::Feature feature_of(const Json& value);
[[nodiscard]] const char* kind_name(mesher::FeatureKind kind);

template <int D>
[[nodiscard]] mesher::Point<D> position_of_json(const Json& value) {
  if (!value.is_array() || value.size() != D) {
    throw refusal("a position has " + std::to_string(D) + " coordinates");
  }
  mesher::Point<D> p;
  for (int i = 0; i < D; ++i) p[i] = number_of(value[i], "a coordinate");
  return p;
}

/// Words of scripts, with the blank before them.
template <int D>
[[nodiscard]] std::string place_words(const mesher::Point<D>& p) {
  std::string text;
  for (const double x : p) {
    text += ' ';
    text += script_number(x);
  }
  return text;
}
[[nodiscard]] inline std::string id_word(auto id) {
  std::string text(1, ' ');
  return text += std::to_string(static_cast<std::int64_t>(id));
}
/// ` marker M`, or nothing for 0.
[[nodiscard]] inline std::string marker_words(std::int64_t marker) {
  return marker == 0 ? "" : " marker " + std::to_string(marker);
}

/// The answer to a command that failed.
[[nodiscard]] Json json_of_error(const mesher::Error& error, const Json& tag);
/// As text; what is no UTF-8 is replaced.
[[nodiscard]] std::string text_of_json(const Json& json);

}  // namespace tool::view
