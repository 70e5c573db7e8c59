// traces render: a trace, or what two traces differ in, as a picture.
#include "traces/render.hpp"

#include <memory>

#include "commands.hpp"
#include "mesher/write.hpp"

namespace tool {
namespace {

struct Arguments {
  std::string a;
  std::string b;
  std::string output;
  traces::RenderOptions options;
};

void render(const Arguments& args) {
  mesher::OutputFiles files;
  files.protect(args.a);
  if (!args.b.empty()) files.protect(args.b);
  mesher::TextFile& file = files.open(args.output);
  file << (args.b.empty() ? traces::render(args.a, args.options)
                          : traces::render_difference(args.a, args.b, args.options));
  files.commit();
}

}  // namespace

void add_render(CLI::App& app) {
  const auto args = std::make_shared<Arguments>();
  CLI::App* sub = app.add_subcommand(
      "render", "Draws a trace, or two with the calls that only one of them has, as SVG");
  sub->add_option("A", args->a, "A trace file")->required();
  sub->add_option("B", args->b, "Another trace file");
  sub->add_option("-o", args->output, "The picture")->required()->type_name("FILE.svg");
  sub->add_option("--width", args->options.width, "In pixels, 200 to 20000")
      ->check(CLI::Range(200, 20000), "")
      ->type_name("N")
      ->capture_default_str();
  sub->add_option("--rows", args->options.rows, "Deeper calls share a row; 1 to 1000")
      ->check(CLI::Range(1, 1000), "")
      ->type_name("N")
      ->capture_default_str();
  sub->callback([args] { render(*args); });
}

}  // namespace tool
