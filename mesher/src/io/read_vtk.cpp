// Reads unstructured grids of `.vtk` files (VTK's legacy format, versions 1 to 5).
//
//   # vtk DataFile Version v
//   title
//   ASCII                    or BINARY: numbers are bytes then, the highest first, from the line
//                            on that follows the last word before them
//   DATASET UNSTRUCTURED_GRID
//   POINTS n type            x y z ...
//   CELLS n size             k v ... v     or, from version 5 on, OFFSETS type, CONNECTIVITY type
//   CELL_TYPES n             t ...
//   POINT_DATA n, CELL_DATA n: SCALARS name type [components] LOOKUP_TABLE name, FIELD name arrays
#include <utility>

#include "io/binary.hpp"
#include "io/vtk_grid.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

struct VtkNumber {
  std::string_view name;
  bool is_integral;
  bool is_signed;
  std::size_t bytes;  // 0: not in binary files
};

// VTK writes its vtkIdType as int.
constexpr VtkNumber kVtkNumbers[] = {
    {"bit", true, false, 0},      {"unsigned_char", true, false, 1},
    {"char", true, true, 1},      {"unsigned_short", true, false, 2},
    {"short", true, true, 2},     {"unsigned_int", true, false, 4},
    {"int", true, true, 4},       {"unsigned_long", true, false, 8},
    {"long", true, true, 8},      {"vtktypeint64", true, true, 8},
    {"vtkidtype", true, true, 4}, {"vtkIdType", true, true, 4},
    {"float", false, true, 4},    {"double", false, true, 8}};
constexpr VtkNumber kVtkInt = {"int", true, true, 4};  // of cells where no type is said

class VtkReader {
 public:
  explicit VtkReader(const text::Source& source)
      : source_(source), fields_({}), bytes_(source, fields_) {
    bytes_.set_big_endian(true);
    grid_.file = source.file();
  }

  VtkGrid read() {
    read_header();
    for (auto word = fields_.next(); !word.empty(); word = fields_.next()) read_section(word);
    grid_.points.name = "POINTS";
    if (!has_points_) fail(ErrorCode::truncated, "no POINTS", source_.end());
    if (!has_cells_) fail(ErrorCode::truncated, "no CELLS", source_.end());
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
    binary_ = format == "BINARY";
    if (!binary_ && format != "ASCII") {
      fail(ErrorCode::bad_header, "expected ASCII or BINARY", format);
    }
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
    if (count < 0) fail(ErrorCode::bad_header, "a count of " + text::quoted(field), field);
    return static_cast<std::size_t>(count);
  }
  VtkNumber take_type() {
    const std::string_view type = take("a type of numbers");
    for (const VtkNumber& known : kVtkNumbers) {
      if (type == known.name && (!binary_ || known.bytes > 0)) return known;
    }
    fail(ErrorCode::unsupported, "numbers of the type " + text::quoted(type), type);
  }
  // Numbers follow.
  void begin_numbers() {
    if (binary_) bytes_.begin();
  }
  void read_numbers(VtkArray& array, std::size_t count, const VtkNumber& type) {
    if (binary_) bytes_.require(count, type.bytes);
    for (std::size_t i = 0; i < count; ++i) {
      if (array.is_integral) {
        array.integers.push_back(take_integer(type));
      } else {
        array.reals.push_back(take_real(type));
      }
    }
  }
  std::int64_t take_integer(const VtkNumber& type) {
    if (!binary_) return source_.integer(take("all of its numbers"));
    return type.is_signed ? bytes_.integer(type.bytes) : bytes_.natural(type.bytes);
  }
  // Where reals are asked for, a file may have integers.
  double take_real(const VtkNumber& type) {
    if (!binary_) return source_.finite(take("all of its numbers"));
    return type.is_integral ? static_cast<double>(take_integer(type)) : bytes_.real(type.bytes);
  }

  void read_points(std::string_view word) {
    has_points_ = true;
    const std::size_t count = take_count("the number of points");
    const VtkNumber type = take_type();
    grid_.points = VtkArray{"POINTS", 3, false, {}, {}, source_.place(word)};
    begin_numbers();
    for (std::size_t i = 0; i < count; ++i) read_numbers(grid_.points, 3, type);
  }

  void read_cells(std::string_view word) {
    has_cells_ = true;
    grid_.connectivity = integers("connectivity", word);
    grid_.offsets = integers("offsets", word);
    const std::size_t first = take_count("the number of cells");
    const std::size_t second = take_count("the size of cells");
    text::Fields ahead = fields_;
    if (ahead.next() == "OFFSETS") return read_offsets(first, second);
    std::size_t left = second;
    begin_numbers();
    for (std::size_t i = 0; i < first; ++i) {
      const std::size_t corners = binary_ ? take_corners() : take_count("all cells");
      if (left < corners + 1 || corners > left) {
        fail(ErrorCode::wrong_count, "cells have more numbers than CELLS says", word);
      }
      left -= corners + 1;
      read_numbers(grid_.connectivity, corners, kVtkInt);
      grid_.offsets.integers.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
    }
    if (left > 0) fail(ErrorCode::wrong_count, "cells have fewer numbers than CELLS says", word);
  }

  std::size_t take_corners() {
    const std::int64_t corners = bytes_.integer(kVtkInt.bytes);
    if (corners >= 0) return static_cast<std::size_t>(corners);
    throw bytes_.error(ErrorCode::bad_header, "a count of " + std::to_string(corners));
  }

  // Version 5: offsets begin with 0.
  void read_offsets(std::size_t offsets, std::size_t size) {
    const std::string_view word = take("OFFSETS");
    read_integers(grid_.offsets, offsets, word);
    if (offsets == 0 || grid_.offsets.integers.front() != 0) {
      fail(ErrorCode::bad_mesh, "the first offset is not 0", word);
    }
    grid_.offsets.integers.erase(grid_.offsets.integers.begin());
    expect("CONNECTIVITY");
    read_integers(grid_.connectivity, size, word);
  }
  void read_integers(VtkArray& array, std::size_t count, std::string_view word) {
    const VtkNumber type = take_type();
    if (!type.is_integral) fail(ErrorCode::bad_mesh, "cells of numbers that are no integers", word);
    begin_numbers();
    read_numbers(array, count, type);
  }

  void read_types(std::string_view word) {
    grid_.types = integers("types", word);
    const std::size_t count = take_count("the number of types");
    begin_numbers();
    read_numbers(grid_.types, count, kVtkInt);
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
    bool is_used = true;
    for (std::size_t i = 0; i < arrays; ++i) {
      VtkArray array;
      const std::string_view at = take("a name");
      array.name = at;
      array.place = source_.place(at);
      array.components = take_count("the number of components");
      const std::size_t count = take_count("the number of values");
      const VtkNumber type = take_type();
      array.is_integral = type.is_integral;
      if (array.components == 0 || (data_ != nullptr && count != items_)) {
        fail(ErrorCode::wrong_count,
             "an array of " + std::to_string(array.components) + " x " + std::to_string(count), at);
      }
      begin_numbers();
      for (std::size_t k = 0; k < count; ++k) read_numbers(array, array.components, type);
      if (data_ != nullptr) {
        data_->push_back(std::move(array));
      } else if (array.name == "dimension") {
        grid_.is_in_space = array.is_integral && array.integers == std::vector<std::int64_t>{3};
      } else {
        is_used = false;
      }
    }
    if (!is_used) grid_.notes.add("fields of the file are not used", source_.place(name));
  }

  void read_scalars() {
    VtkArray array;
    const std::string_view at = take("a name");
    array.name = at;
    array.place = source_.place(at);
    const VtkNumber type = take_type();
    array.is_integral = type.is_integral;
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
    begin_numbers();
    for (std::size_t i = 0; i < items_; ++i) read_numbers(array, array.components, type);
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
  BinaryCursor bytes_;
  bool binary_ = false;
  VtkGrid grid_;
  bool has_points_ = false, has_cells_ = false;
  std::vector<VtkArray>* data_ = nullptr;  // where arrays go
  std::size_t items_ = 0;                  // how many values they have
};

}  // namespace

VtkGrid read_vtk(const std::string& path) {
  const text::Source source(path);
  return VtkReader(source).read();
}

}  // namespace mesher
