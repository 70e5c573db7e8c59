// Updates as records of a journal, and back.
#include "edit_journal.hpp"

#include <zlib.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "graph_edits.hpp"

namespace tool {
namespace {

namespace fs = std::filesystem;
using mesher::Edit;
using mesher::EditKind;
using mesher::Error;
using mesher::ErrorCode;

constexpr std::string_view kSizesComment = "# sizes ";

std::string absolute_folder(const std::string& folder) {
  std::error_code failed;
  const fs::path path = fs::absolute(folder.empty() ? "." : folder, failed);
  return failed ? folder : path.string();
}

// The checksum of a file's content; what cannot be read is as empty here, and is found elsewhere.
std::uint32_t content_of(const std::string& path, std::uint32_t before = 0) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (file) content << file.rdbuf();
  const std::string bytes = content.str();
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

// The file that a line of limits names; "" if it names none.
std::string background_name(const std::string& line) {
  std::istringstream words(line);
  std::string limit, kind, name;
  words >> limit >> kind >> name;
  return limit == "limit" && kind == "sizes" ? name : "";
}

// The checksum of all backgrounds that the lines name.
std::optional<std::uint32_t> backgrounds_in(const std::string& lines, const std::string& folder) {
  std::istringstream stream(lines);
  std::optional<std::uint32_t> content;
  for (std::string line; std::getline(stream, line);) {
    const std::string name = background_name(line);
    if (!name.empty())
      content = content_of((fs::path(folder) / name).string(), content.value_or(0));
  }
  return content;
}

// `CRC FOLDER` of the comment; the folder is "" if there is none.
std::pair<std::uint32_t, std::string> sizes_comment(const std::string& text) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line) && line.starts_with('#');) {
    if (!line.starts_with(kSizesComment)) continue;
    std::uint32_t content = 0;
    const char* const end = line.data() + line.size();
    const auto number = std::from_chars(line.data() + kSizesComment.size(), end, content);
    if (number.ec == std::errc{} && number.ptr < end) return {content, {number.ptr + 1, end}};
  }
  return {0, ""};
}

template <int D>
std::string text_of_box(const mesher::Box<D>& box) {
  std::string text;
  for (const auto& corner : {box.lo, box.hi}) {
    for (const double x : corner) {
      if (!text.empty()) text += ' ';
      text += script_number(x);
    }
  }
  return text;
}

template <int D>
JournalIdentity identity_of(const MeshArguments& args, const Input<D>& input,
                            const mesher::Options<D>& options) {
  const auto& graph = input.graph();
  JournalIdentity identity{{"dimension", std::to_string(D)},
                           {"points", std::to_string(graph.points.size())},
                           {"input", hash_of_graph<D>(graph)},
                           {"rho", script_number(mesher::radius_edge_bound(options))},
                           {"rule", args.rule},
                           {"domain", text_of_box<D>(options.domain)},
                           {"extent", args.box ? "box" : "enclosed"},
                           {"region-limits", args.region_areas ? "applied" : "ignored"},
                           {"largest", script_number(options.max_measure)},
                           {"max-vertices", std::to_string(options.max_vertices)}};
  identity.emplace_back("sizes",
                        args.sizes.empty() ? "none" : std::to_string(content_of(args.sizes)));
  if constexpr (D == 3) {
    identity.emplace_back("min-dihedral", script_number(options.min_dihedral));
  }
  return identity;
}

std::uint64_t journal_limit(const std::string& text) {
  if (text.empty()) return kJournalLimit;
  std::uint64_t limit = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, limit);
  if (result.ec == std::errc{} && result.ptr == end) return limit;
  throw Error(ErrorCode::bad_option, "--journal-limit '" + text + "': not a whole number");
}

const std::string& journal_path(const JournalArguments& journal, const MeshArguments& args) {
  std::error_code failed;
  for (const std::string& input : {args.input, args.source}) {
    if (!fs::equivalent(journal.path, input, failed)) continue;
    throw Error(ErrorCode::bad_option, "the journal cannot be the input", {journal.path});
  }
  return journal.path;
}

}  // namespace

void add_journal_options(CLI::App& command, JournalArguments& args) {
  command.add_flag(
      "--journal-sync", args.sync,
      "Wait at each update until it is on the disk: it then survives a power cut, too");
  command
      .add_option("--journal-limit", args.limit,
                  "A longer journal is compacted to the edits that lead from INPUT to where it is\n"
                  "(default: 16777216)")
      ->type_name("BYTES");
}

template <int D>
EditJournal<D>::EditJournal(const JournalArguments& journal, const MeshArguments& args,
                            const Input<D>& input, const mesher::Options<D>& options)
    : start_(input.graph()),
      file_(journal_path(journal, args), identity_of<D>(args, input, options), journal.sync),
      limit_(journal_limit(journal.limit)),
      found_(file_.take_found()),
      updates_found_(file_.place().updates) {}

template <int D>
std::optional<JournaledUpdate<D>> EditJournal<D>::next_found() {
  if (next_ == found_.size()) return std::nullopt;
  JournaledUpdate<D> update;
  update.text = std::move(found_[next_++]);
  const auto [content, folder] = sizes_comment(update.text);
  const std::string name = fs::path(file_.path()).filename().string();
  if (backgrounds_in(edit_lines(update.text), folder).value_or(0) != content) {
    throw Error(ErrorCode::bad_option,
                "the background of sizes in " + folder + " is not what it was when it was read",
                {file_.path()});
  }
  const std::string shown = folder.empty() ? file_.path() : (fs::path(folder) / name).string();
  auto script = mesher::EditScript<D>::of_text(update.text, shown);
  if (auto edits = script.next()) update.edits = std::move(*edits);
  take_limits(update.edits, folder);
  return update;
}

template <int D>
void EditJournal<D>::take_limits(const std::vector<Edit<D>>& edits, const std::string& folder) {
  for (const auto& edit : edits) {
    if (edit.kind != EditKind::limit) continue;
    if (!edit.box) limits_.clear();
    Limit limit{edit.text, background_name(edit.text)};
    if (!limit.background.empty()) {
      limit.background = (fs::path(absolute_folder(folder)) / limit.background).string();
      limit.content = content_of(limit.background);
    }
    limits_.push_back(std::move(limit));
  }
}

// Nothing if they cannot be said in one script: of a path with blanks, or of a file that has
// changed.
template <int D>
std::optional<std::vector<std::string>> EditJournal<D>::limit_lines() const {
  std::vector<std::string> lines;
  for (const Limit& limit : limits_) {
    lines.push_back(limit.text);
    if (limit.background.empty()) continue;
    if (limit.background.find_first_of(" \t#") != std::string::npos) return std::nullopt;
    if (content_of(limit.background) != limit.content) return std::nullopt;
    const std::string name = background_name(limit.text);
    lines.back().replace(limit.text.find(name, limit.text.find("sizes") + 5), name.size(),
                         limit.background);
  }
  return lines;
}

template <int D>
bool EditJournal<D>::is_long() const noexcept {
  return file_.place().updates > 1 && file_.bytes() > limit_ &&
         file_.bytes() > 4 * file_.bytes_replaced();
}

template <int D>
void EditJournal<D>::make_room(const mesher::Graph<D>& now) {
  if (!is_long()) return;
  const auto limits = limit_lines();
  if (!limits) return;
  std::vector<std::string> lines = graph_edits<D>(start_, now);
  lines.insert(lines.end(), limits->begin(), limits->end());
  std::string text = script_of(lines);
  if (const auto content = backgrounds_in(text, "/")) {
    text = std::string(kSizesComment) + std::to_string(*content) + " /\n" + text;
  }
  try {
    if (text.size() < file_.bytes()) file_.replace(text);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cannot_write) throw;
  }
}

template <int D>
void EditJournal<D>::append(const std::vector<Edit<D>>& edits, const std::string& folder,
                            const std::string& comment) {
  std::vector<std::string> texts;
  for (const auto& edit : edits) texts.push_back(edit.text);
  const std::string script = script_of(texts), lines = edit_lines(script);
  std::string text = comment;
  if (const auto content = backgrounds_in(lines, folder)) {
    text += std::string(kSizesComment) + std::to_string(*content) + " " + absolute_folder(folder) +
            "\n";
  }
  file_.append(text + script, lines);
  take_limits(edits, folder);
}

template <int D>
void print_journal(const EditJournal<D>& journal) {
  const char* const path = journal.file().path().c_str();
  for (const auto& note : journal.file().notes()) {
    std::fprintf(stderr, "%s: note: %s\n", path, note.c_str());
  }
  const auto found = static_cast<unsigned long long>(journal.updates_found());
  if (found > 0) {
    std::fprintf(stderr, "%s: note: %llu update%s resumed\n", path, found, found == 1 ? "" : "s");
  }
}

template class EditJournal<2>;
template class EditJournal<3>;
template void print_journal(const EditJournal<2>&);
template void print_journal(const EditJournal<3>&);

}  // namespace tool
