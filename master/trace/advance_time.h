// The variable of a trace that tells how much idle time was skipped.
#ifndef STRIDE_MASTER_TRACE_ADVANCE_TIME_H
#define STRIDE_MASTER_TRACE_ADVANCE_TIME_H

#include <cstdint>
#include <optional>
#include <string_view>

#include "master/trace/reader.h"

namespace stride::trace {

inline constexpr std::string_view kAdvanceTime = "advanceTime";

/// Follows `advanceTime` through a trace: a total in ticks of the time scale that begins at 0 and
/// never falls. What is recorded at a stamp happened at the stamp plus the total behind all changes
/// of that stamp (docs/traces.md).
class AdvanceTime {
 public:
  /// Nothing where the trace has no such variable. Throws core::Error (Input) if it has two, or one
  /// that is no integer of 64 bits at most.
  static std::optional<AdvanceTime> of(const Reader& reader);

  bool is(const Entry& change) const { return change.code == code_; }
  /// No other name shares its changes.
  bool is_alone() const { return is_alone_; }
  std::uint32_t code() const { return code_; }
  std::int64_t total() const { return total_; }

  /// Takes a change of it. Throws core::Error (Input) if it falls, or is no number below 2^63.
  void update(const Reader& reader, const Entry& change);

 private:
  std::uint32_t code_ = 0;
  bool is_alone_ = true;
  std::int64_t total_ = 0;
  std::int64_t line_ = 0;  ///< of the last change
};

/// The declaration is one of advanceTime.
bool is_advance_time(const Header& header, const Declaration& declaration);

}  // namespace stride::trace

#endif
