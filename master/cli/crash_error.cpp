#include "master/cli/crash_error.h"

#include <algorithm>
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
core::Error error_outside_of_calls(std::string_view end, bool is_leaving) {
  const auto [work, library] = importer::unfinished_library_work();
  if (library != nullptr) {
    const core::Context& user = library->user();
    return {core::Error::Kind::Run, user,
            fmt::format("{} in the {} of '{}'", end, work, library->shown_as()),
            hint_for(user.unit)};
  }
  return {core::Error::Kind::Run,
          {},
          fmt::format("{}{}", end,
                      is_leaving
                          ? " in a destructor or an exit function of a library, after the command"
                          : ", in no call of a unit"),
          kGeneralHint};
}

}  // namespace

std::string_view describe_end(int signal, std::span<char> text) {
  if (signal == 0) return "exit() ends stride";
  if (signal == SIGALRM) return format_into(text, "stride has not ended for {} s", kLongestEnd);
  return format_into(text, "signal {} ({}) ends stride", signal, isolation::signal_name(signal));
}

core::Error error_of(std::string_view end, std::span<const importer::UnitCall> calls,
                     bool is_leaving) {
  const auto own = std::ranges::find_if(calls, &importer::UnitCall::is_by_this_thread);
  if (own != calls.end()) {
    const importer::UnitCall& call = *own;
    const std::string variable = call.variable != nullptr ? *call.variable : "";
    const std::string hint = importer::state_hint(call.function, *call.unit);
    return {core::Error::Kind::Run,
            {.where = *call.where, .unit = *call.unit, .variable = variable, .time = call.time},
            fmt::format("{} in {}", end, call.function),
            hint.empty() ? hint_for(*call.unit) : hint};
  }
  if (calls.empty()) return error_outside_of_calls(end, is_leaving);
  std::string among;
  for (const importer::UnitCall& call : calls) {
    among += fmt::format("{}{} of '{}'",
                         among.empty() ? " in a thread that a unit has started, during " : ", ",
                         call.function, *call.unit);
  }
  return {core::Error::Kind::Run, {}, fmt::format("{}{}", end, among), kGeneralHint};
}

}  // namespace stride::cli
