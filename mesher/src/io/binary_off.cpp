// Finds out which binary form a `.off` file has, and reads it.
#include "io/binary_off.hpp"

#include <bit>
#include <cstdint>
#include <utility>

#include "io/read_mesh.hpp"
#include "io/vtu_data.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

constexpr std::string_view kBinaryOff = "OFF BINARY";
constexpr std::size_t kWordOfOff = 4;

struct OffForm {
  bool big_endian, has_colours;
};
// In the order in which they are tried.
constexpr OffForm kOffForms[] = {{true, true}, {false, true}, {true, false}, {false, false}};

// The words behind the first line.
class OffWords {
 public:
  OffWords(const std::string& path, std::string_view content)
      : path_(path), content_(content), begin_(content.find('\n') + 1) {}

  [[nodiscard]] std::size_t count() const { return (content_.size() - begin_) / kWordOfOff; }
  [[nodiscard]] bool is_whole() const { return (content_.size() - begin_) % kWordOfOff == 0; }
  [[nodiscard]] std::uint32_t natural(std::size_t i, bool big_endian) const {
    return static_cast<std::uint32_t>(
        read_bits(content_.data() + begin_ + i * kWordOfOff, kWordOfOff, big_endian));
  }
  [[nodiscard]] double real(std::size_t i, bool big_endian) const {
    const double value = std::bit_cast<float>(natural(i, big_endian));
    if (value - value == 0) return value;
    throw error(ErrorCode::not_finite, i, "a coordinate is not finite");
  }
  [[nodiscard]] Error error(ErrorCode code, std::size_t i, const std::string& what) const {
    return {code, what + ", at byte " + std::to_string(begin_ + i * kWordOfOff), {path_}};
  }

 private:
  const std::string& path_;
  std::string_view content_;
  std::size_t begin_;
};

// Calls visit(face's first word) for each face, which is the number of its corners. Returns whether
// the file ends where the last face does.
template <class Visit>
bool for_each_face_of_off(const OffWords& words, OffForm form, Visit&& visit) {
  if (words.count() < 3) return false;
  const std::size_t vertices = words.natural(0, form.big_endian);
  const std::size_t faces = words.natural(1, form.big_endian);
  std::size_t at = 3 + 3 * vertices;
  const auto pass = [&] {
    if (at >= words.count()) return false;
    at += 1 + std::size_t{words.natural(at, form.big_endian)};
    return at <= words.count();
  };
  for (std::size_t i = 0; i < faces; ++i) {
    const std::size_t first = at;
    if (!pass() || (form.has_colours && !pass())) return false;
    visit(first);
  }
  return at == words.count();
}

OffForm form_of_off(const OffWords& words) {
  for (const OffForm form : kOffForms) {
    if (words.is_whole() && for_each_face_of_off(words, form, [](std::size_t) {})) return form;
  }
  throw words.error(ErrorCode::truncated, words.count(),
                    "a binary .off file whose length is not that of its vertices and faces");
}

}  // namespace

bool is_binary_off(std::string_view content) noexcept {
  if (!content.starts_with(kBinaryOff)) return false;
  const std::string_view rest = content.substr(kBinaryOff.size());
  return rest.starts_with("\n") || rest.starts_with("\r\n");
}

Surface read_binary_off(const std::string& path, std::string_view content) {
  const OffWords words(path, content);
  const OffForm form = form_of_off(words);
  Surface out{{path, {}, {}, {}}, {}};
  const std::size_t vertices = words.natural(0, form.big_endian);
  for (std::size_t i = 0; i < vertices; ++i) {
    Point<3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = words.real(3 + 3 * i + k, form.big_endian);
    add_vertex(out.rows, p, {path});
  }
  for_each_face_of_off(words, form, [&](std::size_t first) {
    Surface::Face& face = out.faces.emplace_back();
    for (std::size_t k = 1; k <= words.natural(first, form.big_endian); ++k) {
      const std::uint32_t corner = words.natural(first + k, form.big_endian);
      if (corner >= vertices) {
        throw words.error(
            ErrorCode::bad_mesh, first + k,
            "a face has vertex " + std::to_string(corner) + ", of " + std::to_string(vertices));
      }
      face.corners.push_back(corner);
    }
  });
  return out;
}

}  // namespace mesher
