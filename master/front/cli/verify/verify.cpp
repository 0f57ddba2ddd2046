// stride verify: tests a single unit.
#include "master/study/verify/verify.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/output_file.h"
#include "master/base/parse_option.h"
#include "master/base/text/number_text.h"
#include "master/base/time_text.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/study/verify/checks.h"
#include "master/system/scenario/units/file_units.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::cli {
namespace {

struct Options {
  verify::VerifyRequest request;
  std::string json;  ///< a file, or empty
};

/// The name of the running check, on a terminal, where later output overwrites it.
void show_progress(const char* check) {
  if (::isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r\033[Kchecking {} …", check);
}

std::string table_text(const std::vector<verify::Result>& results) {
  Table table({{"check"}, {"verdict"}, {"what was seen"}});
  for (const auto& [check, finding, seconds] : results) {
    table.add({check, verify::name(finding.verdict), finding.seen});
    for (const std::string& note : finding.notes) table.add({"", "note", note});
  }
  return table.text();
}

std::string conclusion(const std::vector<verify::Result>& results) {
  std::size_t counts[3] = {};
  for (const auto& result : results) ++counts[static_cast<std::size_t>(result.finding.verdict)];
  return fmt::format("{} passed, {} failed, {} skipped", counts[0], counts[1], counts[2]);
}

/// Their names, for the error with which the program ends.
std::string failed_checks(const std::vector<verify::Result>& results) {
  std::vector<std::string> names;
  for (const auto& result : results) {
    if (result.finding.verdict == verify::Verdict::Failed) names.push_back(result.check);
  }
  return core::quoted(names);
}

void run(const Options& options) {
  verify::VerifyRequest request = options.request;
  request.file = scenario::find_unit(request.file, {});
  const CrashGuard guard;
  const archive::TemporaryFolder folder;
  if (!core::is_folder(request.file) && scenario::is_stimuli(request.file)) {
    request.shown_as = std::exchange(request.file, folder.path() / "player.fmu");
    scenario::pack_stimuli({request.shown_as, {}, {}, request.file});
  }
  const verify::TestedUnit tested(std::move(request));
  const LimitedEnd end;
  std::optional<core::OutputFile> json;
  if (!options.json.empty()) {
    json.emplace(options.json, core::OutputFile::Hints{"name a file where you may write"});
  }
  const core::UnitDescription& unit = tested.description();
  print_text("{}: FMI {}, steps of {} s to {} s, seed {}\n\n", unit.model_name, unit.fmi_version,
             core::to_text(tested.step()), core::to_text(tested.point(tested.steps())),
             tested.request().seed);
  std::fflush(stdout);
  const Interruption interruption;
  const auto results =
      verify::verify(tested, {.on_begin = show_progress, .interrupted = &Interruption::flag()});
  if (::isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r\033[K");
  print_text("{}\n{}\n", table_text(results), conclusion(results));
  if (json) {
    json->write(verify::json_text(tested, results));
    json->close();
  }
  const std::string failures = failed_checks(results);
  if (!failures.empty()) core::fail_run({}, "it fails " + failures);
}

/// An option whose text becomes a number by a function that throws std::invalid_argument.
template <class Take>
CLI::Option* add_parsed(CLI::App& command, const std::string& name, Take take,
                        const std::string& help) {
  return command.add_option_function<std::string>(
      name, [name, take](const std::string& text) { core::parse_option(name, text, take); }, help);
}

Duration parse_step(const std::string& text) {
  const Duration step = core::parse_seconds(text);
  if (step <= Duration::zero()) {
    throw std::invalid_argument(
        "a step must be above 0 s, at least the picosecond that times are counted in");
  }
  return step;
}

std::string check_list() {
  std::string text = "Checks:\n";
  for (const verify::UnitCheck& check : verify::checks()) {
    text += fmt::format("  {:<14} {}\n", check.name, check.summary);
  }
  return text;
}

void add_times(CLI::App& command, verify::VerifyRequest& request) {
  add_parsed(
      command, "--step", [&request](const std::string& text) { request.step = parse_step(text); },
      "Size of the communication steps; the unit's own if left out, or 0.001")
      ->type_name("SECONDS");
  add_parsed(
      command, "--stop",
      [&request](const std::string& text) { request.stop = core::parse_seconds(text); },
      "Simulated length of a run; by default the unit's own, or 200 steps, but 1000 steps at most")
      ->type_name("SECONDS");
  add_parsed(
      command, "--timeout",
      [&request](const std::string& text) {
        const double seconds = std::min(core::parse_above_zero(text), 1e9);
        request.limit = std::chrono::milliseconds(std::max(1L, std::lround(seconds * 1000)));
      },
      "Time limit of each check; 60 by default")
      ->type_name("SECONDS");
}

}  // namespace

void add_verify(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("verify", "Test whether a single unit keeps what it declares");
  const auto options = std::make_shared<Options>();
  verify::VerifyRequest& request = options->request;
  command
      ->add_option("FILE", request.file,
                   "An FMU: a .fmu, or its unpacked folder; or a table (.csv, .parquet, .mcap)")
      ->required()
      ->type_name("");
  command
      ->add_option("--check", request.checks,
                   "Run only this check of those below; may be given several times")
      ->type_name("CHECK")
      ->allow_extra_args(false);
  command
      ->add_option("--set", request.settings,
                   "Start value of a parameter or an input; an input stays at it; may be given "
                   "several times")
      ->type_name("VARIABLE=VALUE")
      ->allow_extra_args(false);
  add_times(*command, request);
  command->add_option("--seed", request.seed, "Seed of the stimulus of the other numeric inputs")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--instances", request.instances, "Instances that 'memory' makes and frees")
      ->type_name("N")
      ->check(CLI::Range(40U, 10'000'000U))
      ->capture_default_str();
  command
      ->add_option(
          "--leak", request.leak,
          "Heap memory that an instance may leave behind [byte], for modules that cannot be "
          "mended")
      ->type_name("BYTES")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--json", options->json, "Write the results to this file, too (.json)")
      ->type_name("FILE");
  command->footer(
      check_list() +
      "\nEach check runs in a process of its own, so a unit that crashes or hangs fails "
      "it.\nExit codes: 0 all good, 1 a check failed, 2 the input was wrong.\n");
  command->callback([options] { run(*options); });
}

}  // namespace stride::cli
