// traces distance: how far two runs are apart.
#include "traces/distance.hpp"

#include <iomanip>
#include <iostream>
#include <memory>

#include "commands.hpp"

namespace tool {
namespace {

struct Arguments {
  std::string a;
  std::string b;
  bool json = false;
};

Json to_json(const traces::CallCounts& counts) {
  return {{"distance", counts.distance()},
          {"common", counts.common},
          {"calls_a", counts.calls_a},
          {"calls_b", counts.calls_b},
          {"weight_distance", counts.weight_distance},
          {"weight_a", counts.weight_a},
          {"weight_b", counts.weight_b},
          {"heaviest", counts.heaviest}};
}

void print_row(const traces::CallCounts& counts, const std::string& name) {
  for (const std::uint64_t count :
       {counts.distance(), counts.common, counts.calls_a, counts.calls_b, counts.weight_distance,
        counts.weight_a, counts.weight_b, counts.heaviest}) {
    std::cout << std::setw(10) << count << ' ';
  }
  std::cout << ' ' << name << '\n';
}

void print_distance(const traces::Distance& d) {
  std::cout << "                        calls                           weight of the calls\n"
               "  distance     common    calls_a    calls_b   distance          a          b   "
               "heaviest   function\n";
  for (const auto& [name, counts] : d.by_function) print_row(counts, name);
  print_row(d.all, "all");
}

void distance(const Arguments& args) {
  const traces::Trace a = traces::load_trace(args.a), b = traces::load_trace(args.b);
  warn_of_unnamed(args.a, a);
  warn_of_unnamed(args.b, b);
  const traces::Distance d = traces::distance(a, b);
  if (!args.json) return print_distance(d);
  Json object = to_json(d.all);
  object["unnamed_a"] = a.unnamed;
  object["unnamed_b"] = b.unnamed;
  object["functions"] = Json::object();
  for (const auto& [name, counts] : d.by_function) object["functions"][name] = to_json(counts);
  print_json(object);
}

}  // namespace

void add_distance(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  CLI::App* sub =
      app.add_subcommand("distance", "Counts the calls that only one of two traces has");
  sub->add_option("A", args->a, "A trace file")->required();
  sub->add_option("B", args->b, "Another trace file")->required();
  sub->add_flag("--json", args->json, "One JSON object instead of a table");
  sub->footer(
      "A call weighs 1 plus the steps that it reported, if these were recorded. By weight,\n"
      "the distance is the sum of the weights of calls that only one trace has; heaviest is\n"
      "the greatest of these weights.");
  sub->callback([args] { distance(*args); });
}

}  // namespace tool
