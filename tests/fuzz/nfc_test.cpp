// What the NFC units read: frames from whoever is wired to them, the reader's program, the
// channel's tags.
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include <stride/nfc/frame.h>
#include <stride/nfc/iso14443a.h>

#include "tests/fuzz/mutator.h"
#include "units/channel/tag_list.h"
#include "units/reader/program.h"

using stride::tests::Mutator;

TEST_CASE("mutated bytes are a frame that encodes to them, or are refused") {
  const nfc::Frame frame{stride::time_from_seconds(14.2), 106, nfc::to_bits(nfc::with_crc({2, 7}))};
  const nfc::Bytes payload = nfc::encode(frame);
  const std::string bytes(payload.begin(), payload.end());
  Mutator mutator(20240120);
  int read = 0;
  int damaged = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string mutated = mutator.mutate(bytes);
    try {
      const nfc::Frame decoded = nfc::decode({mutated.begin(), mutated.end()});
      ++read;
      CHECK(nfc::decode(nfc::encode(decoded)) == decoded);
      const auto contents = nfc::to_bytes(decoded.bits);
      damaged += !contents || !nfc::without_crc(*contents);
    } catch (const std::invalid_argument&) {
    }
  }
  CHECK(read > 500);
  CHECK(damaged > 100);
}

TEST_CASE("a mutated program is read or refused with its file") {
  const std::string program = R"(<reader-program version="1">
  <axes><axis name="shoulder" tremor="0.001"/><axis name="elbow" start_offset="0.1"/></axes>
  <variation seed="3" lowest_frequency="6"/>
  <poses>
    <pose name="rest" shoulder="0.0" elbow="0.3"/>
    <pose name="near" shoulder="0.6" elbow="1.2"/>
  </poses>
  <motion><waypoint at="0.5" pose="rest"/><waypoint at="2.0" pose="near"/></motion>
  <antenna on="1.8" off="3.2" power="0.5"/>
  <command at="2.2" name="identify"/>
  <command at="2.4" name="set_led" led="on"/>
  <command at="2.6" name="read_temperature" timeout="0.1" bit_rate="212">
    <expect lowest="20" highest="22"/>
  </command>
  <command at="2.8" name="select" identifier="0x0A2B3C4D" retries="2" pause="0.01"/>
  <command at="3" name="raw" bytes="7F01"><expect status="unknown_command"/></command>
</reader-program>
)";
  REQUIRE_NOTHROW(reader::parse_program(program, "x.xml"));
  Mutator mutator(20240121);
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    try {
      reader::parse_program(mutator.mutate(program), "x.xml");
      ++accepted;
    } catch (const std::runtime_error& error) {
      ++refused;
      CHECK(std::string(error.what()).find("x.xml") != std::string::npos);
    }
  }
  CHECK(accepted > 20);
  CHECK(refused > 1000);
}

TEST_CASE("a mutated list of tags is read or refused with its file") {
  const std::string list = R"(<nfc-channel version="1">
  <!-- both on one reader -->
  <tag name="door"/>
  <tag name="window_2"/>
</nfc-channel>
)";
  REQUIRE(channel::parse_tag_list(list, "x.xml", "nfc-channel").size() == 2);
  Mutator mutator(20240122);
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    try {
      accepted += !channel::parse_tag_list(mutator.mutate(list), "x.xml", "nfc-channel").empty();
    } catch (const std::runtime_error& error) {
      ++refused;
      CHECK(std::string(error.what()).find("x.xml:") == 0);
    }
  }
  CHECK(accepted > 100);
  CHECK(refused > 100);
  CHECK(accepted + refused == 4000);
}
