#include "master/front/cli/campaign/cluster/slurm_script.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/shell_word.h"

namespace stride::cli {
namespace {

/// What the script says itself, and what would keep it from being run; by name and by letter.
constexpr std::array<std::string_view, 29> kOwnOptions{
    "array",   "a",        "chdir",    "D",         "cpus-per-task",
    "c",       "output",   "o",        "W",         "wait",
    "Q",       "parsable", "wrap",     "test-only", "help",
    "h",       "usage",    "job-name", "J",         "partition",
    "p",       "time",     "t",        "licenses",  "L",
    "account", "A",        "nodes",    "ntasks"};

void refuse_line_ends(const std::string& text) {
  if (text.find_first_of("\n\r") == std::string::npos) return;
  core::fail_input({}, fmt::format("'{}' has more than one line, and cannot be in a script", text));
}

/// As a word of a line "#SBATCH": within quotation marks a backslash keeps the next character.
std::string directive_word(const std::string& text) {
  refuse_line_ends(text);
  if (text.find_first_of(" \t'\"#\\") == std::string::npos) return text;
  std::string word = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') word += '\\';
    word += c;
  }
  return word + '"';
}

/// "%" begins what Slurm replaces in names of files.
std::string file_word(const std::string& path) {
  std::string name;
  for (const char c : path) name += c == '%' ? std::string("%%") : std::string(1, c);
  return name;
}

bool is_quoted(const std::string& text) {
  return text.size() > 1 && text.front() == '"' && text.back() == '"';
}

/// "mem=4G", "--mem=4G" and "-C fast", as they stand in the script. A value behind "=" is one word.
std::string further_option(const std::string& text) {
  refuse_line_ends(text);
  const std::size_t begin = text.find_first_not_of('-');
  const std::string option = begin == std::string::npos ? "" : text.substr(begin);
  const std::string name = option.substr(0, option.find_first_of("= "));
  if (name.empty()) core::fail_input({}, fmt::format("--sbatch '{}' names no option", text));
  if (std::ranges::find(kOwnOptions, name) != kOwnOptions.end()) {
    core::fail_input(
        {}, fmt::format("--sbatch cannot give '{}', which stride gives itself", name),
        "see --help for the options of submit; --dry-run prints the script, which can be "
        "changed and submitted by hand");
  }
  const std::size_t behind = option.find_first_not_of(' ', name.size());
  if (behind != name.size() && behind != std::string::npos && option[behind] == '=') {
    core::fail_input({}, fmt::format("--sbatch '{}' has a blank before '='", text),
                     "write it without");
  }
  const std::string dashes = name.size() == 1 ? "-" : "--";
  if (name.size() == option.size() || option[name.size()] != '=') return dashes + option;
  const std::string value = option.substr(name.size() + 1);
  return fmt::format("{}{}={}", dashes, name, is_quoted(value) ? value : directive_word(value));
}

std::string directives(const JobArray& array) {
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format("#SBATCH --{}={}\n", name, directive_word(value));
  };
  add("job-name", array.name);
  add("array", fmt::format("0-{}", array.ranges.size() - 1));
  add("chdir", array.working_folder.string());
  add("output", file_word(array.log_folder.string()) + "/%A_%a.log");
  add("cpus-per-task", std::to_string(array.request.processors));
  add("partition", array.request.partition);
  add("time", array.request.time);
  add("licenses", array.request.licenses);
  add("account", array.request.account);
  for (const std::string& option : array.request.further) {
    text += fmt::format("#SBATCH {}\n", further_option(option));
  }
  return text;
}

std::string range_lines(const std::vector<campaign::CaseRange>& ranges) {
  constexpr std::size_t kWidth = 100;
  std::string text, line;
  for (const campaign::CaseRange& range : ranges) {
    const std::string word = to_text(range);
    if (line.size() + 1 + word.size() > kWidth) {
      text += " " + line + "\n";
      line.clear();
    }
    line += " " + word;
  }
  return text + " " + line + "\n";
}

std::string command_text(const JobArray& array) {
  std::string text = "exec";
  for (const std::string& word : array.command) text += " " + core::shell_word(word);
  return text + " \"${ranges[SLURM_ARRAY_TASK_ID]}\"\n";
}

}  // namespace

std::string slurm_script(const JobArray& array) {
  refuse_line_ends(array.comment);
  std::string text = fmt::format("#!/bin/bash\n# {}\n{}\n", array.comment, directives(array));
  text += fmt::format("ranges=(\n{})\n", range_lines(array.ranges));
  text += fmt::format("cd {} || exit\n", core::shell_word(array.working_folder.string()));
  for (const std::string& variable : array.environment) {
    const std::size_t end = variable.find('=') + 1;
    text += fmt::format("export {}{}\n", variable.substr(0, end),
                        core::shell_word(variable.substr(end)));
  }
  return text + command_text(array);
}

}  // namespace stride::cli
