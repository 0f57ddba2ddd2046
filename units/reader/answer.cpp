#include "units/reader/answer.h"

#include <cstddef>

#include "units/nfc/iso14443a.h"

namespace reader {
namespace {

constexpr double kDegreesPerCount = 0.01;

std::size_t data_size(nfc::Command command) {
  switch (command) {
    case nfc::Command::kIdentify:
      return 4;
    case nfc::Command::kReadTemperature:
      return 2;
    default:  // a program has no others with data
      return 0;
  }
}

bool is_known(nfc::Status status) {
  return status == nfc::Status::kOk || status == nfc::Status::kUnknownCommand ||
         status == nfc::Status::kBadArgument;
}

std::uint32_t big_endian(const nfc::Bytes& bytes, std::size_t first) {
  std::uint32_t value = 0;
  for (std::size_t i = first; i < bytes.size(); ++i) value = value << 8 | bytes[i];
  return value;
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
  const std::size_t expected = answer.status == nfc::Status::kOk ? data_size(command) : 0;
  if (!is_known(answer.status) || content->size() != 1 + expected) return std::nullopt;

  const std::uint32_t value = big_endian(*content, 1);
  if (command == nfc::Command::kIdentify) answer.identifier = value;
  if (command == nfc::Command::kReadTemperature) {
    answer.temperature = kDegreesPerCount * static_cast<std::int16_t>(value);
  }
  return answer;
}

}  // namespace reader
