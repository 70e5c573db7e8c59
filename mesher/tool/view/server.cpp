// The only file that knows Boost: HTTP sessions, some of which become web sockets.
#include "server.hpp"

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "mesher/error.hpp"

namespace tool::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using tcp = asio::ip::tcp;
using Request = http::request<http::string_body>;

constexpr std::size_t kMostSessions = 64;
constexpr std::size_t kLongestMessage = std::size_t{1} << 20;  // of a page
constexpr std::uint64_t kLongestScript = std::uint64_t{1} << 30;
constexpr std::size_t kMostWaiting = std::size_t{1} << 28;  // bytes for one page
constexpr std::uint32_t kLongestHead = 16384;
constexpr std::chrono::seconds kPatience{30};
constexpr std::size_t kMostHeld = std::size_t{1} << 20;  // bytes of one page that wait to be taken

constexpr const char* kEditsPath = "edits";  // where scripts are posted
constexpr const char* kStopPath = "stop";

constexpr const char* kPagePolicy =
    "default-src 'self'; img-src 'self' data:; connect-src 'self' ws://127.0.0.1:* "
    "ws://localhost:*; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";
constexpr const char* kPicturePolicy = "default-src 'none'; style-src 'unsafe-inline'";

std::string random_token() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 4; ++i) {
    const std::uint32_t bits = random();
    for (int k = 28; k >= 0; k -= 4) token += "0123456789abcdef"[bits >> k & 15];
  }
  return token;
}

// In a time that does not depend on where they differ.
bool is_same(const std::string& a, const std::string& b) {
  unsigned differs = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    differs |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return differs == 0;
}

std::string text_of_view(beast::string_view view) { return {view.data(), view.size()}; }

}  // namespace

class SocketSession;

struct Server::Impl {
  explicit Impl(Callbacks from) : callbacks(std::move(from)), acceptor(io), tick(io) {}

  void listen(const PageAddress& wanted, bool may_move);
  void accept();
  void ask_whether_to_go_on();
  [[nodiscard]] bool is_own(const std::string& host) const {
    return host == "127.0.0.1" + end || host == "localhost" + end;
  }
  // For calls of callbacks, which are made outside of all handlers: meanwhile() could not count
  // what is outstanding inside of one.
  void deliver(std::function<void()> call) { calls.push_back(std::move(call)); }
  void make_calls();
  // The path behind the token; nothing if the request is to be refused.
  [[nodiscard]] std::optional<std::string> allowed_path(const Request& request) const;

  Callbacks callbacks;
  std::string token, end;  // `:PORT`
  std::map<ClientId, std::shared_ptr<SocketSession>> clients;
  ClientId last_client = 0;
  std::size_t sessions = 0;
  std::deque<std::function<void()>> calls;  // to be made
  std::function<bool()> goes_on;
  asio::io_context io{1};  // handlers that wait hold sessions, which go with it
  tcp::acceptor acceptor;
  asio::steady_timer tick;
};

// Counts the connections that are open.
class SessionCount {
 public:
  explicit SessionCount(Server::Impl& of) : impl(&of) { ++of.sessions; }
  ~SessionCount() {
    if (impl != nullptr) --impl->sessions;
  }
  SessionCount(SessionCount&& from) noexcept : impl(std::exchange(from.impl, nullptr)) {}
  SessionCount& operator=(SessionCount&&) = delete;

  Server::Impl* impl;
};

// --- Web sockets -----------------------------------------------------------------------------

class SocketSession : public std::enable_shared_from_this<SocketSession> {
 public:
  SocketSession(beast::tcp_stream&& stream, SessionCount count)
      : count_(std::move(count)), stream_(std::move(stream)) {}

  void start(const Request& request) {
    auto times = websocket::stream_base::timeout::suggested(beast::role_type::server);
    times.keep_alive_pings = true;
    stream_.set_option(times);
    stream_.read_message_max(kLongestMessage);
    stream_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (!error) self->join();
    });
  }

  [[nodiscard]] bool has_joined() const { return has_joined_; }

  void send(Server::Bytes bytes, bool binary) {
    if (waiting_bytes_ + bytes->size() > kMostWaiting && waiting_.size() > 1) {
      waiting_.resize(1);  // the one that is being written
      waiting_bytes_ = waiting_[0].first->size();
      needs_all_ = true;
    }
    if (needs_all_) return;
    waiting_bytes_ += bytes->size();
    waiting_.emplace_back(std::move(bytes), binary);
    if (waiting_.size() == 1) write();
  }

 private:
  Server::Impl& impl() { return *count_.impl; }

  void join() {
    id_ = ++impl().last_client;
    impl().clients.emplace(id_, shared_from_this());
    impl().deliver([self = shared_from_this()] {
      self->has_joined_ = true;
      self->impl().callbacks.joined(self->id_);
    });
    read();
  }

  void leave() {
    if (impl().clients.erase(id_) == 0) return;
    impl().deliver([self = shared_from_this()] { self->impl().callbacks.left(self->id_); });
  }

  void read() {
    reads_ = true;
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      self->reads_ = false;
      if (error) return self->leave();
      std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      self->take(std::move(text));
      self->read_if_room();
    });
  }

  void take(std::string text) {
    const std::size_t size = text.size() + 256;
    held_ += size;
    impl().deliver([self = shared_from_this(), text = std::move(text), size] {
      self->held_ -= size;
      self->impl().callbacks.message(self->id_, text);
      self->read_if_room();
    });
  }

  void read_if_room() {
    if (!reads_ && held_ <= kMostHeld) read();
  }

  void write() {
    stream_.binary(waiting_.front().second);
    stream_.async_write(asio::buffer(*waiting_.front().first),
                        [self = shared_from_this()](error_code error, std::size_t) {
                          if (error) return self->leave();
                          self->written();
                        });
  }

  void written() {
    waiting_bytes_ -= waiting_.front().first->size();
    waiting_.pop_front();
    if (!waiting_.empty()) return write();
    if (!std::exchange(needs_all_, false)) return;
    impl().deliver([self = shared_from_this()] { self->impl().callbacks.joined(self->id_); });
  }

  SessionCount count_;
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_;
  std::deque<std::pair<Server::Bytes, bool>> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::size_t held_ = 0;  // received, and not yet taken
  bool reads_ = false, has_joined_ = false, needs_all_ = false;
  Server::ClientId id_ = 0;
};

// --- HTTP ------------------------------------------------------------------------------------

namespace {

class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(tcp::socket&& socket, Server::Impl& impl)
      : count_(impl), stream_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kLongestHead);
    parser_->body_limit(kLongestScript);
    stream_.expires_after(kPatience);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error == http::error::end_of_stream) return self->close();
                              if (!error) self->take_head();
                            });
  }

 private:
  // Of a body nothing is read but a script from who knows the token.
  void take_head() {
    if (parser_->is_done()) return answer();
    if (parser_->get().method() != http::verb::post) return;
    if (count_.impl->allowed_path(parser_->get()) != kEditsPath) return;
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

  void answer() {
    const auto asked = std::make_shared<const Request>(parser_->release());
    const Request& request = *asked;
    const auto path = count_.impl->allowed_path(request);
    if (!path) return reply(request, {403, "text/plain", "refused\n", ""});
    const auto& callbacks = count_.impl->callbacks;
    if (request.method() == http::verb::post && *path == kEditsPath) {
      return reply_later(asked, [&callbacks, asked] { return callbacks.edits(asked->body()); });
    }
    if (request.method() == http::verb::post && *path == kStopPath) {
      return reply(request, callbacks.stop());
    }
    if (websocket::is_upgrade(request)) {
      if (*path != "socket") return reply(request, {404, "text/plain", "not found\n", ""});
      stream_.expires_never();
      std::make_shared<SocketSession>(std::move(stream_), std::move(count_))->start(request);
      return;
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return reply(request, {405, "text/plain", "only GET is understood\n", ""});
    }
    if (auto page = callbacks.page(*path)) return reply(request, std::move(*page));
    reply_later(asked, [&callbacks, path = *path] { return callbacks.get(path); });
  }

  // When nothing else is under way.
  void reply_later(std::shared_ptr<const Request> request, std::function<HttpReply()> make) {
    count_.impl->deliver([self = shared_from_this(), request = std::move(request),
                          make = std::move(make)] { self->reply(*request, make()); });
  }

  void reply(const Request& request, HttpReply from) {
    response_ = {};
    response_.version(request.version());
    response_.keep_alive(request.keep_alive());
    response_.result(from.status);
    response_.set(http::field::content_type, from.type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Content-Security-Policy",
                  from.type == "image/svg+xml" ? kPicturePolicy : kPagePolicy);
    if (!from.saved_as.empty()) {
      std::replace_if(
          from.saved_as.begin(), from.saved_as.end(),
          [](char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 32; }, '_');
      response_.set(http::field::content_disposition,
                    "attachment; filename=\"" + from.saved_as + "\"");
    }
    const std::size_t length = from.content.size();
    if (request.method() != http::verb::head) response_.body() = std::move(from.content);
    response_.content_length(length);
    stream_.expires_after(kPatience);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (error) return;
                        if (self->response_.need_eof()) return self->close();
                        self->read();
                      });
  }

  void close() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  SessionCount count_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

std::optional<std::string> Server::Impl::allowed_path(const Request& request) const {
  if (request.count(http::field::host) != 1) return std::nullopt;
  if (!is_own(text_of_view(request[http::field::host]))) return std::nullopt;
  const auto origins = request.count(http::field::origin);
  if (origins > 1 || (origins == 0 && websocket::is_upgrade(request))) return std::nullopt;
  if (origins == 1) {
    const std::string origin = text_of_view(request[http::field::origin]);
    const std::string scheme = "http://";
    if (!origin.starts_with(scheme) || !is_own(origin.substr(scheme.size()))) return std::nullopt;
  }
  const std::string target = text_of_view(request.target());
  const std::size_t slash = target.find('/', 1);
  if (target.empty() || target[0] != '/' || slash == std::string::npos) return std::nullopt;
  if (!is_same(target.substr(1, slash - 1), token)) return std::nullopt;
  return target.substr(slash + 1);
}

void Server::Impl::make_calls() {
  while (!calls.empty()) {
    const auto next = std::move(calls.front());
    calls.pop_front();
    next();
  }
}

void Server::Impl::listen(const PageAddress& wanted, bool may_move) {
  const std::uint16_t port = wanted.port;
  token = wanted.token.empty() ? random_token() : wanted.token;
  try {
    const tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
    acceptor.open(endpoint.protocol());
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    if (may_move) {
      acceptor = tcp::acceptor(io);
      return listen({}, false);
    }
    throw mesher::Error(
        mesher::ErrorCode::bad_option,
        "--port " + std::to_string(port) + ": cannot listen on it: " + error.code().message());
  }
  end = ":" + std::to_string(acceptor.local_endpoint().port());
  accept();
}

void Server::Impl::accept() {
  acceptor.async_accept([this](error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error && sessions < kMostSessions) {
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<HttpSession>(std::move(socket), *this)->read();
    }
    accept();
  });
}

void Server::Impl::ask_whether_to_go_on() {
  if (!goes_on()) return io.stop();
  tick.expires_after(std::chrono::milliseconds(100));
  tick.async_wait([this](error_code error) {
    if (!error) ask_whether_to_go_on();
  });
}

Server::Server(const PageAddress& wanted, bool may_move, Callbacks callbacks)
    : impl_(std::make_unique<Impl>(std::move(callbacks))) {
  impl_->listen(wanted, may_move);
}

Server::~Server() {
  impl_->clients.clear();
  impl_->calls.clear();
}

PageAddress Server::address() const {
  return {impl_->acceptor.local_endpoint().port(), impl_->token};
}

void Server::send(ClientId client, Bytes bytes, bool binary) {
  const auto found = impl_->clients.find(client);
  if (found != impl_->clients.end()) found->second->send(std::move(bytes), binary);
}

void Server::broadcast(const Bytes& bytes, bool binary) {
  for (const auto& client : impl_->clients) {
    if (client.second->has_joined()) client.second->send(bytes, binary);
  }
}

void Server::announce(const Bytes& text) {
  for (const auto& client : impl_->clients) client.second->send(text, false);
}

void Server::meanwhile() { impl_->io.poll(); }

void Server::post(std::function<void()> work) { asio::post(impl_->io, std::move(work)); }

void Server::run(std::function<bool()> goes_on) {
  impl_->goes_on = std::move(goes_on);
  impl_->ask_whether_to_go_on();
  while (!impl_->io.stopped()) {
    impl_->io.run_one();
    impl_->make_calls();
  }
}

}  // namespace tool::view
