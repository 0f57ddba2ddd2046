#include "master/system/scenario/units/foreign_table.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/child_process/child.h"
#include "master/base/child_process/sandbox.h"
#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/output_file.h"
#include "master/system/scenario/units/table_script.h"

namespace stride::scenario {
namespace {

namespace fs = std::filesystem;

/// The exit code of the script for a file that it does not read.
constexpr int kWrongFile = 3;
constexpr int kNoProgram = 127;

std::string python() {
  const char* const named = std::getenv("STRIDE_PYTHON");
  return named != nullptr && *named != '\0' ? named : "python3";
}

/// The script lies alone in its folder, which Python searches for modules; what a table lies beside
/// is not searched.
[[noreturn]] void become(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(kNoProgram);
}

std::string why(const isolation::ChildOutcome& outcome, const std::string& program) {
  using End = isolation::ChildOutcome::End;
  if (outcome.end == End::Threw) return outcome.text;
  if (outcome.end == End::Killed) {
    return fmt::format("'{}' was ended by {}", program, isolation::signal_name(outcome.code));
  }
  return fmt::format("'{}' ended with the exit code {}", program, outcome.code);
}

[[noreturn]] void fail(const isolation::ChildOutcome& outcome, const std::string& program,
                       const fs::path& shown_as) {
  const bool has_exited = outcome.end == isolation::ChildOutcome::End::Exited;
  if (has_exited && outcome.code == kNoProgram) {
    core::fail_input({.where = {shown_as.string(), 0}},
                     fmt::format("a table of this kind is read by Python, and there is no program "
                                 "'{}'",
                                 program),
                     "install Python 3, or name it by STRIDE_PYTHON=PROGRAM");
  }
  std::string printed = outcome.printed;
  while (!printed.empty() && printed.back() == '\n') printed.pop_back();
  if (!has_exited || outcome.code != kWrongFile) {
    core::fail_input({.where = {shown_as.string(), 0}},
                     fmt::format("it cannot be read: {}{}{}", why(outcome, program),
                                 printed.empty() ? "" : ":\n", printed));
  }
  constexpr std::string_view kHint = "\n  hint: ";
  const std::size_t hint = std::min(printed.find(kHint), printed.size());
  core::fail_input({.where = {shown_as.string(), 0}}, printed.substr(0, hint),
                   hint == printed.size() ? "" : printed.substr(hint + kHint.size()));
}

}  // namespace

void write_as_csv(const fs::path& table, const fs::path& csv, const fs::path& shown_as) {
  core::open_input(table);
  const archive::TemporaryFolder folder;
  const fs::path script = folder.path() / "table_to_csv.py";
  core::OutputFile file(script);
  file.write(kTableScript);
  file.close();
  const std::string program = python();
  const std::vector<std::string> words{program, "-B", script.string(), fs::absolute(table).string(),
                                       fs::absolute(csv).string()};
  const auto outcome = isolation::run_in_child([&]() -> std::string {
    const isolation::WritableFolder writable{fs::absolute(csv).parent_path(), "the folder of CSV"};
    isolation::enter_sandbox({&writable, 1});
    become(words);
  });
  const bool is_done = outcome.end == isolation::ChildOutcome::End::Exited && outcome.code == 0;
  if (!is_done) fail(outcome, program, shown_as);
}

}  // namespace stride::scenario
