#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/front/cli/reference/writers.h"

namespace stride::cli::reference {
namespace {

constexpr const char* kFishHead = R"sh(# fish completion for stride, made by `stride reference fish`

function __stride_at # COMMAND...: whether the words of the line begin with these commands, and no further one
    set -l words (commandline -opc)[2..]
    set -l found
    for word in $words
        if contains -- (string join -- ' ' $found $word) $__stride_commands
            set -a found $word
        end
    end
    test "$found" = "$argv"
end

function __stride_scenario_names # of those that come with stride
    set -l words (commandline -opc)
    $words[1] reference scenarios 2>/dev/null
end

function __stride_components # what follows each name
    set -l words (commandline -opc) (commandline -ct)
    set -l known (__stride_scenario_names)
    set -l scenario
    for word in $words
        if string match -q -r '\.ss[dp]$' -- $word; or contains -- $word $known
            set scenario $word
        end
    end
    test -n "$scenario"; and $words[1] reference components $scenario 2>/dev/null | string replace -r '$' "$argv"
end

function __stride_files # EXTENSION...
    __fish_complete_directories (commandline -ct)
    for extension in $argv
        __fish_complete_suffix .$extension
    end
end

function __stride_component_files
    set -l token (commandline -ct)
    if string match -q -- '*=*' $token
        set -l component (string replace -r '=.*' '' -- $token)
        for file in (string replace -r '^[^=]*=' '' -- $token)*
            echo $component=$file
        end
    else
        __stride_components =
    end
end

complete -c stride -f
)sh";

constexpr const char* kAnyFile = " -F";

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + "'";
}

/// "run", "trace info": without the program's own name.
std::string path(const Command& command) {
  return fmt::format("{}", fmt::join(command.words.begin() + 1, command.words.end(), " "));
}

std::string condition(const Command& command) {
  const std::string words = path(command);
  return quoted(words.empty() ? "__stride_at" : "__stride_at " + words);
}

/// The words that are offered for a value, as fish evaluates them.
std::string offer(const Value& value) {
  using Kind = Value::Kind;
  switch (value.kind) {
    case Kind::Choice:
      return fmt::format(" -a '{}'", fmt::join(value.choices, " "));
    case Kind::Scenario:
      return fmt::format(" -a '(__stride_files {}) (__stride_scenario_names)'",
                         fmt::join(value.extensions, " "));
    case Kind::File:
      if (value.extensions.empty()) return kAnyFile;
      return fmt::format(" -a '(__stride_files {})'", fmt::join(value.extensions, " "));
    case Kind::Folder:
      return " -a '(__fish_complete_directories (commandline -ct))'";
    case Kind::Component:
      return " -a '(__stride_components \"\")'";
    case Kind::ComponentVariable:
      return " -a '(__stride_components .)'";
    case Kind::ComponentFile:
      return " -a '(__stride_component_files)'";
    case Kind::Anything:
      break;
  }
  return "";
}

std::string option_line(const Command& command, const Option& option) {
  std::string text = "complete -c stride -n " + condition(command);
  for (const std::string& name : option.names) {
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (option.takes_value()) {
    const std::string words = offer(option.value);
    if (!option.is_value_optional) text += words == kAnyFile ? " -r" : " -x";
    text += words;
  }
  return text + " -d " + quoted(option.description) + "\n";
}

}  // namespace

std::string fish_completion(const Command& program) {
  const auto commands = all_of(program);
  std::string text = kFishHead;
  text += "set -g __stride_commands";
  for (const Command* command : commands) {
    if (command->words.size() > 1) text += " " + quoted(path(*command));
  }
  text += "\n";
  for (const Command* command : commands) {
    text += "\n";
    for (const Command& below : command->commands) {
      text += fmt::format("complete -c stride -n {} -a {} -d {}\n", condition(*command),
                          below.name(), quoted(below.description));
    }
    if (!command->arguments.empty()) {
      const std::string files = offer(command->arguments.front().value);
      text += fmt::format("complete -c stride -n {}{}\n", condition(*command), files);
    }
    for (const Option& option : command->options) text += option_line(*command, option);
  }
  return text;
}

}  // namespace stride::cli::reference
