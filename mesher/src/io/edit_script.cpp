// Reads scripts of edits line by line.
#include "mesher/edit_script.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>

#include "io/text.hpp"

namespace mesher {
namespace {

struct Form {
  std::string_view word;
  Edit::Kind kind;
  std::size_t fields;
  std::string_view usage;
};

constexpr Form kForms[] = {
    {"+point", Edit::Kind::insert, 4, "+point ID x y"},
    {"-point", Edit::Kind::remove, 2, "-point ID"},
    {"move", Edit::Kind::move, 4, "move ID x y"},
};

const Form& form_of(const text::Line& line) {
  for (const Form& form : kForms) {
    if (line[0] == form.word) return form;
  }
  throw line.error(ErrorCode::bad_edit,
                   "no edit is called " + text::quoted(line[0]) +
                       "; there are +point, -point, move, begin and commit",
                   0);
}

Edit parse(const text::Line& line) {
  const Form& form = form_of(line);
  if (line.size() != form.fields) {
    throw line.error(
        ErrorCode::bad_edit,
        std::to_string(line.size()) + " fields, expected '" + std::string(form.usage) + "'",
        std::min(line.size(), form.fields));
  }
  Edit edit{form.kind, FeatureId{line.integer(1)}, {}, std::string(line.trimmed()), line.place(0)};
  if (form.fields == 4) edit.point = {line.coordinate(2), line.coordinate(3)};
  return edit;
}

text::Line split(const std::string& path, long number, std::string_view text) {
  text::Line line(path);
  line.split_blanks(number, text);
  return line;
}

bool is_word(const text::Line& line, std::string_view word) {
  if (line[0] != word) return false;
  if (line.size() == 1) return true;
  throw line.error(ErrorCode::bad_edit, text::quoted(word) + " stands alone on its line", 1);
}

}  // namespace

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
    ++number_;
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
  std::map<FeatureId, bool> comes;  // by the first edit of a point
  for (const Edit& edit : edits) comes.emplace(edit.id, edit.kind == Edit::Kind::insert);
  std::stable_partition(edits.begin(), edits.end(),
                        [&](const Edit& edit) { return !comes.at(edit.id); });
  return edits;
}

Place place_to_blame(const std::vector<Edit>& edits, const Error& error) {
  for (const FeatureId id : error.ids()) {
    const auto is_of = [&](const Edit& edit) { return edit.id == id; };
    const auto last = std::find_if(edits.rbegin(), edits.rend(), is_of);
    if (last != edits.rend()) return last->place;
  }
  return edits.back().place;
}

template <int D>
std::string Update<D>::text() const {
  std::string all;
  for (const Edit& edit : edits) all += (all.empty() ? "" : "; ") + edit.text;
  return all;
}

template struct Update<2>;

double now() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since_start).count();
}

}  // namespace mesher
