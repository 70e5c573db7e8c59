// XML texts as trees whose parts have their location in the file: the subset of XML that VTK's
// files use.
//
// Elements, attributes, comments, declarations. Entities are left as they are written. What is
// between the tags of an element without children is its text. Of an AppendedData element with raw
// bytes, which are not XML, the text is all from '_' to the last end tag of that name.
#pragma once

#include <string_view>
#include <vector>

#include "text/text.hpp"

namespace mesher {

struct XmlAttribute {
  std::string_view name;
  std::string_view value;
};

struct XmlElement {
  std::string_view name;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  std::string_view text;

  /// The attribute's value, or nullptr.
  [[nodiscard]] const std::string_view* find(std::string_view attribute) const;
  /// The first child of this name, or nullptr.
  [[nodiscard]] const XmlElement* child(std::string_view child_name) const;
};

/// The root element; all views are into the source's content.
/// Throws: Error(bad_syntax), also for more than 64 elements within each other.
[[nodiscard]] XmlElement read_xml(const text::Source& source);

}  // namespace mesher
