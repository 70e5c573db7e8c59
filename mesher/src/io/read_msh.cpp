// Reads `.msh` files (Gmsh, versions 4.1 and 2.2).
//
// Version 4.1:
//
//   $MeshFormat      4.1 0 8
//   $PhysicalNames   n   dimension number "name"
//   $Entities        points curves surfaces volumes, then each with its groups
//   $Nodes           blocks nodes least most   dimension tag parametric n, tags, places
//   $Elements        blocks elements least most   dimension tag type n, tag and nodes
//
// In a binary file names are text; elsewhere integers have 4 bytes, but counts, and the tags of
// nodes and elements, 8. A 1 in $MeshFormat shows the order of bytes.
//
// Version 2.2:
//
//   $Nodes           n   number place
//   $Elements        n   number type tags, tags (the first is a group), nodes
//
// In a binary file counts are text, other integers have 4 bytes, and elements come in blocks:
// type, n, tags, then number, tags and nodes of each.
//
// Elements of second order are read by their corners.
#include <map>
#include <set>
#include <utility>

#include "io/binary.hpp"
#include "io/names_read.hpp"
#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// Types of elements. Those of second order have the corners first, then nodes between them.
constexpr std::int64_t kLine = 1, kTriangle = 2, kTetrahedron = 4, kPoint = 15;
constexpr std::int64_t kQuadraticLine = 8, kQuadraticTriangle = 9, kQuadraticTetrahedron = 11;
constexpr std::int64_t kCurve = 1, kSurface = 2, kVolume = 3;  // dimensions of entities

using Key = std::pair<std::int64_t, std::int64_t>;  // dimension and number

constexpr const char* kPointsNote = "elements that are points are not used";

class MshReader {
 public:
  explicit MshReader(const text::Source& source)
      : source_(source), fields_(source.content()), bytes_(source, fields_), mesh_(source.file()) {}

  AnyMesh read() {
    expect("$MeshFormat");
    read_format();
    for (auto word = fields_.next(); !word.empty(); word = fields_.next()) read_section(word);
    for (const char* section : {"$Nodes", "$Elements"}) {
      if (seen_.contains(section)) continue;
      throw source_.error(ErrorCode::truncated, std::string("no ") + section, source_.end());
    }
    return mesh_.finish();
  }

 private:
  std::string_view take() {
    const std::string_view field = fields_.next();
    if (!field.empty()) return field;
    throw source_.error(ErrorCode::truncated, "the file ends too early", source_.end());
  }
  void expect(std::string_view word) {
    const std::string_view found = take();
    if (found == word) return;
    throw source_.error(ErrorCode::bad_syntax, "expected " + text::quoted(word), found);
  }
  // A number, and where it is: nowhere in a binary file.
  struct Number {
    std::int64_t value;
    std::string_view at;

    [[nodiscard]] std::string text() const { return std::to_string(value); }
  };
  Number number(std::size_t bytes) {
    if (binary_) return {bytes_.integer(bytes), {}};
    const std::string_view field = take();
    return {source_.integer(field), field};
  }
  Number tag() { return number(is_old_ ? 4 : 8); }  // of nodes and elements
  std::int64_t integer() { return number(4).value; }
  std::int64_t count() {
    const Number n = number(8);
    if (n.value < 0) throw error(ErrorCode::bad_header, "a count of " + n.text(), n);
    return n.value;
  }
  double real() { return binary_ ? bytes_.real(8) : source_.finite(take()); }
  void skip_reals(std::int64_t n) {
    for (; n > 0; --n) (void)real();
  }
  [[nodiscard]] FileLocation place(const Number& n) const {
    return binary_ ? FileLocation{source_.file()} : source_.place(n.at);
  }
  [[nodiscard]] Error error(ErrorCode code, const std::string& what, const Number& n) const {
    return binary_ ? bytes_.error(code, what) : source_.error(code, what, n.at);
  }

  void read_format() {
    const std::string_view version = take();
    is_old_ = version == "2.2" || version == "2.1" || version == "2";
    if (version != "4.1" && !is_old_) {
      throw source_.error(ErrorCode::unsupported,
                          "version " + text::quoted(version) + ": save as version 4.1 or 2.2",
                          version);
    }
    const std::string_view kind = take();
    binary_ = kind == "1";
    if (!binary_ && kind != "0") {
      throw source_.error(ErrorCode::bad_header, "expected 0 (ASCII) or 1 (binary)", kind);
    }
    const std::string_view size = take();
    if (source_.integer(size) != 8 && binary_) {
      throw source_.error(ErrorCode::unsupported, "counts of other than 8 bytes", size);
    }
    if (binary_) read_byte_order();
    expect("$EndMeshFormat");
  }

  void read_byte_order() {
    bytes_.begin();
    const std::uint64_t one = bytes_.bits(4);
    if (one != 1 && one != 0x01000000) {
      throw bytes_.error(ErrorCode::bad_header, "no order of bytes makes a 1");
    }
    bytes_.set_big_endian(one != 1);
  }

  void read_section(std::string_view word) {
    const bool has_numbers = word == "$Entities" || word == "$Nodes" || word == "$Elements";
    if (binary_ && has_numbers && !is_old_) bytes_.begin();
    if (word == "$PhysicalNames") {
      read_names();
    } else if (word == "$Entities") {
      read_entities();
    } else if (word == "$Nodes") {
      is_old_ ? read_old_nodes() : read_nodes();
    } else if (word == "$Elements") {
      is_old_ ? read_old_elements() : read_elements();
    } else {
      return skip_section(word);
    }
    expect("$End" + std::string(word.substr(1)));
    seen_.insert(word);
  }

  void skip_section(std::string_view word) {
    if (word[0] != '$') throw source_.error(ErrorCode::bad_syntax, "expected a section", word);
    mesh_.notes.add("the section " + text::quoted(word) + " is not used", source_.place(word));
    const std::string end = "$End" + std::string(word.substr(1));
    const auto at = fields_.rest().find(end);
    if (at == std::string_view::npos) {
      throw source_.error(ErrorCode::truncated, "the file ends before " + text::quoted(end),
                          source_.end());
    }
    fields_ = text::Fields(fields_.rest().substr(at + end.size()));
  }

  // Names have blanks: the part between quotes.
  void read_names() {
    std::int64_t left = text_integer();
    for (; left > 0; --left) {
      const std::int64_t dimension = text_integer(), number = text_integer();
      const std::string_view first = take();
      const auto begin = static_cast<std::size_t>(first.data() - source_.content().data()) + 1;
      const auto end = source_.content().find('"', begin);
      if (first[0] != '"' || end == std::string_view::npos) {
        throw source_.error(ErrorCode::bad_syntax, "expected a name in quotes", first);
      }
      const std::string_view name = source_.content().substr(begin, end - begin);
      names_[{dimension, number}] = name;
      if (dimension > 0) {
        mesh_.add_name(static_cast<int>(dimension), number, name, source_.place(first));
      }
      fields_ = text::Fields(source_.content().substr(end + 1));
    }
  }
  std::int64_t text_integer() { return source_.integer(take()); }

  void read_entities() {
    const std::int64_t points = count(), curves = count(), surfaces = count(), volumes = count();
    mesh_.is_in_space = volumes > 0;
    for (std::int64_t i = 0; i < points; ++i) {
      (void)integer();
      skip_reals(3);
      for (auto left = count(); left > 0; --left) (void)integer();
    }
    for (std::int64_t i = 0; i < curves; ++i) read_entity(kCurve);
    for (std::int64_t i = 0; i < surfaces; ++i) read_entity(kSurface);
    for (std::int64_t i = 0; i < volumes; ++i) read_entity(kVolume);
  }

  void read_entity(std::int64_t dimension) {
    const std::int64_t tag = integer();
    skip_reals(6);
    const Number groups = number(8);
    if (groups.value > 1) {
      mesh_.notes.add("groups of an entity but the first are not used", place(groups));
    }
    for (std::int64_t i = 0; i < groups.value; ++i) {
      const std::int64_t number = integer();
      if (i == 0) group_of_[{dimension, tag}] = number;
    }
    for (auto left = count(); left > 0; --left) (void)integer();
  }

  void read_nodes() {
    const std::int64_t blocks = count(), nodes = count();
    (void)tag(), (void)tag();
    for (std::int64_t i = 0; i < blocks; ++i) {
      const std::int64_t dimension = integer();
      (void)integer();
      const bool parametric = integer() != 0;
      const std::int64_t in_block = count();
      std::vector<Number> tags;
      for (std::int64_t k = 0; k < in_block; ++k) tags.push_back(tag());
      for (const Number& tag : tags) {
        add_node(tag);
        if (parametric) skip_reals(dimension);
      }
    }
    require_indexable(mesh_.vertices(), source_.file());
    require_count("nodes", nodes, mesh_.vertices());
  }

  void add_node(const Number& tag) {
    const double x = real(), y = real();
    const std::string_view at = fields_.rest();
    const double z = real();
    const auto index = static_cast<std::uint32_t>(mesh_.vertices());
    if (!node_.try_emplace(tag.value, index).second) {
      throw error(ErrorCode::repeated_id, "node " + tag.text() + " is given twice", tag);
    }
    mesh_.add_vertex({x, y, z},
                     [&] { return binary_ ? place(tag) : source_.place(text::Fields(at).next()); });
  }

  void read_elements() {
    const std::int64_t blocks = count(), elements = count();
    (void)tag(), (void)tag();
    std::size_t done = 0;
    for (std::int64_t i = 0; i < blocks; ++i) {
      const std::int64_t dimension = integer(), tag = integer();
      const Number type = number(4);
      const std::int64_t in_block = count();
      done += static_cast<std::size_t>(in_block);
      read_block(type, {dimension, tag}, in_block);
    }
    require_count("elements", elements, done);
  }

  // Of version 2.2: a count is text.
  std::int64_t old_count() {
    const std::string_view field = take();
    const std::int64_t n = source_.integer(field);
    if (n < 0)
      throw source_.error(ErrorCode::bad_header, "a count of " + text::quoted(field), field);
    if (binary_) bytes_.begin();
    return n;
  }
  void read_old_nodes() {
    const std::int64_t nodes = old_count();
    for (std::int64_t i = 0; i < nodes; ++i) add_node(tag());
    require_indexable(mesh_.vertices(), source_.file());
  }
  void read_old_elements() {
    const std::int64_t elements = old_count();
    for (std::int64_t done = 0; done < elements;) {
      const Number first = binary_ ? Number{0, {}} : tag();
      const Number type = number(4);
      require_type(type);
      const Number in_block = binary_ ? number(4) : Number{1, {}};
      if (in_block.value < 1 || in_block.value > elements - done) {
        throw error(ErrorCode::wrong_count, "a block of " + in_block.text() + " elements",
                    in_block);
      }
      done += in_block.value;
      const std::int64_t tags = integer();
      for (std::int64_t i = 0; i < in_block.value; ++i) {
        const Number name = binary_ ? tag() : first;
        std::int64_t group = 0;
        for (std::int64_t k = 0; k < tags; ++k) {
          const std::int64_t value = integer();
          if (k == 0) group = value;
        }
        read_old_element(type, name, group);
      }
    }
  }
  void read_old_element(const Number& type, const Number& name, std::int64_t group) {
    if (type.value == kPoint) mesh_.notes.add(kPointsNote, place(type));
    const Key key{dimension_of_type(type.value), group};
    read_element(type.value, name, region_of_group(key), marker_of_group(key));
  }

  void read_block(const Number& type, const Key& entity, std::int64_t elements) {
    require_type(type);
    if (type.value == kPoint) mesh_.notes.add(kPointsNote, place(type));
    const double region = region_of(entity);
    const std::int64_t marker = marker_of(entity);
    for (; elements > 0; --elements) read_element(type.value, tag(), region, marker);
  }

  static std::int64_t dimension_of_type(std::int64_t type) {
    if (type == kPoint) return 0;
    if (type == kLine || type == kQuadraticLine) return kCurve;
    return type == kTriangle || type == kQuadraticTriangle ? kSurface : kVolume;
  }
  void require_type(const Number& type) const {
    for (const std::int64_t known : {kPoint, kLine, kTriangle, kTetrahedron, kQuadraticLine,
                                     kQuadraticTriangle, kQuadraticTetrahedron}) {
      if (type.value == known) return;
    }
    throw error(ErrorCode::unsupported,
                "elements of the type " + type.text() +
                    ": points (15), lines (1, 8) and triangles (2, 9), or tetrahedra (4, 11), make "
                    "a mesh",
                type);
  }

  void read_element(std::int64_t type, const Number& name, double region, std::int64_t marker) {
    switch (type) {
      case kPoint:
        (void)node();
        return;
      case kLine:
      case kQuadraticLine:
        read_line(name, marker);
        return type == kQuadraticLine ? skip_midpoints(1, name) : void();
      case kTriangle:
      case kQuadraticTriangle:
        read_simplex<2>(name, region, marker);
        return type == kQuadraticTriangle ? skip_midpoints(3, name) : void();
      default:
        read_simplex<3>(name, region, marker);
        return type == kQuadraticTetrahedron ? skip_midpoints(6, name) : void();
    }
  }

  void skip_midpoints(int nodes, const Number& name) {
    mesh_.notes.add("the nodes between corners of elements of second order are not used",
                    place(name));
    for (; nodes > 0; --nodes) mesh_.add_midpoint(node());
  }

  void read_line(const Number& name, std::int64_t marker) {
    const std::uint32_t a = node(), b = node();
    MeshEdge edge = edge_of(a, b, [&] { return place(name); });
    edge.marker = marker;
    mesh_.edges.push_back(edge);
  }

  template <int D>
  void read_simplex(const Number& name, double region, std::int64_t marker) {
    typename Mesh<D>::Simplex corners;
    for (auto& corner : corners) corner = node();
    if (!are_different(corners)) {
      throw error(ErrorCode::bad_mesh,
                  std::string(kSimplexName<D>) + ' ' + name.text() + " has the same corner twice",
                  name);
    }
    if constexpr (D == 2) {
      mesh_.add_triangle(corners, region, marker);
    } else {
      mesh_.add<D>(corners, region);
    }
  }

  std::uint32_t node() {
    const Number n = tag();
    const auto found = node_.find(n.value);
    if (found != node_.end()) return found->second;
    throw error(ErrorCode::bad_mesh, "there is no node " + n.text(), n);
  }

  // The number behind its first word if the name is that of a number, as write_mesh writes it;
  // empty if it is another.
  std::string_view named_value(const Key& group, std::string_view word) const {
    const auto found = names_.find(group);
    if (found == names_.end() || !is_name_of_number(found->second)) return {};
    const std::string_view name = found->second;
    return name.substr(0, word.size()) == word ? name.substr(word.size() + 1) : std::string_view();
  }

  double region_of_group(const Key& group) const {
    const auto value = named_value(group, "region");
    return value.empty() ? static_cast<double>(group.second) : source_.finite(value);
  }
  // In the plane of surfaces, too, which are faces in space.
  std::int64_t marker_of_group(const Key& group) const {
    for (const std::string_view word : {"marker", "line"}) {
      const auto value = named_value(group, word);
      if (!value.empty()) return source_.integer(value);
    }
    return group.second;
  }

  double region_of(const Key& entity) const {
    const auto number = group_of_.find(entity);
    return number == group_of_.end() ? 0 : region_of_group({entity.first, number->second});
  }
  std::int64_t marker_of(const Key& entity) const {
    const auto number = group_of_.find(entity);
    return number == group_of_.end() ? 0 : marker_of_group({entity.first, number->second});
  }

  void require_count(const std::string& what, std::int64_t said, std::size_t found) const {
    if (std::cmp_equal(said, found)) return;
    throw source_.error(ErrorCode::wrong_count,
                        std::to_string(said) + " " + what + " are announced, but there are " +
                            std::to_string(found),
                        source_.end());
  }

  const text::Source& source_;
  text::Fields fields_;
  BinaryCursor bytes_;
  bool binary_ = false, is_old_ = false;
  MeshParts mesh_;
  std::map<std::int64_t, std::uint32_t> node_;  // by tag
  std::map<Key, std::int64_t> group_of_;        // of an entity
  std::map<Key, std::string_view> names_;       // of groups
  std::set<std::string_view> seen_;             // sections
};

}  // namespace

AnyMesh read_msh(const std::string& path) {
  const text::Source source(path);
  return MshReader(source).read();
}

}  // namespace mesher
