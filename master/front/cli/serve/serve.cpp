// stride serve: a host for the units of a master on another machine.
#include "master/loader/network/server/serve.h"

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/files/descriptor.h"
#include "master/base/parse_option.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/interruption.h"
#include "master/system/declaration/run_settings.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::cli {
namespace {

struct ServeRequest {
  std::vector<std::string> only, folders;
  std::string unit_timeout, memory_limit;
  std::string file_limit = "1024";  ///< [MiB]
  bool accepts_files = false;
  bool no_sandbox = false;
};

/// Before those of STRIDE_UNITS.
void search_in(const std::vector<std::string>& folders) {
  std::string all;
  for (const std::string& folder : folders) all += folder + ':';
  if (const char* const before = std::getenv("STRIDE_UNITS")) all += before;
  if (!folders.empty()) ::setenv("STRIDE_UNITS", all.c_str(), 1);
}

/// Standard input and output are for messages: what else is printed goes to the standard error.
struct Pipes {
  core::Descriptor in{::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)};
  core::Descriptor out{::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3)};

  Pipes() {
    const core::Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    ::dup2(nothing.number(), STDIN_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
};

void serve(const ServeRequest& request) {
  if (::isatty(STDOUT_FILENO) != 0) {
    core::fail_input({}, "stride serve is for programs, and this is a terminal",
                     "stride run starts it on another machine: <stride:Host components=\"…\" "
                     "at=\"ssh://user@machine\"/>");
  }
  search_in(request.folders);
  remote::ServeOptions options;
  options.only = request.only;
  options.find = [](const std::string& name) { return scenario::find_unit(name, {}); };
  if (request.accepts_files) {
    options.file_limit =
        core::parse_option("--file-limit", request.file_limit, scenario::parse_memory_limit);
  }
  options.may_leave_sandbox = request.no_sandbox;
  if (!request.unit_timeout.empty()) {
    options.call_limit =
        core::parse_option("--unit-timeout", request.unit_timeout, scenario::parse_call_limit);
  }
  if (!request.memory_limit.empty()) {
    options.memory_limit =
        core::parse_option("--memory-limit", request.memory_limit, scenario::parse_memory_limit);
  }
  const Pipes pipes;
  const Interruption interruption;
  remote::serve(pipes.in.number(), pipes.out.number(), options, Interruption::flag());
}

}  // namespace

void add_serve(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "serve", "Host a unit of a run on another machine, over the standard input and output");
  const auto request = std::make_shared<ServeRequest>();
  command
      ->add_option(
          "--only", request->only,
          "An FMU that is offered, by path or name; no other is then; may be given several "
          "times")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--units", request->folders,
                   "A folder that is searched for FMUs, before those of STRIDE_UNITS; may be given "
                   "several times")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
  CLI::Option* const accepts_files = command->add_flag(
      "--accept-files", request->accepts_files, "Accept FMUs that are sent; they run in a sandbox");
  command
      ->add_option("--file-limit", request->file_limit,
                   "Limit of an FMU that is sent, and of its files together; 1024 by default")
      ->type_name("MIB")
      ->needs(accepts_files);
  command
      ->add_option("--unit-timeout", request->unit_timeout,
                   "Time limit of a call of the unit; the run may set a lower one")
      ->type_name("SECONDS");
  command
      ->add_option("--memory-limit", request->memory_limit,
                   "Limit of the memory of the unit; the run may set a lower one")
      ->type_name("MIB");
  command->add_flag("--no-sandbox", request->no_sandbox,
                    "Let the run choose that its unit has no sandbox");
  command->callback([request] { serve(*request); });
}

}  // namespace stride::cli
