// The journal of a mesh that follows edits: of an input, options, and the updates since.
//
// The mesh is a function of the input and the options [mesher.hpp, (4)], so the same updates, or
// one that does what they did, lead to the same bytes. Slots are not: they depend on history, and
// start anew where a run goes on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "input.hpp"
#include "journal.hpp"
#include "mesher/extra/edit_script.hpp"

namespace tool {

struct JournalArguments {
  std::string path;  // empty: none
  bool sync = false;
  std::string limit;  // in bytes; empty: kJournalLimit
};

/// A journal that is longer is compacted, if it is four times as long as after the last time.
inline constexpr std::uint64_t kJournalLimit = std::uint64_t{16} << 20;

/// Adds --journal-sync and --journal-limit; --journal is the command's.
void add_journal_options(CLI::App& command, JournalArguments& args);

/// An update that a journal had.
template <int D>
struct JournaledUpdate {
  std::string text;  // its script, with comments
  std::vector<mesher::Edit<D>> edits;
};

template <int D>
class EditJournal {
 public:
  /// Throws: Error, as Journal; bad_option if the path is that of the input.
  EditJournal(const JournalArguments& journal, const MeshArguments& args, const Input<D>& input,
              const mesher::Options<D>& options);

  [[nodiscard]] const Journal& file() const noexcept { return file_; }

  /// The next update that was there when the journal was opened; nothing after the last.
  /// Throws: Error, as EditScript; bad_option if a background is not what it was.
  [[nodiscard]] std::optional<JournaledUpdate<D>> next_found();
  /// How many updates there were, those included that others stand for now.
  [[nodiscard]] std::uint64_t updates_found() const noexcept { return updates_found_; }

  /// Before an update is made: makes the journal short if it is long. `now`: the input. That it
  /// cannot be made short is no error.
  void make_room(const mesher::Graph<D>& now);
  /// Whether make_room() would do something.
  [[nodiscard]] bool is_long() const noexcept;
  /// After an update of these edits, which stand in a script in `folder`. `comment`: "", or lines
  /// that start with '#'. Throws: Error(cannot_write), and then the journal is as before.
  void append(const std::vector<mesher::Edit<D>>& edits, const std::string& folder,
              const std::string& comment = "");

 private:
  struct Limit {
    std::string text;        // the line
    std::string background;  // the path of the file that it names, or empty
    std::uint32_t content = 0;
  };
  void take_limits(const std::vector<mesher::Edit<D>>& edits, const std::string& folder);
  [[nodiscard]] std::optional<std::vector<std::string>> limit_lines() const;

  mesher::Graph<D> start_;
  Journal file_;
  std::uint64_t limit_;
  std::vector<std::string> found_;
  std::size_t next_ = 0;
  std::uint64_t updates_found_;
  std::vector<Limit> limits_;  // those that count: since the last that counts everywhere
};

/// What a journal says of being opened, on standard error.
template <int D>
void print_journal(const EditJournal<D>& journal);

}  // namespace tool
