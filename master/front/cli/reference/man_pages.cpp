#include <cctype>
#include <sstream>

#include <fmt/format.h>

#include "master/front/cli/reference/writers.h"

namespace stride::cli::reference {
namespace {

constexpr std::size_t kManWidth = 72;

/// Text that roff(7) takes as it is.
std::string escaped(const std::string& text) {
  std::string result;
  bool is_line_begin = true;
  for (const char c : text) {
    if (is_line_begin && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    is_line_begin = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

/// A sentence in lines of the length that man pages have.
std::string sentence(const std::string& text) { return escaped(wrapped(text + ".", kManWidth)); }

/// "\fB-o\fR, \fB--out\fR \fIFOLDER\fR"
std::string tag(const Option& option) {
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + bold(name);
  if (!option.takes_value()) return text;
  const std::string value = italic(option.placeholder);
  return text + (option.is_value_optional ? "[=" + value + "]" : " " + value);
}

std::string list(const std::vector<Option>& options) {
  std::string text;
  for (const Option& option : options) {
    text += fmt::format(".TP\n{}\n{}", tag(option), sentence(meaning(option)));
  }
  return text;
}

std::string arguments(const Command& command) {
  std::string text;
  for (const Option& argument : command.arguments) {
    text += fmt::format(".TP\n{}\n{}", italic(argument.names[0]), sentence(meaning(argument)));
  }
  return text;
}

/// Paragraphs; what is indented in a footer, a list, keeps its lines.
std::string paragraphs(const std::string& text) {
  std::string result;
  std::istringstream lines(wrapped(text, kManWidth));
  bool is_list = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_item = line.starts_with(" ");
    if (is_item != is_list) result += is_item ? ".PP\n.nf\n" : ".fi\n.PP\n";
    is_list = is_item;
    if (!line.empty()) {
      result += escaped(line) + "\n";
    } else if (!result.empty() && !result.ends_with(".PP\n")) {
      result += ".PP\n";
    }
  }
  if (is_list) result += ".fi\n";
  while (result.ends_with(".PP\n")) result.resize(result.size() - 4);
  return result;
}

std::string head(const std::string& name, const std::string& version) {
  std::string title = name;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return fmt::format(".TH {} 1 \"\" \"stride {}\" \"stride\"\n", escaped(title), escaped(version));
}

std::string synopsis_line(const Command& command) {
  std::string text = bold(command.full_name());
  if (!documented_options(command).empty()) text += " [" + italic("OPTION") + "]...";
  for (const Option& argument : command.arguments) text += " " + italic(argument.names[0]);
  if (!command.commands.empty()) text += " " + italic("COMMAND");
  return text + "\n";
}

/// The first part of a longer one, for the list that apropos(1) shows.
std::string brief(std::string text) {
  constexpr std::size_t kLeast = 20;
  for (const char* const end : {": ", "; ", ", "}) {
    const std::size_t at = text.find(end);
    if (at != std::string::npos && at > kLeast) text.resize(at);
  }
  return text;
}

std::string subcommands(const Command& command) {
  std::string text;
  for (const Command& below : command.commands) {
    text += fmt::format(".SS \"{}\"\n{}.PP\n{}{}{}", escaped(below.full_name()),
                        sentence(below.description), synopsis_line(below), arguments(below),
                        list(documented_options(below)));
  }
  return text;
}

/// The other pages.
std::string see_also(const Command& program, const std::string& page) {
  std::string text;
  const auto add = [&](const std::string& name) {
    if (name != page) text += fmt::format("{}{}(1)", text.empty() ? "" : ",\n", bold(name));
  };
  add(program.full_name("-"));
  for (const Command& command : program.commands) add(command.full_name("-"));
  return ".SH SEE ALSO\n" + text + "\n";
}

std::string page(const Command& program, const Command& command, const std::string& version) {
  const std::string name = command.full_name("-");
  std::string text = head(name, version);
  text += fmt::format(".SH NAME\n{} \\- {}\n", escaped(name), escaped(brief(command.description)));
  text += ".SH SYNOPSIS\n" + synopsis_line(command);
  text += ".SH DESCRIPTION\n" + sentence(command.description) + arguments(command);
  const std::vector<Option> options = documented_options(command);
  if (!options.empty()) text += ".SH OPTIONS\n" + list(options);
  const bool is_program = &command == &program;
  if (is_program) {
    text += ".SH COMMANDS\n";
    for (const Command& below : command.commands) {
      text +=
          fmt::format(".TP\n{}(1)\n{}", bold(below.full_name("-")), sentence(below.description));
    }
  } else if (!command.commands.empty()) {
    text += ".SH COMMANDS\n" + subcommands(command);
  }
  if (!command.footer.empty()) text += ".SH NOTES\n" + paragraphs(command.footer);
  return text + see_also(program, name);
}

}  // namespace

std::map<std::string, std::string> man_pages(const Command& program, const std::string& version) {
  std::map<std::string, std::string> pages;
  pages[program.full_name("-") + ".1"] = page(program, program, version);
  for (const Command& command : program.commands) {
    pages[command.full_name("-") + ".1"] = page(program, command, version);
  }
  return pages;
}

}  // namespace stride::cli::reference
