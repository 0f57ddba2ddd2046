#include <random>
#include <string>

#include <catch2/catch.hpp>

#include <stride/nfc/in_words.h>
#include <stride/nfc/iso14443a.h>

using nfc::Bytes;
using nfc::Sender;

namespace {

Bytes payload(const nfc::Bits& bits, std::uint32_t bit_rate = 106) {
  return nfc::encode({stride::Time(stride::Duration(7)), bit_rate, bits});
}

nfc::Bits whole(const Bytes& content) { return nfc::to_bits(nfc::with_crc(content)); }

nfc::Bits cut(nfc::Bits bits, std::size_t size) {
  bits.resize(size);
  return bits;
}

std::string request(const Bytes& content) {
  return nfc::in_words(payload(whole(content)), Sender::Reader);
}
std::string answer(const Bytes& content) {
  return nfc::in_words(payload(whole(content)), Sender::Tag);
}

}  // namespace

TEST_CASE("a request is its command and arguments") {
  CHECK(request({0x01}) == "identify");
  CHECK(request({0x02}) == "read_temperature");
  CHECK(request({0x03, 1}) == "set_led 1");
  CHECK(request({0x04, 0x53, 0x45, 0x4E, 0x53}) == "select 0x53454E53");
  CHECK(request({0x06, 0x01, 0x2C}) == "set_sampling_period 300 s");
  CHECK(request({0x07}) == "sleep");
}

TEST_CASE("a request that no sensor understands has a text, too") {
  CHECK(request({0x7F}) == "raw 0x7F");
  CHECK(request({0x7F, 0x0A, 0xB0}) == "raw 0x7F 0ab0");
  CHECK(request({0x03}) == "set_led, arguments missing");
  CHECK(request({0x03, 1, 2}) == "set_led 0102, wrong size of arguments");
  CHECK(request({0x01, 9}) == "identify 09, wrong size of arguments");
}

TEST_CASE("an answer is its status and what its data can only be") {
  CHECK(answer({0x00}) == "ok");
  CHECK(answer({0x00, 0x08, 0x65}) == "ok 21.49 °C");
  CHECK(answer({0x00, 0xFF, 0xFB}) == "ok -0.05 °C");
  CHECK(answer({0x00, 0x80, 0x00}) == "ok -327.68 °C");
  CHECK(answer({0x00, 0x53, 0x45, 0x4E, 0x53}) == "ok 0x53454E53");
  CHECK(answer({0x00, 0xFF, 0xFF, 0x08, 0x65, 0, 5, 0, 100}) ==
        "ok 21.49 °C 65535 s ago or more, 1.00 °C 5 s ago");
  CHECK(answer({0x01}) == "unknown_command");
  CHECK(answer({0x02, 0x08, 0x65}) == "bad_argument 0865");
  CHECK(answer({0x33}) == "status 0x33");
  CHECK(answer({0x00, 1, 2, 3}) == "ok 010203");
  CHECK(answer(Bytes(1 + 9 * 4)) == "ok " + std::string(2 * 9 * 4, '0'));
}

TEST_CASE("the text of a damaged frame has what is wrong") {
  const nfc::Bits led = whole({0x03, 1});
  CHECK(nfc::in_words(payload(cut(led, 17)), Sender::Reader) == "set_led, cut after 17 of 36 bits");
  CHECK(nfc::in_words(payload(cut(led, 18)), Sender::Reader) == "set_led, cut after 18 of 36 bits");
  CHECK(nfc::in_words(payload(cut(led, 8)), Sender::Reader) == "cut after 8 bits");
  CHECK(nfc::in_words(payload({}), Sender::Reader) == "cut before its first bit");
  CHECK(nfc::in_words(payload(cut(led, 17)), Sender::Tag) == "cut after 17 bits");
  CHECK(nfc::in_words(payload(cut(led, 18)), Sender::Tag) == "CRC wrong");
  nfc::Bits flipped = led;
  flipped[10] ^= 1;
  CHECK(nfc::in_words(payload(flipped), Sender::Reader) == "parity wrong");
  flipped[11] ^= 1;
  CHECK(nfc::in_words(payload(flipped), Sender::Reader) == "CRC wrong");
}

TEST_CASE("another bit rate than that of the sensor is in the text") {
  CHECK(nfc::in_words(payload(whole({0x02}), 212), Sender::Reader) ==
        "read_temperature at 212 kbit/s");
}

TEST_CASE("what is not a frame is described with the reason") {
  CHECK(nfc::in_words({}, Sender::Reader) ==
        "no frame: a frame has at least 16 bytes, this one has 0");
  Bytes slow = payload(whole({0x01}));
  slow[8] = 1;
  CHECK(nfc::in_words(slow, Sender::Tag) ==
        "no frame: bit rate 1 kbit/s: expected 106, 212, 424 or 848");
}

TEST_CASE("any bits of any length have words, one line of them") {
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    nfc::Bits bits(random() % 400);
    for (auto& bit : bits) bit = random() & 1;
    const auto sender = (random() & 1) != 0 ? Sender::Reader : Sender::Tag;
    const std::string text = nfc::in_words(payload(bits), sender);
    CHECK(!text.empty());
    CHECK(text.find('\n') == std::string::npos);
  }
  for (int i = 0; i < 20'000; ++i) {
    Bytes content(1 + random() % 40);
    for (auto& byte : content) byte = static_cast<std::uint8_t>(random() % (i % 2 == 0 ? 256 : 8));
    CHECK(!request(content).empty());
    CHECK(answer(content).rfind("cut", 0) == std::string::npos);
  }
}
