#include "example_subject.hpp"

#include <algorithm>
#include <tuple>
#include <type_traits>

#include "apps/all.hpp"

namespace tool {
namespace {

template <class Visit>
void for_each_example(Visit&& visit) {
  [&]<class... App>(std::type_identity<std::tuple<App...>>) {
    (visit.template operator()<App>(), ...);
  }(std::type_identity<apps::All>());
}

std::string option_name(std::string name) {
  std::erase(name, ',');
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

}  // namespace

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for_each_example([&]<class App>() { names.push_back(option_name(App::kName)); });
  return names;
}

std::unique_ptr<RecordedSubject> make_example(const std::string& name, std::uint64_t seed,
                                              int size) {
  std::unique_ptr<RecordedSubject> made;
  for_each_example([&]<class App>() {
    if (name == option_name(App::kName)) made = std::make_unique<AppSubject<App>>(seed, size);
  });
  return made;
}

}  // namespace tool
