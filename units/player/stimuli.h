// What a unit received in a run, as `stride run --capture` has written it, or receives from a
// table (docs/stimuli.md).
#ifndef STRIDE_UNITS_PLAYER_STIMULI_H
#define STRIDE_UNITS_PLAYER_STIMULI_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <stride/time.h>

#include "units/player/curve.h"
#include "units/player/values.h"

namespace player {

/// An input of the captured unit.
struct Input {
  std::string name;
  Type type = Type::Float64;
  bool is_continuous = false;
  std::string unit;
  std::optional<std::size_t> clock;     ///< the place of the triggered clock that it belongs to
  std::vector<std::size_t> dimensions;  ///< empty for a scalar
  std::size_t size = 1;
  std::vector<std::pair<std::string, std::int64_t>> items;  ///< of an Enumeration
  Values values;  ///< all that it received, one behind the other; the start value first
  std::optional<Curve> curve;  ///< instead, of one that follows lines
};

/// A row of the file.
struct Entry {
  enum class Kind : std::uint8_t { Value, Tick, Step, Jump, End };

  /// In Step Mode, and in the first event iteration, a value is there when the step has ended.
  static constexpr std::int32_t kAtStepEnd = 0;

  stride::Time time;
  Kind kind = Kind::End;
  std::int32_t event = kAtStepEnd;  ///< the event iteration in which it arrived
  std::size_t input = 0;            ///< of Value, Tick, and Jump, where its curve has one
  std::size_t first = 0;            ///< of Value: where it begins in the input's values
  stride::Time target{};            ///< of Step: where the unit was sent
};

struct Stimuli {
  std::string unit;       ///< model name of the unit
  std::string component;  ///< what it was called in its system
  std::string system;
  std::vector<Input> inputs;
  std::vector<Entry> entries;  ///< in the order of the file; the last one is the End
  std::string ending;          ///< why the run ended
  bool is_table = false;       ///< none of this was captured: there is no unit, and no step
  stride::Time begin{};        ///< that of the first row

  stride::Time start() const { return entries.front().time; }
  stride::Time end() const { return entries.back().time; }
};

/// Reads the text of a file. Throws std::runtime_error "FILE:LINE: …" for what is cut off, out of
/// order, of another version, or no value of its input.
Stimuli parse_stimuli(const std::string& text, const std::string& file);
/// Of a file of stimuli, or of a table (parse_table()).
Stimuli load_stimuli(const std::string& file);

}  // namespace player

#endif
