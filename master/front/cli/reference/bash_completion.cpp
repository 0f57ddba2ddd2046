#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/front/cli/reference/writers.h"

namespace stride::cli::reference {
namespace {

/// The part that does not depend on the commands. Bash cuts words at '=', so they are joined again,
/// and the candidates replace the text behind the last '='.
constexpr const char* kBashHead = R"sh(# bash completion for stride, made by `stride reference bash`

_stride_words() { # WORD...
  COMPREPLY+=($(compgen -W "$*" -- "$value"))
}

_stride_folders() {
  local IFS=$'\n'
  compopt -o filenames 2> /dev/null
  COMPREPLY+=($(compgen -d -- "${value#*=}"))
}

_stride_files() { # EXTENSION...; any file if there is none
  local IFS=$'\n' extension
  if [ $# -eq 0 ]; then
    compopt -o filenames 2> /dev/null
    COMPREPLY+=($(compgen -f -- "${value#*=}"))
    return
  fi
  _stride_folders
  for extension; do
    COMPREPLY+=($(compgen -f -X "!*.$extension" -- "${value#*=}"))
  done
}

_stride_scenarios() { # EXTENSION...; also those that come with stride
  _stride_files "$@"
  _stride_words $("${words[0]}" reference scenarios 2> /dev/null)
}

_stride_components() { # what follows each name
  local word scenario= known=
  printf -v known ' %s ' $("${words[0]}" reference scenarios 2> /dev/null)
  for word in "${words[@]:1}"; do
    case $word in *.ssd | *.ssp) scenario=$word ;; esac
    [[ -n $word && $known == *" $word "* ]] && scenario=$word
  done
  [ -n "$scenario" ] || return 0
  [ -z "$1" ] || compopt -o nospace 2> /dev/null
  local name # compgen -W would take names for words of the shell, and run what is in them
  while IFS= read -r name; do
    [[ $name == "$value"* ]] && COMPREPLY+=("$name$1")
  done < <("${words[0]}" reference components "$scenario" 2> /dev/null)
  return 0
}

_stride_component_files() { # EXTENSION...
  if [[ $value == *=* ]]; then _stride_files "$@"; else _stride_components =; fi
}
)sh";

constexpr const char* kBashTail = R"sh(
_stride() {
  local words=() word last= command=stride option value i
  COMPREPLY=()
  for ((i = 0; i <= COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [[ $i -gt 0 && ($word == = || $last == =) ]]; then
      words[${#words[@]}-1]+=$word
    else
      words+=("$word")
    fi
    last=$word
  done
  for ((i = 1; i < ${#words[@]} - 1; ++i)); do
    _stride_is_command "$command ${words[i]}" && command="$command ${words[i]}"
  done
  word=${words[${#words[@]}-1]}
  if [[ $word == --*=* ]]; then
    option=${word%%=*} value=${word#*=}
    _stride_value "=" || true
    return
  fi
  option=${words[${#words[@]}-2]} value=$word
  if [[ $option == -* ]] && _stride_value ""; then return; fi
  if [[ $value == -* ]]; then _stride_options; else _stride_arguments; fi
}

complete -F _stride stride
)sh";

std::string bash_completer(const Value& value) {
  using Kind = Value::Kind;
  switch (value.kind) {
    case Kind::Choice:
      return fmt::format("_stride_words {}", fmt::join(value.choices, " "));
    case Kind::Scenario:
      return fmt::format("_stride_scenarios {}", fmt::join(value.extensions, " "));
    case Kind::File:
      return fmt::format("_stride_files {}", fmt::join(value.extensions, " "));
    case Kind::Folder:
      return "_stride_folders";
    case Kind::Component:
      return "_stride_components ''";
    case Kind::ComponentVariable:
      return "_stride_components .";
    case Kind::ComponentFile:
      return fmt::format("_stride_component_files {}", fmt::join(value.extensions, " "));
    case Kind::Anything:
      break;
  }
  return ":";  // nothing can be offered
}

std::string patterns(const Command& command, const Option& option) {
  std::string text;
  for (const std::string& name : option.names) {
    text += fmt::format("{}'{} {}'", text.empty() ? "" : " | ", command.full_name(), name);
  }
  return text;
}

std::string is_command(const std::vector<const Command*>& commands) {
  std::string names;
  for (const Command* command : commands) {
    if (command->words.size() > 1) {
      names += fmt::format("{}'{}'", names.empty() ? "" : " | ", command->full_name());
    }
  }
  return fmt::format(
      "\n_stride_is_command() {{\n  case $1 in\n    {}) ;;\n    *) return 1 ;;\n  esac\n}}\n",
      names);
}

std::string values(const std::vector<const Command*>& commands) {
  std::string text =
      "\n_stride_value() { # whether '=' is between the option and its value; fails if it takes "
      "none\n"
      "  case \"$command $option\" in\n";
  for (const Command* command : commands) {
    for (const Option& option : command->options) {
      if (!option.takes_value()) continue;
      const char* const condition = option.is_value_optional ? "[ -n \"$1\" ] && " : "";
      text += fmt::format("    {}) {}{} ;;\n", patterns(*command, option), condition,
                          bash_completer(option.value));
    }
  }
  return text + "    *) return 1 ;;\n  esac\n}\n";
}

std::string options(const std::vector<const Command*>& commands) {
  std::string text = "\n_stride_options() {\n  case $command in\n";
  for (const Command* command : commands) {
    std::string names;
    for (const Option& option : command->options)
      names += fmt::format(" {}", fmt::join(option.names, " "));
    text += fmt::format("    '{}') _stride_words{} ;;\n", command->full_name(), names);
  }
  return text + "  esac\n}\n";
}

std::string arguments(const std::vector<const Command*>& commands) {
  std::string text = "\n_stride_arguments() {\n  case $command in\n";
  for (const Command* command : commands) {
    std::string work;
    for (const Command& below : command->commands) work += " " + below.name();
    if (!work.empty()) {
      work = "_stride_words" + work;
    } else if (!command->arguments.empty()) {
      work = bash_completer(command->arguments.front().value);
    } else {
      continue;
    }
    text += fmt::format("    '{}') {} ;;\n", command->full_name(), work);
  }
  return text + "  esac\n}\n";
}

}  // namespace

std::string bash_completion(const Command& program) {
  const auto commands = all_of(program);
  return kBashHead + is_command(commands) + values(commands) + options(commands) +
         arguments(commands) + kBashTail;
}

}  // namespace stride::cli::reference
