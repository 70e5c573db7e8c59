// The subcommands `completion` and `manual`.
#include "shell.hpp"

#include <iostream>
#include <memory>

namespace tool::shell {
namespace {

std::string completion(const ProgramWords& program, const std::string& shell) {
  if (shell == "bash") return bash_completion(program);
  return shell == "zsh" ? zsh_completion(program) : fish_completion(program);
}

std::string footer_of(const std::string& name) {
  return "Examples:\n"
         "  source <(" +
         name +
         " completion bash)     in ~/.bashrc\n"
         "  source <(" +
         name +
         " completion zsh)      in ~/.zshrc, after compinit\n"
         "  " +
         name +
         " completion fish | source      in ~/.config/fish/config.fish\n"
         "The Debian package has these files where the shells look for them.";
}

}  // namespace

void add_commands(CLI::App& app) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* const completes = app.add_subcommand(
      "completion", "Prints a script by which a shell completes commands, options and files.");
  completes->add_option("SHELL", *shell, "The shell")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completes->footer(footer_of(app.get_name()));
  completes->callback([&app, shell] { std::cout << completion(words_of(app), *shell); });
  app.add_subcommand("manual", "Prints the manual page.")->group("")->callback([&app] {
    std::cout << manual_page(words_of(app));
  });
}

}  // namespace tool::shell
