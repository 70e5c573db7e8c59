// What a command line consists of, as CLI11's tree of commands and options has it. Completion
// scripts and the manual page are made of this, and so of the description that parses arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tool::shell {

/// An option, a flag or a positional.
struct OptionWords {
  std::vector<std::string> names;   // --dimension, --dim; of a positional its name alone
  std::string about;                // one paragraph, without line breaks
  std::string value;                // what stands for its value in the help: "FILE"; empty: a flag
  std::vector<std::string> values;  // all that it takes, where these are few
  std::string by_default;           // its value where it is not given, if help shows that
  bool positional = false;
  bool takes_file = false;
  bool repeats = false;  // -o A -o B
};

struct CommandWords {
  std::string name;    // empty: the program itself
  std::string about;   // one paragraph
  std::string footer;  // lines
  std::vector<OptionWords> options;
};

struct ProgramWords {
  std::string name, version;
  CommandWords itself;
  std::vector<CommandWords> commands;
};

/// The words of a program whose commands have all been added. What help hides is left out.
[[nodiscard]] ProgramWords words_of(const CLI::App& app);

/// The start of a text, at most a line of it, for a list of choices: its first sentence, or less.
[[nodiscard]] std::string brief(const std::string& about);

}  // namespace tool::shell
