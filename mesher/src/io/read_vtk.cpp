// Reads unstructured grids of `.vtk` files (VTK's legacy format, ASCII, versions 1 to 5).
//
//   # vtk DataFile Version v
//   title
//   ASCII
//   DATASET UNSTRUCTURED_GRID
//   POINTS n type            x y z ...
//   CELLS n size             k v ... v     or, from version 5 on, OFFSETS type, CONNECTIVITY type
//   CELL_TYPES n             t ...
//   POINT_DATA n, CELL_DATA n: SCALARS name type [components] LOOKUP_TABLE name, FIELD name arrays
#include <utility>

#include "io/text.hpp"
#include "io/vtk_grid.hpp"

namespace mesher {
namespace {

constexpr std::string_view kIntegers[] = {"bit",   "unsigned_char", "char",     "unsigned_short",
                                          "short", "unsigned_int",  "int",      "unsigned_long",
                                          "long",  "vtktypeint64",  "vtkidtype"};
constexpr std::string_view kReals[] = {"float", "double"};

class VtkReader {
 public:
  explicit VtkReader(const text::Source& source) : source_(source), fields_({}) {
    grid_.file = source.file();
  }

  VtkGrid read() {
    read_header();
    for (auto word = fields_.next(); !word.empty(); word = fields_.next()) read_section(word);
    grid_.points.name = "POINTS";
    if (!has_points_) fail(ErrorCode::truncated, "no POINTS", source_.end());
    if (grid_.offsets.size() != grid_.types.size()) {
      fail(ErrorCode::wrong_count,
           std::to_string(grid_.offsets.size()) + " cells with " +
               std::to_string(grid_.types.size()) + " types",
           source_.end());
    }
    require_consistent(grid_);
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(ErrorCode code, const std::string& what, std::string_view at) const {
    throw source_.error(code, what, at);
  }

  // The first two lines are free text; the rest is fields.
  void read_header() {
    std::string_view rest = source_.content();
    if (rest.substr(0, 22) != "# vtk DataFile Version") {
      fail(ErrorCode::bad_header, "expected '# vtk DataFile Version'", rest);
    }
    for (int line = 0; line < 2; ++line) {
      const auto end = rest.find('\n');
      if (end == std::string_view::npos) fail(ErrorCode::truncated, "the header ends", rest);
      rest.remove_prefix(end + 1);
    }
    fields_ = text::Fields(rest);
    const std::string_view format = take("ASCII");
    if (format == "BINARY")
      fail(ErrorCode::unsupported, "a binary file: write it as ASCII", format);
    if (format != "ASCII") fail(ErrorCode::bad_header, "expected ASCII", format);
    expect("DATASET");
    const std::string_view set = take("a data set");
    if (set == "UNSTRUCTURED_GRID") return;
    fail(ErrorCode::unsupported, "the data set " + text::quoted(set) + ", not UNSTRUCTURED_GRID",
         set);
  }

  void read_section(std::string_view word) {
    if (word == "POINTS") return read_points(word);
    if (word == "CELLS") return read_cells(word);
    if (word == "CELL_TYPES") return read_types(word);
    if (word == "POINT_DATA") return begin_data(grid_.point_data, grid_.point_count());
    if (word == "CELL_DATA") return begin_data(grid_.cell_data, grid_.cell_count());
    if (word == "FIELD") return read_field();
    if (word == "SCALARS" && data_ != nullptr) return read_scalars();
    if (word == "METADATA") return skip_metadata(word);
    fail(ErrorCode::unsupported, "the section " + text::quoted(word), word);
  }

  std::string_view take(const std::string& what) {
    const std::string_view field = fields_.next();
    if (field.empty()) fail(ErrorCode::truncated, "the file ends before " + what, source_.end());
    return field;
  }
  void expect(std::string_view word) {
    const std::string_view found = take(std::string(word));
    if (found != word) fail(ErrorCode::bad_syntax, "expected " + std::string(word), found);
  }
  std::size_t take_count(const std::string& what) {
    const std::string_view field = take(what);
    const std::int64_t count = source_.integer(field);
    if (count < 0) fail(ErrorCode::bad_header, "a count of " + std::string(field), field);
    return static_cast<std::size_t>(count);
  }
  bool take_is_integral() {
    const std::string_view type = take("a type of numbers");
    for (const auto known : kIntegers) {
      if (type == known) return true;
    }
    for (const auto known : kReals) {
      if (type == known) return false;
    }
    fail(ErrorCode::unsupported, "numbers of the type " + text::quoted(type), type);
  }
  void read_numbers(VtkArray& array, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view field = take("all of its numbers");
      if (array.is_integral) {
        array.integers.push_back(source_.integer(field));
      } else {
        array.reals.push_back(source_.finite(field));
      }
    }
  }

  void read_points(std::string_view word) {
    has_points_ = true;
    const std::size_t count = take_count("the number of points");
    (void)take_is_integral();
    grid_.points = VtkArray{"POINTS", 3, false, {}, {}, source_.place(word)};
    for (std::size_t i = 0; i < count; ++i) read_numbers(grid_.points, 3);
  }

  void read_cells(std::string_view word) {
    grid_.connectivity = integers("connectivity", word);
    grid_.offsets = integers("offsets", word);
    const std::size_t first = take_count("the number of cells");
    const std::size_t second = take_count("the size of cells");
    text::Fields ahead = fields_;
    if (ahead.next() == "OFFSETS") return read_offsets(first, second);
    std::size_t left = second;
    for (std::size_t i = 0; i < first; ++i) {
      const std::size_t corners = take_count("all cells");
      if (left < corners + 1 || corners > left) {
        fail(ErrorCode::wrong_count, "cells have more numbers than CELLS says", word);
      }
      left -= corners + 1;
      read_numbers(grid_.connectivity, corners);
      grid_.offsets.integers.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
    }
    if (left > 0) fail(ErrorCode::wrong_count, "cells have fewer numbers than CELLS says", word);
  }

  // Version 5: offsets begin with 0.
  void read_offsets(std::size_t offsets, std::size_t size) {
    const std::string_view word = take("OFFSETS");
    (void)take_is_integral();
    read_numbers(grid_.offsets, offsets);
    if (offsets == 0 || grid_.offsets.integers.front() != 0) {
      fail(ErrorCode::bad_mesh, "the first offset is not 0", word);
    }
    grid_.offsets.integers.erase(grid_.offsets.integers.begin());
    expect("CONNECTIVITY");
    (void)take_is_integral();
    read_numbers(grid_.connectivity, size);
  }

  void read_types(std::string_view word) {
    grid_.types = integers("types", word);
    read_numbers(grid_.types, take_count("the number of types"));
  }

  VtkArray integers(const char* name, std::string_view at) const {
    return VtkArray{name, 1, true, {}, {}, source_.place(at)};
  }

  void begin_data(std::vector<VtkArray>& into, std::size_t expected) {
    const std::string_view word = take("the number of values");
    if (std::cmp_not_equal(source_.integer(word), expected)) {
      fail(ErrorCode::wrong_count,
           "data of " + std::string(word) + ", expected " + std::to_string(expected), word);
    }
    data_ = &into;
    items_ = expected;
  }

  // Before POINT_DATA and CELL_DATA fields are of the whole file.
  void read_field() {
    const std::string_view name = take("a name");
    const std::size_t arrays = take_count("the number of arrays");
    for (std::size_t i = 0; i < arrays; ++i) {
      VtkArray array;
      const std::string_view at = take("a name");
      array.name = at;
      array.place = source_.place(at);
      array.components = take_count("the number of components");
      const std::size_t count = take_count("the number of values");
      array.is_integral = take_is_integral();
      if (array.components == 0 || (data_ != nullptr && count != items_)) {
        fail(ErrorCode::wrong_count,
             "an array of " + std::to_string(array.components) + " x " + std::to_string(count), at);
      }
      for (std::size_t k = 0; k < count; ++k) read_numbers(array, array.components);
      if (data_ != nullptr) data_->push_back(std::move(array));
    }
    if (data_ == nullptr) grid_.notes.add("fields of the file are not used", source_.place(name));
  }

  void read_scalars() {
    VtkArray array;
    const std::string_view at = take("a name");
    array.name = at;
    array.place = source_.place(at);
    array.is_integral = take_is_integral();
    std::string_view next = take("LOOKUP_TABLE");
    if (next != "LOOKUP_TABLE") {
      array.components = static_cast<std::size_t>(source_.integer(next));
      if (array.components < 1 || array.components > 4) {
        fail(ErrorCode::bad_header, "scalars have 1 to 4 components", next);
      }
      expect("LOOKUP_TABLE");
    }
    if (const auto table = take("a table"); table != "default") {
      fail(ErrorCode::unsupported, "the lookup table " + text::quoted(table), table);
    }
    for (std::size_t i = 0; i < items_; ++i) read_numbers(array, array.components);
    data_->push_back(std::move(array));
  }

  // Up to the next empty line.
  void skip_metadata(std::string_view word) {
    grid_.notes.add("METADATA is not used", source_.place(word));
    const auto begin = static_cast<std::size_t>(word.data() - source_.content().data());
    const auto end = source_.content().find("\n\n", begin);
    fields_ =
        text::Fields(end == std::string_view::npos ? source_.end() : source_.content().substr(end));
  }

  const text::Source& source_;
  text::Fields fields_;
  VtkGrid grid_;
  bool has_points_ = false;
  std::vector<VtkArray>* data_ = nullptr;  // where arrays go
  std::size_t items_ = 0;                  // how many values they have
};

}  // namespace

VtkGrid read_vtk(const std::string& path) {
  const text::Source source(path);
  return VtkReader(source).read();
}

}  // namespace mesher
