// The words of a command line from CLI11's tree.
#include "words.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace tool::shell {
namespace {

constexpr std::size_t kBrief = 70;  // characters of a line that lists a choice

std::string paragraph(const std::string& text) {
  std::istringstream words(text);
  std::string flat, word;
  while (words >> word) flat += (flat.empty() ? "" : " ") + word;
  return flat;
}

// "TEXT:{2,3}" is a type with the values that a validator admits: {"2", "3"}.
std::vector<std::string> values_of(const std::string& type) {
  const std::size_t begin = type.find(":{"), end = type.find('}');
  std::vector<std::string> values;
  if (begin == std::string::npos || end == std::string::npos) return values;
  std::istringstream list(type.substr(begin + 2, end - begin - 2));
  for (std::string value; std::getline(list, value, ',');) values.push_back(value);
  return values;
}

// Help names a file by one of these words; FILE may have an extension.
bool is_file(const std::string& word) {
  constexpr std::array<std::string_view, 6> kFiles = {"OUT", "EDITS", "INPUT", "MESH", "A", "B"};
  return word.rfind("FILE", 0) == 0 ||
         std::find(kFiles.begin(), kFiles.end(), word) != kFiles.end();
}

OptionWords option_words(const CLI::Option& option) {
  OptionWords words;
  words.positional = !option.nonpositional();
  words.about = paragraph(option.get_description());
  words.by_default = option.get_default_str();
  words.repeats = option.get_expected_max() > 1;
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  if (option.get_items_expected_max() == 0) return words;
  const std::string type = option.get_type_name();
  words.values = values_of(type);
  words.value = type.substr(0, type.find(':'));
  if (!option.get_option_text().empty() && !words.positional)
    words.value = option.get_option_text();
  if (words.positional) words.names = {option.get_name(true)};
  // --max-area A is a number; a positional A is a file.
  const bool letter = words.value.size() == 1;
  words.takes_file = words.positional ? is_file(words.names[0]) : !letter && is_file(words.value);
  return words;
}

CommandWords command_words(const CLI::App& command) {
  CommandWords words{
      command.get_name(), paragraph(command.get_description()), command.get_footer(), {}};
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_group().empty()) words.options.push_back(option_words(*option));
  }
  return words;
}

}  // namespace

ProgramWords words_of(const CLI::App& app) {
  ProgramWords words{app.get_name(), app.version(), command_words(app), {}};
  words.itself.name.clear();
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) words.commands.push_back(command_words(*command));
  }
  return words;
}

std::string brief(const std::string& about) {
  const std::size_t sentence = std::min(about.find(". "), about.find("; "));
  std::string text = about.substr(0, sentence);
  if (!text.empty() && text.back() == '.') text.pop_back();
  return text.size() > kBrief ? text.substr(0, text.rfind(' ', kBrief)) + " ..." : text;
}

}  // namespace tool::shell
