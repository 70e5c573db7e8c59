// Reads scripts of edits line by line.
#include "mesher/extra/edit_script.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <sstream>

#include "mesher/read.hpp"
#include "mesher/sizes.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

struct Form {
  std::string_view word;
  EditKind kind;
  std::size_t fields;
  std::string_view usage;
  std::size_t most = fields;
};

template <int D>
constexpr std::string_view kLimitUsage =
    D == 2 ? "limit area A|size H|sizes FILE|none [in XMIN YMIN XMAX YMAX]"
           : "limit volume V|size H|sizes FILE|none [in XMIN YMIN ZMIN XMAX YMAX ZMAX]";

constexpr std::string_view kPolygonUsage =
    "+polygon ID P P P... [/ P P P...]... [on P...] [along A B [A B]...] [marker M]";

constexpr Form kPlaneForms[] = {
    {"+point", EditKind::insert, 4, "+point ID x y [marker M]"},
    {"-point", EditKind::remove, 2, "-point ID"},
    {"move", EditKind::move, 4, "move ID x y"},
    {"+segment", EditKind::insert_segment, 4, "+segment ID A B [marker M]"},
    {"-segment", EditKind::remove_segment, 2, "-segment ID"},
    {"+polyline", EditKind::insert_polyline, 4, "+polyline ID P P... [marker M]", SIZE_MAX},
    {"-polyline", EditKind::remove_polyline, 2, "-polyline ID"},
    {"+hole", EditKind::insert_hole, 4, "+hole ID x y"},
    {"-hole", EditKind::remove_hole, 2, "-hole ID"},
    {"+region", EditKind::insert_region, 5, "+region ID x y ATTRIBUTE [MAX_AREA]", 6},
    {"-region", EditKind::remove_region, 2, "-region ID"},
    {"limit", EditKind::limit, 2, kLimitUsage<2>, 8},
};

constexpr Form kSpaceForms[] = {
    {"+point", EditKind::insert, 5, "+point ID x y z [marker M]"},
    {"-point", EditKind::remove, 2, "-point ID"},
    {"move", EditKind::move, 5, "move ID x y z"},
    {"+segment", EditKind::insert_segment, 4, "+segment ID A B [marker M]"},
    {"-segment", EditKind::remove_segment, 2, "-segment ID"},
    {"+polyline", EditKind::insert_polyline, 4, "+polyline ID P P... [marker M]", SIZE_MAX},
    {"-polyline", EditKind::remove_polyline, 2, "-polyline ID"},
    {"+polygon", EditKind::insert_polygon, 5, kPolygonUsage, SIZE_MAX},
    {"-polygon", EditKind::remove_polygon, 2, "-polygon ID"},
    {"limit", EditKind::limit, 2, kLimitUsage<3>, 10},
    {"+hole", EditKind::insert_hole, 5, "+hole ID x y z"},
    {"-hole", EditKind::remove_hole, 2, "-hole ID"},
    {"+region", EditKind::insert_region, 6, "+region ID x y z ATTRIBUTE [MAX_VOLUME]", 7},
    {"-region", EditKind::remove_region, 2, "-region ID"},
};

const Form* find_form(std::span<const Form> forms, std::string_view word) {
  for (const Form& form : forms) {
    if (form.word == word) return &form;
  }
  return nullptr;
}

std::string words_of(std::span<const Form> forms) {
  std::string words;
  for (const Form& form : forms) words += std::string(form.word) + ", ";
  return words + "begin and commit";
}

template <int D>
const Form& form_of(const text::Line& line) {
  constexpr std::span<const Form> kForms =
      D == 2 ? std::span<const Form>(kPlaneForms) : std::span<const Form>(kSpaceForms);
  if (const Form* const form = find_form(kForms, line[0])) return *form;
  const bool elsewhere =
      find_form(kPlaneForms, line[0]) != nullptr || find_form(kSpaceForms, line[0]) != nullptr;
  constexpr std::string_view kThere =
      D == 2 ? " is an edit in space; in the plane" : " is an edit in the plane; in space";
  throw line.error(ErrorCode::bad_edit,
                   (elsewhere ? text::quoted(line[0]) + std::string(kThere)
                              : "no edit is called " + text::quoted(line[0]) + ";") +
                       " there are " + words_of(kForms),
                   0);
}

bool takes_place(EditKind kind) {
  return kind == EditKind::insert || kind == EditKind::move || kind == EditKind::insert_hole ||
         kind == EditKind::insert_region;
}
bool inserts(EditKind kind) {
  return kind == EditKind::insert || kind == EditKind::insert_segment ||
         kind == EditKind::insert_polyline || kind == EditKind::insert_polygon;
}

// When edits of a batch are announced, by rank: 0 of lines and polygons that go, 1 of points that
// are there, 2 of points that come, 3 of lines and polygons that come, 4 of seeds and limits.
template <int D>
std::vector<int> ranks(const std::vector<Edit<D>>& edits) {
  std::map<std::int64_t, bool> points;  // whether they come: by the first edit of each
  std::map<Feature, bool> others;       // whether they have come so far
  std::vector<int> all;
  for (const auto& edit : edits) {
    const FeatureKind of = feature_kind(edit.kind);
    if (of == FeatureKind::line || of == FeatureKind::polygon) {
      bool& came = others[edit.feature()];
      came = came || inserts(edit.kind);
      all.push_back(came ? 3 : 0);
    } else if (of != FeatureKind::point) {
      all.push_back(4);
    } else {
      all.push_back(points.emplace(edit.number, inserts(edit.kind)).first->second ? 2 : 1);
    }
  }
  return all;
}

// Whether the line ends with 'marker M', as edits of what has markers may.
bool has_marker(const text::Line& line, const Form& form) {
  return inserts(form.kind) && line.size() >= form.fields + 2 && line[line.size() - 2] == "marker";
}

void require_fields(const text::Line& line, std::size_t size, const Form& form) {
  if (size >= form.fields && size <= form.most) return;
  throw line.error(
      ErrorCode::bad_edit,
      std::to_string(line.size()) + " fields, expected '" + std::string(form.usage) + "'",
      std::min(line.size(), form.most));
}

// The limit of a region, where it is given: as in a .poly file, none if it is not above 0.
std::optional<double> max_measure_of(const text::Line& line, std::size_t field) {
  if (line.size() <= field) return std::nullopt;
  const double area = line.finite(field);
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
template <int D>
std::shared_ptr<const SizeField<D>> background_of(const text::Line& line) {
  const FileLocation place = line.place(2);
  const auto path = std::filesystem::path(place.file).parent_path() / std::string(line[2]);
  try {
    return sampled_sizes<D>(read_sizes<D>(path.string()).samples);
  } catch (const Error& error) {
    throw Error(
        error.code(),
        error.message() + " (named by " + place.file + ":" + std::to_string(place.line) + ")",
        error.location(), error.features(), error.places());
  }
}

template <int D>
SizeLimits<D> limits_of(const text::Line& line) {
  const std::string_view kind = line[1];
  if (kind == "none") return {};
  if (kind == "area" || kind == "volume") return {.max_measure = positive(line, 2)};
  if (kind == "size") return {.max_measure = measure_of_size<D>(positive(line, 2))};
  return {.sizes = background_of<D>(line)};
}

template <int D>
Point<D> place_of(const text::Line& line, std::size_t first) {
  Point<D> place;
  for (std::size_t i = 0; i < D; ++i) place[i] = line.coordinate(first + i);
  return place;
}

template <int D>
Box<D> limit_box(const text::Line& line, std::size_t first) {
  const Box<D> box{place_of<D>(line, first), place_of<D>(line, first + D)};
  for (std::size_t i = 0; i < D; ++i) {
    if (box.lo[i] <= box.hi[i]) continue;
    throw line.error(ErrorCode::bad_edit,
                     D == 2 ? "the first corner of a box must be below and left"
                            : "the first corner of a box must be below, left and before",
                     first);
  }
  return box;
}

// The fields from `i` up to the next that is a word of +polygon; `i` is that one's then.
std::vector<PointId> points_from(const text::Line& line, std::size_t size, std::size_t& i) {
  std::vector<PointId> points;
  for (; i < size && line[i] != "/" && line[i] != "on" && line[i] != "along"; ++i) {
    points.push_back(PointId{line.integer(i)});
  }
  return points;
}

// Of its first `size` fields.
Polygon parse_polygon(const text::Line& line, std::size_t size) {
  Polygon polygon{.id = PolygonId{line.integer(1)}, .loops = {}};
  std::size_t i = 2;
  polygon.loops.push_back(points_from(line, size, i));
  while (i < size) {
    const std::size_t word = i++;
    const std::vector<PointId> points = points_from(line, size, i);
    if (line[word] == "/") {
      polygon.loops.push_back(points);
    } else if (line[word] == "on") {
      polygon.points.insert(polygon.points.end(), points.begin(), points.end());
    } else if (points.size() % 2 == 0) {
      for (std::size_t k = 0; k < points.size(); k += 2) {
        polygon.edges.push_back({points[k], points[k + 1]});
      }
    } else {
      throw line.error(ErrorCode::bad_edit, "'along' takes two points for each edge", word);
    }
  }
  return polygon;
}

template <int D>
bool is_limit(std::string_view kind) {
  if (kind == "size" || kind == "sizes" || kind == "none") return true;
  return kind == (D == 2 ? "area" : "volume");
}

template <int D>
void parse_limit(const text::Line& line, Edit<D>& edit) {
  const auto refuse = [&](std::size_t i) {
    throw line.error(ErrorCode::bad_edit, "expected '" + std::string(kLimitUsage<D>) + "'", i);
  };
  if (!is_limit<D>(line[1])) refuse(1);
  const std::size_t said = limit_fields(line), with_box = said + 1 + 2 * D;
  if (line.size() != said && line.size() != with_box) refuse(std::min(line.size(), with_box));
  if (line.size() > said && line[said] != "in") refuse(said);
  edit.limits = limits_of<D>(line);
  if (line.size() > said) edit.box = limit_box<D>(line, said + 1);
}

template <int D>
Edit<D> parse(const text::Line& line) {
  const Form& form = form_of<D>(line);
  const bool marked = has_marker(line, form);
  const std::size_t size = line.size() - (marked ? 2 : 0);
  require_fields(line, size, form);
  Edit<D> edit;
  edit.kind = form.kind;
  edit.text = line.trimmed();
  edit.location = line.place(0);
  if (marked) edit.marker = line.integer(line.size() - 1);
  if (form.kind == EditKind::limit) return parse_limit<D>(line, edit), edit;
  edit.number = line.integer(1);
  if (takes_place(form.kind)) {
    edit.point = place_of<D>(line, 2);
    if (form.kind == EditKind::insert_region) {
      edit.attribute = line.finite(2 + D);
      edit.max_measure = max_measure_of(line, 3 + D);
    }
  } else if (form.kind == EditKind::insert_polygon) {
    edit.polygon = parse_polygon(line, size);
    edit.polygon.marker = edit.marker;
  } else {
    for (std::size_t i = 2; i < size; ++i) {
      edit.points.push_back(PointId{line.integer(i)});
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

FeatureKind feature_kind(EditKind kind) {
  switch (kind) {
    case EditKind::insert:
    case EditKind::remove:
    case EditKind::move:
      return FeatureKind::point;
    case EditKind::insert_hole:
    case EditKind::remove_hole:
      return FeatureKind::hole;
    case EditKind::insert_region:
    case EditKind::remove_region:
      return FeatureKind::region;
    case EditKind::insert_polygon:
    case EditKind::remove_polygon:
      return FeatureKind::polygon;
    case EditKind::limit:
      return FeatureKind::none;
    default:
      return FeatureKind::line;
  }
}

template <int D>
Feature Edit<D>::feature() const {
  const FeatureKind of = feature_kind(kind);
  return of == FeatureKind::none ? Feature() : Feature(of, number);
}

template <int D>
EditScript<D>::EditScript(std::unique_ptr<std::istream> stream, std::string path)
    : path_(std::move(path)), stream_(std::move(stream)) {}

template <int D>
EditScript<D>::EditScript(const std::string& path) : path_(path) {
  auto file = std::make_unique<std::ifstream>();
  std::error_code error;
  errno = std::filesystem::is_directory(path, error) ? EISDIR : 0;
  if (errno == 0) file->open(path, std::ios::binary);
  if (!file->is_open()) {
    throw Error(ErrorCode::cannot_read, std::string("cannot be read: ") + std::strerror(errno),
                {path});
  }
  stream_ = std::move(file);
}

template <int D>
EditScript<D> EditScript<D>::of_text(std::string text, std::string path) {
  return {std::make_unique<std::istringstream>(std::move(text)), std::move(path)};
}

// Goes to the next line that holds anything.
template <int D>
bool EditScript<D>::read_line() {
  while (std::getline(*stream_, text_)) {
    if (++number_ == 1) text_ = without_mark(text_);
    if (!text_.empty() && text_.back() == '\r') text_.pop_back();
    if (split(path_, number_, text_).size() > 0) return true;
  }
  if (stream_->bad()) throw Error(ErrorCode::cannot_read, "cannot be read further", here());
  return false;
}

template <int D>
std::optional<std::vector<Edit<D>>> EditScript<D>::next() {
  if (!read_line()) return std::nullopt;
  const text::Line line = split(path_, number_, text_);
  if (is_word(line, "commit")) {
    throw line.error(ErrorCode::unbalanced_commit, "commit without begin", 0);
  }
  if (is_word(line, "begin")) return read_block();
  return std::vector<Edit<D>>{parse<D>(line)};
}

template <int D>
std::vector<Edit<D>> EditScript<D>::read_block() {
  const FileLocation begin = split(path_, number_, text_).place(0);
  std::vector<Edit<D>> edits;
  while (read_line()) {
    const text::Line line = split(path_, number_, text_);
    if (is_word(line, "commit")) return edits;
    if (is_word(line, "begin")) {
      throw line.error(ErrorCode::unbalanced_commit,
                       "begin within the block begun on line " + std::to_string(begin.line), 0);
    }
    edits.push_back(parse<D>(line));
  }
  throw Error(ErrorCode::unbalanced_commit, "begin without commit", begin);
}

template <int D>
std::vector<Edit<D>> announcing_order(std::vector<Edit<D>> edits) {
  const std::vector<int> rank = ranks(edits);
  std::vector<Edit<D>> ordered;
  ordered.reserve(edits.size());
  for (int r = 0; r < 5; ++r) {
    for (std::size_t i = 0; i < edits.size(); ++i) {
      if (rank[i] == r) ordered.push_back(std::move(edits[i]));
    }
  }
  return ordered;
}

template <int D>
FileLocation location_to_blame(const std::vector<Edit<D>>& edits, const Error& error) {
  for (const Feature& feature : error.features()) {
    const auto is_of = [&](const Edit<D>& edit) {
      return edit.kind != EditKind::limit && edit.feature() == feature;
    };
    const auto last = std::find_if(edits.rbegin(), edits.rend(), is_of);
    if (last != edits.rend()) return last->location;
  }
  return edits.back().location;
}

template <int D>
std::string text_of(const std::vector<Edit<D>>& edits) {
  std::string all;
  for (const auto& edit : edits) all += (all.empty() ? "" : "; ") + edit.text;
  return all;
}

double now() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since_start).count();
}

template Feature Edit<2>::feature() const;
template class EditScript<2>;
template std::string text_of(const std::vector<Edit<2>>&);
template std::vector<Edit<2>> announcing_order(std::vector<Edit<2>>);
template FileLocation location_to_blame(const std::vector<Edit<2>>&, const Error&);
#ifndef MESHER_PLANE_ONLY
template Feature Edit<3>::feature() const;
template class EditScript<3>;
template std::string text_of(const std::vector<Edit<3>>&);
template std::vector<Edit<3>> announcing_order(std::vector<Edit<3>>);
template FileLocation location_to_blame(const std::vector<Edit<3>>&, const Error&);
#endif

}  // namespace mesher
