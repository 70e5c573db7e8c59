// A file: a line that names the format, the job, the length and checksum of the content, and it.
#include "tiles/halo_store.hpp"

#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "platform/files.hpp"

namespace mesher::detail {

namespace {

namespace fs = std::filesystem;

constexpr char kFormat[16] = "mesher tile 1\n";
constexpr const char* kUnfinished = ".part";
constexpr const char* kParts[] = {"points", "vertices", "simplices", "looks", "view"};

struct Header {
  char format[sizeof kFormat];
  std::uint64_t job, size, checksum;
};

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw Error(ErrorCode::cannot_write, why, {path});
}
[[noreturn]] void fail_lost(const std::string& path) {
  throw Error(ErrorCode::cannot_read, "a tile's file is not there any more, or was changed",
              {path});
}
[[noreturn]] void fail_system(const std::string& path) { fail(path, std::strerror(errno)); }

std::uint64_t checksum(std::span<const std::byte> bytes) {
  return ::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

void write(std::FILE* file, const void* bytes, std::size_t size, const std::string& path) {
  if (size != 0 && std::fwrite(bytes, 1, size, file) != size) fail_system(path);
}

// Where in the file of a tile's looks those at another are, and their checksum.
struct LooksAt {
  std::uint64_t tile, begin, count, checksum;
};
template <int D>
std::vector<LooksAt> table(const std::vector<HaloLook<D>>& looks) {
  std::vector<LooksAt> table;
  for (std::size_t i = 0; i < looks.size();) {
    const auto some = those_of(looks[i].tile, looks);
    table.push_back({looks[i].tile, i, some.size(), checksum(std::as_bytes(some))});
    i += some.size();
  }
  return table;
}

template <int D>
void pack(const HaloView<D>& view, Packer& to) {
  to.put_all(view.gives);
  to.put_all(view.receives);
  to.put(view.fault.has_value());
  if (view.fault) pack(*view.fault, to);
}

}  // namespace

template <int D>
FolderStore<D>::FolderStore(std::string folder, std::size_t tiles, std::uint64_t job)
    : folder_(std::move(folder)), tiles_(tiles), job_(job) {
  std::error_code failure;
  fs::create_directories(folder_, failure);
  if (failure) fail(folder_, failure.message());
  const std::string path = folder_ + "/job";
  const std::optional<Bytes> before = load(path);
  if (before) return;
  if (fs::exists(path)) {
    fail(folder_, "the folder has tiles of another input, or made with other options");
  }
  save(path, Packer());
}

template <int D>
void FolderStore<D>::put_points(std::size_t tile, Points points) {
  Packer content;
  content.put_all(points);
  save(path("points", tile), content);
}
template <int D>
auto FolderStore<D>::points(std::size_t tile) const -> Kept<Points> {
  const Bytes bytes = must_load(path("points", tile));
  return std::make_shared<const Points>(Unpacker(bytes).take_all<SpacedPoint<D>>());
}

// The view goes first and comes last: who has that has all of one run.
template <int D>
void FolderStore<D>::put_run(std::size_t tile, HaloRun<D> run) {
  platform::remove(path("view", tile));
  Packer content;
  content.put_all(run.vertices.places);
  content.put_all(run.vertices.kinds);
  content.put_all(run.vertices.born);
  save(path("vertices", tile), content);
  content.clear();
  content.put_all(run.simplices.foreign);
  content.put_all(run.simplices.simplices);
  save(path("simplices", tile), content);
  content.clear();
  content.put_all(run.looks);
  save(path("looks", tile), content);
  content.clear();
  content.put_all(table(run.looks));
  pack(run.view, content);
  save(path("view", tile), content);
}
template <int D>
bool FolderStore<D>::has_run(std::size_t tile) const {
  bool has_all = true;
  for (const char* what : {"view", "vertices", "simplices", "looks"}) {
    has_all = has_all && load(path(what, tile)).has_value();
  }
  return has_all;
}
template <int D>
auto FolderStore<D>::vertices(std::size_t tile) const -> Kept<HaloVertices<D>> {
  const Bytes bytes = must_load(path("vertices", tile));
  Unpacker from(bytes);
  auto vertices = std::make_shared<HaloVertices<D>>();
  vertices->places = from.take_all<Point<D>>();
  vertices->kinds = from.take_all<VertexKind>();
  vertices->born = from.take_all<Born<D>>();
  return vertices;
}
template <int D>
auto FolderStore<D>::simplices(std::size_t tile) const -> Kept<HaloSimplices<D>> {
  const Bytes bytes = must_load(path("simplices", tile));
  Unpacker from(bytes);
  auto simplices = std::make_shared<HaloSimplices<D>>();
  simplices->foreign = from.take_all<Point<D>>();
  simplices->simplices = from.take_all<std::array<std::uint32_t, D + 1>>();
  return simplices;
}
template <int D>
auto FolderStore<D>::view(std::size_t tile) const -> Kept<HaloView<D>> {
  const Bytes bytes = must_load(path("view", tile));
  Unpacker from(bytes);
  static_cast<void>(from.take_all<LooksAt>());
  auto view = std::make_shared<HaloView<D>>();
  view->gives = from.take_all<HaloBirth<D>>();
  view->receives = from.take_all<HaloBirth<D>>();
  if (from.take<bool>()) view->fault = unpack_error(from);
  return view;
}

template <int D>
auto FolderStore<D>::looks(std::size_t by, std::size_t at) const -> typename HaloStore<D>::Looks {
  const Bytes bytes = must_load(path("view", by));
  Unpacker from(bytes);
  const std::vector<LooksAt> all = from.take_all<LooksAt>();
  const auto part = those_of(at, all);
  if (part.empty()) return {};
  const std::string path = this->path("looks", by);
  std::ifstream file(path, std::ios::binary);
  const auto looks = std::make_shared<std::vector<HaloLook<D>>>(part[0].count);
  // Behind the header and the number of all.
  const std::uint64_t begin =
      sizeof(Header) + sizeof(std::uint64_t) + part[0].begin * sizeof(HaloLook<D>);
  file.seekg(static_cast<std::streamoff>(begin));
  file.read(reinterpret_cast<char*>(looks->data()),
            static_cast<std::streamsize>(looks->size() * sizeof(HaloLook<D>)));
  if (!file || checksum(std::as_bytes(std::span(*looks))) != part[0].checksum) fail_lost(path);
  return {looks, *looks};
}

template <int D>
void FolderStore<D>::remove() noexcept {
  try {
    const auto drop = [](const std::string& path) {
      platform::remove(path);
      platform::remove(path + kUnfinished);
    };
    for (std::size_t tile = 0; tile < tiles_; ++tile) {
      for (const char* what : kParts) drop(path(what, tile));
    }
    drop(folder_ + "/job");
    std::error_code failure;
    fs::remove(folder_, failure);  // not if something else is in it
  } catch (...) {                  // no memory for a name: the file stays
  }
}

template <int D>
std::string FolderStore<D>::path(const char* what, std::size_t tile) const {
  return folder_ + "/" + what + "_" + std::to_string(tile);
}

template <int D>
void FolderStore<D>::save(const std::string& path, const Packer& content) const {
  const std::string part = path + kUnfinished;
  Header header{{}, job_, content.bytes().size(), checksum(content.bytes())};
  std::memcpy(header.format, kFormat, sizeof kFormat);
  {
    const File file(platform::open_to_write(part));
    if (file == nullptr) fail_system(part);
    write(file.get(), &header, sizeof header, part);
    write(file.get(), content.bytes().data(), content.bytes().size(), part);
    if (std::fflush(file.get()) != 0) fail_system(part);
  }
  if (const std::error_code failure = platform::rename(part, path)) fail(path, failure.message());
}

template <int D>
std::optional<Bytes> FolderStore<D>::load(const std::string& path) const {
  const File file(std::fopen(path.c_str(), "rb"));
  Header header;
  if (file == nullptr || std::fread(&header, sizeof header, 1, file.get()) != 1) return {};
  std::error_code failure;
  const std::uintmax_t size = fs::file_size(path, failure);
  if (failure || std::memcmp(header.format, kFormat, sizeof kFormat) != 0 || header.job != job_ ||
      size != sizeof header + header.size) {
    return {};
  }
  Bytes bytes(static_cast<std::size_t>(header.size));
  if (!bytes.empty() && std::fread(bytes.data(), bytes.size(), 1, file.get()) != 1) return {};
  if (checksum(bytes) != header.checksum) return {};
  return bytes;
}
template <int D>
Bytes FolderStore<D>::must_load(const std::string& path) const {
  std::optional<Bytes> bytes = load(path);
  if (!bytes) fail_lost(path);
  return std::move(*bytes);
}

template class FolderStore<2>;
#ifndef MESHER_PLANE_ONLY
template class FolderStore<3>;
#endif

}  // namespace mesher::detail
