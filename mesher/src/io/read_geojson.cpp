// Reads GeoJSON (RFC 7946): lines and points of any geometry, regions and holes of polygons.
#include <algorithm>
#include <optional>
#include <utility>

#include "io/json.hpp"
#include "io/polygon_builder.hpp"
#include "io/read_pslg.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using Kind = JsonValue::Kind;

// What the properties of a feature say of its parts.
struct Properties {
  std::int64_t marker = 0;
  std::optional<double> attribute;
  std::optional<double> max_area;
  NameInFile name{};
};

class GeoJsonReader {
 public:
  explicit GeoJsonReader(const text::Source& source)
      : source_(source), build_(source.file()), polygons_(build_, source.file()) {}

  GraphFile<2> read() {
    read_object(read_json(source_), Properties());
    polygons_.add_seeds();
    return build_.finish();
  }

 private:
  [[noreturn]] void fail(const std::string& what, const JsonValue& at) const {
    throw source_.error(ErrorCode::bad_syntax, what, at.at);
  }

  void require(const JsonValue& value, Kind kind, const char* what) const {
    if (value.kind != kind) fail(std::string("expected ") + what, value);
  }

  const JsonValue& member(const JsonValue& object, std::string_view name, Kind kind,
                          const char* what) const {
    const JsonValue* const value = object.find(name);
    if (value == nullptr) fail("no member " + text::quoted(name), object);
    require(*value, kind, what);
    return *value;
  }

  void note_members(const JsonValue& object, std::initializer_list<std::string_view> used,
                    const std::string& what) {
    for (const JsonValue& value : object.values) {
      if (std::find(used.begin(), used.end(), value.name) != used.end()) continue;
      build_.note("the " + what + " " + text::quoted(value.name) + " is not used",
                  source_.place(value.at));
    }
  }

  void read_object(const JsonValue& object, const Properties& properties) {
    require(object, Kind::object, "a GeoJSON object");
    const JsonValue& type = member(object, "type", Kind::string, "the name of a type");
    if (type.text == "FeatureCollection") {
      note_members(object, {"type", "features"}, "member");
      const JsonValue& features = member(object, "features", Kind::array, "an array of features");
      for (const JsonValue& feature : features.values) read_feature(feature);
    } else if (type.text == "Feature") {
      read_feature(object);
    } else {
      read_geometry(object, properties);
    }
  }

  void read_feature(const JsonValue& feature) {
    require(feature, Kind::object, "a feature");
    if (member(feature, "type", Kind::string, "'Feature'").text != "Feature") {
      fail("expected a feature, of the type 'Feature'", feature);
    }
    note_members(feature, {"type", "geometry", "properties"}, "member");
    const Properties properties = read_properties(feature.find("properties"));
    const JsonValue* const geometry = feature.find("geometry");
    if (geometry == nullptr) fail("no member 'geometry'", feature);
    if (geometry->kind == Kind::null) {
      build_.note("a feature without geometry", source_.place(feature.at));
    } else {
      read_geometry(*geometry, properties);
    }
  }

  Properties read_properties(const JsonValue* object) {
    Properties properties;
    if (object == nullptr || object->kind == Kind::null) return properties;
    require(*object, Kind::object, "an object of properties");
    const JsonValue* const name = object->find("name");
    const bool has_name = name != nullptr && name->kind == Kind::string;
    if (has_name) properties.name = {name->text, source_.place(name->at)};
    if (has_name) {
      note_members(*object, {"marker", "attribute", "max_area", "name"}, "property");
    } else {
      note_members(*object, {"marker", "attribute", "max_area"}, "property");
    }
    if (const auto* marker = number_in(*object, "marker")) {
      properties.marker = source_.integer(marker->at);
    }
    if (const auto* attribute = number_in(*object, "attribute")) {
      properties.attribute = source_.finite(attribute->at);
    }
    if (const auto* area = number_in(*object, "max_area")) {
      properties.max_area = source_.finite(area->at);
      if (*properties.max_area <= 0) fail("a limit of area is above 0", *area);
    }
    return properties;
  }

  // The property, or nothing where it is absent or null.
  const JsonValue* number_in(const JsonValue& object, std::string_view name) const {
    const JsonValue* const value = object.find(name);
    if (value == nullptr || value->kind == Kind::null) return nullptr;
    require(*value, Kind::number, "a number");
    return value;
  }

  void read_geometry(const JsonValue& geometry, const Properties& properties) {
    require(geometry, Kind::object, "a geometry");
    const std::string& type = member(geometry, "type", Kind::string, "a type").text;
    if (type == "GeometryCollection") {
      note_members(geometry, {"type", "geometries"}, "member");
      for (const auto& part :
           member(geometry, "geometries", Kind::array, "an array of geometries").values) {
        read_geometry(part, properties);
      }
      return;
    }
    const auto read = reader_of(type);
    if (read.one == nullptr) fail("no geometry is called " + text::quoted(type), geometry);
    note_members(geometry, {"type", "coordinates"}, "member");
    const auto& coordinates = member(geometry, "coordinates", Kind::array, "coordinates");
    if (coordinates.values.empty()) {
      build_.note("a geometry without coordinates", source_.place(geometry.at));
    } else if (read.many) {
      for (const JsonValue& part : coordinates.values) (this->*read.one)(part, properties);
    } else {
      (this->*read.one)(coordinates, properties);
    }
  }

  struct Reader {
    void (GeoJsonReader::*one)(const JsonValue&, const Properties&);
    bool many;
  };
  static Reader reader_of(std::string_view type) {
    const bool many = type.substr(0, 5) == "Multi";
    const std::string_view single = many ? type.substr(5) : type;
    if (single == "Point") return {&GeoJsonReader::read_point, many};
    if (single == "LineString") return {&GeoJsonReader::read_line, many};
    if (single == "Polygon") return {&GeoJsonReader::read_polygon, many};
    return {nullptr, false};
  }

  void read_point(const JsonValue& position, const Properties& properties) {
    build_.point_at(position_of(position), properties.marker, source_.position(position.at));
    note_name(properties, "a point");
  }

  void note_name(const Properties& properties, const std::string& of) {
    if (properties.name.text.empty()) return;
    build_.note("the name of " + of + " is not used", properties.name.place);
  }

  void read_line(const JsonValue& line, const Properties& properties) {
    require(line, Kind::array, "an array of positions");
    if (line.values.size() < 2) fail("a line has two positions or more", line);
    polygons_.add_line(places_of(line, properties), properties.marker, source_.position(line.at));
    if (properties.marker != 0) return build_.name_marker(properties.marker, properties.name);
    note_name(properties, "a line without a marker");
  }

  void read_polygon(const JsonValue& polygon, const Properties& properties) {
    require(polygon, Kind::array, "an array of rings");
    if (polygon.values.empty()) fail("a polygon has a ring", polygon);
    RingPolygon added{
        {}, {}, properties.marker, properties.attribute, properties.max_area, properties.name};
    for (const JsonValue& ring : polygon.values) {
      require(ring, Kind::array, "a ring of positions");
      if (ring.values.size() < 4) fail("a ring has four positions or more", ring);
      added.rings.push_back(places_of(ring, properties));
      added.positions.push_back(source_.position(ring.at));
      if (added.rings.back().front() == added.rings.back().back()) continue;
      fail("a ring ends where it begins", ring);
    }
    polygons_.add(std::move(added));
  }

  // Of positions, each of which is a point from now on.
  Ring places_of(const JsonValue& line, const Properties& properties) {
    Ring places;
    for (const JsonValue& position : line.values) {
      places.push_back(position_of(position));
      build_.point_at(places.back(), properties.marker, source_.position(position.at));
    }
    return places;
  }

  Point<2> position_of(const JsonValue& position) {
    require(position, Kind::array, "a position: [x, y]");
    if (position.values.size() < 2) fail("a position has two numbers or more", position);
    for (const JsonValue& number : position.values) require(number, Kind::number, "a number");
    if (position.values.size() > 2) {
      build_.note("an altitude is not used", source_.place(position.values[2].at));
    }
    return {source_.coordinate(position.values[0].at), source_.coordinate(position.values[1].at)};
  }

  const text::Source& source_;
  PslgBuilder build_;
  PolygonBuilder polygons_;
};

}  // namespace

GraphFile<2> read_geojson(const std::string& path) {
  const text::Source source(path);
  return GeoJsonReader(source).read();
}

}  // namespace mesher
