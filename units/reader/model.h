// The robot's behaviour: it runs a program, sends the commands and makes sense of the answers.
#ifndef STRIDE_UNITS_READER_MODEL_H
#define STRIDE_UNITS_READER_MODEL_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "units/nfc/frame.h"
#include "units/reader/answer.h"
#include "units/reader/program.h"

namespace reader {

enum class Outcome : std::uint8_t {
  kWaiting,     ///< on the air, or its answer is
  kAnswered,    ///< an intact answer with status kOk
  kRefused,     ///< an intact answer with another status
  kUnanswered,  ///< no answer began in time
  kDamaged,     ///< an answer came, but parity, CRC or content were wrong
};

/// What became of one command of the program.
struct Record {
  stride::Time sent_at;      ///< when its frame began
  stride::Time answered_at;  ///< when the answer's frame ended; meaningless without one
  Outcome outcome = Outcome::kWaiting;
  nfc::Status status = nfc::Status::kOk;  ///< of an intact answer
};

/// How many commands were sent, and what became of them. A command that is still waiting is in
/// sent only.
struct Counts {
  std::uint64_t sent = 0;
  std::uint64_t answered = 0;    ///< by an intact answer, whatever its status
  std::uint64_t refused = 0;     ///< those of the answered ones whose status was not kOk
  std::uint64_t unanswered = 0;  ///< not at all, or by a damaged answer
};

/// At each communication point call advance(), then receive() for each frame that arrives there and
/// advance() again, as such a frame may have ended already, then transmit(). A point at each
/// next_event_time() makes the reader exact: a command leaves at the first communication point at
/// or after its programmed instant.
///
/// One command is under way at a time; the next one waits until it is answered or its time limit
/// is over. The limit runs from the end of the command to the start of the answer, as the frame
/// waiting time in ISO/IEC 14443-4, 7.2 does.
class Reader {
 public:
  /// An answer on the air.
  struct Reception {
    stride::Time end;
    bool intact = false;
    Answer answer;
  };

  /// All that a rollback has to bring back. What the axes and the carrier do is no part of it: they
  /// are functions of time.
  struct State {
    std::vector<Record> records;  ///< of the commands sent so far, in the program's order
    stride::Time request_end;     ///< when the frame of the last of them ends
    stride::Time deadline;        ///< until when the answer to it may begin
    bool receiving = false;
    Reception reception;
    Counts counts;
    double temperature = 0.0;      ///< last measured [degC], 0 before the first
    std::uint32_t identifier = 0;  ///< of the sensor, 0 before it is known
  };

  Reader() = default;
  explicit Reader(Program program) : program_(std::move(program)) {}

  const Program& program() const { return program_; }
  double axis(std::size_t index, stride::Time time) const;  ///< target of an axis [rad]
  double carrier_power(stride::Time time) const;            ///< [W]

  /// Notes what has ended by `now`: an answer, or the time limit for one.
  void advance(stride::Time now);

  /// Whether there is a command to transmit: its instant has come and nothing is under way.
  bool is_due(stride::Time now) const;

  /// The frame of a command that is due, which begins now; nothing if none is.
  std::optional<nfc::Frame> transmit(stride::Time now);

  /// A frame from the air. It is heard if it begins between the end of the command and the time
  /// limit; a second one that overlaps it destroys both.
  void receive(const nfc::Frame& frame);

  /// The next instant after `now` at which something happens by itself: a command, a switch of the
  /// antenna, the end of an answer or of a time limit.
  std::optional<stride::Time> next_event_time(stride::Time now) const;

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  bool waiting() const;
  void finish_reception();
  void give_up(Outcome outcome);

  Program program_;
  State state_;
};

}  // namespace reader

#endif
