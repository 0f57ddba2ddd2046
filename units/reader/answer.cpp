#include "units/reader/answer.h"

#include <stride/nfc/commands.h>
#include <stride/nfc/iso14443a.h>
#include <stride/nfc/numbers.h>

namespace reader {
namespace {

constexpr double kCountsPerDegree = 100.0;

/// An answer to a command that is not known may have any data.
nfc::DataSize data_size(nfc::Command command) {
  const nfc::CommandFormat* const format = nfc::find_format(command);
  return format != nullptr ? format->data : nfc::DataSize{0, nfc::kLogSize.most, 1};
}

bool is_known(nfc::Status status) {
  return status == nfc::Status::Ok || status == nfc::Status::UnknownCommand ||
         status == nfc::Status::BadArgument;
}

bool fits(nfc::Command command, nfc::Status status, std::size_t size) {
  if (status != nfc::Status::Ok) return size == 0;
  const nfc::DataSize expected = data_size(command);
  return size >= expected.least && size <= expected.most && size % expected.unit == 0;
}

double temperature(const nfc::Bytes& bytes, std::size_t first) {
  return static_cast<std::int16_t>(nfc::number_in(bytes, first, first + 2)) / kCountsPerDegree;
}

void read_log(const nfc::Bytes& content, Answer& answer) {
  for (std::size_t at = 1; at < content.size(); at += nfc::kLogSampleBytes) {
    const auto age = static_cast<std::uint16_t>(nfc::number_in(content, at, at + 2));
    answer.samples[answer.sample_count++] = {age, temperature(content, at + 2)};
  }
}

}  // namespace

nfc::Bits request_bits(nfc::Command command, const nfc::Bytes& arguments) {
  nfc::Bytes bytes = {static_cast<std::uint8_t>(command)};
  bytes.insert(bytes.end(), arguments.begin(), arguments.end());
  return nfc::to_bits(nfc::with_crc(bytes));
}

std::optional<Answer> parse_answer(nfc::Command command, const nfc::Bits& bits) {
  const auto bytes = nfc::to_bytes(bits);
  const auto content = bytes ? nfc::without_crc(*bytes) : std::nullopt;
  if (!content || content->empty()) return std::nullopt;

  Answer answer;
  answer.status = static_cast<nfc::Status>(content->front());
  if (!is_known(answer.status) || !fits(command, answer.status, content->size() - 1)) {
    return std::nullopt;
  }
  if (answer.status != nfc::Status::Ok) return answer;
  if (command == nfc::Command::Identify) answer.identifier = nfc::number_in(*content, 1, 5);
  if (command == nfc::Command::ReadTemperature) answer.temperature = temperature(*content, 1);
  if (command == nfc::Command::ReadLog) read_log(*content, answer);
  return answer;
}

stride::Duration longest_answer(nfc::Command command) {
  nfc::Bytes content(1 + data_size(command).most);
  return nfc::air_time({{}, 106, nfc::to_bits(nfc::with_crc(content))});
}

}  // namespace reader
