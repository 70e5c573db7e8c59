// Completion scripts for bash, zsh and fish.
#include <sstream>

#include "shell.hpp"

namespace tool::shell {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string replaced(const std::string& text, const std::string& special,
                     const std::string& before) {
  std::string safe;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) safe += before;
    safe += c;
  }
  return safe;
}

// In single quotes, for bash and zsh.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + safe + "'";
}

std::vector<std::string> names_of_commands(const ProgramWords& program) {
  std::vector<std::string> names;
  for (const CommandWords& command : program.commands) names.push_back(command.name);
  return names;
}

std::vector<std::string> names_of_options(const CommandWords& command) {
  std::vector<std::string> names;
  for (const OptionWords& option : command.options) {
    if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

// --- bash ----------------------------------------------------------------------------------------

std::string bash_cases(const CommandWords& command, const OptionWords& option) {
  std::vector<std::string> cases;
  for (const std::string& name : option.names) cases.push_back(quoted(command.name + " " + name));
  return joined(cases, " | ");
}

// What follows an option, or stands for a positional.
std::string bash_choice(const OptionWords& option) {
  if (option.takes_file) return "files=yes";
  return "words=" + quoted(joined(option.values));
}

void write_bash_command(std::ostream& out, const CommandWords& command) {
  for (const OptionWords& option : command.options) {
    if (option.positional || option.value.empty()) continue;
    out << "    " << bash_cases(command, option) << ") " << bash_choice(option) << " ;;\n";
  }
  out << "    " << quoted(command.name + " ") << "*)\n"
      << "      if [[ $current == -* ]]; then\n"
      << "        words=" << quoted(joined(names_of_options(command))) << "\n"
      << "      else\n";
  std::string choice = ":";
  for (const OptionWords& option : command.options) {
    if (option.positional) choice = bash_choice(option);
  }
  out << "        " << choice << "\n"
      << "      fi ;;\n";
}

// --- zsh -----------------------------------------------------------------------------------------

std::string zsh_action(const OptionWords& option) {
  if (option.takes_file) return "_files";
  return option.values.empty() ? " " : "(" + joined(option.values) + ")";
}

std::string zsh_option(const OptionWords& option) {
  const std::string about = replaced(brief(option.about), "[]:\\", "\\");
  const std::string value =
      option.value.empty() ? ""
                           : ":" + replaced(option.value, ":\\", "\\") + ":" + zsh_action(option);
  std::string specs;
  for (const std::string& name : option.names) {
    const std::string once = option.repeats ? "*" : "(" + joined(option.names) + ")";
    const std::string equals = option.value.empty() || name.rfind("--", 0) != 0 ? "" : "=";
    specs += " \\\n        " + quoted(once + name + equals + "[" + about + "]" + value);
  }
  return specs;
}

std::string zsh_positional(const OptionWords& option) {
  return " \\\n        " + quoted("*:" + option.names[0] + ":" + zsh_action(option));
}

// --- fish ----------------------------------------------------------------------------------------

std::string fish_quoted(const std::string& text) { return "'" + replaced(text, "'\\", "\\") + "'"; }

std::string fish_line(const ProgramWords& program, const CommandWords& command) {
  return "complete -c " + program.name + " -n '__fish_seen_subcommand_from " + command.name + "'";
}

void write_fish_option(std::ostream& out, const std::string& line, const OptionWords& option) {
  out << line;
  for (const std::string& name : option.names) {
    out << (name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1));
  }
  if (!option.value.empty()) out << (option.takes_file ? " -r -F" : " -x");
  if (!option.values.empty()) out << " -a " << fish_quoted(joined(option.values));
  out << " -d " << fish_quoted(brief(option.about)) << "\n";
}

}  // namespace

std::string bash_completion(const ProgramWords& program) {
  std::ostringstream out;
  out << "# bash completion of " << program.name << ", printed by '" << program.name
      << " completion bash'\n"
      << "_" << program.name << "() {\n"
      << "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
      << "  local command=${COMP_WORDS[1]} words= files=\n"
      << "  if [[ $current == = ]]; then  # --option=\n"
      << "    current=\n"
      << "  elif [[ $before == = ]]; then\n"
      << "    before=${COMP_WORDS[COMP_CWORD-2]}\n"
      << "  fi\n"
      << "  ((COMP_CWORD > 1)) || command=\n"
      << "  case \"$command $before\" in\n"
      << "    ' '*) words="
      << quoted(joined(names_of_commands(program)) + " " + joined(names_of_options(program.itself)))
      << " ;;\n";
  for (const CommandWords& command : program.commands) write_bash_command(out, command);
  out << "  esac\n"
      << "  COMPREPLY=()\n"
      << "  if [[ -n $files ]]; then\n"
      << "    compopt -o filenames 2>/dev/null\n"
      << "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
      << "  else\n"
      << "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
      << "  fi\n"
      << "}\n"
      << "complete -F _" << program.name << " " << program.name << "\n";
  return out.str();
}

std::string zsh_completion(const ProgramWords& program) {
  std::ostringstream out;
  out << "#compdef " << program.name << "\n"
      << "# zsh completion of " << program.name << ", printed by '" << program.name
      << " completion zsh'\n"
      << "_" << program.name << "() {\n"
      << "  local state line curcontext=$curcontext\n"
      << "  local -a commands\n"
      << "  typeset -A opt_args\n"
      << "  _arguments -C";
  for (const OptionWords& option : program.itself.options) out << zsh_option(option);
  out << " \\\n    '1:command:->command' '*::argument:->argument'\n"
      << "  case $state in\n"
      << "    command)\n"
      << "      commands=(";
  for (const CommandWords& command : program.commands) {
    out << "\n        " << quoted(command.name + ":" + brief(command.about));
  }
  out << ")\n"
      << "      _describe -t commands command commands ;;\n"
      << "    argument)\n"
      << "      case $line[1] in\n";
  for (const CommandWords& command : program.commands) {
    out << "      " << command.name << ")\n        _arguments";
    for (const OptionWords& option : command.options) {
      out << (option.positional ? zsh_positional(option) : zsh_option(option));
    }
    out << " ;;\n";
  }
  out << "      esac ;;\n"
      << "  esac\n"
      << "}\n"
      << "if [[ $funcstack[1] == _" << program.name << " ]]; then\n"
      << "  _" << program.name << " \"$@\"\n"
      << "else\n"
      << "  compdef _" << program.name << " " << program.name << "\n"
      << "fi\n";
  return out.str();
}

std::string fish_completion(const ProgramWords& program) {
  std::ostringstream out;
  out << "# fish completion of " << program.name << ", printed by '" << program.name
      << " completion fish'\n"
      << "complete -c " << program.name << " -f\n";
  const std::string first = "complete -c " + program.name + " -n __fish_use_subcommand";
  for (const OptionWords& option : program.itself.options) write_fish_option(out, first, option);
  for (const CommandWords& command : program.commands) {
    out << first << " -a " << command.name << " -d " << fish_quoted(brief(command.about)) << "\n";
  }
  for (const CommandWords& command : program.commands) {
    const std::string line = fish_line(program, command);
    for (const OptionWords& option : command.options) {
      if (!option.positional) {
        write_fish_option(out, line, option);
      } else if (option.takes_file) {
        out << line << " -F\n";
      } else if (!option.values.empty()) {
        out << line << " -a " << fish_quoted(joined(option.values)) << "\n";
      }
    }
  }
  return out.str();
}

}  // namespace tool::shell
