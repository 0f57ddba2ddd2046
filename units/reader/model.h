// The robot's behaviour: it runs a program, sends the commands and makes sense of the answers.
#ifndef STRIDE_UNITS_READER_MODEL_H
#define STRIDE_UNITS_READER_MODEL_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <stride/nfc/frame.h>
#include <stride/time.h>

#include "units/reader/answer.h"
#include "units/reader/program.h"
#include "units/reader/variation.h"

namespace reader {

enum class Outcome : std::uint8_t {
  Waiting,     ///< on the air, or its answer is, or it is to be sent again
  Answered,    ///< an intact answer with status Ok
  Refused,     ///< an intact answer with another status
  Unanswered,  ///< no answer began in time
  Damaged,     ///< an answer came, but parity, CRC or content were wrong
  Cut,         ///< the antenna was switched off while the request was on the air
  NotSent,     ///< the antenna was off when its turn had come
};

/// What became of one command of the program.
struct Record {
  stride::Time sent_at;     ///< when its first frame began; when its turn came, if none did
  stride::Time settled_at;  ///< when the answer's frame ended, or the reader gave it up
  std::uint32_t tries = 0;  ///< frames that were sent for it
  Outcome outcome = Outcome::Waiting;
  Answer answer;             ///< if there was an intact one
  bool as_expected = false;  ///< once it is settled
};

/// A temperature that the sensor has sent.
struct Measurement {
  stride::Time received;  ///< when its answer ended
  double temperature;     ///< [degC]
  stride::Duration age;   ///< as the sensor sent it, when it was received: it is this at least,
  stride::Duration age_resolution;  ///< and less than this more, but for the answer's way
};

/// How many commands were sent, and what became of them. A command that is still waiting is in
/// sent only.
struct Counts {
  std::uint64_t sent = 0;
  std::uint64_t retries = 0;      ///< frames sent again, for whichever command
  std::uint64_t answered = 0;     ///< by an intact answer, whatever its status
  std::uint64_t refused = 0;      ///< those of the answered ones whose status was not Ok
  std::uint64_t unanswered = 0;   ///< in the end; sent = answered + unanswered + waiting
  std::uint64_t damaged = 0;      ///< those of the unanswered ones whose last answer was damaged
  std::uint64_t as_expected = 0;  ///< of all that are settled, those never sent included
  std::uint64_t unexpected = 0;   ///< likewise
};

/// At each communication point call advance(), then receive() for each frame that arrives there and
/// advance() again, as such a frame may have ended already, then transmit(). A point at each
/// next_event_time() makes the reader exact: a command leaves at the first communication point at
/// or after its programmed instant.
///
/// One command is under way at a time; the next one waits until it is settled. The time limit runs
/// from the end of the request to the start of the answer, as the frame waiting time in ISO/IEC
/// 14443-4, 7.2 does. A frame may arrive at any time from its start to its end; the reader looks at
/// frame.start and nfc::air_time() only, so it gives a command up when no answer that began in time
/// can be on the air any more. A command without an intact answer is sent again after its pause as
/// often as the program requires, while the antenna is on.
class Reader {
 public:
  /// An answer on the air.
  struct Reception {
    stride::Time end;
    bool intact = false;
    Answer answer;
  };

  enum class Phase : std::uint8_t { Idle, Waiting, Receiving, Pausing };

  /// All that a rollback has to bring back. What the axes and the carrier do is not part of it:
  /// they are functions of time.
  struct State {
    std::vector<Record> records;  ///< of the commands so far, in the program's order
    Phase phase = Phase::Idle;
    stride::Time request_start;
    stride::Time request_end;
    stride::Time deadline;    ///< until when the answer may begin
    stride::Time give_up_at;  ///< when none that began in time can still come
    stride::Time retry_at;    ///< while pausing
    Outcome last_try = Outcome::Waiting;
    Reception reception;
    Counts counts;
    double temperature = 0.0;              ///< last measured [degC], 0 before the first
    std::uint32_t identifier = 0;          ///< of the sensor, 0 before it is known
    std::uint32_t logged = 0;              ///< samples in the last log that was read
    std::deque<Measurement> measurements;  ///< not taken yet, in the order of the answers
  };

  Reader() = default;
  explicit Reader(Program program);

  const Program& program() const { return program_; }
  double axis(std::size_t index, stride::Time time) const;  ///< target of an axis [rad]
  double carrier_power(stride::Time time) const;            ///< [W]

  /// Notes what has ended by `now`: an answer, the time for one, or a pause.
  void advance(stride::Time now);

  /// Whether transmit() has something to do.
  bool is_due(stride::Time now) const;

  /// The frame of a command that is due, which begins now. Or, if the antenna was switched off in
  /// the middle of a request, that request again, with the bits that got out. Else nothing.
  std::optional<nfc::Frame> transmit(stride::Time now);

  /// A frame from the air. It is heard if it begins between the end of the request and the time
  /// limit; a second one that overlaps it destroys both.
  void receive(const nfc::Frame& frame);

  /// The temperatures that were received, one at a time: each sample of a log is one, oldest first.
  bool has_measurement() const { return !state_.measurements.empty(); }
  Measurement take_measurement();

  /// The next instant after `now` at which something happens by itself: a command, a switch of the
  /// antenna, the end of an answer, of the time for one, or of a pause.
  std::optional<stride::Time> next_event_time(stride::Time now) const;

  /// Such as "at 14.2 s identify: expected ok; got ok identifier 0x0A2B3C4D after 1 try", of a
  /// record that is settled.
  std::string report(std::size_t record) const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  const ProgramCommand& current() const { return program_.commands[state_.records.size() - 1]; }
  nfc::Frame request(stride::Time start) const;
  bool command_is_due(stride::Time now) const;
  bool cut_is_due(stride::Time now) const;
  nfc::Frame cut();
  void begin_try(stride::Time now);
  void finish_reception();
  void keep_what_is_new(const Answer& answer);
  void keep_temperatures(const Answer& answer);
  void fail_try(stride::Time at, Outcome outcome);
  void skip_without_antenna(stride::Time now);
  void settle(stride::Time at, Outcome outcome);

  Program program_;
  Tremor tremor_;
  State state_;
};

}  // namespace reader

#endif
