// Reads scripts of edits line by line.
#include "mesher/edit_script.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>

#include "io/text.hpp"
#include "mesher/sizes.hpp"

namespace mesher {
namespace {

struct Form {
  std::string_view word;
  Edit::Kind kind;
  std::size_t fields;
  std::string_view usage;
  std::size_t most = fields;
};

constexpr std::string_view kLimitUsage =
    "limit area A|size H|sizes FILE|none [in XMIN YMIN XMAX YMAX]";

constexpr Form kForms[] = {
    {"+point", Edit::Kind::insert, 4, "+point ID x y [marker M]"},
    {"-point", Edit::Kind::remove, 2, "-point ID"},
    {"move", Edit::Kind::move, 4, "move ID x y"},
    {"+segment", Edit::Kind::insert_segment, 4, "+segment ID A B [marker M]"},
    {"-segment", Edit::Kind::remove_segment, 2, "-segment ID"},
    {"+polyline", Edit::Kind::insert_polyline, 4, "+polyline ID P P... [marker M]", SIZE_MAX},
    {"-polyline", Edit::Kind::remove_polyline, 2, "-polyline ID"},
    {"+hole", Edit::Kind::insert_hole, 4, "+hole ID x y"},
    {"-hole", Edit::Kind::remove_hole, 2, "-hole ID"},
    {"+region", Edit::Kind::insert_region, 5, "+region ID x y ATTRIBUTE [MAX_AREA]", 6},
    {"-region", Edit::Kind::remove_region, 2, "-region ID"},
    {"limit", Edit::Kind::limit, 2, kLimitUsage, 8},
};

const Form& form_of(const text::Line& line) {
  for (const Form& form : kForms) {
    if (line[0] == form.word) return form;
  }
  throw line.error(ErrorCode::bad_edit,
                   "no edit is called " + text::quoted(line[0]) +
                       "; there are +point, -point, move, +segment, -segment, +polyline, "
                       "-polyline, +hole, -hole, +region, -region, limit, begin and commit",
                   0);
}

bool takes_place(Edit::Kind kind) {
  return kind == Edit::Kind::insert || kind == Edit::Kind::move ||
         kind == Edit::Kind::insert_hole || kind == Edit::Kind::insert_region;
}
bool is_of_line(const Edit& edit) { return featured(edit.kind) == Featured::line; }
bool inserts(const Edit& edit) {
  return edit.kind == Edit::Kind::insert || edit.kind == Edit::Kind::insert_segment ||
         edit.kind == Edit::Kind::insert_polyline;
}

// When edits of a batch are announced, by rank: 0 of lines that go, 1 of points that are there, 2
// of points that come, 3 of lines that come, 4 of seeds and limits.
std::vector<int> ranks(const std::vector<Edit>& edits) {
  std::map<FeatureId, bool> points;  // whether they come: by the first edit of each
  std::map<FeatureId, bool> lines;   // whether they have come so far
  std::vector<int> all;
  for (const Edit& edit : edits) {
    if (is_of_line(edit)) {
      bool& came = lines[edit.id];
      came = came || inserts(edit);
      all.push_back(came ? 3 : 0);
    } else if (featured(edit.kind) != Featured::point) {
      all.push_back(4);
    } else {
      all.push_back(points.emplace(edit.id, inserts(edit)).first->second ? 2 : 1);
    }
  }
  return all;
}

// Whether the line ends with 'marker M', as edits of what has markers may.
bool has_marker(const text::Line& line, const Form& form) {
  const auto k = form.kind;
  const bool may = k == Edit::Kind::insert || k == Edit::Kind::insert_segment ||
                   k == Edit::Kind::insert_polyline;
  return may && line.size() >= form.fields + 2 && line[line.size() - 2] == "marker";
}

void require_fields(const text::Line& line, std::size_t size, const Form& form) {
  if (size >= form.fields && size <= form.most) return;
  throw line.error(
      ErrorCode::bad_edit,
      std::to_string(line.size()) + " fields, expected '" + std::string(form.usage) + "'",
      std::min(line.size(), form.most));
}

// The limit of a region, where it is given: as in a .poly file, none if it is not above 0.
std::optional<double> max_area_of(const text::Line& line) {
  if (line.size() < 6) return std::nullopt;
  const double area = line.finite(5);
  return area > 0 ? std::optional(area) : std::nullopt;
}

double positive(const text::Line& line, std::size_t i) {
  const double x = line.finite(i);
  if (x > 0) return x;
  throw line.error(ErrorCode::bad_number, text::quoted(line[i]) + ": must be above 0", i);
}

// How many fields say what the limit is, 'limit' included.
std::size_t limit_fields(const text::Line& line) { return line[1] == "none" ? 2 : 3; }

// The background in the file that field 2 names; an error is said of that file, and of the line.
std::shared_ptr<const SizeField<2>> background_of(const text::Line& line) {
  const Place place = line.place(2);
  const auto path = std::filesystem::path(place.file).parent_path() / std::string(line[2]);
  try {
    return sampled_sizes(read_sizes(path.string()).samples);
  } catch (const Error& error) {
    throw Error(
        error.code(),
        error.message() + " (named by " + place.file + ":" + std::to_string(place.line) + ")",
        error.place(), error.ids());
  }
}

SizeLimits<2> limits_of(const text::Line& line) {
  const std::string_view kind = line[1];
  if (kind == "none") return {};
  if (kind == "area") return {.max_area = positive(line, 2)};
  if (kind == "size") {
    const double h = positive(line, 2);
    return {.max_area = kAreaOfSize * h * h};
  }
  return {.sizes = background_of(line)};
}

Box<2> limit_box(const text::Line& line, std::size_t first) {
  const Box<2> box{{line.coordinate(first), line.coordinate(first + 1)},
                   {line.coordinate(first + 2), line.coordinate(first + 3)}};
  if (box.lo[0] <= box.hi[0] && box.lo[1] <= box.hi[1]) return box;
  throw line.error(ErrorCode::bad_edit, "the first corner of a box must be below and left", first);
}

void parse_limit(const text::Line& line, Edit& edit) {
  constexpr std::array<std::string_view, 4> kKinds{"area", "size", "sizes", "none"};
  const auto refuse = [&](std::size_t i) {
    throw line.error(ErrorCode::bad_edit, "expected '" + std::string(kLimitUsage) + "'", i);
  };
  if (std::find(kKinds.begin(), kKinds.end(), line[1]) == kKinds.end()) refuse(1);
  const std::size_t said = limit_fields(line);
  if (line.size() != said && line.size() != said + 5) refuse(std::min(line.size(), said + 5));
  if (line.size() > said && line[said] != "in") refuse(said);
  edit.limits = limits_of(line);
  if (line.size() > said) edit.box = limit_box(line, said + 1);
}

Edit parse(const text::Line& line) {
  const Form& form = form_of(line);
  const bool marked = has_marker(line, form);
  const std::size_t size = line.size() - (marked ? 2 : 0);
  require_fields(line, size, form);
  Edit edit;
  edit.kind = form.kind;
  edit.text = line.trimmed();
  edit.place = line.place(0);
  if (marked) edit.marker = line.integer(line.size() - 1);
  if (form.kind == Edit::Kind::limit) return parse_limit(line, edit), edit;
  edit.id = FeatureId{line.integer(1)};
  if (takes_place(form.kind)) {
    edit.point = {line.coordinate(2), line.coordinate(3)};
    if (form.kind == Edit::Kind::insert_region) {
      edit.attribute = line.finite(4);
      edit.max_area = max_area_of(line);
    }
  } else {
    for (std::size_t i = 2; i < size; ++i) {
      edit.points.push_back(FeatureId{line.integer(i)});
    }
  }
  return edit;
}

text::Line split(const std::string& path, long number, std::string_view text) {
  text::Line line(path);
  line.split_blanks(number, text);
  return line;
}

// The first line of a file, which may begin with a byte order mark: Lines passes over it.
std::string without_mark(const std::string& first) {
  text::Lines lines(first);
  return lines.next() ? std::string(lines.text()) : std::string();
}

bool is_word(const text::Line& line, std::string_view word) {
  if (line[0] != word) return false;
  if (line.size() == 1) return true;
  throw line.error(ErrorCode::bad_edit, text::quoted(word) + " stands alone on its line", 1);
}

}  // namespace

Featured featured(Edit::Kind kind) {
  switch (kind) {
    case Edit::Kind::insert:
    case Edit::Kind::remove:
    case Edit::Kind::move:
      return Featured::point;
    case Edit::Kind::insert_hole:
    case Edit::Kind::remove_hole:
      return Featured::hole;
    case Edit::Kind::insert_region:
    case Edit::Kind::remove_region:
      return Featured::region;
    case Edit::Kind::limit:
      return Featured::nothing;
    default:
      return Featured::line;
  }
}

EditScript::EditScript(const std::string& path) : path_(path) {
  std::error_code error;
  errno = std::filesystem::is_directory(path, error) ? EISDIR : 0;
  if (errno == 0) stream_.open(path, std::ios::binary);
  if (stream_.is_open()) return;
  throw Error(ErrorCode::cannot_read, std::string("cannot be read: ") + std::strerror(errno),
              {path});
}

// Goes to the next line that holds anything.
bool EditScript::read_line() {
  while (std::getline(stream_, text_)) {
    if (++number_ == 1) text_ = without_mark(text_);
    if (!text_.empty() && text_.back() == '\r') text_.pop_back();
    if (split(path_, number_, text_).size() > 0) return true;
  }
  if (stream_.bad()) throw Error(ErrorCode::cannot_read, "cannot be read further", here());
  return false;
}

std::optional<std::vector<Edit>> EditScript::next() {
  if (!read_line()) return std::nullopt;
  const text::Line line = split(path_, number_, text_);
  if (is_word(line, "commit")) {
    throw line.error(ErrorCode::unbalanced_commit, "commit without begin", 0);
  }
  if (is_word(line, "begin")) return read_block();
  return std::vector<Edit>{parse(line)};
}

std::vector<Edit> EditScript::read_block() {
  const Place begin = split(path_, number_, text_).place(0);
  std::vector<Edit> edits;
  while (read_line()) {
    const text::Line line = split(path_, number_, text_);
    if (is_word(line, "commit")) return edits;
    if (is_word(line, "begin")) {
      throw line.error(ErrorCode::unbalanced_commit,
                       "begin within the block begun on line " + std::to_string(begin.line), 0);
    }
    edits.push_back(parse(line));
  }
  throw Error(ErrorCode::unbalanced_commit, "begin without commit", begin);
}

std::vector<Edit> announcing_order(std::vector<Edit> edits) {
  const std::vector<int> rank = ranks(edits);
  std::vector<Edit> ordered;
  ordered.reserve(edits.size());
  for (int r = 0; r < 5; ++r) {
    for (std::size_t i = 0; i < edits.size(); ++i) {
      if (rank[i] == r) ordered.push_back(std::move(edits[i]));
    }
  }
  return ordered;
}

// A line may have the id of a point: where the error is one of lines, theirs are meant. Seeds are
// never to blame, limits only where no feature is.
Place place_to_blame(const std::vector<Edit>& edits, const Error& error) {
  const bool of_lines = error.code() == ErrorCode::crossing_segments ||
                        error.code() == ErrorCode::overlapping_segments ||
                        error.code() == ErrorCode::repeated_segment;
  for (const FeatureId id : error.ids()) {
    const auto is_of = [&](const Edit& edit) {
      const Featured of = featured(edit.kind);
      return edit.id == id && (of == Featured::line || (of == Featured::point && !of_lines));
    };
    const auto last = std::find_if(edits.rbegin(), edits.rend(), is_of);
    if (last != edits.rend()) return last->place;
  }
  return edits.back().place;
}

std::string text_of(const std::vector<Edit>& edits) {
  std::string all;
  for (const Edit& edit : edits) all += (all.empty() ? "" : "; ") + edit.text;
  return all;
}

double now() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since_start).count();
}

}  // namespace mesher
