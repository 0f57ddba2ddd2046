// stride trace: idle time in value change dumps.
#include <functional>
#include <memory>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/observe/trace/compress.h"
#include "master/observe/trace/expand.h"
#include "master/observe/trace/info.h"

namespace stride::cli {
namespace {

struct TraceArguments {
  std::filesystem::path from;
  std::filesystem::path to;
  std::optional<Duration> min_gap;
  bool is_cut_off = false;

  trace::CutOff cut_off() const {
    return is_cut_off ? trace::CutOff::Accept : trace::CutOff::Refuse;
  }
};

void warn_of(const std::filesystem::path& file, std::optional<std::int64_t> cut) {
  if (!cut) return;
  spdlog::warn("{}:{}: the file is cut off here; its last instant is left out", file.string(),
               *cut);
}

std::string ratio(const trace::Info& info) {
  if (info.kernel_time == 0) return "–";
  return fmt::format("{:.6g} : 1",
                     static_cast<double>(info.true_time) / static_cast<double>(info.kernel_time));
}

std::string facts(const trace::Info& info) {
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}  {}\n", name, value);
  };
  add("size", core::counted(info.bytes, "byte"));
  add("time scale", info.timescale.text());
  add("variables", std::to_string(info.variables));
  add("changes", fmt::format("{} at {}", info.changes, core::counted(info.instants, "instant")));
  add("kernel time", info.timescale.seconds(info.kernel_time) + " s");
  add("true time", info.timescale.seconds(info.true_time) + " s");
  add("ratio", ratio(info));
  add("skips", std::to_string(info.skips));
  add("gaps", fmt::format("{} longer than {} s", info.gaps, info.timescale.seconds(info.min_gap)));
  return text;
}

std::string gaps(const trace::Info& info) {
  Table table({{"from [s]", Table::Align::Right},
               {"to [s]", Table::Align::Right},
               {"length [s]", Table::Align::Right},
               {"skipped [s]", Table::Align::Right}});
  const auto seconds = [&](std::int64_t ticks) { return info.timescale.seconds(ticks); };
  for (const trace::Gap& gap : info.longest) {
    table.add({seconds(gap.from), seconds(gap.to), seconds(gap.length()), seconds(gap.skipped)});
  }
  return table.text();
}

void show(const TraceArguments& arguments) {
  const trace::Info info = trace::info(arguments.from, arguments.min_gap, arguments.cut_off());
  warn_of(arguments.from, info.cut);
  print_text("{}: {}\n{}", arguments.from.string(),
             info.has_advance_time ? "idle time is left out (advanceTime)"
                                   : "no advanceTime, so its time is true",
             facts(info));
  if (info.longest.empty()) return;
  print_text("\nLongest gaps\n{}", gaps(info));
}

void expand(const TraceArguments& arguments) {
  warn_of(arguments.from, trace::expand(arguments.from, arguments.to, arguments.cut_off()));
}

void compress(const TraceArguments& arguments) {
  warn_of(arguments.from,
          trace::compress(arguments.from, arguments.to, arguments.min_gap, arguments.cut_off()));
}

/// A command with the options that all of them have.
CLI::App& add_command(CLI::App& group, const std::string& name, const std::string& meaning,
                      const std::shared_ptr<TraceArguments>& arguments,
                      const std::function<void(const TraceArguments&)>& work) {
  CLI::App* command = group.add_subcommand(name, meaning);
  command->add_option("IN.vcd", arguments->from, "The value change dump to read")
      ->required()
      ->type_name("");
  command->add_flag("--cut-off", arguments->is_cut_off,
                    "Take a file that ends anywhere, as a run that crashed leaves it: all "
                    "instants but the last");
  command->callback([arguments, work] { work(*arguments); });
  return *command;
}

void add_output(CLI::App& command, const std::shared_ptr<TraceArguments>& arguments) {
  command.add_option("OUT.vcd", arguments->to, "The file to write; one that exists is replaced")
      ->required()
      ->type_name("");
}

void add_min_gap(CLI::App& command, const std::shared_ptr<TraceArguments>& arguments) {
  command
      .add_option_function<std::string>(
          "--min-gap",
          [arguments](const std::string& text) {
            try {
              arguments->min_gap = core::parse_seconds(text);
            } catch (const std::invalid_argument& mistake) {
              core::fail_input({}, fmt::format("--min-gap {}: {}", text, mistake.what()));
            }
          },
          "Shortest time without any change that is a gap; 0.001 by default")
      ->type_name("SECONDS");
}

}  // namespace

void add_trace(CLI::App& app) {
  CLI::App* group =
      app.add_subcommand("trace", "Show, remove or restore the idle time in a value change dump");
  group->require_subcommand(1);
  const auto arguments = std::make_shared<TraceArguments>();
  CLI::App& info =
      add_command(*group, "info", "Show what a trace holds, and its gaps", arguments, show);
  add_min_gap(info, arguments);
  CLI::App& to_true = add_command(
      *group, "expand", "Restore the true time of a trace with advanceTime", arguments, expand);
  add_output(to_true, arguments);
  CLI::App& to_short =
      add_command(*group, "compress", "Shorten the gaps of a trace, which 'expand' can restore",
                  arguments, compress);
  add_output(to_short, arguments);
  add_min_gap(to_short, arguments);
}

}  // namespace stride::cli
