// Runs a fuzz target, without libFuzzer, on the files of a folder and on mutations of them, the
// same in every run:  replay FOLDER MUTATIONS_OF_EACH
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "random.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A few bytes changed, one left out or doubled, or a stretch of another file put in.
void mutate(Bytes& bytes, const Bytes& other, support::Random& random) {
  for (int times = 1 + random(4); times > 0 && !bytes.empty(); --times) {
    const auto at = bytes.begin() + random(static_cast<int>(bytes.size()));
    switch (random(4)) {
      case 0:
        bytes.erase(at);
        break;
      case 1:
        bytes.insert(at, *at);
        break;
      case 2:
        *at = static_cast<std::uint8_t>(random(256));
        break;
      default:
        if (other.empty()) break;
        const int from = random(static_cast<int>(other.size()));
        const int length = std::min(12, static_cast<int>(other.size()) - from);
        bytes.insert(at, other.begin() + from, other.begin() + from + length);
    }
  }
}

void run(const Bytes& bytes) { LLVMFuzzerTestOneInput(bytes.data(), bytes.size()); }

}  // namespace

int main(int argc, char** argv) {
  int mutations = -1;
  if (argc == 3) {
    const std::string_view number = argv[2];
    std::from_chars(number.data(), number.data() + number.size(), mutations);
  }
  if (mutations < 0) {
    std::fprintf(stderr, "replay FOLDER MUTATIONS_OF_EACH\n");
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Bytes> corpus;
  for (const auto& file : files) corpus.push_back(content_of(file));
  if (corpus.empty()) {
    std::fprintf(stderr, "replay: no files in %s\n", argv[1]);
    return 1;
  }
  support::Random random(1);
  for (const Bytes& bytes : corpus) {
    run(bytes);
    for (int i = 0; i < mutations; ++i) {
      Bytes mutation = bytes;
      mutate(mutation, corpus[static_cast<std::size_t>(random(static_cast<int>(corpus.size())))],
             random);
      run(mutation);
    }
  }
  std::printf("%zu files, %d mutations of each\n", corpus.size(), mutations);
  return 0;
}
