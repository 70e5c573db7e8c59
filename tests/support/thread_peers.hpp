// Processes for tests: threads of one, each with a part of a hall where they meet.
#pragma once

#include <barrier>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "tiles/peers.hpp"

namespace support {

/// Where threads meet: what each has brought.
class Hall {
 public:
  explicit Hall(std::size_t size) : views(size), values(size), failed(size), barrier(size) {}

  std::vector<const mesher::detail::Peers::Views*> views;
  std::vector<mesher::detail::Peers::Values> values;
  std::vector<char> failed;
  std::barrier<> barrier;
};

class ThreadPeers final : public mesher::detail::Peers {
 public:
  ThreadPeers(Hall& hall, std::size_t self) : hall_(hall), self_(self) { make_room(size()); }

  [[nodiscard]] std::size_t size() const noexcept override { return hall_.views.size(); }
  [[nodiscard]] std::size_t self() const noexcept override { return self_; }
  void least(Values values) noexcept override {
    reduce(values, [](std::uint64_t a, std::uint64_t b) { return a < b ? a : b; });
  }
  void sum(Values values) noexcept override {
    reduce(values, [](std::uint64_t a, std::uint64_t b) { return a + b; });
  }
  [[nodiscard]] std::vector<mesher::detail::Bytes> exchange(const Views& out) override {
    hall_.views[self_] = &out;
    hall_.barrier.arrive_and_wait();
    std::vector<mesher::detail::Bytes> in;
    hall_.failed[self_] = false;
    try {
      for (const Views* views : hall_.views) {
        in.emplace_back((*views)[self_].begin(), (*views)[self_].end());
      }
    } catch (const std::bad_alloc&) {
      hall_.failed[self_] = true;
    }
    hall_.barrier.arrive_and_wait();
    bool failed = false;
    for (const char one : hall_.failed) failed = failed || one != 0;
    hall_.barrier.arrive_and_wait();
    if (failed) throw std::bad_alloc();
    return in;
  }

 private:
  template <class Join>
  void reduce(Values values, Join join) noexcept {
    hall_.values[self_] = values;
    hall_.barrier.arrive_and_wait();
    std::uint64_t joined[8];
    for (std::size_t i = 0; i < values.size(); ++i) {
      joined[i] = hall_.values[0][i];
      for (std::size_t k = 1; k < size(); ++k) joined[i] = join(joined[i], hall_.values[k][i]);
    }
    hall_.barrier.arrive_and_wait();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = joined[i];
  }

  Hall& hall_;
  std::size_t self_;
};

/// Calls act(peers) in each of so many processes. Throws: what the first of them has thrown, when
/// all have come to the end.
inline void in_processes(
    std::size_t size,
    const std::function<void(std::unique_ptr<mesher::detail::Peers>, std::size_t)>& act) {
  Hall hall(size);
  std::vector<std::exception_ptr> failures(size);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < size; ++k) {
    threads.emplace_back([&, k] {
      try {
        act(std::make_unique<ThreadPeers>(hall, k), k);
      } catch (...) {
        failures[k] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace support
