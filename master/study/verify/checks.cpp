#include "master/study/verify/checks.h"

#include <string_view>

#include <fmt/format.h>

#include "master/base/child_process/child.h"
#include "master/base/error.h"
#include "master/base/time_text.h"
#include "master/study/verify/finding.h"

namespace stride::verify {
namespace {

using End = isolation::ChildOutcome::End;

/// The last line that is not empty, without what no table can show.
std::string last_line(const std::string& printed) {
  std::string line;
  std::string last;
  for (const char c : printed + "\n") {
    if (c == '\n') {
      if (!line.empty()) last = line;
      line.clear();
    } else if (static_cast<unsigned char>(c) >= ' ') {
      line += c;
    }
  }
  constexpr std::size_t kMost = 200;
  return last.substr(0, kMost);
}

}  // namespace

std::string explain(const isolation::ChildOutcome& outcome, const importer::CallNote& note) {
  std::string text;
  switch (outcome.end) {
    case End::Answered:
    case End::Threw:
      return outcome.text;
    case End::Killed:
      text = fmt::format("it crashed with signal {} ({})", outcome.code,
                         isolation::signal_name(outcome.code));
      break;
    case End::Exited:
      text = fmt::format("it ended the process with exit code {}", outcome.code);
      break;
    case End::TimedOut:
      text = "it did not come to an end in time";
      break;
    case End::Interrupted:
    case End::Unkept:  // it has no keeper
      text = "it was interrupted";
      break;
  }
  if (const std::string_view function = note.function(); !function.empty()) {
    text += fmt::format(" in {} at {} s", function, core::to_text(note.time()));
  }
  if (const std::string line = last_line(outcome.printed); !line.empty()) {
    text += fmt::format("; its last output: {}", line);
  }
  return text;
}

std::string Trial::in_child(const std::function<std::string()>& work) const {
  note.clear();
  isolation::ChildOutcome outcome = isolation::run_in_child(work);
  if (outcome.end == End::Answered) return std::move(outcome.text);
  throw Failure(explain(outcome, note));
}

Recording Trial::record(const TestInstanceOptions& options, std::size_t to) const {
  return recording_from_text(in_child([&] {
    TestInstance instance = make_instance(options);
    instance.start();
    instance.run_to(to == 0 ? tested.steps() : to);
    return to_text(instance.recording());
  }));
}

bool Trial::is_of_kit() const {
  return in_child([&] {
           const auto library = tested.fmu().load_fmi3_library();
           return std::string(library && library->describes_itself() ? "yes" : "no");
         }) == "yes";
}

const char* name(Verdict verdict) {
  constexpr const char* kNames[] = {"passed", "FAILED", "skipped"};
  return kNames[static_cast<std::size_t>(verdict)];
}

const std::vector<UnitCheck>& checks() {
  static const std::vector<UnitCheck> checks = {
      {"load", "the library loads, has the functions that are declared, and unloads", &check_load},
      {"description", "the model description is complete and agrees with itself",
       &check_description},
      {"values",
       "start values are what the unit has, and values stay within min and max",
       &check_values,
       {"2.2.7", "2.4.7"}},
      {"dependencies",
       "an output does not depend on an input that is declared to be none of its",
       &check_dependencies,
       {"2.2.8", "2.4.8"}},
      {"events",
       "Event Mode, early returns and next events are as declared",
       &check_events,
       {nullptr, "2.3.5 and 4.2.1"}},
      {"calls",
       "an instance called in order works; calls out of order are refused",
       &check_calls,
       {"4.2.4", "2.3 and 4.2"}},
      {"messages", "message descriptions are valid text and change no state", &check_messages},
      {"splitting", "steps may be split, if the unit declares it", &check_splitting},
      {"idle", "what the unit promises while it is idle holds, and skipping changes nothing else",
       &check_idle},
      {"rejection",
       "a rejected step leaves the unit as it was",
       &check_rejection,
       {"2.1.3 and 2.1.8", "2.2.4"}},
      {"reset", "after a reset the unit is like a new one", &check_reset, {"2.1.6", "2.3.1"}},
      {"instances",
       "instances in one process do not disturb each other",
       &check_instances,
       {"4.3.1", "2.4.2"}},
      {"restore",
       "an instance continues from a restored state as from the saved one",
       &check_restore,
       {"2.1.8", "2.2.7.4"}},
      {"repetition",
       "steps that are repeated from a restored state have the same results",
       &check_repetition,
       {"2.1.8", "2.2.7.4"}},
      {"serialization",
       "an instance continues from a serialised state, also in another process",
       &check_serialization,
       {"2.1.8", "2.2.7.4"}},
      {"memory",
       "neither memory nor files nor threads are left behind",
       &check_memory,
       {"2.1.5", "2.3.1"}},
      {"determinism", "two processes get the same bits", &check_determinism},
  };
  return checks;
}

std::string rule_of(const Rules& rules, const std::string& fmi_version) {
  const char* const section = fmi_version.starts_with("2.")   ? rules.fmi2
                              : fmi_version.starts_with("3.") ? rules.fmi3
                                                              : nullptr;
  return section != nullptr ? fmt::format("FMI {}.0, {}", fmi_version.front(), section) : "";
}

}  // namespace stride::verify
