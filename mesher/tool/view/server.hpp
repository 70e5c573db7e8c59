// A server of pages and web sockets for one user on this machine, by Boost.Beast.
//
// Guarantees:
//   (1) it listens on the loopback address alone;
//   (2) a request is answered only if its path begins with the token, 128 random bits, if its Host
//       is this server, and if its Origin, which a web socket must have, is this server: so no page
//       of another site can read or edit, whatever name it gives to this machine;
//   (3) callbacks are called one at a time, on the thread that calls run(); what comes while one
//       calls meanwhile() waits for its end, except for `page` and `stop`;
//   (4) a page that does not read what it is sent costs a bounded amount of memory: what waits is
//       dropped, and `joined` is called for it again when it reads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "page_address.hpp"

namespace tool::view {

struct HttpReply {
  unsigned status = 200;
  std::string type;  // of the content
  std::string content;
  std::string saved_as;  // a name: to be saved, not shown
};

class Server {
 public:
  using ClientId = std::uint64_t;
  using Bytes = std::shared_ptr<const std::string>;
  struct Callbacks {
    // path: behind the token, "page.js"; nothing of `page`: to be asked of `get`.
    std::function<std::optional<HttpReply>(const std::string& path)> page;
    std::function<HttpReply(const std::string& path)> get;
    std::function<HttpReply(const std::string& text)> edits;  // a script that was posted
    std::function<HttpReply()> stop;                          // what is under way
    std::function<void(ClientId)> joined, left;               // of web sockets
    std::function<void(ClientId, std::string)> message;
  };

  /// At `wanted`; if it cannot listen there and `may_move`, at any other address.
  /// Throws: Error(bad_option) if it cannot listen.
  Server(const PageAddress& wanted, bool may_move, Callbacks callbacks);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] PageAddress address() const;

  void send(ClientId client, Bytes bytes, bool binary);
  /// To all that have joined.
  void broadcast(const Bytes& bytes, bool binary);
  /// To those as well whose `joined` waits.
  void announce(const Bytes& text);
  /// For callbacks that take long: sends and receives what can be at once.
  void meanwhile();
  /// Calls `work` on the thread of run(). May be called on any thread.
  void post(std::function<void()> work);
  /// Serves until `goes_on`, asked ten times a second, is false.
  void run(std::function<bool()> goes_on);

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace tool::view
