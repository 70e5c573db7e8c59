// JSON texts as trees whose values have their location in the file. The JSON library reads; the
// tree keeps only what a reader of geometry needs.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/text.hpp"

namespace mesher {

/// A value and its place.
struct JsonValue {
  enum class Kind : std::uint8_t { null, boolean, number, string, array, object };
  Kind kind = Kind::null;
  std::string_view at;  ///< its first character; of a number all; of a string the last quote
  std::string name;     ///< in an object: the member's name
  std::string text;     ///< of a string
  std::vector<JsonValue> values;  ///< of an array or object

  /// The member of this name, or nullptr. Requires: an object.
  [[nodiscard]] const JsonValue* find(std::string_view member) const;
};

/// Throws: Error(bad_syntax) for what is no JSON, a name twice in one object, or more than 64
/// values within each other.
[[nodiscard]] JsonValue read_json(const text::Source& source);

}  // namespace mesher
