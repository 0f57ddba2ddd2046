#include <cstdint>
#include <optional>

#include <catch2/catch.hpp>

#include <stride/nfc/commands.h>
#include <stride/nfc/iso14443a.h>

using nfc::Bits;
using nfc::Bytes;

namespace {

std::optional<Bytes> contents(const Bits& bits) {
  const auto bytes = nfc::to_bytes(bits);
  return bytes ? nfc::without_crc(*bytes) : std::nullopt;
}

/// Of each length that the application protocol has, and some more.
Bytes data_of_length(std::size_t length) {
  Bytes data;
  for (std::size_t i = 0; i < length; ++i) data.push_back(static_cast<std::uint8_t>(91 * i + 5));
  return data;
}

constexpr std::size_t kLongest = 1 + nfc::kLogSamples * nfc::kLogSampleBytes;

}  // namespace

TEST_CASE("CRC_A gives the check values that are published for it") {
  // ISO/IEC 14443-3, annex B
  CHECK(nfc::with_crc({0x00, 0x00}) == Bytes{0x00, 0x00, 0xA0, 0x1E});
  CHECK(nfc::with_crc({0x12, 0x34}) == Bytes{0x12, 0x34, 0x26, 0xCF});
  // the catalogue of parametrised CRC algorithms, CRC-16/ISO-IEC-14443-3-A
  CHECK(nfc::crc_a({'1', '2', '3', '4', '5', '6', '7', '8', '9'}) == 0xBF05);
  // the command HLTA as readers send it
  CHECK(nfc::with_crc({0x50, 0x00}) == Bytes{0x50, 0x00, 0x57, 0xCD});
  CHECK(nfc::crc_a({}) == 0x6363);
}

TEST_CASE("The CRC comes off again, and every single wrong bit is found") {
  const Bytes sent = nfc::with_crc({0x02, 0x7F, 0x80});
  CHECK(nfc::without_crc(sent) == Bytes{0x02, 0x7F, 0x80});
  for (std::size_t bit = 0; bit < 8 * sent.size(); ++bit) {
    Bytes received = sent;
    received[bit / 8] = static_cast<std::uint8_t>(received[bit / 8] ^ (1U << (bit % 8)));
    CHECK_FALSE(nfc::without_crc(received).has_value());
  }
  CHECK_FALSE(nfc::without_crc({0x63}).has_value());
  CHECK_FALSE(nfc::without_crc({}).has_value());
  CHECK(nfc::without_crc({0x63, 0x63}) == Bytes{});
}

TEST_CASE("A byte is sent least significant bit first and followed by odd parity") {
  CHECK(nfc::to_bits({0x26}) == Bits{0, 1, 1, 0, 0, 1, 0, 0, 0});
  CHECK(nfc::to_bits({0x00}) == Bits{0, 0, 0, 0, 0, 0, 0, 0, 1});
  CHECK(nfc::to_bits({0xFF}) == Bits{1, 1, 1, 1, 1, 1, 1, 1, 1});
  CHECK(nfc::to_bits({0x01, 0x03}) == Bits{1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1});
}

TEST_CASE("Every byte survives the way to bits and back, with an odd number of ones") {
  for (int value = 0; value < 256; ++value) {
    const Bytes byte = {static_cast<std::uint8_t>(value)};
    const Bits bits = nfc::to_bits(byte);
    int ones = 0;
    for (const auto bit : bits) ones += bit;
    CHECK(ones % 2 == 1);
    CHECK(nfc::to_bytes(bits) == byte);
  }
}

TEST_CASE("Bits with a wrong parity or of no whole number of bytes are not bytes") {
  Bits bits = nfc::to_bits({0x12, 0x34});
  for (std::size_t i = 0; i < bits.size(); ++i) {
    bits[i] ^= 1;
    CHECK_FALSE(nfc::to_bytes(bits).has_value());
    bits[i] ^= 1;
  }
  CHECK(nfc::to_bytes(bits) == Bytes{0x12, 0x34});
  bits.pop_back();
  CHECK_FALSE(nfc::to_bytes(bits).has_value());
  CHECK_FALSE(nfc::to_bytes({}).has_value());
}

TEST_CASE("Every single wrong bit of a frame is found, whatever its length") {
  for (std::size_t length = 0; length <= kLongest; ++length) {
    Bits bits = nfc::to_bits(nfc::with_crc(data_of_length(length)));
    REQUIRE(bits.size() == 9 * (length + 2));
    REQUIRE(contents(bits) == data_of_length(length));
    for (auto& bit : bits) {
      bit ^= 1;
      CHECK_FALSE(contents(bits).has_value());
      bit ^= 1;
    }
  }
}

TEST_CASE("Two wrong bits of one byte, which parity does not see, are found by the CRC") {
  Bits bits = nfc::to_bits(nfc::with_crc(data_of_length(kLongest)));
  for (std::size_t byte = 0; byte < bits.size() / 9; ++byte) {
    for (std::size_t first = 0; first < 8; ++first) {
      for (std::size_t second = first + 1; second < 8; ++second) {
        bits[9 * byte + first] ^= 1;
        bits[9 * byte + second] ^= 1;
        REQUIRE(nfc::to_bytes(bits).has_value());
        CHECK_FALSE(contents(bits).has_value());
        bits[9 * byte + first] ^= 1;
        bits[9 * byte + second] ^= 1;
      }
    }
  }
}

TEST_CASE("A frame that was cut off is found, wherever the cut is") {
  for (std::size_t length = 0; length <= kLongest; ++length) {
    Bits bits = nfc::to_bits(nfc::with_crc(data_of_length(length)));
    while (!bits.empty()) {
      bits.pop_back();
      CHECK_FALSE(contents(bits).has_value());
    }
  }
}

TEST_CASE("What is not a command takes no arguments") {
  CHECK(nfc::argument_bytes(nfc::Command::Select) == 4);
  CHECK(nfc::argument_bytes(static_cast<nfc::Command>(0x7F)) == -1);
}
