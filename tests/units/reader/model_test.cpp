#include "units/reader/model.h"

#include <catch2/catch.hpp>

#include "units/nfc/iso14443a.h"

using namespace reader;
using stride::Duration;
using stride::Time;

namespace {

constexpr Duration kPicosecond{1};

Time at(double seconds) { return stride::time_from_seconds(seconds); }

Reader reader_with(const std::string& commands) {
  return Reader(parse_program(R"(<reader-program version="1">
      <antenna on="1" off="9" power="0.5"/>)" +
                                  commands + "</reader-program>",
                              "p.xml"));
}

Reader one_command() {
  return reader_with(R"(<command at="2" name="read_temperature" timeout="0.05"/>)");
}

nfc::Frame answer(Time start, const nfc::Bytes& content) {
  return {start, 106, nfc::to_bits(nfc::with_crc(content))};
}

const nfc::Bytes kWarm = {0x00, 0x08, 0x66};  // 21.5 degC

Outcome last_outcome(const Reader& reader) { return reader.state().records.back().outcome; }

}  // namespace

TEST_CASE("A command is sent at its instant, not before and only once") {
  Reader reader = one_command();
  reader.advance(at(2) - kPicosecond);
  CHECK_FALSE(reader.transmit(at(2) - kPicosecond).has_value());
  reader.advance(at(2));
  const auto frame = reader.transmit(at(2));
  REQUIRE(frame.has_value());
  CHECK(frame->start == at(2));
  CHECK(frame->bit_rate == 106);
  CHECK(nfc::without_crc(*nfc::to_bytes(frame->bits)) == nfc::Bytes{0x02});
  CHECK_FALSE(reader.transmit(at(2)).has_value());
  CHECK(reader.state().counts.sent == 1);
  CHECK(last_outcome(reader) == Outcome::kWaiting);
}

TEST_CASE("On a coarse grid a command leaves at the first point after its instant") {
  Reader reader = one_command();
  reader.advance(at(2.0004));
  CHECK(reader.transmit(at(2.0004))->start == at(2.0004));
  CHECK(reader.state().records[0].sent_at == at(2.0004));
}

TEST_CASE("An answer counts when its frame ends") {
  Reader reader = one_command();
  reader.transmit(at(2));
  const auto frame = answer(at(2.001), kWarm);
  const Time end = frame.start + nfc::air_time(frame);
  reader.receive(frame);
  reader.advance(end - kPicosecond);
  CHECK(reader.state().counts.answered == 0);
  CHECK(reader.next_event_time(end - kPicosecond) == end);
  reader.advance(end);
  CHECK(reader.state().counts.answered == 1);
  CHECK(reader.state().counts.unanswered == 0);
  CHECK(reader.state().temperature == Approx(21.5));
  CHECK(last_outcome(reader) == Outcome::kAnswered);
  CHECK(reader.state().records[0].answered_at == end);
}

TEST_CASE("On a coarse grid the record still has the instant at which the answer ended") {
  Reader reader = one_command();
  reader.transmit(at(2));
  const auto frame = answer(at(2.001), kWarm);
  reader.receive(frame);
  reader.advance(at(2.5));
  CHECK(last_outcome(reader) == Outcome::kAnswered);
  CHECK(reader.state().records[0].answered_at == frame.start + nfc::air_time(frame));
}

TEST_CASE("The time limit runs from the end of the command to the start of the answer") {
  Reader reader = one_command();
  const auto request = reader.transmit(at(2));
  const Time deadline = at(2.05) + nfc::air_time(*request);
  CHECK(reader.next_event_time(at(2)) == deadline);

  SECTION("an answer that begins in time is heard to its end") {
    reader.receive(answer(deadline, kWarm));
    reader.advance(deadline);
    CHECK(reader.state().counts.unanswered == 0);
    reader.advance(deadline + std::chrono::seconds(1));
    CHECK(last_outcome(reader) == Outcome::kAnswered);
  }
  SECTION("one that begins later is not heard") {
    reader.receive(answer(deadline + kPicosecond, kWarm));
    reader.advance(deadline + std::chrono::seconds(1));
    CHECK(last_outcome(reader) == Outcome::kUnanswered);
    CHECK(reader.state().temperature == 0.0);
  }
  SECTION("without any the command is unanswered from then on") {
    reader.advance(deadline - kPicosecond);
    CHECK(reader.state().counts.unanswered == 0);
    reader.advance(deadline);
    CHECK(reader.state().counts.unanswered == 1);
    reader.receive(answer(deadline, kWarm));
    reader.advance(deadline + std::chrono::seconds(1));
    CHECK(reader.state().counts.answered == 0);
    CHECK(reader.state().counts.unanswered == 1);
  }
}

TEST_CASE("What arrives while the reader sends is not heard") {
  Reader reader = one_command();
  const auto request = reader.transmit(at(2));
  reader.receive(answer(at(2) + nfc::air_time(*request) - kPicosecond, kWarm));
  reader.advance(at(3));
  CHECK(last_outcome(reader) == Outcome::kUnanswered);
}

TEST_CASE("An answer with a wrong CRC counts as none") {
  Reader reader = one_command();
  reader.transmit(at(2));
  nfc::Bytes bytes = nfc::with_crc(kWarm);
  bytes[2] ^= 0x01;
  reader.receive({at(2.001), 106, nfc::to_bits(bytes)});
  reader.advance(at(2.04));
  CHECK(last_outcome(reader) == Outcome::kDamaged);
  CHECK(reader.state().counts.answered == 0);
  CHECK(reader.state().counts.unanswered == 1);
  CHECK(reader.state().temperature == 0.0);
}

TEST_CASE("Two answers at once destroy each other") {
  Reader reader = one_command();
  reader.transmit(at(2));
  reader.receive(answer(at(2.001), kWarm));
  reader.receive(answer(at(2.0011), kWarm));
  reader.advance(at(2.02));
  CHECK(last_outcome(reader) == Outcome::kDamaged);
  CHECK(reader.state().counts.unanswered == 1);
}

TEST_CASE("A refusal is an answer but measures nothing") {
  Reader reader = one_command();
  reader.transmit(at(2));
  reader.receive(answer(at(2.001), {0x02}));
  reader.advance(at(2.04));
  CHECK(last_outcome(reader) == Outcome::kRefused);
  CHECK(reader.state().records[0].status == nfc::Status::kBadArgument);
  CHECK(reader.state().counts.answered == 1);
  CHECK(reader.state().counts.refused == 1);
  CHECK(reader.state().temperature == 0.0);
}

TEST_CASE("A frame that nobody asked for changes nothing") {
  Reader reader = one_command();
  reader.receive(answer(at(1), kWarm));
  reader.advance(at(1.5));
  CHECK(reader.state().counts.answered == 0);
  CHECK(reader.state().records.empty());
}

TEST_CASE("A command waits for the one before it") {
  Reader reader = reader_with(R"(<command at="2" name="identify" timeout="0.05"/>
                                 <command at="2" name="set_led" led="on"/>)");
  reader.transmit(at(2));
  CHECK_FALSE(reader.transmit(at(2)).has_value());

  SECTION("until it is answered") {
    reader.receive(answer(at(2.001), {0, 1, 2, 3, 4}));
    const Time end = *reader.next_event_time(at(2.001));
    reader.advance(end);
    CHECK(reader.state().identifier == 0x01020304);
    const auto next = reader.transmit(end);
    REQUIRE(next.has_value());
    CHECK(nfc::without_crc(*nfc::to_bytes(next->bits)) == nfc::Bytes{0x03, 0x01});
  }
  SECTION("until its time limit is over") {
    const Time deadline = *reader.next_event_time(at(2));
    reader.advance(deadline);
    CHECK(reader.transmit(deadline).has_value());
    CHECK(reader.state().counts.sent == 2);
  }
}

TEST_CASE("The next event is the next thing that the program or the protocol brings") {
  Reader reader = one_command();
  CHECK(reader.next_event_time(at(0)) == at(1));
  CHECK(reader.next_event_time(at(1)) == at(2));
  const auto request = reader.transmit(at(2));
  const Time deadline = at(2.05) + nfc::air_time(*request);
  CHECK(reader.next_event_time(at(2.01)) == deadline);
  reader.advance(deadline);
  CHECK(reader.next_event_time(deadline) == at(9));
  CHECK_FALSE(reader.next_event_time(at(9)).has_value());
}

TEST_CASE("A restored state repeats what followed it") {
  Reader reader = one_command();
  reader.transmit(at(2));
  const Reader::State saved = reader.state();
  reader.receive(answer(at(2.001), kWarm));
  reader.advance(at(3));
  CHECK(reader.state().counts.answered == 1);

  reader.state() = saved;
  CHECK(last_outcome(reader) == Outcome::kWaiting);
  reader.advance(at(3));
  CHECK(last_outcome(reader) == Outcome::kUnanswered);
  CHECK(reader.state().counts.answered == 0);
}
