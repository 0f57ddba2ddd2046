#include "master/study/verify/verify.h"

#include <algorithm>
#include <chrono>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/child_process/child.h"
#include "master/base/child_process/shared_memory.h"
#include "master/base/error.h"
#include "master/base/text/suggest.h"
#include "master/loader/fmu/instance/call_note.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;
using End = isolation::ChildOutcome::End;

std::string dump(const OrderedJson& json) {
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace);
}

std::string to_text(const Finding& finding) {
  return dump({static_cast<int>(finding.verdict), finding.seen, finding.notes});
}

/// The unit may write to the pipe, too.
constexpr const char* kUnreadable = "the answer of its process is unreadable";

Finding finding_from_text(const std::string& text) {
  try {
    const OrderedJson json = OrderedJson::parse(text);
    return {static_cast<Verdict>(json.at(0).get<int>()), json.at(1), json.at(2)};
  } catch (const OrderedJson::exception&) {
    return failed(kUnreadable);
  }
}

void check_names(const std::vector<std::string>& wanted) {
  std::vector<std::string> known;
  for (const UnitCheck& check : checks()) known.emplace_back(check.name);
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    core::fail_input(
        {}, fmt::format("--check {}: there is no such check", name),
        fmt::format("{}; there are {}", core::suggestion(name, known), core::quoted(known)));
  }
}

bool is_wanted(const UnitCheck& check, const std::vector<std::string>& wanted) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), check.name) != wanted.end();
}

Finding failed_against(const std::string& rule, const std::string& seen) {
  return failed(rule.empty() ? seen : fmt::format("{} ({})", seen, rule));
}

Finding run_isolated(const UnitCheck& check, const TestedUnit& tested, const Hooks& hooks) {
  const isolation::Shared<importer::CallNote> note;
  const std::string rule = rule_of(check.rules, tested.description().fmi_version);
  const auto work = [&] {
    const Trial trial{tested, *note};
    try {
      return to_text(check.run(trial));
    } catch (const Failure& failure) {
      return to_text(failed_against(failure.breaks_rule() ? rule : "", failure.what()));
    } catch (const core::Error& error) {
      return to_text(failed_against(rule, error.what()));
    } catch (const OrderedJson::exception&) {
      return to_text(failed(kUnreadable));
    }
  };
  const isolation::ChildOutcome outcome = isolation::run_in_child(
      work, {.limit = tested.request().limit, .interrupted = hooks.interrupted});
  if (outcome.end == End::Interrupted) {
    core::fail_run({}, fmt::format("interrupted during the check '{}'", check.name));
  }
  if (outcome.end == End::Answered) return finding_from_text(outcome.text);
  std::string text = explain(outcome, *note);
  if (outcome.end == End::TimedOut) {
    text += fmt::format(" (limit: {} s)",
                        std::chrono::duration<double>(tested.request().limit).count());
  }
  return failed(std::move(text));
}

/// A message of several lines as one.
void flatten(std::string& text) {
  constexpr std::string_view kHint = "\n  hint: ";
  for (std::size_t at = text.find(kHint); at != std::string::npos; at = text.find(kHint)) {
    text.replace(at, kHint.size(), "; ");
  }
  std::replace(text.begin(), text.end(), '\n', ';');
}

}  // namespace

std::vector<Result> verify(const TestedUnit& tested, const Hooks& hooks) {
  check_names(tested.request().checks);
  std::vector<Result> results;
  bool has_loaded = true;
  for (const UnitCheck& check : checks()) {
    if (!is_wanted(check, tested.request().checks)) continue;
    hooks.on_begin(check.name);
    const auto begin = std::chrono::steady_clock::now();
    Finding finding = has_loaded ? run_isolated(check, tested, hooks)
                                 : skipped("the library cannot be used, see 'load'");
    if (check.run == &check_load) has_loaded = finding.verdict == Verdict::Passed;
    flatten(finding.seen);
    for (std::string& note : finding.notes) flatten(note);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    results.push_back({check.name, std::move(finding), seconds.count()});
  }
  return results;
}

bool all_good(const std::vector<Result>& results) {
  return std::none_of(results.begin(), results.end(), [](const Result& result) {
    return result.finding.verdict == Verdict::Failed;
  });
}

std::string json_text(const TestedUnit& tested, const std::vector<Result>& results) {
  const core::UnitDescription& unit = tested.description();
  OrderedJson json = {{"file", tested.fmu().path().string()},
                      {"model", unit.model_name},
                      {"fmi_version", unit.fmi_version},
                      {"step", to_seconds(tested.step())},
                      {"stop", to_seconds(tested.point(tested.steps()))},
                      {"seed", tested.request().seed},
                      {"good", all_good(results)},
                      {"checks", OrderedJson::array()}};
  for (const auto& [check, finding, seconds] : results) {
    json["checks"].push_back({{"name", check},
                              {"verdict", name(finding.verdict)},
                              {"seen", finding.seen},
                              {"notes", finding.notes},
                              {"wall_time", seconds}});
  }
  return dump(json) + '\n';
}

}  // namespace stride::verify
