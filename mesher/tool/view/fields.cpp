// Reading commands field by field.
#include "fields.hpp"

#include <cmath>
#include <map>

#include "pipe.hpp"

namespace tool::view {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Feature;
using mesher::FeatureKind;

Error refusal(const std::string& what) { return {ErrorCode::bad_edit, what}; }

const Json& field(const Json& command, const char* name) {
  const auto found = command.find(name);
  if (found == command.end()) throw refusal(std::string("the command has no '") + name + "'");
  return *found;
}

std::int64_t id_of(const Json& value) {
  if (!value.is_number_integer() && !value.is_number_unsigned())
    throw refusal("an id is no integer");
  const bool fits = value.is_number_unsigned()
                        ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(kLargestId)
                        : std::abs(value.get<double>()) <= static_cast<double>(kLargestId);
  if (!fits) throw refusal("an id is beyond 2^53");
  return value.get<std::int64_t>();
}

double number_of(const Json& value, const char* what) {
  if (!value.is_number()) throw refusal(std::string(what) + " is no number");
  const double x = value.get<double>();
  if (!std::isfinite(x)) throw refusal(std::string(what) + " is not finite");
  return x;
}

bool flag_of(const Json& command, const char* name) {
  const auto found = command.find(name);
  if (found == command.end()) return false;
  if (!found->is_boolean()) throw refusal(std::string("'") + name + "' is neither true nor false");
  return found->get<bool>();
}

std::int64_t marker_of(const Json& command) {
  const auto found = command.find("marker");
  return found == command.end() ? 0 : id_of(*found);
}

Feature feature_of(const Json& value) {
  static const std::map<std::string, FeatureKind> kKinds{{"point", FeatureKind::point},
                                                         {"line", FeatureKind::line},
                                                         {"polygon", FeatureKind::polygon},
                                                         {"hole", FeatureKind::hole},
                                                         {"region", FeatureKind::region}};
  if (!value.is_array() || value.size() != 2 || !value[0].is_string()) {
    throw refusal("a feature is [kind, id]");
  }
  const auto kind = kKinds.find(value[0].get<std::string>());
  if (kind == kKinds.end()) throw refusal("no feature is of that kind");
  return {kind->second, id_of(value[1])};
}

const char* kind_name(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::point:
      return "point";
    case FeatureKind::line:
      return "line";
    case FeatureKind::polygon:
      return "polygon";
    case FeatureKind::hole:
      return "hole";
    case FeatureKind::region:
      return "region";
    case FeatureKind::none:
      break;
  }
  return "none";
}

Json json_of_error(const Error& error, const Json& tag) {
  Json json{{"kind", "error"},
            {"code", std::string(code_name(error.code()))},
            {"text", with_own_paths(error.message())},
            {"places", error.places()},
            {"tag", tag}};
  json["features"] = Json::array();
  for (const Feature& f : error.features()) {
    if (f.kind != FeatureKind::none) json["features"].push_back({kind_name(f.kind), f.number});
  }
  return json;
}

std::string text_of_json(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tool::view
