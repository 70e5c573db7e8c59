// Reads `.msh` files (Gmsh, version 4.1).
//
//   $MeshFormat      4.1 0 8
//   $PhysicalNames   n   dimension number "name"
//   $Entities        points curves surfaces volumes, then each with its groups
//   $Nodes           blocks nodes least most   dimension tag parametric n, tags, places
//   $Elements        blocks elements least most   dimension tag type n, tag and nodes
//
// In a binary file names are text; elsewhere integers have 4 bytes, but counts, and the tags of
// nodes and elements, 8. A 1 in $MeshFormat shows the order of bytes.
#include <map>
#include <set>
#include <utility>

#include "io/binary.hpp"
#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

constexpr std::int64_t kLine = 1, kTriangle = 2, kTetrahedron = 4, kPoint = 15;  // types
constexpr std::int64_t kCurve = 1, kSurface = 2, kVolume = 3;  // dimensions of entities

using Key = std::pair<std::int64_t, std::int64_t>;  // dimension and number

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
  Number tag() { return number(8); }  // of nodes and elements
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
    if (version != "4.1") {
      throw source_.error(ErrorCode::unsupported,
                          "version " + text::quoted(version) + ": save as version 4.1", version);
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
    if (binary_ && has_numbers) bytes_.begin();
    if (word == "$PhysicalNames") {
      read_names();
    } else if (word == "$Entities") {
      read_entities();
    } else if (word == "$Nodes") {
      read_nodes();
    } else if (word == "$Elements") {
      read_elements();
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
      names_[{dimension, number}] = source_.content().substr(begin, end - begin);
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

  void read_block(const Number& type, const Key& entity, std::int64_t elements) {
    switch (type.value) {
      case kPoint:
        mesh_.notes.add("elements that are points are not used", place(type));
        for (; elements > 0; --elements) (void)tag(), (void)node();
        return;
      case kLine:
        return read_lines(marker_of(entity), elements);
      case kTriangle:
        return read_simplices<2>(region_of(entity), elements, marker_of(entity));
      case kTetrahedron:
        return read_simplices<3>(region_of(entity), elements);
    }
    throw error(ErrorCode::unsupported,
                "elements of the type " + type.text() +
                    ": points (15), lines (1) and triangles (2), or tetrahedra (4), make a mesh",
                type);
  }

  void read_lines(std::int64_t marker, std::int64_t elements) {
    for (; elements > 0; --elements) {
      const Number number = tag();
      const std::uint32_t a = node(), b = node();
      MeshEdge edge = edge_of(a, b, [&] { return place(number); });
      edge.marker = marker;
      mesh_.edges.push_back(edge);
    }
  }

  template <int D>
  void read_simplices(double region, std::int64_t elements, std::int64_t marker = 0) {
    for (; elements > 0; --elements) {
      const Number number = tag();
      typename Mesh<D>::Simplex corners;
      for (auto& corner : corners) corner = node();
      if (!are_different(corners)) {
        throw error(
            ErrorCode::bad_mesh,
            std::string(kSimplexName<D>) + ' ' + number.text() + " has the same corner twice",
            number);
      }
      if constexpr (D == 2) {
        mesh_.add_triangle(corners, region, marker);
      } else {
        mesh_.add<D>(corners, region);
      }
    }
  }

  std::uint32_t node() {
    const Number n = tag();
    const auto found = node_.find(n.value);
    if (found != node_.end()) return found->second;
    throw error(ErrorCode::bad_mesh, "there is no node " + n.text(), n);
  }

  // What the name says behind its first word, as write_mesh writes it, or nothing.
  std::string_view named_value(const Key& group, std::string_view word) const {
    const auto name = names_.find(group);
    if (name == names_.end()) return {};
    const std::string_view said = name->second;
    return said.substr(0, word.size()) == word ? said.substr(word.size()) : std::string_view();
  }

  double region_of(const Key& entity) const {
    const auto number = group_of_.find(entity);
    if (number == group_of_.end()) return 0;
    const auto value = named_value({entity.first, number->second}, "region ");
    return value.empty() ? static_cast<double>(number->second) : source_.finite(value);
  }

  std::int64_t marker_of(const Key& entity) const {
    const auto number = group_of_.find(entity);
    if (number == group_of_.end()) return 0;
    const auto value = named_value({entity.first, number->second}, "marker ");
    return value.empty() ? number->second : source_.integer(value);
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
  bool binary_ = false;
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
