#include "units/reader/model.h"

#include <chrono>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/nfc/iso14443a.h>

#include "tests/units/reader/programs.h"

using namespace reader;
using namespace reader::tests;
using stride::Duration;
using stride::Time;

namespace {

Reader reader_with(const std::string& commands) { return Reader(program_with(commands)); }

Reader one_command() {
  return reader_with(R"(<command at="2" name="read_temperature" timeout="0.05"/>)");
}

nfc::Frame answer(Time start, const nfc::Bytes& content) {
  return {start, 106, nfc::to_bits(nfc::with_crc(content))};
}

/// After this nothing of an answer can come.
Time give_up(Time deadline, nfc::Command command) {
  return deadline + longest_answer(command) + nfc::bit_duration(106);
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
  CHECK(last_outcome(reader) == Outcome::Waiting);
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
  CHECK(last_outcome(reader) == Outcome::Answered);
  CHECK(reader.state().records[0].settled_at == end);
}

TEST_CASE("A temperature is a new measurement, also if it is the same as before") {
  Reader reader = reader_with(R"(<command at="2" name="read_temperature"/>
                                 <command at="3" name="read_temperature"/>)");
  for (const double second : {2.0, 3.0}) {
    reader.transmit(at(second));
    const auto frame = answer(at(second + 0.001), kWarm);
    reader.receive(frame);
    CHECK_FALSE(reader.has_measurement());
    reader.advance(at(second + 0.1));
    REQUIRE(reader.has_measurement());
    const Measurement measurement = reader.take_measurement();
    CHECK(measurement.received == frame.start + nfc::air_time(frame));
    CHECK(measurement.temperature == 21.5);
    CHECK(measurement.age == Duration{});
    CHECK(measurement.age_resolution == Duration{});
    CHECK_FALSE(reader.has_measurement());
  }
}

TEST_CASE("Each sample of a log is a measurement, with its age in the log") {
  Reader reader = reader_with(R"(<command at="2" name="read_log"/>)");
  reader.transmit(at(2));
  reader.receive(answer(at(2.001), {0x00, 0xFF, 0xFF, 0x08, 0x66,  // 65535 s or more: 21.5 degC
                                    0x01, 0x02, 0xFF, 0x9C,        // 258 s: -1 degC
                                    0x00, 0x00, 0x08, 0x67}));     // 0 s: 21.51 degC
  reader.advance(at(2.1));
  std::vector<Measurement> measurements;
  while (reader.has_measurement()) measurements.push_back(reader.take_measurement());
  REQUIRE(measurements.size() == 3);
  CHECK(measurements[0].temperature == 21.5);
  CHECK(measurements[0].age == std::chrono::seconds(65535));
  CHECK(measurements[0].age_resolution == stride::duration_from_seconds(stride::kMaxSeconds));
  CHECK(measurements[1].temperature == -1);
  CHECK(measurements[1].age == std::chrono::seconds(258));
  CHECK(measurements[1].age_resolution == std::chrono::seconds(1));
  CHECK(measurements[2].temperature == 21.51);
  CHECK(measurements[2].age == Duration{});
}

TEST_CASE("What is not a temperature, refused or damaged is not a measurement") {
  Reader reader = reader_with(R"(<command at="2" name="identify"/>
                                 <command at="3" name="read_temperature"/>
                                 <command at="4" name="read_temperature"/>)");
  reader.transmit(at(2));
  reader.receive(answer(at(2.001), {0x00, 1, 2, 3, 4}));
  reader.advance(at(3));
  reader.transmit(at(3));
  reader.receive(answer(at(3.001), {0x01}));
  reader.advance(at(4));
  reader.transmit(at(4));
  auto damaged = answer(at(4.001), kWarm);
  damaged.bits[3] = !damaged.bits[3];
  reader.receive(damaged);
  reader.advance(at(5));
  CHECK(reader.state().counts.answered == 2);
  CHECK_FALSE(reader.has_measurement());
}

TEST_CASE("On a coarse grid the record still has the instant at which the answer ended") {
  Reader reader = one_command();
  reader.transmit(at(2));
  const auto frame = answer(at(2.001), kWarm);
  reader.receive(frame);
  reader.advance(at(2.5));
  CHECK(last_outcome(reader) == Outcome::Answered);
  CHECK(reader.state().records[0].settled_at == frame.start + nfc::air_time(frame));
}

TEST_CASE("An answer may arrive at any time between its start and its end") {
  Reader reader = one_command();
  reader.transmit(at(2));
  const auto frame = answer(at(2.001), kWarm);
  const Time end = frame.start + nfc::air_time(frame);
  const Time arrival =
      GENERATE_COPY(as<Time>{}, frame.start, frame.start + (end - frame.start) / 2, end);
  reader.advance(arrival);
  reader.receive(frame);
  reader.advance(arrival);
  CHECK(reader.state().counts.answered == (arrival == end ? 1 : 0));
  reader.advance(end);
  CHECK(reader.state().counts.answered == 1);
  CHECK(reader.state().records[0].settled_at == end);
}

TEST_CASE("The time limit runs from the end of the command to the start of the answer") {
  Reader reader = one_command();
  const auto request = reader.transmit(at(2));
  const Time deadline = at(2.05) + nfc::air_time(*request);
  const Time end = give_up(deadline, nfc::Command::ReadTemperature);
  CHECK(reader.next_event_time(at(2)) == end);

  SECTION("an answer that begins in time is heard to its end") {
    reader.receive(answer(deadline, kWarm));
    reader.advance(deadline);
    CHECK(reader.state().counts.unanswered == 0);
    reader.advance(deadline + std::chrono::seconds(1));
    CHECK(last_outcome(reader) == Outcome::Answered);
  }
  SECTION("also if it arrives when it ends") {
    const auto frame = answer(deadline, kWarm);
    const Time arrival = deadline + nfc::air_time(frame);
    CHECK(arrival < end);
    reader.advance(arrival);
    reader.receive(frame);
    reader.advance(arrival);
    CHECK(last_outcome(reader) == Outcome::Answered);
  }
  SECTION("one that begins later is not heard") {
    const auto frame = answer(deadline + kPicosecond, kWarm);
    reader.advance(frame.start + nfc::air_time(frame));
    reader.receive(frame);
    reader.advance(deadline + std::chrono::seconds(1));
    CHECK(last_outcome(reader) == Outcome::Unanswered);
    CHECK(reader.state().temperature == 0.0);
  }
  SECTION("without any the command is given up when none can come any more") {
    reader.advance(end - kPicosecond);
    CHECK(reader.state().counts.unanswered == 0);
    reader.advance(end);
    CHECK(reader.state().counts.unanswered == 1);
    CHECK(reader.state().records[0].settled_at == end);
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
  CHECK(last_outcome(reader) == Outcome::Unanswered);
}

TEST_CASE("An answer with a wrong CRC counts as none") {
  Reader reader = one_command();
  reader.transmit(at(2));
  nfc::Bytes bytes = nfc::with_crc(kWarm);
  bytes[2] ^= 0x01;
  reader.receive({at(2.001), 106, nfc::to_bits(bytes)});
  reader.advance(at(2.04));
  CHECK(last_outcome(reader) == Outcome::Damaged);
  CHECK(reader.state().counts.answered == 0);
  CHECK(reader.state().counts.unanswered == 1);
  CHECK(reader.state().counts.damaged == 1);
  CHECK(reader.state().temperature == 0.0);
}

TEST_CASE("Two answers at once destroy each other") {
  Reader reader = one_command();
  reader.transmit(at(2));
  reader.receive(answer(at(2.001), kWarm));
  reader.receive(answer(at(2.0011), kWarm));
  reader.advance(at(2.02));
  CHECK(last_outcome(reader) == Outcome::Damaged);
  CHECK(reader.state().counts.unanswered == 1);
}

TEST_CASE("A refusal is an answer but measures nothing") {
  Reader reader = one_command();
  reader.transmit(at(2));
  reader.receive(answer(at(2.001), {0x02}));
  reader.advance(at(2.04));
  CHECK(last_outcome(reader) == Outcome::Refused);
  CHECK(reader.state().records[0].answer.status == nfc::Status::BadArgument);
  CHECK(reader.state().counts.answered == 1);
  CHECK(reader.state().counts.refused == 1);
  CHECK(reader.state().temperature == 0.0);
}

TEST_CASE("An unrequested frame changes nothing") {
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
  const Time end = give_up(deadline, nfc::Command::ReadTemperature);
  CHECK(reader.next_event_time(at(2.01)) == end);
  reader.advance(end);
  CHECK(reader.next_event_time(end) == at(9));
  CHECK_FALSE(reader.next_event_time(at(9)).has_value());
}

TEST_CASE("A command without an intact answer is sent again, as often as the program says") {
  Reader reader = reader_with(
      R"(<command at="2" name="read_temperature" timeout="0.05" retries="2" pause="0.03"/>)");
  Time now = at(2);
  reader.advance(now);
  const auto first = reader.transmit(now);
  for (std::uint64_t retry = 1; retry <= 2; ++retry) {
    const Time failed = *reader.next_event_time(now);
    reader.advance(failed);
    CHECK_FALSE(reader.transmit(failed).has_value());
    CHECK(last_outcome(reader) == Outcome::Waiting);
    now = *reader.next_event_time(failed);
    CHECK(now == failed + std::chrono::milliseconds(30));
    reader.advance(now);
    const auto again = reader.transmit(now);
    REQUIRE(again.has_value());
    CHECK(again->bits == first->bits);
    CHECK(reader.state().counts.retries == retry);
  }
  CHECK(reader.state().counts.sent == 1);

  SECTION("an answer to the last one counts") {
    reader.receive(answer(now + std::chrono::milliseconds(2), kWarm));
    reader.advance(now + std::chrono::milliseconds(10));
    CHECK(last_outcome(reader) == Outcome::Answered);
    CHECK(reader.report(0) ==
          "at 2 s read_temperature: expected ok; got ok 21.5 degC after 3 tries");
  }
  SECTION("without one the command is unanswered once") {
    reader.advance(*reader.next_event_time(now));
    CHECK(last_outcome(reader) == Outcome::Unanswered);
    CHECK(reader.state().counts.unanswered == 1);
    CHECK(reader.report(0) ==
          "at 2 s read_temperature: expected ok; got no answer after 3 tries; not as expected");
  }
}

TEST_CASE("A damaged answer brings a retry, a refusal does not") {
  Reader reader = reader_with(R"(<command at="2" name="read_temperature" retries="1" pause="0"/>)");
  reader.transmit(at(2));
  auto damaged = answer(at(2.001), kWarm);
  damaged.bits[3] ^= 1;
  const Time end = damaged.start + nfc::air_time(damaged);
  reader.advance(end);
  reader.receive(damaged);
  reader.advance(end);
  REQUIRE(reader.transmit(end).has_value());
  reader.receive(answer(end + std::chrono::milliseconds(2), {0x01}));
  reader.advance(at(2.05));
  CHECK(last_outcome(reader) == Outcome::Refused);
  CHECK(reader.state().counts.damaged == 0);  // in the end it was answered
  CHECK_FALSE(reader.is_due(at(3)));
}

TEST_CASE("A retry that falls into an interval without antenna is not sent") {
  Reader reader = Reader(parse_program(R"(<reader-program version="1">
      <antenna on="1" off="2.04" power="0.5"/>
      <command at="2" name="identify" timeout="0.02" retries="5" pause="0.03"/>
    </reader-program>)",
                                       "p.xml"));
  reader.transmit(at(2));
  const Time failed = at(2.03);
  reader.advance(failed);
  CHECK(last_outcome(reader) == Outcome::Waiting);
  const Time retry = *reader.next_event_time(at(2.04));
  reader.advance(retry);
  CHECK_FALSE(reader.transmit(retry).has_value());
  CHECK(last_outcome(reader) == Outcome::Unanswered);
  CHECK(reader.state().records[0].tries == 1);
}

TEST_CASE("A request is cut where the antenna goes off, and sent again with what got out") {
  Reader reader = Reader(parse_program(R"(<reader-program version="1">
      <antenna on="1" off="2.0001" power="0.5"/><antenna on="3" off="4" power="0.5"/>
      <command at="2" name="identify" retries="3"/><command at="3" name="identify"/>
    </reader-program>)",
                                       "p.xml"));
  const auto whole = reader.transmit(at(2));
  REQUIRE(at(2) + nfc::air_time(*whole) > at(2.0001));
  CHECK(reader.next_event_time(at(2)) == at(2.0001));
  CHECK_FALSE(reader.is_due(at(2.0001) - kPicosecond));
  const Time now = GENERATE(at(2.0001), at(2.5));  // the second is a coarse grid
  reader.advance(now);
  const auto cut = reader.transmit(now);
  REQUIRE(cut.has_value());
  CHECK(*cut == nfc::cut_off(*whole, at(2.0001)));
  CHECK(cut->start == whole->start);
  CHECK(cut->bits.size() == 9);  // ten whole bits, of which one is the start of communication
  CHECK(last_outcome(reader) == Outcome::Cut);
  CHECK(reader.state().records[0].settled_at == at(2.0001));
  CHECK(reader.state().counts.unanswered == 1);
  CHECK_FALSE(reader.transmit(now).has_value());
  CHECK(reader.transmit(at(3)).has_value());
}

TEST_CASE("A carrier that only changes its power cuts nothing") {
  Reader reader = Reader(parse_program(R"(<reader-program version="1">
      <antenna on="1" off="2.0001" power="0.5"/><antenna on="2.0001" off="4" power="0.2"/>
      <command at="2" name="identify"/>
    </reader-program>)",
                                       "p.xml"));
  reader.transmit(at(2));
  reader.advance(at(2.0001));
  CHECK_FALSE(reader.transmit(at(2.0001)).has_value());
  CHECK(last_outcome(reader) == Outcome::Waiting);
}

TEST_CASE("A command that is due while the antenna is off is not sent, and reported") {
  Reader reader = Reader(parse_program(R"(<reader-program version="1">
      <antenna on="1" off="2.02" power="0.5"/>
      <command at="2" name="identify" timeout="0.05"/><command at="2.01" name="identify"/>
      <command at="2.01" name="sleep"><expect status="none"/></command>
    </reader-program>)",
                                       "p.xml"));
  reader.transmit(at(2));
  reader.advance(at(2.06));
  REQUIRE(reader.state().records.size() == 3);
  CHECK(last_outcome(reader) == Outcome::NotSent);
  CHECK(reader.state().counts.sent == 1);
  CHECK(reader.state().counts.unanswered == 1);
  CHECK(reader.state().counts.unexpected == 3);
  CHECK(reader.report(1) ==
        "at 2.06 s identify: expected ok; got no chance because the antenna was off; not as "
        "expected");
}

TEST_CASE("What was expected is compared with what came") {
  const auto settled = [](const std::string& expectation, const nfc::Bytes& content) {
    Reader reader =
        reader_with(R"(<command at="2" name="read_temperature">)" + expectation + "</command>");
    reader.transmit(at(2));
    if (!content.empty()) reader.receive(answer(at(2.001), content));
    reader.advance(at(3));
    const Counts& counts = reader.state().counts;
    CHECK(counts.as_expected + counts.unexpected == 1);
    CHECK(reader.state().records[0].as_expected == (counts.as_expected == 1));
    return reader.report(0);
  };
  CHECK(settled("", kWarm) == "at 2 s read_temperature: expected ok; got ok 21.5 degC after 1 try");
  CHECK(settled(R"(<expect lowest="20" highest="21"/>)", kWarm) ==
        "at 2 s read_temperature: expected ok 20 to 21 degC; got ok 21.5 degC after 1 try; "
        "not as expected");
  CHECK(settled(R"(<expect status="none"/>)", {}) ==
        "at 2 s read_temperature: expected no answer; got no answer after 1 try");
  CHECK(settled(R"(<expect status="bad_argument"/>)", {0x02}) ==
        "at 2 s read_temperature: expected bad_argument; got bad_argument after 1 try");
}

TEST_CASE("The first waypoint is displaced, and all of the way trembles") {
  const std::string text = R"(<reader-program version="1">
      <axes><axis name="a" tremor="0.001" start_offset="0.2"/><axis name="b"/></axes>
      <poses><pose name="p" a="1" b="2"/><pose name="q" a="3" b="4"/></poses>
      <motion><waypoint at="1" pose="p"/><waypoint at="2" pose="q"/></motion>
      <variation seed="7"/></reader-program>)";
  const Reader reader(parse_program(text, "p.xml"));
  const Tremor tremor(reader.program().variation);
  const double offset = start_offsets(reader.program().variation)[0];
  CHECK(offset != 0.0);
  CHECK(reader.axis(0, at(0.5)) == Approx(1 + offset + tremor.at(0, at(0.5))));
  CHECK(reader.axis(0, at(2.5)) == Approx(3 + tremor.at(0, at(2.5))));
  CHECK(reader.axis(0, at(2.5)) != 3.0);
  CHECK(reader.axis(1, at(0.5)) == 2.0);
}

TEST_CASE("A restored state repeats what followed it") {
  Reader reader = one_command();
  reader.transmit(at(2));
  const Reader::State saved = reader.state();
  reader.receive(answer(at(2.001), kWarm));
  reader.advance(at(3));
  CHECK(reader.state().counts.answered == 1);

  reader.state() = saved;
  CHECK(last_outcome(reader) == Outcome::Waiting);
  reader.advance(at(3));
  CHECK(last_outcome(reader) == Outcome::Unanswered);
  CHECK(reader.state().counts.answered == 0);
}
