#include "master/front/cli/reference/command_tree.h"

#include <algorithm>
#include <regex>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/study/verify/checks.h"

namespace stride::cli::reference {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t first = 0;
  for (std::size_t at = 0; at <= text.size(); ++at) {
    if (at < text.size() && text[at] != separator) continue;
    parts.push_back(text.substr(first, at - first));
    first = at + 1;
  }
  return parts;
}

/// Of "FILE.fmu", "IN.vcd", or else those that are words of the description: ".ssd".
std::vector<std::string> extensions(const std::string& placeholder, const std::string& text) {
  static const std::regex in_text(R"((^|[^\w])\.([a-z][a-z0-9]+)\b)");
  const std::size_t dot = placeholder.rfind('.');
  if (dot != std::string::npos) return {placeholder.substr(dot + 1)};
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), in_text), end; match != end; ++match) {
    const std::string extension = (*match)[2];
    if (std::ranges::find(found, extension) == found.end()) found.push_back(extension);
  }
  return found;
}

std::vector<std::string> check_names() {
  std::vector<std::string> names;
  for (const verify::UnitCheck& check : verify::checks()) names.emplace_back(check.name);
  return names;
}

Value value_of(const std::string& placeholder, const std::string& description) {
  using Kind = Value::Kind;
  const bool is_file = placeholder.find("FILE") != std::string::npos ||
                       placeholder.find(".vcd") != std::string::npos;
  if (placeholder == "CHECK") return {Kind::Choice, check_names(), {}};
  if (placeholder.find('|') != std::string::npos)
    return {Kind::Choice, split(placeholder, '|'), {}};
  if (placeholder == "COMPONENT") return {Kind::Component, {}, {}};
  if (placeholder.starts_with("COMPONENT.")) return {Kind::ComponentVariable, {}, {}};
  if (placeholder.find("FOLDER") != std::string::npos) return {Kind::Folder, {}, {}};
  if (placeholder == "SCENARIO") return {Kind::Scenario, {}, extensions(placeholder, description)};
  if (!is_file) return {};
  const bool is_of_component = placeholder.starts_with("COMPONENT=");
  return {
      is_of_component ? Kind::ComponentFile : Kind::File, {}, extensions(placeholder, description)};
}

/// Of a flag that also takes a value, such as "COMPONENT", which its description shows behind "=".
std::string flag_value(const CLI::Option& option) {
  for (const std::string& name : option.get_lnames()) {
    const std::regex form("--" + name + "=([A-Z]+)");
    std::smatch match;
    const std::string text = option.get_description();
    if (std::regex_search(text, match, form)) return match[1];
  }
  return "";
}

/// CLI11 puts a bound behind the placeholder: "N:INT in [1 - 1024]".
void split_range(Option& option) {
  static const std::regex form(R"(([^:]*):\w+ in \[(.*) - (.*)\])");
  std::smatch match;
  const std::string text = option.placeholder;
  if (!std::regex_match(text, match, form)) return;
  option.placeholder = match[1];
  option.description += fmt::format("; {} to {}", match[2].str(), match[3].str());
}

Option describe(const CLI::Option& from) {
  Option option;
  option.description = from.get_description();
  option.is_required = from.get_required();
  option.default_text = from.get_default_str();
  if (from.get_positional()) {
    option.names = {from.get_name()};
    option.placeholder = from.get_name();
  } else {
    for (const std::string& name : from.get_snames()) option.names.push_back("-" + name);
    for (const std::string& name : from.get_lnames()) option.names.push_back("--" + name);
    const bool is_flag = from.get_expected_max() == 0 || from.get_type_size_max() == 0 ||
                         from.get_expected_min() == 0;
    option.placeholder = is_flag ? flag_value(from) : from.get_type_name();
    option.is_value_optional = is_flag && !option.placeholder.empty();
    split_range(option);
  }
  option.is_repeatable = option.description.find("several times") != std::string::npos;
  option.value = value_of(option.placeholder, option.description);
  return option;
}

/// In one line, without a full stop.
std::string phrase(std::string text) {
  while (text.ends_with('\n') || text.ends_with('.')) text.pop_back();
  std::ranges::replace(text, '\n', ' ');
  return text;
}

/// Subcommands inherit the footer; only the program keeps it.
Command describe(const CLI::App& app, std::vector<std::string> words) {
  words.push_back(app.get_name());
  const CLI::App* const above = app.get_parent();
  const bool has_own_footer = above == nullptr || app.get_footer() != above->get_footer();
  Command command{std::move(words),
                  phrase(app.get_description()),
                  has_own_footer ? app.get_footer() : "",
                  {},
                  {},
                  {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    auto& options = option->get_positional() ? command.arguments : command.options;
    options.push_back(describe(*option));
    options.back().is_help = option == app.get_help_ptr();
  }
  for (const CLI::App* below : app.get_subcommands({})) {
    if (below->get_group().empty()) continue;
    command.commands.push_back(describe(*below, command.words));
  }
  return command;
}

}  // namespace

std::string Command::full_name(const std::string& separator) const {
  return fmt::format("{}", fmt::join(words, separator));
}

Command describe(const CLI::App& app) { return describe(app, {}); }

std::vector<const Command*> all_of(const Command& command) {
  std::vector<const Command*> all{&command};
  for (const Command& below : command.commands) {
    const auto further = all_of(below);
    all.insert(all.end(), further.begin(), further.end());
  }
  return all;
}

std::vector<Option> documented_options(const Command& command) {
  std::vector<Option> shown = command.options;
  if (command.words.size() > 1) std::erase_if(shown, &Option::is_help);
  return shown;
}

std::string value_text(const Option& option) {
  if (!option.takes_value()) return "";
  return option.is_value_optional ? "[=" + option.placeholder + "]" : " " + option.placeholder;
}

std::string synopsis(const Command& command) {
  std::string text = command.full_name();
  if (!documented_options(command).empty()) text += " [OPTION]...";
  for (const Option& argument : command.arguments) {
    text += argument.is_required ? " " + argument.names[0] : " [" + argument.names[0] + "]";
  }
  if (!command.commands.empty()) text += " COMMAND";
  return text;
}

std::string meaning(const Option& option) {
  std::string text = option.description;
  if (!option.default_text.empty()) text += "; " + option.default_text + " if left out";
  if (option.is_required && option.names[0].starts_with("-")) text += "; required";
  return text;
}

}  // namespace stride::cli::reference
