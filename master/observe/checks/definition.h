// The checks of a scenario, resolved to the variables of its system.
#ifndef STRIDE_MASTER_OBSERVE_CHECKS_DEFINITION_H
#define STRIDE_MASTER_OBSERVE_CHECKS_DEFINITION_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/engine/port/observer.h"
#include "master/observe/checks/condition.h"

namespace stride::checks {

/// always, never, eventually, until: of the values during the interval. final: of the value where
/// the run ends. count: of the messages during the interval. answer: of each request during the
/// interval.
enum class Kind : std::uint8_t { Always, Never, Eventually, Until, Final, Count, Answer };

/// As run.json has it: "always".
const char* name(Kind kind);

/// The instants that a check is about, both ends included; nothing: from the start, to the end.
struct Window {
  std::optional<Time> from;
  std::optional<Time> to;

  bool has_begun(Time time) const { return !from || time >= *from; }
  bool is_past(Time time) const { return to && time > *to; }
  bool contains(Time time) const { return has_begun(time) && !is_past(time); }
  /// " from 8 s to 20 s", " up to 20 s"
  std::string text() const;
};

/// One element of a signal keeps to a condition.
struct SignalDemand {
  core::VariableId id;
  std::size_t element = 0;
  std::string signal;  ///< its full name
  std::string unit;    ///< of measure
  Condition condition;
};

/// One signal keeps to its condition until another one meets the second.
struct UntilDemand {
  SignalDemand holds, ends;
  /// "sensor.led = true"
  std::string text() const { return ends.signal + " " + ends.condition.text(); }
};

/// How many messages travel at a variable: those that it sends if it is an output, those that it
/// receives if it is an input. One of the limits is there.
struct CountDemand {
  core::VariableId event;
  std::optional<std::uint64_t> min{};
  std::optional<std::uint64_t> max{};
};

/// Each message at `request` is followed by one at `reply`, at the same time or later, by `within`
/// at most. A reply answers the oldest request that is open, and only this one; with `repeats` it
/// answers all that are open, since those behind the first repeat it.
struct AnswerDemand {
  core::VariableId request;
  core::VariableId reply;
  Duration within{};
  bool repeats = false;
};

struct Definition {
  Kind kind = Kind::Always;
  std::string name;    ///< unique in its scenario
  std::string demand;  ///< in words
  Window window;
  core::Location where;
  std::variant<SignalDemand, UntilDemand, CountDemand, AnswerDemand> what;
};

}  // namespace stride::checks

#endif
