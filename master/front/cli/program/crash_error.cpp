#include "master/front/cli/program/crash_error.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include <fmt/format.h>

#include "master/base/child_process/child.h"
#include "master/loader/fmu/instance/state_hint.h"

namespace stride::cli {
namespace {

constexpr const char* kHint =
    "--isolate{} runs it in a process of its own, which cannot damage that of stride";
constexpr const char* kGeneralHint =
    "--isolate runs units in processes of their own, which cannot damage that of stride";

std::string hint_for(const std::string& unit) {
  return unit.empty() ? kGeneralHint : fmt::format(kHint, "=" + unit);
}

/// "signal 11 (SIGSEGV) ends stride"
std::string describe(const ProcessEnd& end) {
  switch (end.kind) {
    case ProcessEnd::Kind::ExitCall:
      return "exit() ends stride";
    case ProcessEnd::Kind::ExitCode:
      return fmt::format("an exit with code {} ends stride", end.number);
    case ProcessEnd::Kind::Program:
      return fmt::format("the program '{}' has replaced stride", end.text.view());
    case ProcessEnd::Kind::TimeOut:
      return fmt::format("stride has not ended for {} s", kLongestEnd);
    case ProcessEnd::Kind::Error:
      return std::string(end.text.view());
    case ProcessEnd::Kind::Signal:
      break;
  }
  return fmt::format("signal {} ({}){} ends stride", end.number, isolation::signal_name(end.number),
                     end.origin == SignalOrigin::Outside ? " from outside" : "");
}

core::Error error_of_locked_output(const std::string& end, std::span<const core::Context> users) {
  const bool is_known = users.size() == 1;
  return {core::Error::Kind::Run, is_known ? users.front() : core::Context{},
          fmt::format("{}, since a thread that {} has started keeps the lock of the standard "
                      "output or error stream (flockfile)",
                      end, is_known ? "it" : "a unit" + importer::names_in_brackets(users)),
          hint_for(is_known ? users.front().unit : "")};
}

/// Not the error's context, since it is a suspicion: "the last call was fmi3DoStep of …".
std::string last_call(const importer::UnitCall& call) {
  return fmt::format("the last call was {} of unit '{}'{}", call.function, call.unit,
                     call.time ? fmt::format(" at {} s", to_seconds(*call.time)) : "");
}

/// Of a process that calls no unit.
core::Error error_outside_of_calls(const std::string& end, const UnitWork& work) {
  const importer::LibraryWork& library = work.library;
  if (!library.what.view().empty()) {
    const std::string unit(library.unit.view());
    return {core::Error::Kind::Run,
            {.where = {std::string(library.file.view()), library.line}, .unit = unit},
            fmt::format("{} in the {} of '{}'", end, library.what.view(), library.library.view()),
            hint_for(unit)};
  }
  if (work.has_locked_output) return error_of_locked_output(end, work.users);
  if (work.is_leaving) {
    return {core::Error::Kind::Run,
            {},
            end + " in a destructor or an exit function of a library, after the command",
            kGeneralHint};
  }
  const std::string place = end + ", in no call of a unit";
  if (!work.last) return {core::Error::Kind::Run, {}, place, kGeneralHint};
  return {core::Error::Kind::Run,
          {},
          fmt::format("{}; {}", place, last_call(*work.last)),
          hint_for(work.last->unit)};
}

core::Error error_in(const importer::UnitCall& call, const std::string& end) {
  const std::string hint = importer::state_hint(call.function.c_str(), call.unit);
  return {core::Error::Kind::Run,
          {.where = call.where, .unit = call.unit, .variable = call.variable, .time = call.time},
          fmt::format("{} {}", end, call.function),
          hint.empty() ? hint_for(call.unit) : hint};
}

std::string names_of(std::span<const importer::UnitCall> calls) {
  constexpr std::size_t kMost = 5;
  std::vector<std::string> names;
  for (const importer::UnitCall& call : calls) {
    names.push_back(fmt::format("{} of '{}'", call.function, call.unit));
  }
  return core::abridged(names, kMost);
}

}  // namespace

core::Error error_of(const ProcessEnd& end, const UnitWork& work) {
  const std::string how = describe(end);
  if (end.kind == ProcessEnd::Kind::Error) return {core::Error::Kind::Run, {}, how};
  if (work.is_overwritten) {
    return {core::Error::Kind::Run,
            {},
            how + ", after other code had overwritten what stride notes of its calls",
            kGeneralHint};
  }
  const bool is_by_call = end.origin == SignalOrigin::Call;
  const auto own = std::ranges::find_if(work.calls, &importer::UnitCall::is_by_thread);
  if (is_by_call && own != work.calls.end()) return error_in(*own, how + " in");
  if (is_by_call && end.thread == nullptr && work.calls.size() == 1) {
    return error_in(work.calls.front(), how + " during");
  }
  const bool is_from_outside = end.origin == SignalOrigin::Outside;
  if (work.calls.empty() && is_from_outside) return {core::Error::Kind::Run, {}, how};
  if (work.calls.empty()) return error_outside_of_calls(how, work);
  const char* const place = is_by_call && end.thread != nullptr
                                ? " in a thread that a unit has started, during "
                                : " during ";
  return {core::Error::Kind::Run,
          {},
          how + place + names_of(work.calls),
          is_from_outside ? "" : kGeneralHint};
}

}  // namespace stride::cli
