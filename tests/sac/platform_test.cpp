// What the engine relies on in the file of the operating system, whichever that is.
#include "sac/internal/platform.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <vector>

#include "sac/arena.hpp"

namespace {

namespace platform = sac::platform;

constexpr std::size_t kAlignment = std::size_t{1} << platform::kReserveBits;
constexpr std::size_t kBytes = std::size_t{64} << 20;

struct Range {
  Range() : base(static_cast<std::byte*>(platform::reserve(kBytes, kAlignment))) {}
  Range(const Range&) = delete;
  Range& operator=(const Range&) = delete;
  ~Range() {
    if (base != nullptr) platform::release(base, kBytes, kAlignment);
  }
  std::byte* base;
};

std::uintptr_t number(const void* at) { return reinterpret_cast<std::uintptr_t>(at); }

}  // namespace

TEST_CASE("reserved ranges are aligned, apart, and below the end of addresses") {
  const std::array<Range, 5> ranges;
  for (const Range& a : ranges) {
    REQUIRE(a.base != nullptr);
    CHECK(number(a.base) % kAlignment == 0);
    CHECK(number(a.base) + kBytes <= std::uintptr_t{1} << platform::kAddressBits);
    for (const Range& b : ranges) {
      CHECK((&a == &b || number(a.base) / kAlignment != number(b.base) / kAlignment));
    }
  }
}

TEST_CASE("committed memory holds what is written, also when more is committed behind it") {
  const std::size_t step = 4 * platform::page_bytes();
  const Range range;
  REQUIRE(range.base != nullptr);
  for (std::size_t end = step; end <= 8 * step; end += step) {
    REQUIRE(platform::commit(range.base + end - step, step));
    std::memset(range.base + end - step, static_cast<int>(end / step), step);
    platform::advise_huge_pages(range.base + end - step, step);
  }
  for (std::size_t i = 0; i < 8 * step; ++i) {
    REQUIRE(range.base[i] == static_cast<std::byte>(i / step + 1));
  }
}

TEST_CASE("discarded pages can be written again, and their neighbours are as they were") {
  const std::size_t page = platform::page_bytes();
  const Range range;
  REQUIRE(range.base != nullptr);
  REQUIRE(platform::commit(range.base, 3 * page));
  std::memset(range.base, 7, 3 * page);
  platform::discard(range.base + page, page);
  CHECK(range.base[page - 1] == std::byte{7});
  CHECK(range.base[2 * page] == std::byte{7});
  std::memset(range.base + page, 8, page);
  CHECK(range.base[page] == std::byte{8});
  CHECK(range.base[2 * page - 1] == std::byte{8});
}

TEST_CASE("a page is a power of two, and a stack has room for calls") {
  const std::size_t page = platform::page_bytes();
  CHECK((page >= 4096 && (page & (page - 1)) == 0));
  CHECK((std::size_t{2} << 20) % page == 0);  // arenas commit in steps of 2 MiB
  CHECK(platform::stack_bytes() >= std::size_t{1} << 18);
}

TEST_CASE("stamps tell objects of many arenas apart") {
  std::vector<std::unique_ptr<sac::Arena>> arenas;
  for (int i = 0; i < 8; ++i) arenas.push_back(std::make_unique<sac::Arena>());
  for (const auto& a : arenas) {
    const std::uint32_t stamp = sac::Arena::next_stamp(&a->header());
    for (const auto& b : arenas) {
      CHECK(sac::Arena::is_stamp_of(stamp, &b->header()) == (&a == &b));
    }
  }
}
