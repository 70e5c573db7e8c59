// The manual page. What help shows below the options is kept: its paragraphs are filled, and what
// is indented there (examples, tables) is shown as it is.
#include <algorithm>
#include <cctype>
#include <sstream>

#include "shell.hpp"

namespace tool::shell {
namespace {

// Text for roff: hyphens stay hyphens, and no line is taken for a request.
std::string safe(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + safe(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + safe(text) + "\\fR"; }

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string tag_of(const OptionWords& option) {
  std::string tag;
  for (const std::string& name : option.names) {
    tag += (tag.empty() ? "" : ", ") + (option.positional ? italic(name) : bold(name));
  }
  if (option.positional || option.value.empty()) return tag;
  return tag + " " + italic(option.value);
}

void write_option(std::ostream& out, const OptionWords& option) {
  out << ".TP\n" << tag_of(option) << "\n" << safe(option.about);
  const bool told =
      !option.values.empty() && option.about.find(option.values[0]) != std::string::npos;
  if (!option.values.empty() && !(option.positional && told)) {
    out << " (";
    for (std::size_t i = 0; i < option.values.size(); ++i) {
      out << (i == 0 ? "" : ", ") << bold(option.values[i]);
    }
    out << (option.by_default.empty() ? "" : "; default: " + safe(option.by_default)) << ")";
  } else if (!option.by_default.empty()) {
    out << " (default: " << safe(option.by_default) << ")";
  }
  out << "\n";
}

// A footer of help, or the part of it before `end`.
void write_footer(std::ostream& out, const std::string& footer) {
  std::istringstream lines(footer);
  bool shown = false;  // as it is
  out << ".PP\n";
  for (std::string line; std::getline(lines, line);) {
    const bool indented = line.rfind("  ", 0) == 0;
    if (indented != shown) out << (indented ? ".nf\n" : ".fi\n.PP\n");
    if (!indented && !shown && line == "Examples:") out << ".PP\n";
    shown = indented;
    out << safe(line) << "\n";
  }
  if (shown) out << ".fi\n";
}

void write_options(std::ostream& out, const CommandWords& command) {
  for (const bool positional : {true, false}) {
    for (const OptionWords& option : command.options) {
      if (option.positional == positional) write_option(out, option);
    }
  }
}

void write_command(std::ostream& out, const ProgramWords& program, const CommandWords& command) {
  std::string usage = program.name + " " + command.name + " [OPTIONS]";
  for (const OptionWords& option : command.options) {
    if (option.positional) usage += " " + option.names[0];
  }
  out << ".SS \"" << safe(usage) << "\"\n" << safe(command.about) << "\n";
  write_options(out, command);
  if (!command.footer.empty()) write_footer(out, command.footer);
}

// "Makes meshes of points, and updates them." is a name's "makes meshes of points, ...".
std::string in_a_sentence(std::string about) {
  if (!about.empty())
    about[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(about[0])));
  if (!about.empty() && about.back() == '.') about.pop_back();
  return about;
}

}  // namespace

std::string manual_page(const ProgramWords& program) {
  std::ostringstream out;
  out << ".TH " << capitals(program.name) << " 1 \"\" \"" << safe(program.version)
      << "\" \"User Commands\"\n"
      << ".SH NAME\n"
      << safe(program.name) << " \\- " << safe(in_a_sentence(program.itself.about)) << "\n"
      << ".SH SYNOPSIS\n"
      << bold(program.name) << " " << italic("COMMAND") << " [" << italic("OPTIONS") << "] "
      << italic("ARGUMENT") << " ...\n"
      << ".SH DESCRIPTION\n"
      << "Each command has options of its own, which the section\n.B COMMANDS\ndescribes; '"
      << safe(program.name) << " COMMAND --help' prints them.\n";
  write_footer(out, program.itself.footer);
  out << ".SH OPTIONS\n";
  write_options(out, program.itself);
  out << ".SH COMMANDS\n";
  for (const CommandWords& command : program.commands) write_command(out, program, command);
  return out.str();
}

}  // namespace tool::shell
