// What happened at one stamp of a trace.
#ifndef STRIDE_MASTER_OBSERVE_TRACE_INSTANTS_H
#define STRIDE_MASTER_OBSERVE_TRACE_INSTANTS_H

#include <cstdint>
#include <optional>
#include <string_view>

#include "master/observe/trace/reader.h"
#include "master/observe/trace/spool.h"

namespace stride::trace {

inline constexpr std::string_view kAdvanceTime = "advanceTime";

/// Follows `advanceTime` through a trace: a total in ticks of the time scale that begins at 0 and
/// never falls. What is recorded at a stamp happened at the stamp plus the total behind all changes
/// of that stamp (docs/traces.md).
class AdvanceTime {
 public:
  /// Nothing where the trace has no such variable. Throws core::Error (Input) if it has two, or one
  /// that is not an integer of 64 bits at most.
  static std::optional<AdvanceTime> of(const Reader& reader);

  bool is(const Entry& change) const { return change.code == code_; }
  /// No other name shares its changes.
  bool is_alone() const { return is_alone_; }
  std::uint32_t code() const { return code_; }
  std::int64_t total() const { return total_; }

  /// Takes a change of it. Throws core::Error (Input) if it falls, or is not a number below 2^63.
  void update(const Reader& reader, const Entry& change);

 private:
  std::uint32_t code_ = 0;
  bool is_alone_ = true;
  std::int64_t total_ = 0;
  std::int64_t line_ = 0;  ///< of the last change
};

/// The declaration is one of advanceTime.
bool is_advance_time(const Header& header, const Declaration& declaration);

/// All entries from one stamp to the next one, equal stamps taken together. What
/// $dumpvars and its kin open ends with it, if not before.
struct Instant {
  bool has_stamp = false;     ///< false for what is before the first one
  std::int64_t stamp = 0;     ///< kernel time [ticks]
  std::int64_t time = 0;      ///< true time [ticks]: the stamp plus the whole advanceTime
  std::int64_t skipped = 0;   ///< advanceTime
  std::int64_t line = 0;      ///< of the stamp
  std::uint64_t changes = 0;  ///< but for those of advanceTime
  bool is_empty = true;       ///< nothing was recorded, or advanceTime only
  Spool text;                 ///< the entries but for advanceTime, each on a line of its own
};

/// Reads a trace instant by instant, and takes advanceTime out of it. Of a file that is cut off the
/// last instant is left out: its advanceTime may be what is missing.
class InstantReader {
 public:
  enum class Text { Keep, Drop };

  /// The reader outlives this.
  InstantReader(Reader& reader, Text text);

  /// Empty where the trace has no advanceTime.
  const std::optional<AdvanceTime>& advance_time() const { return advance_; }
  /// False at the end. Throws core::Error (Input) for true time beyond 2^63 - 1, and as the reader.
  bool next(Instant& instant);

 private:
  void take(Instant& instant, const Entry& entry);
  void take_change(Instant& instant, const Entry& entry);
  void end_dump(Instant& instant);
  void finish(Instant& instant);

  Reader& reader_;
  bool keeps_text_;
  std::optional<AdvanceTime> advance_;
  const Entry* ahead_ = nullptr;  ///< the stamp of the next instant
  bool is_first_ = true;
  bool is_in_dump_ = false;  ///< a $end has to come
};

}  // namespace stride::trace

#endif
