// What segments are called while an update goes on, and afterwards.
#include "facade/segment_names.hpp"

#include <catch2/catch.hpp>

using mesher::LineId;
using mesher::detail::SegmentNames;

TEST_CASE("after a large update of lines its names are forgotten at the cost of a small one") {
  SegmentNames names;
  const std::size_t none = names.buckets();
  for (std::uint32_t i = 1; i <= 1000; ++i) {
    names.add(i, LineId{i});
    names.take(i);
  }
  CHECK(names.buckets() > 2000);
  names.discard();
  CHECK(names.buckets() == none);
  CHECK(names.added().size() + names.taken().size() == 0);
}

TEST_CASE("a segment that goes, comes again or is taken back is called as it should be") {
  SegmentNames names;
  names.add(1, LineId{10});
  names.add(2, LineId{20});
  CHECK(names.was(1) == std::nullopt);
  CHECK(names.find(1) == LineId{10});
  names.prepare();
  names.commit();

  names.take(1);
  names.take(2);
  names.add(2, LineId{21});
  CHECK(names.find(1) == std::nullopt);
  CHECK(names.latest(1) == LineId{10});
  CHECK(names.find(2) == LineId{21});
  CHECK(names.was(2) == LineId{20});
  names.discard();
  CHECK(names.find(1) == LineId{10});
  CHECK(names.find(2) == LineId{20});

  names.take(1);
  names.add(5, LineId{10});
  names.prepare();
  names.commit();
  CHECK(names.was(1) == std::nullopt);
  CHECK(names.was(5) == LineId{10});
  CHECK(names.find(4) == std::nullopt);
  CHECK(names.find(99) == std::nullopt);
}
