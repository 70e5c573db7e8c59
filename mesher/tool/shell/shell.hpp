// The subcommands by which a program describes itself: completion scripts for shells, and its
// manual page. Both print what the tree of commands and options says (words.hpp); nothing is
// written twice.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "words.hpp"

namespace tool::shell {

/// Adds `completion SHELL`, and `manual`, which help does not list. When one of them is called,
/// `app` must have all other commands.
void add_commands(CLI::App& app);

/// Scripts that complete commands, options, their values, and files.
[[nodiscard]] std::string bash_completion(const ProgramWords& program);
[[nodiscard]] std::string zsh_completion(const ProgramWords& program);
[[nodiscard]] std::string fish_completion(const ProgramWords& program);

/// The manual page, for section 1, in the language of man(7).
[[nodiscard]] std::string manual_page(const ProgramWords& program);

}  // namespace tool::shell
