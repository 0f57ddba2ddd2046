// What the tests of the checks share.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_CHECKS_SUPPORT_H
#define STRIDE_TESTS_MASTER_OBSERVE_CHECKS_SUPPORT_H

#include <chrono>
#include <optional>
#include <ostream>
#include <string>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "master/engine/model/description.h"
#include "master/engine/model/values.h"
#include "master/observe/checks/check.h"

namespace stride::checks {

constexpr Time at(std::int64_t milliseconds) {
  return Time(std::chrono::milliseconds(milliseconds));
}

inline Window window(std::optional<std::int64_t> from, std::optional<std::int64_t> to) {
  Window made;
  if (from) made.from = at(*from);
  if (to) made.to = at(*to);
  return made;
}

inline core::Variable variable(core::ValueType type, const std::string& unit = "") {
  core::Variable made;
  made.name = "x";
  made.type = type;
  made.unit = unit;
  return made;
}

/// A message at the variable (0, `place`).
inline core::Message message(std::int64_t milliseconds, std::size_t place) {
  return {at(milliseconds), 0, {0, place}, false, nullptr, 0};
}

/// Of a run that went to its end there, and of one that did not.
inline Ending ended(std::int64_t milliseconds) { return {at(milliseconds), true}; }
inline Ending broke(std::int64_t milliseconds) { return {at(milliseconds), false}; }

/// A check that goes on where another one is.
template <class OneCheck>
void take_over(OneCheck& check, OneCheck& other) {
  core::StateArchive written;
  other.persist(written);
  core::StateArchive read(written.bytes());
  check.persist(read);
  read.end();
}

/// "0.5 V at 0.01 s", or "none".
inline std::string margin_of(const core::Verdict& verdict) {
  if (!verdict.margin) return "none";
  return core::to_text(*verdict.margin) + " at " + core::to_text(verdict.margin->at) + " s";
}

/// All of a verdict that can differ.
inline std::string text_of(const core::Verdict& verdict) {
  std::string text = verdict.text + (verdict.time ? core::to_text(*verdict.time) : "-");
  text += verdict.passed ? (*verdict.passed ? " passed" : " failed") : " undecided";
  for (const auto& value : verdict.values) text += " " + core::element_text(value.value, 0);
  if (verdict.margin) text += "; " + margin_of(verdict);
  return text;
}

}  // namespace stride::checks

#endif
