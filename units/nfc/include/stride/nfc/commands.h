// The application protocol between reader and sensor: a request is a command byte and its
// arguments, an answer is a status byte and data, both in standard frames that end with CRC_A.
// Numbers of more than one byte have their most significant byte first.
#ifndef STRIDE_NFC_COMMANDS_H
#define STRIDE_NFC_COMMANDS_H

#include <cstddef>
#include <cstdint>

namespace nfc {

/// A sensor that is not selected answers Identify, and Select with its own identifier; to
/// anything else, and to these with wrong arguments, it is silent. A sensor that is alone may be
/// set up to count as selected always.
enum class Command : std::uint8_t {
  /// Answer: the sensor's identifier, 32 bits.
  Identify = 0x01,
  /// Answer: the temperature, converted on this command, as a signed 16-bit count of 1/100 degC.
  ReadTemperature = 0x02,
  /// Argument: one byte, 0 off, 1 on. The answer has no data.
  SetLed = 0x03,
  /// Argument: an identifier, 32 bits. The sensor whose it is answers without data and is selected;
  /// every other one is not selected any more, and silent. The loss of the field deselects, too.
  Select = 0x04,
  /// Answer: up to kLogSamples samples, the last that were logged, oldest first; each is its age in
  /// whole seconds, rounded down, 65535 for all that are older (16 bits), and its temperature as
  /// ReadTemperature gives it. The log is kept.
  ReadLog = 0x05,
  /// Argument: the time between two samples in seconds, 16 bits, 0 = none. The first sample is
  /// taken one period after the command. The answer has no data.
  SetSamplingPeriod = 0x06,
  /// Switches the LED off and deselects. The answer has no data. Samples are taken further on.
  Sleep = 0x07,
};

/// An answer with another status than Ok has no data.
enum class Status : std::uint8_t {
  Ok = 0x00,
  UnknownCommand = 0x01,
  BadArgument = 0x02,  ///< out of range, or not as many bytes as the command takes
};

inline constexpr std::size_t kLogSamples = 8;          ///< at most, in an answer to ReadLog
inline constexpr std::size_t kLogSampleBytes = 4;      ///< age and temperature
inline constexpr std::uint16_t kOldestLogAge = 65535;  ///< of a sample [s]: so much, or more

/// How many bytes of data follow Ok in an answer.
struct DataSize {
  std::size_t least = 0;
  std::size_t most = 0;
  std::size_t unit = 1;  ///< it is a multiple of this
};

struct CommandFormat {
  Command command;
  const char* name;  ///< in programs, reports and messages
  int argument_bytes;
  DataSize data;
};

inline constexpr DataSize kLogSize{0, kLogSamples* kLogSampleBytes, kLogSampleBytes};

/// All commands, in the order in which documentation lists them.
inline constexpr CommandFormat kCommands[] = {
    {Command::Identify, "identify", 0, {4, 4}},
    {Command::Select, "select", 4, {}},
    {Command::ReadTemperature, "read_temperature", 0, {2, 2}},
    {Command::ReadLog, "read_log", 0, kLogSize},
    {Command::SetSamplingPeriod, "set_sampling_period", 2, {}},
    {Command::SetLed, "set_led", 1, {}},
    {Command::Sleep, "sleep", 0, {}},
};

/// Null for a byte that is not a command.
constexpr const CommandFormat* find_format(Command command) {
  for (const CommandFormat& format : kCommands) {
    if (format.command == command) return &format;
  }
  return nullptr;
}

/// How many bytes of arguments a command takes; -1 for a byte that is not a command.
constexpr int argument_bytes(Command command) {
  const CommandFormat* const format = find_format(command);
  return format != nullptr ? format->argument_bytes : -1;
}

}  // namespace nfc

#endif
