// mesher view: a mesh in a browser, which follows what is done to it there.
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "cancel.hpp"
#include "commands.hpp"
#include "edit_journal.hpp"
#include "fields.hpp"
#include "model.hpp"
#include "pages.hpp"
#include "platform/process.hpp"
#include "server.hpp"

namespace tool {
namespace {

using view::Model;
using view::Outgoing;
using view::Server;

struct ViewArguments : MeshArguments {
  JournalArguments journal;
  std::string port;    // empty: that of the last time, or any
  std::string script;  // empty: none
  bool new_address = false, with_parent = false;
};

std::uint16_t port_of(const std::string& text) {
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, port);
  if (result.ec == std::errc{} && result.ptr == end) return port;
  throw mesher::Error(mesher::ErrorCode::bad_option,
                      "--port '" + text + "': not a whole number up to 65535");
}

std::optional<view::HttpReply> page_reply(const std::string& path) {
  const auto* page = view::find_page(path);
  if (page == nullptr) return std::nullopt;
  return view::HttpReply{200, std::string(page->type), std::string(page->content), ""};
}

view::HttpReply file_reply(Model& model, const std::string& path, const Model::Send& send) {
  const std::string saved = "save/";
  if (path == "calls.svg" || path.starts_with("calls.svg?")) {
    std::string picture = model.calls();
    if (picture.empty()) return {404, "text/plain", "no calls are drawn\n", ""};
    return {200, "image/svg+xml", std::move(picture), ""};
  }
  if (!path.starts_with(saved)) return {404, "text/plain", "not found\n", ""};
  try {
    auto file = model.saved(path.substr(saved.size()), send);
    return {200, file.type, std::move(file.content), file.name};
  } catch (const mesher::Error& error) {
    return {409, "text/plain", std::string(error.what()) + "\n", ""};
  }
}

view::HttpReply edits_reply(Model& model, const std::string& script, const Model::Send& send) {
  const char* const json = "application/json";
  const auto refused = [&](const mesher::Error& error) -> view::HttpReply {
    return {409, json, view::text_of_json(view::json_of_error(error, view::Json())), ""};
  };
  try {
    return {200, json, model.edit(script, send), ""};
  } catch (const mesher::Error& error) {
    return refused(error);
  } catch (const std::bad_alloc&) {
    return refused({mesher::ErrorCode::too_many, "out of memory"});
  }
}

constexpr double kLook = 0.02;     // seconds between looks at the network during an update
constexpr double kPatience = 0.5;  // until pages are told of an update that is under way
constexpr double kInterval = 0.25;

// The model behind the server: answers go to one page or to all. While an update runs, pages are
// served, and may stop it.
class View {
 public:
  View(std::unique_ptr<Model> model, const view::PageAddress& wanted, bool may_move)
      : model_(std::move(model)),
        server_(wanted, may_move,
                {.page = page_reply,
                 .get =
                     [this](const std::string& path) {
                       return attended([&] { return file_reply(*model_, path, sender(0)); });
                     },
                 .edits =
                     [this](const std::string& script) {
                       return attended([&] { return edits_reply(*model_, script, sender(0)); });
                     },
                 .stop = [this] { return stop(); },
                 .joined =
                     [this](Server::ClientId client) {
                       server_.send(client, bytes(model_->snapshot()), true);
                     },
                 .left =
                     [this](Server::ClientId client) {
                       attended([&] { return model_->left(client, sender(client)), true; });
                     },
                 .message = [this](Server::ClientId client,
                                   const std::string& text) { take(client, text); }}) {
    model_->set_meanwhile([this](const mesher::Progress& progress) { return goes_on(progress); });
  }
  ~View() {
    fresh_stop_.request_stop();
    for (auto& thread : threads_) thread.join();
  }
  View(const View&) = delete;
  View& operator=(const View&) = delete;

  [[nodiscard]] view::PageAddress address() const { return server_.address(); }
  // `parent`: ends when another process is; nothing: whatever the parent is.
  void run(const std::optional<std::uint64_t>& parent) {
    server_.run(
        [=] { return !interrupted() && (!parent || platform::parent_number() == *parent); });
    model_->finish(sender(0));
  }
  [[nodiscard]] const Model& model() const { return *model_; }

 private:
  static Server::Bytes bytes(std::string text) {
    return std::make_shared<const std::string>(std::move(text));
  }

  Model::Send sender(Server::ClientId client) {
    return [this, client](Outgoing out) {
      auto shared = bytes(std::move(out.bytes));
      if (out.to_all) {
        server_.broadcast(shared, out.binary);
      } else {
        server_.send(client, std::move(shared), out.binary);
      }
    };
  }

  // What the model does, during which goes_on() is asked.
  template <class Do>
  std::invoke_result_t<Do> attended(Do make) {
    stops_ = false;
    began_ = mesher::now();
    next_look_ = began_ + kLook;
    next_word_ = began_ + kPatience;
    attends_ = true;
    auto made = make();
    attends_ = stops_ = false;
    if (next_word_ > began_ + kPatience) server_.announce(bytes(R"({"kind":"idle"})"));
    return made;
  }

  bool goes_on(const mesher::Progress& progress) {
    const double now = mesher::now();
    if (!attends_ || now < next_look_) return !stops_;
    next_look_ = now + kLook;
    server_.meanwhile();
    if (now < next_word_) return !stops_;
    next_word_ = now + kInterval;
    server_.announce(bytes(view::Json{
        {"kind", "busy"}, {"seconds", now - began_}, {"calls", progress.done}, {"stops", stops_}}
                               .dump()));
    return !stops_;
  }

  view::HttpReply stop() {
    stops_ = attends_;
    if (running_ > 0) fresh_stop_.request_stop();
    const bool any = attends_ || running_ > 0;
    return {200, "text/plain", any ? "stopping\n" : "nothing is under way\n", ""};
  }

  void take(Server::ClientId client, const std::string& text) {
    Model::Work work =
        attended([&] { return model_->command(client, text, sender(client), running_ > 0); });
    if (!work) return;
    ++running_;
    for (auto& thread : threads_) thread.join();  // they are done
    threads_.clear();
    fresh_stop_ = {};
    threads_.emplace_back([this, client, work = std::move(work), stop = fresh_stop_.get_token()] {
      std::string answer = work(stop);
      server_.post([this, client, answer = std::move(answer)] {
        --running_;
        server_.send(client, bytes(answer), false);
      });
    });
  }

  std::unique_ptr<Model> model_;
  std::vector<std::thread> threads_;
  int running_ = 0;
  std::stop_source fresh_stop_;
  bool attends_ = false, stops_ = false;
  double began_ = 0, next_look_ = 0, next_word_ = 0;  // by mesher::now()
  Server server_;
};

// A journal that nobody asked for may be in a folder that one may not write to.
std::unique_ptr<Model> model_of(const ViewArguments& args, const JournalArguments& journal) {
  try {
    return view::make_model(args, journal, args.script);
  } catch (const mesher::Error& error) {
    if (error.code() != mesher::ErrorCode::cannot_write || !args.journal.path.empty()) throw;
    throw error.with_message(error.message() + "; --journal FILE records updates elsewhere");
  }
}

// Where the page was the last time, so that pages that are still open find it; unless that is
// taken.
std::unique_ptr<View> opened_view(const ViewArguments& args, const JournalArguments& journal) {
  const std::optional<std::uint16_t> port =
      args.port.empty() ? std::nullopt : std::optional(port_of(args.port));
  const std::string file = journal.path + ".page";
  auto model = model_of(args, journal);
  const auto last = args.new_address ? std::nullopt : view::read_page_address(file);
  view::PageAddress wanted = last.value_or(view::PageAddress());
  if (port) wanted.port = *port;
  auto view = std::make_unique<View>(std::move(model), wanted, last && !port);
  if (!view::write_page_address(file, view->address()) && !args.quiet) {
    std::fprintf(stderr,
                 "%s: note: cannot be written: a view that is started again has another "
                 "address\n",
                 file.c_str());
  }
  return view;
}

void run_view(const ViewArguments& args) {
  const auto parent =  // which may end before the mesh is made
      args.with_parent ? std::optional(platform::parent_number()) : std::nullopt;
  JournalArguments journal = args.journal;
  if (journal.path.empty()) {
    if (args.source != args.input) {
      throw mesher::Error(mesher::ErrorCode::bad_option,
                          "INPUT is a pipe or has --format: --journal FILE is needed",
                          {args.source});
    }
    journal.path = args.source + ".journal";
  }
  const auto view = opened_view(args, journal);
  std::printf("%s\n", view->address().text().c_str());
  std::fflush(stdout);
  if (!args.quiet) {
    std::fprintf(stderr, "%s: %s\nThe page is at the address above; Ctrl-C ends.\n",
                 args.source.c_str(), view->model().summary().c_str());
  }
  const StopPolitely stop;
  view->run(parent);
}

}  // namespace

void add_view(CLI::App& app) {
  const auto args = std::make_shared<ViewArguments>();
  CLI::App* view = app.add_subcommand(
      "view", "Shows a mesh in a browser, where points are dragged and lines are drawn.");
  add_mesh_options(*view, *args, MeshGoes::elsewhere);
  view->add_option("--script", args->script,
                   "Edits to be made first, if the journal is new; the page cannot undo them")
      ->type_name("EDITS");
  view->add_option("--journal", args->journal.path,
                   "Record each update in this file, and go on from it if it is there (default:\n"
                   "INPUT.journal)")
      ->type_name("FILE");
  add_journal_options(*view, args->journal);
  add_threads_option(*view, *args);
  view->add_option("--port", args->port,
                   "Where to listen on 127.0.0.1 (default: as the last time, or any free port)")
      ->type_name("PORT");
  view->add_flag("--new-address", args->new_address,
                 "Do not take the address of the last time, which is in FILE.page beside the\n"
                 "journal FILE: pages that know it are refused");
  view->add_flag("--with-parent", args->with_parent,
                 "End when the program that has started this one ends");
  view->footer(
      "Prints the address of the page, which holds a random token; no browser is started. The "
      "page\n"
      "is only for this machine, and for who knows the address; it saves meshes. Its script of\n"
      "edits, replayed by 'mesher edit', gives the same mesh. See mesher/docs/view.md.\n"
      "Examples:\n"
      "  mesher view lake.poly\n"
      "  mesher view part.stl --surface --journal part.edits --port 8080");
  view->callback([args] { run_view(*args); });
}

}  // namespace tool
