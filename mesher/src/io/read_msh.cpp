// Reads `.msh` files (Gmsh, version 4.1, ASCII).
//
//   $MeshFormat      4.1 0 8
//   $PhysicalNames   n   dimension number "name"
//   $Entities        points curves surfaces volumes, then each with its groups
//   $Nodes           blocks nodes least most   dimension tag parametric n, tags, places
//   $Elements        blocks elements least most   dimension tag type n, tag and nodes
#include <map>
#include <utility>

#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

constexpr std::int64_t kLine = 1, kTriangle = 2, kPoint = 15;  // types of elements
constexpr std::int64_t kCurve = 1, kSurface = 2;               // dimensions of entities

using Key = std::pair<std::int64_t, std::int64_t>;  // dimension and number

class MshReader {
 public:
  explicit MshReader(const text::Source& source) : source_(source), fields_(source.content()) {}

  MeshData read() {
    expect("$MeshFormat");
    read_format();
    for (auto word = fields_.next(); !word.empty(); word = fields_.next()) read_section(word);
    mesh_.kinds.assign(mesh_.vertices.size(), VertexKind::steiner);
    mesh_.notes = notes_.notes();
    return std::move(mesh_);
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
    throw source_.error(ErrorCode::bad_syntax, "expected " + std::string(word), found);
  }
  std::int64_t integer() { return source_.integer(take()); }
  std::int64_t count() {
    const std::string_view field = take();
    const std::int64_t value = source_.integer(field);
    if (value >= 0) return value;
    throw source_.error(ErrorCode::bad_header, "a count of " + std::string(field), field);
  }
  double real() { return source_.finite(take()); }
  void skip_reals(int n) {
    for (int i = 0; i < n; ++i) (void)real();
  }

  void read_format() {
    const std::string_view version = take();
    if (version != "4.1") {
      throw source_.error(ErrorCode::unsupported,
                          "version " + std::string(version) + ": save as version 4.1", version);
    }
    const std::string_view binary = take();
    if (binary != "0") {
      throw source_.error(ErrorCode::unsupported, "a binary file: save as ASCII", binary);
    }
    (void)integer();
    expect("$EndMeshFormat");
  }

  void read_section(std::string_view word) {
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
  }

  void skip_section(std::string_view word) {
    if (word[0] != '$') throw source_.error(ErrorCode::bad_syntax, "expected a section", word);
    notes_.add("the section " + text::quoted(word) + " is not used", source_.place(word));
    const std::string end = "$End" + std::string(word.substr(1));
    while (take() != end) continue;
  }

  // Names have blanks: the part between quotes.
  void read_names() {
    for (auto left = count(); left > 0; --left) {
      const std::int64_t dimension = integer(), number = integer();
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

  void read_entities() {
    const std::int64_t points = count(), curves = count(), surfaces = count(), volumes = count();
    for (std::int64_t i = 0; i < points; ++i) {
      (void)integer();
      skip_reals(3);
      for (auto left = count(); left > 0; --left) (void)integer();
    }
    for (std::int64_t i = 0; i < curves; ++i) read_entity(kCurve);
    for (std::int64_t i = 0; i < surfaces; ++i) read_entity(kSurface);
    for (std::int64_t i = 0; i < volumes; ++i) read_entity(kSurface + 1);
  }

  void read_entity(std::int64_t dimension) {
    const std::int64_t tag = integer();
    skip_reals(6);
    const std::string_view at = take();
    const std::int64_t groups = source_.integer(at);
    if (groups > 1) {
      notes_.add("groups of an entity but the first are not used", source_.place(at));
    }
    for (std::int64_t i = 0; i < groups; ++i) {
      const std::int64_t number = integer();
      if (i == 0) group_of_[{dimension, tag}] = number;
    }
    for (auto left = count(); left > 0; --left) (void)integer();
  }

  void read_nodes() {
    const std::int64_t blocks = count(), nodes = count();
    (void)integer(), (void)integer();
    for (std::int64_t i = 0; i < blocks; ++i) {
      const std::int64_t dimension = integer();
      (void)integer();
      const bool parametric = integer() != 0;
      const std::int64_t in_block = count();
      std::vector<std::string_view> tags;
      for (std::int64_t k = 0; k < in_block; ++k) tags.push_back(take());
      for (const std::string_view tag : tags) {
        add_node(tag);
        if (parametric) skip_reals(static_cast<int>(dimension));
      }
    }
    require_indexable(mesh_.vertices.size(), source_.file());
    require_count("nodes", nodes, mesh_.vertices.size());
  }

  void add_node(std::string_view tag) {
    const double x = real(), y = real();
    const std::string_view z = take();
    height_.require(source_.finite(z), [&] { return source_.place(z); });
    const auto index = static_cast<std::uint32_t>(mesh_.vertices.size());
    if (!node_.try_emplace(source_.integer(tag), index).second) {
      throw source_.error(ErrorCode::repeated_id, "node " + std::string(tag) + " is given twice",
                          tag);
    }
    mesh_.vertices.push_back({x, y});
  }

  void read_elements() {
    const std::int64_t blocks = count(), elements = count();
    (void)integer(), (void)integer();
    std::size_t done = 0;
    for (std::int64_t i = 0; i < blocks; ++i) {
      const std::int64_t dimension = integer(), tag = integer();
      const std::string_view type = take();
      const std::int64_t in_block = count();
      done += static_cast<std::size_t>(in_block);
      read_block(type, {dimension, tag}, in_block);
    }
    require_count("elements", elements, done);
  }

  void read_block(std::string_view type, const Key& entity, std::int64_t elements) {
    switch (source_.integer(type)) {
      case kPoint:
        notes_.add("elements that are points are not used", source_.place(type));
        for (; elements > 0; --elements) (void)integer(), (void)node();
        return;
      case kLine:
        return read_lines(marker_of(entity), elements);
      case kTriangle:
        return read_triangles(region_of(entity), elements);
    }
    throw source_.error(ErrorCode::unsupported,
                        "elements of the type " + std::string(type) +
                            ": points (15), lines (1) and triangles (2) make a mesh",
                        type);
  }

  void read_lines(std::int64_t marker, std::int64_t elements) {
    for (; elements > 0; --elements) {
      const std::string_view number = take();
      (void)source_.integer(number);
      const std::uint32_t a = node(), b = node();
      MeshEdge edge = edge_of(a, b, [&] { return source_.place(number); });
      edge.marker = marker;
      mesh_.features.edges.push_back(edge);
    }
  }

  void read_triangles(double region, std::int64_t elements) {
    for (; elements > 0; --elements) {
      const std::string_view number = take();
      (void)source_.integer(number);
      const Mesh<2>::Simplex t{node(), node(), node()};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        throw source_.error(ErrorCode::bad_mesh,
                            "triangle " + std::string(number) + " has the same corner twice",
                            number);
      }
      mesh_.simplices.push_back(t);
      mesh_.features.regions.push_back(region);
    }
  }

  std::uint32_t node() { return node_at(take()); }
  std::uint32_t node_at(std::string_view field) const {
    const auto found = node_.find(source_.integer(field));
    if (found != node_.end()) return found->second;
    throw source_.error(ErrorCode::bad_mesh, "there is no node " + std::string(field), field);
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
  MeshData mesh_;
  NoteCounter notes_;
  PlaneHeight height_;
  std::map<std::int64_t, std::uint32_t> node_;  // by tag
  std::map<Key, std::int64_t> group_of_;        // of an entity
  std::map<Key, std::string_view> names_;       // of groups
};

}  // namespace

MeshData read_msh(const std::string& path) {
  const text::Source source(path);
  return MshReader(source).read();
}

}  // namespace mesher
