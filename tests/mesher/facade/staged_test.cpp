// Values as the last update left them, and as they shall be.
#include "facade/staged.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace {

using Table = mesher::detail::Staged<int, std::string>;

// "key:was>is", ascending; "-": it is not there.
std::vector<std::string> edits(const Table& table) {
  std::vector<std::string> all;
  const auto text = [](const std::string* value) { return value == nullptr ? "-" : *value; };
  table.for_each_edit([&](int key, const std::string* was, const std::string* is) {
    all.push_back(std::to_string(key) + ":" + text(was) + ">" + text(is));
  });
  return all;
}

Table one_and_two() {
  Table table;
  table.set(2, "two");
  table.set(1, "one");
  table.prepare();
  table.commit();
  return table;
}

}  // namespace

TEST_CASE("only the difference to the last update is an edit, whatever was said before") {
  Table table = one_and_two();
  CHECK(edits(table).empty());
  table.set(3, "three");
  table.set(2, std::nullopt);
  table.set(1, std::nullopt);
  table.set(1, "one");
  table.set(4, "four");
  table.set(4, std::nullopt);
  CHECK(edits(table) == std::vector<std::string>{"2:two>-", "3:->three"});
  CHECK(*table.find(3) == "three");
  CHECK(table.find(2) == nullptr);
  CHECK(table.committed().size() == 2);
}

TEST_CASE("edits that are discarded leave what the last update left, also when they are prepared") {
  Table table = one_and_two();
  table.set(1, std::nullopt);
  table.set(3, "three");
  table.prepare();
  table.discard();
  CHECK(edits(table).empty());
  CHECK(*table.find(1) == "one");
  CHECK(table.find(3) == nullptr);
}

TEST_CASE("a key goes, another comes and one changes when edits are committed") {
  Table table = one_and_two();
  table.set(1, std::nullopt);
  table.set(2, "deux");
  table.set(3, "three");
  table.prepare();
  table.commit();
  CHECK(edits(table).empty());
  CHECK(table.committed() == std::map<int, std::string>{{2, "deux"}, {3, "three"}});
}
