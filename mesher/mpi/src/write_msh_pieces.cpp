// Files as Gmsh writes them for partitions.
#include "write_msh_pieces.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "geometry/box.hpp"
#include "mesher/write.hpp"
#include "write_vtu_pieces.hpp"

namespace mesher::detail {

namespace {

template <std::size_t N>
void write_place(const std::array<double, N>& p, TextFile& file) {
  for (std::size_t i = 0; i < 3; ++i) file << (i == 0 ? "" : " ") << (i < N ? p[i] : 0.0);
}

// The entity 1 is the whole mesh; that of the partition k has the number k + 1.
template <int D>
class MshPiece {
 public:
  MshPiece(const Mesh<D>& own, const JointNumbers& numbers, std::size_t self, std::size_t size,
           const Box<D>& extent, TextFile& file)
      : own_(own), numbers_(numbers), self_(self), size_(size), extent_(extent), file_(file) {
    std::vector<bool> is_used(own.vertices.size());
    for (const auto& simplex : own.simplices) {
      for (const std::uint32_t v : simplex) is_used[v] = true;
    }
    for (std::uint32_t v = 0; v < is_used.size(); ++v) {
      if (is_used[v]) nodes_.push_back(v);
    }
  }

  void write() {
    file_ << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n" << kCounts << "1 ";
    write_box(extent_);
    file_ << " 0 0\n$EndEntities\n$PartitionedEntities\n" << size_ << "\n0\n" << kCounts;
    file_ << self_ + 2 << ' ' << D << " 1 1 " << self_ + 1 << ' ';
    write_box(bounding_box<D>(own_.vertices));
    file_ << " 0 0\n$EndPartitionedEntities\n";
    write_nodes();
    write_elements();
  }

 private:
  static constexpr const char* kCounts = D == 2 ? "0 0 1 0\n" : "0 0 0 1\n";
  static constexpr int kType = D == 2 ? 2 : 4;  // a triangle, a tetrahedron

  [[nodiscard]] std::uint64_t number(std::uint32_t v) const { return numbers_.vertices[v] + 1; }
  void write_box(const Box<D>& box) {
    write_place(box.lo, file_);
    file_ << ' ';
    write_place(box.hi, file_);
  }
  // A section of one block of the partition's entity; numbers from 1.
  void write_counts(std::size_t count, std::uint64_t first, std::uint64_t last, int kind) {
    file_ << (count > 0 ? 1 : 0) << ' ' << count << ' ' << first << ' ' << last << '\n';
    if (count > 0) file_ << D << ' ' << self_ + 2 << ' ' << kind << ' ' << count << '\n';
  }
  void write_nodes() {
    std::uint64_t first = nodes_.empty() ? 0 : number(nodes_.front()), last = first;
    for (const std::uint32_t v : nodes_) {
      first = std::min(first, number(v));
      last = std::max(last, number(v));
    }
    file_ << "$Nodes\n";
    write_counts(nodes_.size(), first, last, 0);
    for (const std::uint32_t v : nodes_) file_ << number(v) << '\n';
    for (const std::uint32_t v : nodes_) {
      write_place(own_.vertices[v], file_);
      file_ << '\n';
    }
    file_ << "$EndNodes\n";
  }
  void write_elements() {
    const std::size_t count = own_.simplices.size();
    const std::uint64_t before = numbers_.first_simplex;
    file_ << "$Elements\n";
    write_counts(count, count > 0 ? before + 1 : 0, count > 0 ? before + count : 0, kType);
    for (std::size_t i = 0; i < count; ++i) {
      file_ << before + i + 1;
      for (const std::uint32_t v : own_.simplices[i]) file_ << ' ' << number(v);
      file_ << '\n';
    }
    file_ << "$EndElements\n";
  }

  const Mesh<D>& own_;
  const JointNumbers& numbers_;
  std::size_t self_, size_;
  Box<D> extent_;
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

}  // namespace

std::string msh_piece_name(const std::string& path, std::size_t process) {
  return path.substr(0, path.rfind('.')) + "_" + std::to_string(process + 1) + ".msh";
}

template <int D>
void write_msh_pieces(Peers& peers, const Mesh<D>& own, const JointNumbers& numbers,
                      const std::string& path) {
  const Box<D> extent = joint_extent(peers, own);
  OutputFiles piece;
  std::string name;
  together(peers, [&] {
    name = msh_piece_name(path, peers.self());
    TextFile& file = piece.open(name);
    MshPiece<D>(own, numbers, peers.self(), peers.size(), extent, file).write();
  });
  together(peers, [&] { remove_old(name); });
  together(peers, [&] { piece.commit(); });
}

template void write_msh_pieces(Peers&, const Mesh<2>&, const JointNumbers&, const std::string&);
template void write_msh_pieces(Peers&, const Mesh<3>&, const JointNumbers&, const std::string&);
}  // namespace mesher::detail
