// The records of a journal as bytes.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_RECORD_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_RECORD_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <stride/time.h>

#include "master/observe/checkpoint/byte_log.h"
#include "master/observe/checkpoint/variable_lists.h"

namespace stride::checkpoint {

/// What a record is about; its first byte.
enum class Call : std::uint8_t {
  ForgetValues,  ///< no call: the values that follow do not refer to earlier ones
  EnterConfigurationMode,
  ExitConfigurationMode,
  EnterInitialization,
  ExitInitialization,
  EnterEventMode,
  UpdateDiscreteStates,
  EnterStepMode,
  Set,
  Get,
  Step,
  RequestInputs,  ///< by the unit, within a step
  EndStep,
  EnableIdleSkipping,
  SetIdleTolerances,
  GetClockInterval,
  GetClockShift,
  SetInputUpdate,
  End,  ///< no call
};

/// Bits that go with Call::Step.
struct StepBits {
  static constexpr std::uint8_t kMayGoBackBefore = 1, kFromHere = 2, kAsLong = 4;
};
/// Bits that go with Call::EndStep.
struct EndBits {
  static constexpr std::uint8_t kRejected = 1, kEarly = 2, kEvent = 4, kTerminate = 8,
                                kReachedEnd = 16;
};

__extension__ using Wide = unsigned __int128;

/// Appends one record. Numbers are as short as they are small.
class RecordWriter {
 public:
  RecordWriter(ByteLog& log, Call call) : log_(log) {
    log_.settle();
    put(static_cast<std::uint8_t>(call));
  }
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  void put(std::uint8_t byte) { log_.tail().push_back(std::byte{byte}); }
  void put_count(std::uint64_t count) { put_digits(count); }
  void put_duration(Duration duration) {
    const Picoseconds count = duration.count();
    put_digits((static_cast<Wide>(count) << 1) ^ static_cast<Wide>(count >> 127));
  }
  void put_time(Time time) { put_duration(time.time_since_epoch()); }
  void put_bytes(std::span<const std::byte> bytes) {
    log_.tail().insert(log_.tail().end(), bytes.begin(), bytes.end());
  }
  void put_double(double number) { put_bytes(std::as_bytes(std::span(&number, 1))); }
  /// What is another value than in the last call with this list.
  void put_values(VariableLists::Number number, VariableList& list, const core::ValueBlock& values);

 private:
  template <class Count>
  void put_digits(Count count) {
    for (; count >= 0x80; count >>= 7) put(static_cast<std::uint8_t>(count | 0x80));
    put(static_cast<std::uint8_t>(count));
  }

  ByteLog& log_;
};

/// Takes what a RecordWriter has put. Throws core::BadState for what none does.
class RecordReader {
 public:
  RecordReader(const ByteLog& log, ByteLog::Position from) : bytes_(log, from) {}

  bool is_at_end() { return bytes_.is_at_end(); }
  /// Of the next record, which take_call() takes.
  Call next_call();
  Call take_call();
  std::uint8_t take() {
    std::uint8_t byte = 0;
    bytes_.take(&byte, 1);
    return byte;
  }
  std::uint64_t take_count();
  Duration take_duration();
  Time take_time() { return Time(take_duration()); }
  double take_double() {
    double number = 0;
    bytes_.take(&number, sizeof number);
    return number;
  }
  VariableLists::Number take_number(const VariableLists& lists);
  /// The list, whose set_block() has the values.
  VariableList& take_values(VariableLists& lists);

 private:
  template <class Count>
  Count take_digits();
  void take_elements(VariableList& list, bool are_all);
  void take_sequence(auto& element);

  ByteLog::Reader bytes_;
};

}  // namespace stride::checkpoint

#endif
