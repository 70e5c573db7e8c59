// Files as Gmsh writes them for partitions.
#include "write_msh_pieces.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "geometry/box.hpp"
#include "mesher/write.hpp"
#include "write_vtu_pieces.hpp"

namespace mesher::detail {

namespace {

constexpr std::size_t kSent = std::size_t{1} << 22;  // bytes at once

// Text as a TextFile writes it.
class Text {
 public:
  Text& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  Text& operator<<(char c) {
    text_ += c;
    return *this;
  }
  template <class Number>
  requires std::is_arithmetic_v<Number> Text& operator<<(Number value) {
    char digits[32];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }
  [[nodiscard]] std::string_view view() const noexcept { return text_; }
  void clear() noexcept { text_.clear(); }

 private:
  std::string text_;
};

template <std::size_t N, class Out>
void write_place(const std::array<double, N>& p, Out& out) {
  for (std::size_t i = 0; i < 3; ++i) out << (i == 0 ? "" : " ") << (i < N ? p[i] : 0.0);
}
template <int D, class Out>
void write_box(const Box<D>& box, Out& out) {
  write_place(box.lo, out);
  out << ' ';
  write_place(box.hi, out);
}

// The lines of a process. The entity 1 is the whole mesh; that of the partition k has the number
// k + 1, and a section has a block for each.
template <int D>
struct MshLines {
  static constexpr const char* kCounts = D == 2 ? "0 0 1 0\n" : "0 0 0 1\n";

  std::size_t partition;  // from 1

  template <class Out>
  static void write_header(const Box<D>& extent, std::size_t partitions, Out& out) {
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n" << kCounts << "1 ";
    write_box<D>(extent, out);
    out << " 0 0\n$EndEntities\n$PartitionedEntities\n" << partitions << "\n0\n";
  }
  template <class Out>
  void write_entity(const Box<D>& box, Out& out) const {
    out << partition + 1 << ' ' << D << " 1 1 " << partition << ' ';
    write_box<D>(box, out);
    out << " 0 0\n";
  }
  template <class Out>
  void write_block(int kind, std::size_t count, Out& out) const {
    out << D << ' ' << partition + 1 << ' ' << kind << ' ' << count << '\n';
  }
};

// The lines of a block, each by its number: none, if it is empty.
template <int D, class Number, class Place>
struct NodeLines {
  MshLines<D> lines;
  std::size_t count;
  Number number;  // of the i-th node
  Place place;

  [[nodiscard]] std::size_t size() const { return count > 0 ? 1 + 2 * count : 0; }
  template <class Out>
  void write(std::size_t line, Out& out) const {
    if (line == 0) return lines.write_block(0, count, out);
    if (line <= count) {
      out << number(line - 1);
    } else {
      write_place(place(line - 1 - count), out);
    }
    out << '\n';
  }
};
template <int D, class Number, class Place>
NodeLines(MshLines<D>, std::size_t, Number, Place) -> NodeLines<D, Number, Place>;

template <int D>
struct ElementLines {
  MshLines<D> lines;
  const Mesh<D>& own;
  const JointNumbers<D>& numbers;

  [[nodiscard]] std::size_t size() const {
    return own.simplices.empty() ? 0 : 1 + own.simplices.size();
  }
  template <class Out>
  void write(std::size_t line, Out& out) const {
    constexpr int kType = D == 2 ? 2 : 4;  // a triangle, a tetrahedron
    if (line == 0) return lines.write_block(kType, own.simplices.size(), out);
    out << numbers.first_simplex + line;
    for (const std::uint32_t v : own.simplices[line - 1]) out << ' ' << numbers.vertices[v] + 1;
    out << '\n';
  }
};

template <int D>
struct EntityLine {
  MshLines<D> lines;
  const Mesh<D>& own;

  [[nodiscard]] static std::size_t size() { return 1; }
  template <class Out>
  void write(std::size_t, Out& out) const {
    lines.write_entity(bounding_box<D>(own.vertices), out);
  }
};

template <class Lines, class Out>
void write_all(const Lines& lines, Out& out) {
  for (std::size_t line = 0; line < lines.size(); ++line) lines.write(line, out);
}

// Of a section: blocks, and numbers from `first` on.
template <class Out>
void write_counts(std::uint64_t blocks, std::uint64_t count, std::uint64_t first,
                  std::uint64_t last, Out& out) {
  out << blocks << ' ' << count << ' ' << first << ' ' << last << '\n';
}

// A file of one process.
template <int D>
class MshPiece {
 public:
  MshPiece(const Mesh<D>& own, const JointNumbers<D>& numbers, std::size_t self, TextFile& file)
      : own_(own), numbers_(numbers), lines_{self + 1}, file_(file) {
    std::vector<bool> is_used(own.vertices.size());
    for (const auto& simplex : own.simplices) {
      for (const std::uint32_t v : simplex) is_used[v] = true;
    }
    for (std::uint32_t v = 0; v < is_used.size(); ++v) {
      if (is_used[v]) nodes_.push_back(v);
    }
  }

  void write(const Box<D>& extent, std::size_t size) {
    lines_.write_header(extent, size, file_);
    file_ << MshLines<D>::kCounts;
    lines_.write_entity(bounding_box<D>(own_.vertices), file_);
    file_ << "$EndPartitionedEntities\n$Nodes\n";
    write_nodes();
    file_ << "$EndNodes\n$Elements\n";
    const std::size_t count = own_.simplices.size();
    const std::uint64_t before = numbers_.first_simplex;
    write_counts(count > 0 ? 1 : 0, count, count > 0 ? before + 1 : 0,
                 count > 0 ? before + count : 0, file_);
    write_all(ElementLines<D>{lines_, own_, numbers_}, file_);
    file_ << "$EndElements\n";
  }

 private:
  void write_nodes() {
    const auto number = [&](std::size_t i) { return numbers_.vertices[nodes_[i]] + 1; };
    std::uint64_t first = nodes_.empty() ? 0 : number(0), last = first;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      first = std::min(first, number(i));
      last = std::max(last, number(i));
    }
    write_counts(nodes_.empty() ? 0 : 1, nodes_.size(), first, last, file_);
    const auto place = [&](std::size_t i) { return own_.vertices[nodes_[i]]; };
    write_all(NodeLines{lines_, nodes_.size(), number, place}, file_);
  }

  const Mesh<D>& own_;
  const JointNumbers<D>& numbers_;
  MshLines<D> lines_;
  TextFile& file_;
  std::vector<std::uint32_t> nodes_;  // that simplices have
};

// Of the parts of all processes.
template <int D>
Box<D> joint_extent(Peers& peers, const Mesh<D>& own) {
  Packer mine;
  together(peers, [&] {
    mine.put(std::uint8_t{!own.vertices.empty()});
    mine.put(bounding_box<D>(own.vertices));
  });
  std::optional<Box<D>> all;
  for (const Bytes& bytes : peers.gather(mine.bytes())) {
    Unpacker one(bytes);
    if (one.take<std::uint8_t>() == 0) continue;
    const auto box = one.take<Box<D>>();
    if (!all) all = box;
    grow(*all, box.lo), grow(*all, box.hi);
  }
  return all.value_or(Box<D>());
}

// How many processes have something.
std::uint64_t having(bool mine, Peers& peers) {
  std::uint64_t all = mine ? 1 : 0;
  peers.sum({&all, 1});
  return all;
}

// Appends the lines of all processes, in their order, to the file of the first. Of all.
template <class Lines>
void append(Peers& peers, const Lines& lines, TextFile* file) {
  Text text;
  Peers::Views out;
  together(peers, [&] { out.resize(peers.size()); });
  for (std::size_t from = 0; from < peers.size(); ++from) {
    const bool is_mine = from == peers.self();
    std::size_t next = 0;
    while (having(is_mine && next < lines.size(), peers) != 0) {
      together(peers, [&] {
        if (!is_mine) return;
        text.clear();
        for (; next < lines.size() && text.view().size() < kSent; ++next) lines.write(next, text);
        out[0] = std::as_bytes(std::span(text.view()));
      });
      const std::vector<Bytes> in = peers.exchange(out);
      together(peers, [&] {
        if (file == nullptr) return;
        const auto* begin = reinterpret_cast<const char*>(in[from].data());
        *file << std::string_view(begin, in[from].size());
      });
    }
    out[0] = {};
  }
}

}  // namespace

std::string msh_piece_name(const std::string& path, std::size_t process) {
  return path.substr(0, path.rfind('.')) + "_" + std::to_string(process + 1) + ".msh";
}

template <int D>
void write_msh_pieces(Peers& peers, const Mesh<D>& own, const JointNumbers<D>& numbers,
                      const std::string& path) {
  const Box<D> extent = joint_extent(peers, own);
  OutputFiles piece;
  std::string name;
  together(peers, [&] {
    name = msh_piece_name(path, peers.self());
    TextFile& file = piece.open(name);
    MshPiece<D>(own, numbers, peers.self(), file).write(extent, peers.size());
  });
  together(peers, [&] { remove_old(name); });
  together(peers, [&] { piece.commit(); });
}

template <int D>
void write_msh_partitions(Peers& peers, const Mesh<D>& own, const JointNumbers<D>& numbers,
                          const std::string& path) {
  const Box<D> extent = joint_extent(peers, own);
  const MshLines<D> lines{peers.self() + 1};
  OutputFiles files;
  TextFile* file = nullptr;  // of the first process
  // Writes what is said once for all, and then the lines of each process.
  const auto write = [&](const auto& once, const auto& each) {
    together(peers, [&] {
      if (file != nullptr) once(*file);
    });
    append(peers, each, file);
  };
  together(peers, [&] {
    if (peers.self() == 0) file = &files.open(path);
  });
  write(
      [&](TextFile& out) {
        lines.write_header(extent, peers.size(), out);
        out << (D == 2 ? "0 0 " : "0 0 0 ") << peers.size() << (D == 2 ? " 0\n" : "\n");
      },
      EntityLine<D>{lines, own});
  const std::uint64_t node_blocks = having(!numbers.owned.empty(), peers);
  const auto number = [&](std::size_t i) { return numbers.first_owned + i + 1; };
  const auto place = [&](std::size_t i) { return numbers.owned[i]; };
  write(
      [&](TextFile& out) {
        out << "$EndPartitionedEntities\n$Nodes\n";
        write_counts(node_blocks, numbers.all_vertices, std::min<std::uint64_t>(node_blocks, 1),
                     numbers.all_vertices, out);
      },
      NodeLines{lines, numbers.owned.size(), number, place});
  const std::uint64_t element_blocks = having(!own.simplices.empty(), peers);
  write(
      [&](TextFile& out) {
        out << "$EndNodes\n$Elements\n";
        write_counts(element_blocks, numbers.all_simplices,
                     std::min<std::uint64_t>(element_blocks, 1), numbers.all_simplices, out);
      },
      ElementLines<D>{lines, own, numbers});
  together(peers, [&] {
    if (file == nullptr) return;
    *file << "$EndElements\n";
    files.commit();
  });
}

#define MESHER_INSTANTIATE(D)                                                        \
  template void write_msh_pieces(Peers&, const Mesh<D>&, const JointNumbers<D>&,     \
                                 const std::string&);                                \
  template void write_msh_partitions(Peers&, const Mesh<D>&, const JointNumbers<D>&, \
                                     const std::string&)
MESHER_INSTANTIATE(2);
MESHER_INSTANTIATE(3);
#undef MESHER_INSTANTIATE

}  // namespace mesher::detail
