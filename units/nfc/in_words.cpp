#include <cstdlib>
#include <optional>
#include <stdexcept>

#include <stride/nfc/commands.h>
#include <stride/nfc/in_words.h>
#include <stride/nfc/iso14443a.h>
#include <stride/nfc/names.h>
#include <stride/nfc/numbers.h>
#include <stride/value_text.h>

namespace nfc {
namespace {

constexpr std::size_t kCrcBytes = 2;

std::string digits(const Bytes& content, std::size_t first) {
  std::string text;
  for (std::size_t i = first; i < content.size(); ++i) stride::append_hexadecimal(text, content[i]);
  return text;
}

std::string temperature(const Bytes& content, std::size_t first) {
  const int centidegrees = static_cast<std::int16_t>(number_in(content, first, first + 2));
  const int size = std::abs(centidegrees);
  const std::string fraction = std::to_string(100 + size % 100).substr(1);
  return (centidegrees < 0 ? "-" : "") + std::to_string(size / 100) + "." + fraction + " °C";
}

std::string log_in_words(const Bytes& content) {
  std::string text;
  for (std::size_t at = 1; at < content.size(); at += kLogSampleBytes) {
    const std::uint32_t age = number_in(content, at, at + 2);
    text += (at == 1 ? " " : ", ") + temperature(content, at + 2) + " " + std::to_string(age) +
            (age == kOldestLogAge ? " s ago or more" : " s ago");
  }
  return text;
}

std::string answer_in_words(const Bytes& content) {
  const auto status = static_cast<Status>(content.front());
  const std::size_t data = content.size() - 1;
  std::string text = name_of(status);
  if (data == 0) return text;
  if (status == Status::Ok) {
    if (data == 2) return text + " " + temperature(content, 1);
    if (data == 4) return text + " " + hexadecimal(number_in(content, 1, 5));
    const bool is_log = data % kLogSampleBytes == 0 && data / kLogSampleBytes <= kLogSamples;
    if (is_log) return text + log_in_words(content);
  }
  return text + " " + digits(content, 1);
}

std::string request_in_words(const Bytes& content) {
  const auto command = static_cast<Command>(content.front());
  std::string text = name_of(command);
  const int expected = argument_bytes(command);
  if (expected >= 0 && content.size() != static_cast<std::size_t>(expected) + 1) {
    if (content.size() == 1) return text + ", arguments missing";
    return text + " " + digits(content, 1) + ", wrong size of arguments";
  }
  switch (command) {
    case Command::SetLed:
      return text + " " + std::to_string(content[1]);
    case Command::Select:
      return text + " " + hexadecimal(number_in(content, 1, 5));
    case Command::SetSamplingPeriod:
      return text + " " + std::to_string(number_in(content, 1, 3)) + " s";
    default:
      return content.size() == 1 ? text : text + " " + digits(content, 1);
  }
}

/// The command of a request of which so much was heard.
std::optional<Command> begun_command(const Bits& bits) {
  if (bits.size() < kBitsPerByte) return std::nullopt;
  const auto first = to_bytes(Bits(bits.begin(), bits.begin() + kBitsPerByte));
  if (!first || argument_bytes(static_cast<Command>(first->front())) < 0) return std::nullopt;
  return static_cast<Command>(first->front());
}

std::string damage_in_words(const Bits& bits, Sender sender) {
  if (bits.empty()) return "cut before its first bit";
  const std::string cut = "cut after " + std::to_string(bits.size());
  if (sender == Sender::Reader) {
    if (const auto command = begun_command(bits)) {
      const auto arguments = static_cast<std::size_t>(argument_bytes(*command));
      const std::size_t whole = kBitsPerByte * (1 + arguments + kCrcBytes);
      if (bits.size() < whole) {
        return name_of(*command) + ", " + cut + " of " + std::to_string(whole) + " bits";
      }
    }
  }
  if (bits.size() % kBitsPerByte != 0) return cut + " bits";
  return to_bytes(bits) ? "CRC wrong" : "parity wrong";
}

std::string bits_in_words(const Bits& bits, Sender sender) {
  const auto bytes = to_bytes(bits);
  const auto content = bytes ? without_crc(*bytes) : std::nullopt;
  if (!content || content->empty()) return damage_in_words(bits, sender);
  return sender == Sender::Reader ? request_in_words(*content) : answer_in_words(*content);
}

}  // namespace

std::string in_words(const Bytes& payload, Sender sender) {
  try {
    const Frame frame = decode(payload);
    const std::string text = bits_in_words(frame.bits, sender);
    if (frame.bit_rate == 106) return text;
    return text + " at " + std::to_string(frame.bit_rate) + " kbit/s";
  } catch (const std::invalid_argument& reason) {
    return std::string("no frame: ") + reason.what();
  }
}

}  // namespace nfc
