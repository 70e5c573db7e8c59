// Reads unstructured grids of `.vtu` files (VTK XML).
//
//   VTKFile type byte_order header_type
//     UnstructuredGrid / FieldData: an array "dimension", if it has no cells to tell
//     UnstructuredGrid / Piece NumberOfPoints NumberOfCells
//       PointData, CellData: DataArrays; Points: one; Cells: connectivity, offsets, types
//     AppendedData encoding: '_' and blocks
#include <bit>
#include <cmath>
#include <utility>

#include "io/vtk_grid.hpp"
#include "io/vtu_data.hpp"
#include "io/xml.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// How the bytes of a number are to be read.
struct VtuNumber {
  std::string_view name;
  std::size_t bytes;
  bool is_integral, is_signed;
};
constexpr VtuNumber kVtuNumbers[] = {{"Float64", 8, false, true}, {"Float32", 4, false, true},
                                     {"Int64", 8, true, true},    {"UInt64", 8, true, false},
                                     {"Int32", 4, true, true},    {"UInt32", 4, true, false},
                                     {"Int16", 2, true, true},    {"UInt16", 2, true, false},
                                     {"Int8", 1, true, true},     {"UInt8", 1, true, false}};

class VtuReader {
 public:
  explicit VtuReader(const text::Source& source) : source_(source), root_(read_xml(source)) {
    grid_.file = source.file();
  }

  VtkGrid read() {
    read_root();
    const XmlElement& piece = the_piece();
    read_dimension();
    read_arrays(piece.child("PointData"), grid_.point_data);
    read_arrays(piece.child("CellData"), grid_.cell_data);
    const XmlElement& points = require_child(piece, "Points");
    grid_.points = as_reals(read_array(require_child(points, "DataArray")));
    const XmlElement& cells = require_child(piece, "Cells");
    grid_.connectivity = read_integers(cells, "connectivity");
    grid_.offsets = read_integers(cells, "offsets");
    grid_.types = read_integers(cells, "types");
    require_counts(piece);
    require_consistent(grid_);
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(ErrorCode code, const std::string& what, const XmlElement& at) const {
    throw source_.error(code, what, at.name);
  }

  const XmlElement& require_child(const XmlElement& parent, std::string_view name) const {
    if (const XmlElement* const found = parent.child(name)) return *found;
    fail(ErrorCode::bad_syntax, "no element " + text::quoted(name), parent);
  }
  std::string_view value_of(const XmlElement& element, std::string_view name,
                            std::string_view otherwise) const {
    const std::string_view* const value = element.find(name);
    return value == nullptr ? otherwise : *value;
  }

  void read_root() {
    if (root_.name != "VTKFile" || value_of(root_, "type", "") != "UnstructuredGrid") {
      fail(ErrorCode::bad_header, "expected a VTKFile of the type UnstructuredGrid", root_);
    }
    const std::string_view compressor = value_of(root_, "compressor", "");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
      fail(ErrorCode::unsupported, "data of the " + text::quoted(compressor) + ": use zlib or none",
           root_);
    }
    encoding_.compressed = !compressor.empty();
    encoding_.big_endian = value_of(root_, "byte_order", "LittleEndian") == "BigEndian";
    encoding_.wide_headers = value_of(root_, "header_type", "UInt32") == "UInt64";
  }

  void read_dimension() {
    const XmlElement* const data = require_child(root_, "UnstructuredGrid").child("FieldData");
    if (data == nullptr) return;
    for (const XmlElement& child : data->children) {
      if (child.name != "DataArray" || value_of(child, "Name", "") != "dimension") continue;
      const VtkArray array = read_array(child);
      grid_.is_in_space = array.is_integral && array.integers == std::vector<std::int64_t>{3};
    }
  }

  const XmlElement& the_piece() const {
    const XmlElement& all = require_child(root_, "UnstructuredGrid");
    const XmlElement& piece = require_child(all, "Piece");
    for (const XmlElement& other : all.children) {
      if (other.name == "Piece" && &other != &piece) {
        fail(ErrorCode::unsupported, "more than one piece", other);
      }
    }
    return piece;
  }

  void require_counts(const XmlElement& piece) const {
    require_count(piece, "NumberOfPoints", grid_.point_count());
    require_count(piece, "NumberOfCells", grid_.cell_count());
  }
  void require_count(const XmlElement& piece, std::string_view name, std::size_t count) const {
    const std::string_view* const said = piece.find(name);
    if (said == nullptr) fail(ErrorCode::bad_header, "no " + std::string(name), piece);
    if (std::cmp_equal(source_.integer(*said), count)) return;
    throw source_.error(ErrorCode::wrong_count,
                        std::string(name) + " is " + text::quoted(*said) + ", but there are " +
                            std::to_string(count),
                        *said);
  }

  void read_arrays(const XmlElement* parent, std::vector<VtkArray>& into) {
    if (parent == nullptr) return;
    for (const XmlElement& child : parent->children) {
      if (child.name != "DataArray") {
        grid_.notes.add("the element " + text::quoted(child.name) + " is not used",
                        source_.place(child.name));
      } else if (value_of(child, "type", "") == "String") {
        grid_.notes.add("an array of strings is not used", source_.place(child.name));
      } else {
        into.push_back(read_array(child));
      }
    }
  }

  VtkArray read_integers(const XmlElement& cells, std::string_view name) const {
    for (const XmlElement& child : cells.children) {
      if (child.name != "DataArray" || value_of(child, "Name", "") != name) continue;
      VtkArray array = read_array(child);
      if (array.is_integral) return array;
      fail(ErrorCode::bad_number, "the array " + text::quoted(name) + " is not of integers", child);
    }
    fail(ErrorCode::bad_syntax, "no array " + text::quoted(name), cells);
  }

  VtkArray as_reals(VtkArray array) const {
    if (array.components != 3) {
      throw Error(ErrorCode::bad_dimension, "points have 3 components", array.place);
    }
    if (!array.is_integral) return array;
    array.reals.assign(array.integers.begin(), array.integers.end());
    array.integers.clear();
    array.is_integral = false;
    return array;
  }

  VtkArray read_array(const XmlElement& element) const {
    const VtuNumber& type = type_of(element);
    VtkArray array;
    array.name = value_of(element, "Name", "");
    array.is_integral = type.is_integral;
    array.place = source_.place(element.name);
    const std::string_view* const components = element.find("NumberOfComponents");
    if (components != nullptr) {
      const std::int64_t count = source_.integer(*components);
      if (count < 1 || count > 1 << 20) {
        throw source_.error(ErrorCode::bad_header, "a bad number of components", *components);
      }
      array.components = static_cast<std::size_t>(count);
    }
    const std::string_view format = value_of(element, "format", "ascii");
    if (format == "ascii") {
      read_ascii(element, array);
    } else if (format == "binary") {
      decode(read_block(source_, element.text, false, encoding_), type, element, array);
    } else if (format == "appended") {
      decode(appended_block(element), type, element, array);
    } else {
      fail(ErrorCode::unsupported, "the format " + text::quoted(format), element);
    }
    return array;
  }

  const VtuNumber& type_of(const XmlElement& element) const {
    const std::string_view name = value_of(element, "type", "");
    for (const VtuNumber& type : kVtuNumbers) {
      if (type.name == name) return type;
    }
    fail(ErrorCode::unsupported, "numbers of the type " + text::quoted(name), element);
  }

  void read_ascii(const XmlElement& element, VtkArray& array) const {
    text::Fields fields(element.text);
    for (auto field = fields.next(); !field.empty(); field = fields.next()) {
      if (array.is_integral) {
        array.integers.push_back(source_.integer(field));
      } else {
        array.reals.push_back(source_.finite(field));
      }
    }
  }

  std::string appended_block(const XmlElement& element) const {
    const std::string_view* const offset = element.find("offset");
    if (offset == nullptr) fail(ErrorCode::bad_syntax, "no offset", element);
    const XmlElement& data = require_child(root_, "AppendedData");
    const std::string_view* const encoding = data.find("encoding");
    const auto mark = data.text.find('_');
    if (encoding == nullptr || mark == std::string_view::npos) {
      fail(ErrorCode::bad_syntax, "appended data without an encoding or '_'", data);
    }
    const std::string_view blocks = data.text.substr(mark + 1);
    const std::int64_t at = source_.integer(*offset);
    if (at < 0 || std::cmp_greater(at, blocks.size())) {
      throw source_.error(ErrorCode::truncated,
                          "offset " + std::to_string(at) + " is behind the appended data", *offset);
    }
    return read_block(source_, blocks.substr(static_cast<std::size_t>(at)), *encoding == "raw",
                      encoding_);
  }

  void decode(const std::string& bytes, const VtuNumber& type, const XmlElement& element,
              VtkArray& array) const {
    if (bytes.size() % type.bytes != 0) {
      fail(ErrorCode::wrong_count,
           std::to_string(bytes.size()) + " bytes of numbers of " + std::to_string(type.bytes),
           element);
    }
    for (std::size_t i = 0; i < bytes.size(); i += type.bytes) {
      const std::uint64_t bits = read_bits(bytes.data() + i, type.bytes, encoding_.big_endian);
      if (type.is_integral) {
        array.integers.push_back(integer_of(bits, type, element));
      } else {
        array.reals.push_back(real_of(bits, type, i / type.bytes, element));
      }
    }
  }

  std::int64_t integer_of(std::uint64_t bits, const VtuNumber& type,
                          const XmlElement& element) const {
    const unsigned unused = 64 - 8 * static_cast<unsigned>(type.bytes);
    if (type.is_signed) return static_cast<std::int64_t>(bits << unused) >> unused;
    if (bits > INT64_MAX) fail(ErrorCode::bad_number, "an integer of 2^63 or more", element);
    return static_cast<std::int64_t>(bits);
  }

  double real_of(std::uint64_t bits, const VtuNumber& type, std::size_t number,
                 const XmlElement& element) const {
    const double value = type.bytes == 8 ? std::bit_cast<double>(bits)
                                         : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (std::isfinite(value)) return value;
    fail(ErrorCode::not_finite, "number " + std::to_string(number) + " is not finite", element);
  }

  const text::Source& source_;
  XmlElement root_;
  VtuEncoding encoding_;
  VtkGrid grid_;
};

}  // namespace

VtkGrid read_vtu(const std::string& path) {
  const text::Source source(path);
  return VtuReader(source).read();
}

}  // namespace mesher
