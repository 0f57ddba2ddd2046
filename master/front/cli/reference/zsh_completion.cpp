#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/front/cli/reference/writers.h"

namespace stride::cli::reference {
namespace {

constexpr const char* kZshHead = R"sh(#compdef stride
# zsh completion for stride, made by `stride reference zsh`

_stride_scenarios() { # pattern of the files; also those that come with stride
  local -a known=(${(f)"$($_stride_program reference scenarios 2> /dev/null)"})
  local result=1
  compadd -a known && result=0
  _files -g "$1" && result=0
  return result
}

_stride_components() { # what follows each name
  local -a known=(${(f)"$($_stride_program reference scenarios 2> /dev/null)"})
  local scenario=${${(M)words:#*.ss[dp]}[-1]:-${${words:*known}[-1]}}
  [[ -n $scenario ]] || return 1
  local -a names=(${(f)"$($_stride_program reference components ${(Q)scenario} 2> /dev/null)"})
  compadd ${1:+-S} ${1:+$1} -a names
}

_stride_component_files() { # pattern of the files
  if compset -P '*='; then _files -g "$1"; else _stride_components =; fi
}
)sh";

constexpr const char* kZshTail = R"sh(
_stride() {
  local _stride_program=${words[1]}
  _stride_stride
}

_stride "$@"
)sh";

/// Of a text in a specification for _arguments, which is in single quotation marks.
std::string escaped(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) result += '\\';
    result += c == '\n' ? std::string(" ") : c == '\'' ? "'\\''" : std::string(1, c);
  }
  return result;
}

std::string glob(const Value& value) {
  if (value.extensions.empty()) return "*";
  if (value.extensions.size() == 1) return "*." + value.extensions.front();
  return fmt::format("*.({})", fmt::join(value.extensions, "|"));
}

/// An action of _arguments; with a blank before it, a function gets its own arguments alone.
std::string zsh_completer(const Value& value) {
  using Kind = Value::Kind;
  switch (value.kind) {
    case Kind::Choice:
      return fmt::format("({})", fmt::join(value.choices, " "));
    case Kind::Scenario:
      return fmt::format(" _stride_scenarios \"{}\"", glob(value));
    case Kind::File:
      return fmt::format("_files -g \"{}\"", glob(value));
    case Kind::Folder:
      return "_files -/";
    case Kind::Component:
      return " _stride_components \"\"";
    case Kind::ComponentVariable:
      return " _stride_components .";
    case Kind::ComponentFile:
      return fmt::format(" _stride_component_files \"{}\"", glob(value));
    case Kind::Anything:
      break;
  }
  return " ";
}

/// "'(-o --out)'{-o,--out}'[Results folder]:FOLDER:_files -/'"
std::string specification(const Option& option) {
  std::string text;
  if (option.is_repeatable) {
    text = "'*'";
  } else if (option.names.size() > 1) {
    text = fmt::format("'({})'", fmt::join(option.names, " "));
  }
  for (std::size_t i = 0; i < option.names.size(); ++i) {
    std::string name = option.names[i];
    if (option.is_value_optional) name += "=-";
    if (option.takes_value() && !option.is_value_optional && name.starts_with("--")) name += "=";
    text += (i == 0 ? (option.names.size() > 1 ? "{" : "") : ",") + ("'" + name + "'");
  }
  if (option.names.size() > 1) text += "}";
  text += fmt::format("'[{}]", escaped(option.description, "[]:\\"));
  if (!option.takes_value()) return text + "'";
  const char* const colon = option.is_value_optional ? "::" : ":";
  return text + fmt::format("{}{}:{}'", colon, escaped(option.placeholder, ":\\"),
                            escaped(zsh_completer(option.value), ":"));
}

/// "_stride_stride", "_stride_stride_trace_info"
std::string function_name(const Command& command) { return "_stride_" + command.full_name("_"); }

std::string commands_of(const Command& command) {
  std::string text = "  case $state in\n    command)\n      local -a commands=(\n";
  for (const Command& below : command.commands) {
    text += fmt::format("        '{}:{}'\n", below.name(), escaped(below.description, ":\\"));
  }
  text +=
      "      )\n      _describe -t commands command commands\n      ;;\n    rest)\n      case "
      "$words[1] in\n";
  for (const Command& below : command.commands) {
    text += fmt::format("        {}) {} ;;\n", below.name(), function_name(below));
  }
  return text + "      esac\n      ;;\n  esac\n";
}

std::string function(const Command& command) {
  const bool has_commands = !command.commands.empty();
  std::string text = fmt::format("\n{}() {{\n", function_name(command));
  if (has_commands)
    text +=
        "  local curcontext=$curcontext context state state_descr line\n  typeset -A opt_args\n";
  text += fmt::format("  _arguments{}", has_commands ? " -C" : "");
  for (const Option& option : command.options) text += " \\\n    " + specification(option);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const Option& argument = command.arguments[i];
    text += fmt::format(" \\\n    '{}:{}:{}'", i + 1, escaped(argument.names[0], ":\\"),
                        escaped(zsh_completer(argument.value), ":"));
  }
  if (has_commands) text += " \\\n    '1: :->command' \\\n    '*:: :->rest'";
  text += "\n";
  if (has_commands) text += commands_of(command);
  return text + "}\n";
}

}  // namespace

std::string zsh_completion(const Command& program) {
  std::string text = kZshHead;
  for (const Command* command : all_of(program)) text += function(*command);
  return text + kZshTail;
}

}  // namespace stride::cli::reference
