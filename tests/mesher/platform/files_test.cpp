// What output files rely on in the file of the operating system, whichever that is.
#include "platform/files.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "scratch_file.hpp"

namespace {

namespace platform = mesher::platform;
using support::ScratchFolder;

}  // namespace

TEST_CASE("a file is created once: a name that is taken, by a folder too, is refused") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("folder"));
  CHECK_FALSE(platform::create(folder.path("a")));
  CHECK(std::filesystem::file_size(folder.path("a")) == 0);
  CHECK(platform::create(folder.path("a")) == std::errc::file_exists);
  CHECK(platform::create(folder.path("folder")) == std::errc::file_exists);
  CHECK(platform::create(folder.path("nowhere/a")) == std::errc::no_such_file_or_directory);
  CHECK(folder.count() == 2);
}

TEST_CASE("bytes are written as they are") {
  const ScratchFolder folder;
  std::FILE* const file = platform::open_to_write(folder.path("a"));
  REQUIRE(file != nullptr);
  CHECK(std::fputs("a\nb\r\n", file) >= 0);
  CHECK(std::fclose(file) == 0);
  CHECK(folder.read("a") == "a\nb\r\n");
  CHECK(platform::open_to_write(folder.path("nowhere/a")) == nullptr);
}

TEST_CASE("to ask whether a file may be written leaves it as it is") {
  const ScratchFolder folder;
  const std::string path = folder.write("a", "content");
  const auto before = std::filesystem::last_write_time(path);
  CHECK_FALSE(platform::why_not_writable(path));
  CHECK(folder.read("a") == "content");
  CHECK(std::filesystem::last_write_time(path) == before);
}

TEST_CASE("a file takes the place of another, or nothing changes") {
  const ScratchFolder folder;
  folder.write("a", "new");
  folder.write("b", "old");
  std::filesystem::create_directory(folder.path("folder"));
  CHECK(platform::rename(folder.path("a"), folder.path("folder")));
  CHECK(platform::rename(folder.path("missing"), folder.path("b")));
  CHECK(folder.read("b") == "old");
  CHECK_FALSE(platform::rename(folder.path("a"), folder.path("b")));
  CHECK(folder.read("b") == "new");
  CHECK(folder.count() == 2);
  platform::remove(folder.path("b"));
  platform::remove(folder.path("b"));
  CHECK(folder.count() == 1);
}
