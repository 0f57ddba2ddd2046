#include <sstream>

#include <fmt/format.h>

#include "master/front/cli/reference/writers.h"

namespace stride::cli::reference {
namespace {

constexpr std::size_t kMarkdownWidth = 120;

constexpr const char* kMarkdownHead =
    "# Command line\n\n"
    "This page is the help of the program (`stride COMMAND --help`), written by\n"
    "`scripts/update_reference.sh`. [scenario.md](scenario.md#command-line) has examples, and what "
    "mistakes look like; an\n"
    "installation has the same as man pages (`man stride-run`), and completion for bash, zsh and "
    "fish.\n";

std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '<') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

/// In a span of code only the bar means something to a table.
std::string code_cell(const std::string& text) {
  std::string escaped = "`";
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped + '`';
}

std::string names_of(const Option& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string table(const std::string& title, const std::vector<Option>& options, bool is_argument) {
  std::string text = fmt::format("\n| {} | meaning |\n|---|---|\n", title);
  for (const Option& option : options) {
    const std::string name = names_of(option) + (is_argument ? "" : value_text(option));
    text += fmt::format("| {} | {} |\n", code_cell(name), cell(meaning(option)));
  }
  return text;
}

std::string section(const Command& command, std::size_t depth) {
  std::string text =
      fmt::format("\n{} {}\n\n```sh\n{}\n```\n\n{}", std::string(depth, '#'), command.full_name(),
                  synopsis(command), wrapped(command.description + ".", kMarkdownWidth));
  if (!command.arguments.empty()) text += table("argument", command.arguments, true);
  const std::vector<Option> options = documented_options(command);
  if (!options.empty()) text += table("option", options, false);
  if (!command.commands.empty()) {
    text += "\n| command | what it does |\n|---|---|\n";
    for (const Command& below : command.commands) {
      text += fmt::format("| [`{}`](#{}) | {} |\n", below.full_name(), below.full_name("-"),
                          cell(below.description));
    }
  }
  if (!command.footer.empty())
    text += "\n```text\n" + wrapped(command.footer, kMarkdownWidth) + "```\n";
  for (const Command& below : command.commands) text += section(below, depth + 1);
  return text;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::string result;
  std::istringstream lines(text);
  bool is_open = false;  // a line that more words may be added to
  std::size_t column = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == ' ') {
      result += is_open ? "\n" : "";
      result += line + "\n";
      is_open = false;
      continue;
    }
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (is_open && column + 1 + word.size() <= width) {
        result += " " + word;
        column += 1 + word.size();
        continue;
      }
      result += (is_open ? "\n" : "") + word;
      column = word.size();
      is_open = true;
    }
  }
  return is_open ? result + "\n" : result;
}

std::string markdown(const Command& program) { return kMarkdownHead + section(program, 2); }

}  // namespace stride::cli::reference
