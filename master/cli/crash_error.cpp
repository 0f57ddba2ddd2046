#include "master/cli/crash_error.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/importer/shared_library.h"
#include "master/importer/state_hint.h"
#include "master/isolation/process/child.h"

namespace stride::cli {
namespace {

template <class... Arguments>
std::string_view format_into(std::span<char> text, fmt::format_string<Arguments...> format,
                             Arguments&&... arguments) {
  const auto end =
      fmt::format_to_n(text.data(), text.size(), format, std::forward<Arguments>(arguments)...);
  return {text.data(), std::min(end.size, text.size())};
}

constexpr const char* kHint =
    "--isolate{} runs it in a process of its own, which cannot damage that of stride";
constexpr const char* kGeneralHint =
    "--isolate runs units in processes of their own, which cannot damage that of stride";

std::string hint_for(const std::string& unit) {
  return unit.empty() ? kGeneralHint : fmt::format(kHint, "=" + unit);
}

/// Of a process that calls no unit.
core::Error error_outside_of_calls(std::string_view end, std::string_view place) {
  const auto [work, library] = importer::unfinished_library_work();
  if (library != nullptr) {
    const core::Context& user = library->user();
    return {core::Error::Kind::Run, user,
            fmt::format("{} in the {} of '{}'", end, work, library->shown_as()),
            hint_for(user.unit)};
  }
  return {core::Error::Kind::Run, {}, fmt::format("{}{}", end, place), kGeneralHint};
}

using Calls = std::span<const importer::UnitCall>;

/// The one that ends the process; null if that is not known.
const importer::UnitCall* call_that_ends(const ProcessEnd& end, Calls calls) {
  if (end.origin != SignalOrigin::Call) return nullptr;
  const auto own = std::ranges::find_if(calls, &importer::UnitCall::is_by_this_thread);
  return own == calls.end() ? nullptr : &*own;
}

core::Error error_in(const importer::UnitCall& call, std::string_view end) {
  const std::string variable = call.variable != nullptr ? *call.variable : "";
  const std::string hint = importer::state_hint(call.function, *call.unit);
  return {core::Error::Kind::Run,
          {.where = *call.where, .unit = *call.unit, .variable = variable, .time = call.time},
          fmt::format("{} in {}", end, call.function),
          hint.empty() ? hint_for(*call.unit) : hint};
}

std::string names_of(Calls calls) {
  std::string names;
  for (const importer::UnitCall& call : calls) {
    names += fmt::format("{}{} of '{}'", names.empty() ? "" : ", ", call.function, *call.unit);
  }
  return names;
}

}  // namespace

std::string_view describe_end(const ProcessEnd& end, std::span<char> text) {
  switch (end.kind) {
    case ProcessEnd::Kind::Call:
      return format_into(text, "{}() ends stride", end.function);
    case ProcessEnd::Kind::TimeOut:
      return format_into(text, "stride has not ended for {} s", kLongestEnd);
    case ProcessEnd::Kind::Error:
      return format_into(text, "{}", end.error);
    case ProcessEnd::Kind::Signal:
      break;
  }
  return format_into(text, "signal {} ({}){} ends stride", end.signal,
                     isolation::signal_name(end.signal),
                     end.origin == SignalOrigin::Outside ? " from outside" : "");
}

core::Error error_of(const ProcessEnd& end, Calls calls, bool is_leaving) {
  if (end.kind == ProcessEnd::Kind::Error) return {core::Error::Kind::Run, {}, end.error};
  std::array<char, 80> text{};
  const std::string_view how = describe_end(end, text);
  if (const auto* call = call_that_ends(end, calls)) return error_in(*call, how);
  const bool is_from_outside = end.origin == SignalOrigin::Outside;
  if (calls.empty()) {
    if (is_from_outside) return {core::Error::Kind::Run, {}, std::string(how)};
    return error_outside_of_calls(
        how, is_leaving ? " in a destructor or an exit function of a library, after the command"
                        : ", in no call of a unit");
  }
  const char* const place = end.origin == SignalOrigin::Call
                                ? " in a thread that a unit has started, during "
                                : " during ";
  return {core::Error::Kind::Run,
          {},
          fmt::format("{}{}{}", how, place, names_of(calls)),
          is_from_outside ? "" : kGeneralHint};
}

std::string_view describe_briefly(const ProcessEnd& end, Calls calls, std::span<char> text) {
  std::array<char, 80> buffer{};
  const std::string_view how = describe_end(end, buffer);
  const auto* const call = call_that_ends(end, calls);
  if (call == nullptr) return format_into(text, "{}", how);
  return format_into(text, "unit '{}', at {} s: {} in {}", *call->unit,
                     to_seconds(call->time.value_or(Time{})), how, call->function);
}

}  // namespace stride::cli
