// Files of all processes, in steps that all take together.
#include "write_vtu_pieces.hpp"

#include <filesystem>

#include "mesher/write.hpp"

namespace mesher::detail {

namespace {

std::string piece_name(const std::string& index, std::size_t process) {
  return index.substr(0, index.rfind('.')) + "_" + std::to_string(process) + ".vtu";
}

std::string escaped(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (c == '&') {
      all += "&amp;";
    } else if (c == '<') {
      all += "&lt;";
    } else if (c == '"') {
      all += "&quot;";
    } else {
      all += c;
    }
  }
  return all;
}

// The arrays of a .vtu file without features.
void write_index(const std::string& path, std::size_t processes, TextFile& file) {
  file << "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<PUnstructuredGrid GhostLevel=\"0\">\n"
          "<PPointData Scalars=\"kind\">\n<PDataArray type=\"UInt8\" Name=\"kind\"/>\n"
          "</PPointData>\n<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" "
          "NumberOfComponents=\"3\"/>\n</PPoints>\n";
  const std::string name = std::filesystem::path(path).filename().string();
  for (std::size_t k = 0; k < processes; ++k) {
    file << "<Piece Source=\"" << escaped(piece_name(name, k)) << "\"/>\n";
  }
  file << "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

void remove_old(const std::string& path) {
  std::error_code failure;
  std::filesystem::remove(path, failure);
  if (failure) throw Error(ErrorCode::cannot_write, failure.message(), {path});
}

template <int D>
void write_vtu_pieces(Peers& peers, const std::function<Mesh<D>()>& own_mesh,
                      const std::string& path) {
  const bool is_first = peers.self() == 0;
  OutputFiles piece, index;
  together(peers, [&] {
    const auto writer = open_mesh<D>(piece, piece_name(path, peers.self()));
    if (is_first) write_index(path, peers.size(), index.open(path));
    writer(own_mesh());
  });
  together(peers, [&] {
    if (is_first) remove_old(path);
  });
  together(peers, [&] { piece.commit(); });
  together(peers, [&] {
    if (is_first) index.commit();
  });
}

template void write_vtu_pieces<2>(Peers&, const std::function<Mesh<2>()>&, const std::string&);
template void write_vtu_pieces<3>(Peers&, const std::function<Mesh<3>()>&, const std::string&);

}  // namespace mesher::detail
