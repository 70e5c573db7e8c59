// What a live view shows and edits: a mesh with its journal, a history to undo, and the point that
// is being dragged. It knows pages by numbers, and nothing of networks.
//
// Commands come as JSON objects; `do` says which:
//   {"do": "point", "at": [x, y], "marker": m}
//   {"do": "line", "through": [id or [x, y], ...], "closed": true, "marker": m}
//                                   a segment or polyline; positions become new points
//   {"do": "polygon", "through": [...], "marker": m}            in space
//   {"do": "hole", "at": [x, y]}
//   {"do": "region", "at": [x, y], "attribute": a, "largest": A}
//   {"do": "delete", "features": [["point", id], ["line", id], ["polygon", id], ["hole", id],
//                                 ["region", id]]}       with what hangs on points
//   {"do": "drag", "point": id, "at": [x, y], "drop": true}
//   {"do": "drag", "feature": ["polygon", id], "by": [dx, dy, dz], "drop": true}
//                                   all points of a line or polygon, from where it began
//   {"do": "limit", "largest": A, "box": [[x, y], [x, y]]}
//                                   a limit of area (volume), or "size": H, or, with neither, none;
//                                   without a box everywhere, in place of all others
//   {"do": "unlimit", "box": [...]}  as if the limit in that box had not been given
//   {"do": "undo"}, {"do": "redo"}
//   {"do": "script", "text": lines}  of edits; each batch is an update. `limit sizes` is refused: a
//                                   page cannot name files
//   {"do": "snapshot"}               all of the mesh again
//   {"do": "fresh"}                  a run from scratch, to compare times and counts; `calls`: how
//                                   many the program has to run for it
//   {"do": "calls", "on": true}      from now on, draw which calls of the engine each update runs
// `tag`, any number, comes back with the answer. Anything else is refused and changes nothing.
//
// A drag is one update in journal and history: the moves from where it began to where it ends,
// which is when it is dropped, or when anybody does something else. Until then the mesh has updates
// that the journal does not.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "arguments.hpp"
#include "edit_journal.hpp"
#include "mesher/meshing.hpp"

namespace tool::view {

using ClientId = std::uint64_t;

/// What is sent to pages: one of these, or several.
struct Outgoing {
  std::string bytes;
  bool binary = false;  // a Message; else JSON
  bool to_all = false;  // else to the page whose command it was
};

/// A file to be saved.
struct SavedFile {
  std::string name, type, content;
};

class Model {
 public:
  using Send = std::function<void(Outgoing)>;
  /// Work that takes long and may run on another thread; gives what to send when it is done, or was
  /// stopped.
  using Work = std::function<std::string(std::stop_token)>;
  /// Called some thousand times a second while an update runs. It must not use the model.
  using Meanwhile = std::function<bool(const mesher::Progress&)>;

  Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  virtual ~Model() = default;

  /// From now on, what this calls false stops an update: that is an error (cancelled), and nothing
  /// is changed. What takes an update back goes on.
  virtual void set_meanwhile(Meanwhile meanwhile) = 0;
  /// All of the mesh, as a Message.
  [[nodiscard]] virtual std::string snapshot() = 0;
  /// Does what a page says; mistakes are answered. Gives work that remains.
  virtual Work command(ClientId client, const std::string& text, const Send& send,
                       bool runs_fresh) = 0;
  /// A page is gone: what it drags is dropped.
  virtual void left(ClientId client, const Send& send) = 0;
  /// Makes the updates of a script, up to the first that is refused. Gives JSON.
  /// Throws: Error; bad_alloc.
  virtual std::string edit(const std::string& script, const Send& send) = 0;
  /// The mesh, the input or a script as a file: mesh.EXT, input.poly, input.txt (edits that make
  /// the input and its limits of nothing), or edits.txt (those since the start). Throws: Error
  /// (unknown_format, cannot_write, ...).
  [[nodiscard]] virtual SavedFile saved(const std::string& name, const Send& send) = 0;
  /// A picture (SVG) of the calls that only the trace before the last update has, or only the one
  /// after it, and of their ancestors; empty if there is none.
  [[nodiscard]] virtual std::string calls() const = 0;
  /// What a journal had and how large the mesh is, for people.
  [[nodiscard]] virtual std::string summary() const = 0;
  /// Drops what is dragged, as the view ends.
  virtual void finish(const Send& send) = 0;
};

/// Reads the input, replays its journal, and makes the mesh. `script`: edits with which a new
/// journal begins, and which cannot be undone; empty: none. Throws: Error.
[[nodiscard]] std::unique_ptr<Model> make_model(const MeshArguments& args,
                                                const JournalArguments& journal,
                                                const std::string& script);

}  // namespace tool::view
