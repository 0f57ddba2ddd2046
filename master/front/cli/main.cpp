#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/message_text.h"
#include "master/base/text/readable_text.h"
#include "master/base/text/suggest.h"
#include "master/front/cli/process_watch.h"
#include "master/front/cli/program/command_line.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/end_note.h"
#include "master/front/cli/program/exit.h"
#include "master/front/cli/program/hard_limits.h"
#include "master/front/cli/program/memory_limits.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/program/repeated_options.h"

namespace {

using stride::cli::kRunFailed;
using stride::cli::kWrongInput;

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  return names;
}

/// The last command of the line: of 'stride trace info', info.
const CLI::App* innermost(const CLI::App* app) {
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return app;
}

/// "stride trace info"
std::string full_name(const CLI::App* app) {
  const CLI::App* parent = app->get_parent();
  return parent == nullptr ? app->get_name() : full_name(parent) + " " + app->get_name();
}

/// Options whose value, if any, follows '='.
constexpr const char* kFlagsWithValue[] = {"--isolate", "--film", "--scene", "--live"};

/// What follows such a flag and a blank is another argument.
std::string flag_hint(const CLI::App& command) {
  for (const char* flag : kFlagsWithValue) {
    const CLI::Option* const option = command.get_option_no_throw(flag);
    if (option == nullptr || option->count() == 0) continue;
    return fmt::format("\n  hint: a value of {0} follows '=', as in {0}=VALUE", flag);
  }
  return "";
}

/// Options whose values are assignments.
constexpr const char* kAssignments[] = {"--set", "--swap"};

/// Where what should follow '=' is an argument of its own.
std::string assignment_hint(const CLI::App& command, const std::vector<std::string>& rest) {
  for (const char* name : kAssignments) {
    const CLI::Option* const option = command.get_option_no_throw(name);
    if (option == nullptr) continue;
    for (const std::string& text : option->results()) {
      if (text.find('=') != std::string::npos) continue;
      std::error_code ignored;
      const bool is_value = rest.size() == 1 && !std::filesystem::exists(rest.front(), ignored);
      return fmt::format("\n  hint: the value follows '=', as in {} {}={}", name, text,
                         is_value ? rest.front() : "VALUE");
    }
  }
  return "";
}

/// The long options of a command.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// What other tools and habits call an option.
std::string other_name(const std::string& option) {
  static const std::map<std::string, const char*> kOthers = {{"--end", "--stop"},
                                                             {"--end-time", "--stop"},
                                                             {"--stop-time", "--stop"},
                                                             {"--until", "--stop"},
                                                             {"--duration", "--stop"},
                                                             {"--start-time", "--start"},
                                                             {"--begin", "--start"},
                                                             {"--dt", "--step"},
                                                             {"--step-size", "--step"},
                                                             {"--timestep", "--step"},
                                                             {"--output-interval", "--step"},
                                                             {"--param", "--set"},
                                                             {"--parameter", "--set"},
                                                             {"--start-value", "--set"},
                                                             {"--outdir", "--out"},
                                                             {"--output-dir", "--out"},
                                                             {"--results", "--out"},
                                                             {"--record", "--signals"},
                                                             {"--seconds", "--stop"},
                                                             {"--algorithm", "--coupling"},
                                                             {"--solver", "--policy"}};
  const auto found = kOthers.find(option);
  return found == kOthers.end() ? "" : found->second;
}

/// The option of these that was meant; empty if none is near.
std::string meant_option(const std::string& option, const std::vector<std::string>& names) {
  const std::string other = other_name(option);
  if (std::ranges::find(names, other) != names.end()) return other;
  return stride::core::nearest(option, names);
}

/// The option that was meant by one that is not there, or else where they are listed.
std::string option_hint(const CLI::App& command, const std::vector<std::string>& rest) {
  const std::vector<std::string> names = option_names(command);
  for (const std::string& word : rest) {
    if (!word.starts_with("--")) continue;
    const std::string meant = meant_option(word.substr(0, word.find('=')), names);
    if (!meant.empty()) return fmt::format("did you mean '{}'?", meant);
  }
  return fmt::format("'{} --help' lists its options", full_name(&command));
}

/// CLI11 takes "--isolate=" for "--isolate".
void refuse_empty_values(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    for (const char* flag : kFlagsWithValue) {
      if (argv[i] != std::string(flag) + "=") continue;
      stride::core::fail_input({}, fmt::format("{}: there is no value behind '='", argv[i]),
                               fmt::format("leave the '=' out, or give {} a value", flag));
    }
  }
}

/// The command that was meant by one that is not there.
std::string command_hint(const CLI::App& above, const std::string& word) {
  if (above.get_parent() == nullptr && word == "export") {
    return "it comes with the Python package: pip install 'stride-cosim[mcap]'";
  }
  return stride::core::suggestion(word, command_names(above));
}

/// In the order in which they were written, which CLI11 turns round.
std::string unexpected_text(const std::vector<std::string>& rest) {
  return fmt::format("The following argument{} not expected: {}",
                     rest.size() == 1 ? " was" : "s were", fmt::join(rest, " "));
}

/// The mistake in the command line; with the whole help only if there is no command at all.
std::string explanation(const CLI::App* app, const CLI::Error& mistake) {
  using stride::core::message_text;
  using stride::core::name_text;
  const CLI::App* command = innermost(app);
  const std::vector<std::string> rest = command->remaining();
  if (!command_names(*command).empty() && !rest.empty()) {
    return fmt::format("stride: error: there is no {} '{}'\n  hint: {}\n",
                       rest.front().starts_with("-") ? "option" : "command",
                       message_text(name_text(rest.front())), command_hint(*command, rest.front()));
  }
  const bool has_too_many = dynamic_cast<const CLI::ExtrasError*>(&mistake) != nullptr;
  const std::string message =
      message_text(name_text(has_too_many ? unexpected_text(rest) : mistake.what()));
  if (command == app) return fmt::format("stride: error: {}\n\n{}", message, app->help());
  return fmt::format("stride: error: {}{}\n  hint: {}\n", message,
                     has_too_many ? flag_hint(*command) + assignment_hint(*command, rest) : "",
                     option_hint(*command, rest));
}

std::string explain(const CLI::App* app, const CLI::Error& mistake) {
  return stride::core::terminal_text(explanation(app, mistake));
}

int parse(CLI::App& app, int argc, char** argv) {
  try {
    std::vector<std::string> words =
        stride::cli::with_repeated_options({argv + 1, argv + std::max(argc, 1)});
    std::ranges::reverse(words);  // as CLI11 takes them
    app.parse(std::move(words));
    return 0;
  } catch (const CLI::RuntimeError& end) {  // a command has done its work, and this is its answer
    return end.get_exit_code();
  } catch (const CLI::ParseError& answer) {
    return app.exit(answer) == 0 ? 0 : kWrongInput;
  }
}

/// A file that the run opens must not get a number that messages are written to.
void open_missing_standard_files() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) >= 0) continue;
    (void)::open("/dev/null", file == STDIN_FILENO ? O_RDONLY : O_WRONLY);
  }
}

/// What was printed is in memory yet. Throws core::Error (Run).
void flush_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  const int reason = errno;
  stride::core::fail_run({},
                         fmt::format("cannot write the standard output: {}",
                                     reason != 0 ? std::generic_category().message(reason)
                                                 : "an earlier part of it could not be written"));
}

void add_verbose(CLI::App& command) {
  command.add_flag_callback(
      "--verbose", [] { spdlog::set_level(spdlog::level::info); },
      "Show everything that units log, not only warnings and errors");
}

void add_all(CLI::App& app) {
  app.set_version_flag("--version", "stride " STRIDE_VERSION);
  app.require_subcommand(1);
  app.failure_message(explain);
  app.footer(
      "Exit codes: 0 good, 1 the run failed, or a check or verdict failed, 2 the input was wrong.\n"
      "'stride COMMAND --help' shows more about a command.");
  add_verbose(app);
  stride::cli::add_run(app);
  stride::cli::add_resume(app);
  stride::cli::add_campaign(app);
  stride::cli::add_report(app);
  stride::cli::add_compare(app);
  stride::cli::add_coverage(app);
  stride::cli::add_check(app);
  stride::cli::add_inspect(app);
  stride::cli::add_verify(app);
  stride::cli::add_new(app);
  stride::cli::add_complete(app);
  stride::cli::add_pack(app);
  stride::cli::add_build(app);
  stride::cli::add_trace(app);
  stride::cli::add_serve(app);
  stride::cli::add_reference(app);
  for (const char* command : {"run", "resume", "check", "inspect", "verify", "complete", "pack"}) {
    add_verbose(*app.get_subcommand(command));
  }
}

/// Behind what was printed. The process that watches this one prints it where this one cannot.
void tell(const std::string& error) {
  if (!stride::cli::is_output_locked()) std::fflush(stdout);
  stride::cli::EndNote& note = stride::cli::end_note();
  note.error.set(error);
  note.is_printed.set(stride::cli::print_error(error));
}

int execute(int argc, char** argv) {
  stride::cli::go_on_watched();
  stride::cli::keep_hard_limits();
  stride::cli::note_command_line(argc, argv);
  stride::cli::require_stack();
  refuse_empty_values(argc, argv);
  CLI::App app(
      "stride couples simulators: it loads units of FMI 3.0, 2.0 and 1.0 as plug-ins\n"
      "and runs them in steps, as a scenario (an SSP system file, .ssd) wires them.\n",
      "stride");
  add_all(app);
  const int code = parse(app, argc, argv);
  flush_standard_output();
  return code;
}

int execute_or_tell(int argc, char** argv) {
  try {
    return execute(argc, argv);
  } catch (const stride::core::Error& error) {
    tell(error.what());
    return error.kind() == stride::core::Error::Kind::Input ? kWrongInput : kRunFailed;
  } catch (const std::exception& error) {
    tell(stride::cli::in_words(error));
  } catch (...) {
    tell("something that is not a std::exception was thrown");
  }
  return kRunFailed;
}

}  // namespace

int main(int argc, char** argv) {
  open_missing_standard_files();
  stride::cli::set_up_output();
  ::pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, nullptr);  // a unit may leave one pending
  std::signal(SIGXFSZ, SIG_IGN);  // then writing fails with an error; the signal would kill
  return stride::cli::leave_with(execute_or_tell(argc, argv));
}
