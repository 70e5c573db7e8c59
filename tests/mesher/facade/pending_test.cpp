// Pending edits leave nothing behind that later updates would pay for.
#include "facade/pending.hpp"

#include <catch2/catch.hpp>

#include "mesher/extra/generate.hpp"

using mesher::PointId;

TEST_CASE("after a large batch was announced and forgotten, forgetting costs what it did before") {
  const mesher::detail::MeshBox<2> box{.lo = {0, 0}, .side = 4};
  mesher::detail::Pending<2> pending(box);
  const std::size_t none = pending.buckets();
  std::int64_t id = 0;
  for (const auto& p : mesher::generate_points<2>(mesher::PointKind::uniform, 1000, 3)) {
    pending.set(PointId{++id}, {}, p);
  }
  CHECK(pending.buckets() > 1000);
  pending.clear();
  CHECK(pending.buckets() == none);
  CHECK(pending.growth() == 0);
}
