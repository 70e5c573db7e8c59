// Binary .off files, in the forms that programs write.
#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "io/read_points.hpp"
#include "mesher/error.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Error;
using mesher::ErrorCode;

struct Form {
  bool big_endian, has_colours;
};

class Words {
 public:
  explicit Words(bool big_endian) : big_endian_(big_endian) {}
  void add(std::uint32_t word) {
    for (int i = 0; i < 4; ++i) {
      bytes_ += static_cast<char>(word >> (big_endian_ ? 24 - 8 * i : 8 * i) & 0xff);
    }
  }
  void add(float x) { add(std::bit_cast<std::uint32_t>(x)); }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  bool big_endian_;
  std::string bytes_;
};

// A tetrahedron; `last`: a corner of its last face.
std::string tetrahedron(Form form, std::uint32_t last = 3, float x = 0.5F) {
  Words words(form.big_endian);
  for (const std::uint32_t n : {4U, 4U, 0U}) words.add(n);
  for (const float at : {0.0F, 0.0F, 0.0F, x, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 2.0F}) {
    words.add(at);
  }
  int face = 0;
  for (const auto& corners : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 1, 3}, {0, 2, 3}}) {
    words.add(3U);
    for (const std::uint32_t v : corners) words.add(v);
    if (!form.has_colours) continue;
    words.add(face++ == 1 ? 3U : 0U);
    if (face == 2) words.add(1.0F), words.add(0.5F), words.add(0.25F);
  }
  words.add(3U), words.add(1U), words.add(2U), words.add(last);
  if (form.has_colours) words.add(0U);
  return "OFF BINARY\n" + words.bytes();
}

mesher::Surface read(const std::string& content) {
  const support::ScratchFolder folder;
  return mesher::read_off_surface(folder.write("binary.off", content));
}

ErrorCode refusal_of(const std::string& content) {
  const Error error = support::error_of([&] { static_cast<void>(read(content)); });
  CHECK(error.message().find(" byte ") != std::string::npos);
  return error.code();
}

}  // namespace

TEST_CASE("Binary .off files are read in either order of bytes, with colours or without") {
  for (const Form form : {Form{true, true}, {true, false}, {false, true}, {false, false}}) {
    const mesher::Surface surface = read(tetrahedron(form));
    REQUIRE(surface.rows.points.size() == 4);
    CHECK(surface.rows.points[1] == mesher::Point<3>{0.5, 0, 0});
    CHECK(surface.rows.points[3] == mesher::Point<3>{0, 0, 2});
    REQUIRE(surface.faces.size() == 4);
    CHECK(surface.faces[2].corners == std::vector<std::uint32_t>{0, 2, 3});
    CHECK(surface.faces[3].corners == std::vector<std::uint32_t>{1, 2, 3});
    const support::ScratchFolder folder;
    CHECK(mesher::read_off_points(folder.write("points.off", tetrahedron(form))).points.size() ==
          4);
  }
}

TEST_CASE("Binary .off files that are damaged are refused") {
  const Form form{false, false};
  const std::string good = tetrahedron(form);
  for (std::size_t n = 11; n < good.size(); ++n) {
    CHECK(refusal_of(good.substr(0, n)) == ErrorCode::truncated);
  }
  CHECK(refusal_of(good + "....") == ErrorCode::truncated);
  CHECK(refusal_of(tetrahedron(form, 4)) == ErrorCode::bad_mesh);
  CHECK(refusal_of(tetrahedron(form, 0xffffffffU)) == ErrorCode::bad_mesh);
  CHECK(refusal_of(tetrahedron(form, 3, std::nanf(""))) == ErrorCode::not_finite);
  CHECK(refusal_of("OFF BINARY\n" + std::string(12, '\xff')) == ErrorCode::truncated);
}
