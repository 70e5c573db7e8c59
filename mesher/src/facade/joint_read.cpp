// Shares of a file's lines; what counts lines before them is told by those who have these.
#include "facade/joint_read.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "facade/divided_points.hpp"
#include "io/line_points.hpp"
#include "io/read_points.hpp"
#include "io/rows.hpp"
#include "sets/counting_sort.hpp"

namespace mesher::detail {

namespace {

// How a file is divided, as the first process sees it.
struct Division {
  bool is_divided = false;
  std::uint64_t bytes = 0;
  std::string head;
};

// What cannot be divided is read by one, who says why if it cannot be read.
Division division_of(const std::string& path) {
  std::error_code none;
  if (!has_line_points(path) || !std::filesystem::is_regular_file(path, none)) return {};
  const auto bytes = std::filesystem::file_size(path, none);
  if (none || bytes == 0) return {};  // of some files the size is not known
  return {true, bytes, head_of(path)};
}

Division told_by_first(const std::string& path, Peers& peers) {
  Packer mine;
  together(peers, [&] {
    if (peers.self() != 0) return;
    const Division division = division_of(path);
    mine.put(std::uint8_t{division.is_divided});
    mine.put(division.bytes);
    mine.put_all(std::string_view(division.head));
  });
  const std::vector<Bytes> told = peers.gather(mine.bytes());
  Division division;
  together(peers, [&] {
    Unpacker rest(told[0]);
    division.is_divided = rest.take<std::uint8_t>() != 0;
    division.bytes = rest.take<std::uint64_t>();
    division.head = rest.take_text();
  });
  return division;
}

// The lines of one process. What comes before and after them is not known yet.
text::Share share_of(const std::string& path, const Division& all, const Peers& peers) {
  const std::uint64_t head = all.head.size(), bytes = std::max(all.bytes, head) - head;
  const auto begin_of = [&](std::size_t process) {
    const std::uint64_t size = peers.size();
    return head + bytes / size * process + std::min<std::uint64_t>(process, bytes % size);
  };
  text::Share share{.file = path, .is_first = peers.self() == 0};
  if (!share.is_first) share.head = all.head;
  const std::uint64_t begin = share.is_first ? 0 : begin_of(peers.self());
  share.lines = text::read_lines(path, begin, begin_of(peers.self() + 1));
  return share;
}

struct Counts {
  std::uint64_t lines, rows;
  std::uint64_t has_fields;  // as wide as the others: no gap
};

Counts counts_of(text::Share& share) {
  const std::string& lines = share.lines;
  auto ends = static_cast<std::uint64_t>(std::count(lines.begin(), lines.end(), '\n'));
  if (!lines.empty() && lines.back() != '\n') ++ends;
  const std::size_t rows = count_rows(share);
  std::string head;
  head.swap(share.head);
  const bool has_fields = !text::Lines(share).at_end();
  head.swap(share.head);
  return {ends, rows, has_fields ? 1U : 0U};
}

// Returns: how many rows there are in all shares.
std::uint64_t put_in_order(text::Share& share, Peers& peers) {
  Packer mine;
  together(peers, [&] { mine.put(counts_of(share)); });
  const std::vector<Bytes> told = peers.gather(mine.bytes());
  std::uint64_t rows = 0;
  for (std::size_t k = 0; k < told.size(); ++k) {
    const auto counts = Unpacker(told[k]).take<Counts>();
    rows += counts.rows;
    if (k < peers.self()) {
      share.lines_before += static_cast<long>(counts.lines);
      share.rows_before += static_cast<std::size_t>(counts.rows);
    }
    if (k > peers.self() && counts.has_fields != 0) share.is_followed = true;
  }
  return rows;
}

// --- What repeats ----------------------------------------------------------------------------

// A row of a point, and what must be its own alone.
template <class Key>
struct Keyed {
  Key key;
  std::uint64_t row;
  friend auto operator<=>(const Keyed&, const Keyed&) = default;
};

// Whether keys ascend from row to row, through all processes: then none repeats.
template <int D, class KeyOf>
bool ascend(const std::vector<GraphPoint<D>>& points, const KeyOf& key_of, Peers& peers) {
  Packer mine;
  together(peers, [&] {
    if (points.empty()) return;
    const bool here = std::adjacent_find(points.begin(), points.end(), [&](auto& a, auto& b) {
                        return key_of(a) >= key_of(b);
                      }) == points.end();
    mine.put(std::uint8_t{here});
    mine.put(key_of(points.front())), mine.put(key_of(points.back()));
  });
  using Key = decltype(key_of(points[0]));
  std::optional<Key> last;
  for (const Bytes& one : peers.gather(mine.bytes())) {
    if (one.empty()) continue;
    Unpacker rest(one);
    const bool there = rest.take<std::uint8_t>() != 0;
    const Key first = rest.take<Key>();
    if (!there || (last && *last >= first)) return false;
    last = rest.take<Key>();
  }
  return true;
}

// The first of all rows that repeats an earlier one. Equal keys come to one process.
template <int D, class KeyOf>
std::optional<Repeat> first_repeat(const std::vector<GraphPoint<D>>& points, std::size_t before,
                                   const KeyOf& key_of, Peers& peers) {
  if (ascend<D>(points, key_of, peers)) return std::nullopt;
  using Row = Keyed<decltype(key_of(points[0]))>;
  std::vector<Packer> out;
  together(peers, [&] {
    out.resize(peers.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto key = key_of(points[i]);
      out[row_hash(key) % out.size()].put(Row{key, before + i});
    }
  });
  std::vector<Bytes> in = told_each(out, peers);
  Packer mine;
  together(peers, [&] {
    out.clear();
    std::vector<Row> rows;
    for (Bytes& some : in) {
      for (Unpacker rest(some); !rest.is_empty();) rows.push_back(rest.take<Row>());
      some = Bytes();
    }
    sort_spread(
        rows, [](const Row& row) { return row_hash(row.key); },
        [](const Row& a, const Row& b) {
          const std::uint64_t i = row_hash(a.key), k = row_hash(b.key);
          return i != k ? i < k : a < b;
        });
    Repeat first{SIZE_MAX, SIZE_MAX};
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (rows[i - 1].key == rows[i].key && rows[i].row < first.later) {
        first = {static_cast<std::size_t>(rows[i - 1].row), static_cast<std::size_t>(rows[i].row)};
      }
    }
    mine.put(first);
  });
  Repeat first{SIZE_MAX, SIZE_MAX};
  for (const Bytes& one : peers.gather(mine.bytes())) {
    const auto repeat = Unpacker(one).take<Repeat>();
    if (repeat.later < first.later) first = repeat;
  }
  if (first.later == SIZE_MAX) return std::nullopt;
  return first;
}

// The two rows, in all processes, as if they were a file.
template <int D>
PointFile<D> rows_told(const Repeat& repeat, const GraphFile<D>& share, std::size_t before,
                       Peers& peers) {
  PointFile<D> two;
  for (const std::size_t row : {repeat.earlier, repeat.later}) {
    Packer mine;
    together(peers, [&] {
      const std::size_t i = row - before;
      if (row < before || i >= share.points.size()) return;
      mine.put(share.graph.points[i].id), mine.put(share.graph.points[i].at);
      mine.put(share.points[i].line);
    });
    const std::vector<Bytes> told = peers.gather(mine.bytes());
    together(peers, [&] {
      two.file = share.file;
      for (const Bytes& one : told) {
        if (one.empty()) continue;
        Unpacker rest(one);
        two.ids.push_back(rest.take<PointId>());
        two.points.push_back(rest.take<Point<D>>());
        two.lines.push_back(rest.take<long>());
      }
    });
  }
  return two;
}

template <int D>
void require_distinct(const GraphFile<D>& share, std::size_t before, CoincidingPoints coinciding,
                      Peers& peers) {
  const auto& points = share.graph.points;
  const auto id_of = [](const GraphPoint<D>& p) { return p.id; };
  if (const auto repeat = first_repeat<D>(points, before, id_of, peers)) {
    const PointFile<D> two = rows_told(*repeat, share, before, peers);
    together(peers, [&] { fail_repeated_id(two, {0, 1}); });
  }
  if (coinciding == CoincidingPoints::kept) return;
  const auto place_of = [](const GraphPoint<D>& p) { return p.at; };
  if (const auto repeat = first_repeat<D>(points, before, place_of, peers)) {
    const PointFile<D> two = rows_told(*repeat, share, before, peers);
    together(peers, [&] { fail_duplicate_point(two, {0, 1}); });
  }
}

}  // namespace

int joint_dimension(const std::string& path, Peers& peers) {
  const Division division = told_by_first(path, peers);
  std::uint64_t is_in_plane = 1;
  together(peers, [&] {
    if (division.is_divided) {
      const bool is_told = head_tells_dimension(path);
      const text::Share share =
          is_told ? text::Share{path, division.head} : share_of(path, division, peers);
      is_in_plane = is_in_space(share) ? 0 : 1;
    } else if (peers.self() == 0) {
      is_in_plane = dimension_of(path) == 3 ? 0 : 1;
    }
  });
  peers.least({&is_in_plane, 1});
  return is_in_plane != 0 ? 2 : 3;
}

template <int D>
GraphFile<D> joint_read(const std::string& path, const ReadOptions& options, Peers& peers) {
  GraphFile<D> file;
  const Division division = told_by_first(path, peers);
  if (!division.is_divided) {
    together(peers, [&] {
      if (peers.self() == 0) file = read<D>(path, options);
    });
    return file;
  }
  text::Share share;
  together(peers, [&] { share = share_of(path, division, peers); });
  const std::uint64_t rows = put_in_order(share, peers);
  // The first that fails has what is wrong first.
  together(peers, [&] {
    file = read_share<D>(share);
    std::string().swap(share.lines);
    require_indexable(static_cast<std::size_t>(rows), path);
  });
  require_distinct(file, share.rows_before, options.coinciding, peers);
  return file;
}

template <int D>
Error joint_located(const Error& error, const GraphFile<D>& share, Peers& peers) {
  Packer mine;
  together(peers, [&] {
    for (const mesher::Feature& feature : error.features()) {
      pack(location_of(feature, share), mine);
    }
  });
  const std::vector<Bytes> told = peers.gather(mine.bytes());
  std::optional<Error> found;
  together(peers, [&] {
    std::vector<FileLocation> of_all(error.features().size());
    for (const Bytes& one : told) {
      Unpacker rest(one);
      for (FileLocation& at : of_all) {
        FileLocation here = unpack_location(rest);
        if (at.file.empty() || here.line > 0) at = std::move(here);
      }
    }
    std::size_t next = 0;
    found = located(error, [&](const mesher::Feature&) { return of_all[next++]; });
  });
  return std::move(*found);
}

template GraphFile<2> joint_read(const std::string&, const ReadOptions&, Peers&);
template Error joint_located(const Error&, const GraphFile<2>&, Peers&);
#ifndef MESHER_PLANE_ONLY
template GraphFile<3> joint_read(const std::string&, const ReadOptions&, Peers&);
template Error joint_located(const Error&, const GraphFile<3>&, Peers&);
#endif

}  // namespace mesher::detail
