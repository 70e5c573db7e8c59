#include "example_subject.hpp"

#include <algorithm>

#include "apps/graphs.hpp"
#include "apps/lists.hpp"
#include "apps/text.hpp"

namespace tool {
namespace {

using namespace apps;

template <class... Apps, class Visit>
void for_each_app(Visit&& visit) {
  (visit.template operator()<Apps>(), ...);
}
template <class Visit>
void for_each_example(Visit&& visit) {
  for_each_app<ArrayApp, MapApp, FilterApp, ReverseApp, SumApp, MinimumApp, QuicksortApp,
               MergesortApp, QuickhullApp<spread_point>, DiameterApp<spread_point>,
               DistanceApp<1000>, ExpressionApp, ForestApp, SearchApp, ComponentsApp, SpellApp,
               StringApp, SheetApp>(visit);
}

std::string option_name(std::string name) {
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
