// Failures of one process become failures of all.
#include "tiles/peers.hpp"

#include <array>
#include <new>
#include <stdexcept>

#include "sac/engine.hpp"

namespace mesher::detail {

namespace {

enum class Kind : std::uint8_t { none, cancelled, no_memory, error, other };

void pack_failure(const std::exception_ptr& failure, Packer& to) {
  try {
    std::rethrow_exception(failure);
  } catch (const sac::Cancelled&) {
    to.put(Kind::cancelled);
  } catch (const std::bad_alloc&) {
    to.put(Kind::no_memory);
  } catch (const Error& error) {
    to.put(Kind::error);
    pack(error, to);
  } catch (const std::exception& other) {
    to.put(Kind::other);
    to.put_all(std::string_view(other.what()));
  } catch (...) {
    to.put(Kind::other);
    to.put_all(std::string_view("it is not known why"));
  }
}

[[noreturn]] void throw_equal(Unpacker failure) {
  switch (failure.take<Kind>()) {
    case Kind::cancelled:
      throw sac::Cancelled();
    case Kind::error:
      throw unpack_error(failure);
    case Kind::other:
      throw std::runtime_error("another process has failed: " + failure.take_text());
    default:
      throw std::bad_alloc();
  }
}

[[noreturn]] void throw_first(Peers& peers, const std::exception_ptr& failure) {
  Packer packed;
  std::array<std::byte, 1> mine{std::byte{static_cast<std::uint8_t>(Kind::none)}};
  std::span<const std::byte> told = mine;
  if (failure) {
    try {
      pack_failure(failure, packed);
      told = packed.bytes();
    } catch (...) {  // without memory that is all there is to say
      mine[0] = std::byte{static_cast<std::uint8_t>(Kind::no_memory)};
    }
  }
  const std::vector<Bytes> all = peers.gather(told);
  std::size_t first = all.size();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto kind = Unpacker(all[k]).take<Kind>();
    if (kind == Kind::none) continue;
    if (kind != Kind::cancelled) {
      first = k;
      break;
    }
    if (first == all.size()) first = k;
  }
  if (first == peers.self()) std::rethrow_exception(failure);
  throw_equal(Unpacker(all[first]));
}

}  // namespace

void agree(Peers& peers, const std::exception_ptr& failure, Peers::Values values) {
  if (peers.is_alone()) {
    if (failure) std::rethrow_exception(failure);
    return;
  }
  std::array<std::uint64_t, 4> all{failure ? 0u : 1u};
  SAC_EXPECTS(values.size() < all.size());
  std::copy(values.begin(), values.end(), all.begin() + 1);
  peers.least(Peers::Values(all).first(values.size() + 1));
  if (all[0] == 0) throw_first(peers, failure);
  std::copy_n(all.begin() + 1, values.size(), values.begin());
}

}  // namespace mesher::detail
