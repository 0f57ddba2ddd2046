// What happened at one stamp of a trace.
#ifndef STRIDE_MASTER_TRACE_INSTANTS_H
#define STRIDE_MASTER_TRACE_INSTANTS_H

#include <cstdint>
#include <optional>

#include "master/trace/advance_time.h"
#include "master/trace/reader.h"
#include "master/trace/spool.h"

namespace stride::trace {

/// All entries from one stamp to the next one, equal stamps taken together. What
/// $dumpvars and its kin open ends with it, if not before.
struct Instant {
  bool has_stamp = false;  ///< false for what stands before the first one
  std::int64_t stamp = 0;  ///< kernel time [ticks]
  std::int64_t time = 0;  ///< true time [ticks]: the stamp plus what advanceTime says behind it all
  std::int64_t skipped = 0;   ///< advanceTime
  std::int64_t line = 0;      ///< of the stamp
  std::uint64_t changes = 0;  ///< but for those of advanceTime
  bool is_empty = true;       ///< nothing was recorded, or advanceTime only
  Spool text;                 ///< the entries but for advanceTime, each on a line of its own
};

/// Reads a trace instant by instant, and takes advanceTime out of it. Of a file that is cut off the
/// last instant is left out: its advanceTime may be what is missing.
class Instants {
 public:
  enum class Text { Keep, Drop };

  /// The reader outlives this.
  Instants(Reader& reader, Text text);

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
