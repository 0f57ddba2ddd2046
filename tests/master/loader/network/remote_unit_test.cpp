// Units behind `stride serve`, call by call.
#include "master/loader/network/remote_unit.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/engine/port/capabilities/concurrent_steps.h"
#include "tests/build.h"
#include "tests/error_of.h"
#include "tests/master/base/archive/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Passes on what it reads, but for the time in which a file is there.
constexpr const char* kGate = R"(
import os, sys, time
while True:
    piece = os.read(0, 65536)
    while os.path.exists(sys.argv[1]):
        time.sleep(0.001)
    if not piece:
        break
    while piece:
        piece = piece[os.write(1, piece):]
)";

std::string serve_command() { return fmt::format("exec:{} serve", stride_program().string()); }

/// In Initialization Mode.
std::unique_ptr<remote::RemoteUnit> unit_elsewhere(const std::string& unit,
                                                   const std::string& at = serve_command(),
                                                   std::chrono::milliseconds silence_limit = 30s) {
  const remote::RemoteSpec spec{.place = remote::parse_place(at, ""),
                                .fmu = (test_unit_folder() / (unit + ".fmu")).string(),
                                .silence_limit = silence_limit};
  auto made =
      std::make_unique<remote::RemoteUnit>(spec, remote::describe(spec, {}), unit,
                                           importer::InstanceOptions{}, isolation::HostOptions{});
  made->instantiate();
  made->enter_initialization(Time(), std::nullopt);
  return made;
}

void begin(remote::RemoteUnit& unit) {
  unit.exit_initialization();
  unit.update_discrete_states();
  unit.enter_step_mode();
}

using Put = std::function<void(remote::PacketWriter&)>;

/// What becomes of the instantiation of a unit if this is all that its machine says; the component
/// is in line 7 of its scenario.
std::string error_of_answer(remote::ReplyCode code, const Put& put,
                            const std::string& unit = "feedthrough", bool takes_snapshots = false) {
  const tests::Scratch scratch;
  std::string bytes = greeting_line(remote::Side::Server, remote::own_greeting());
  isolation::PacketBuffer memory;
  remote::PacketWriter packet(memory);
  put(packet);
  remote::append_message(bytes, remote::ReplyHead{.code = code}, packet.bytes());
  const fs::path said = scratch.write("said", bytes);
  const remote::RemoteSpec spec{
      .place = remote::parse_place(fmt::format("exec:cat {}; cat > /dev/null", said.string()))};
  isolation::HostOptions host;
  host.takes_snapshots = takes_snapshots;
  return error_of([&] {
    remote::RemoteUnit made(spec, importer::Fmu::load(test_unit_folder() / (unit + ".fmu")), "far",
                            {.where = {"test.ssd", 7}}, host);
    made.instantiate();
  });
}

core::ValueReference reference_of(const std::string& unit, const std::string& variable) {
  const auto fmu = importer::Fmu::load(test_unit_folder() / (unit + ".fmu"));
  return fmu->description()->variables[fmu->description()->find(variable).value()].reference;
}

}  // namespace

TEST_CASE("while one machine is not done with a step another one is asked for its own") {
  const tests::Scratch scratch;
  const fs::path script = scratch.write("gate.py", kGate), closed = scratch / "closed";
  const auto slow = unit_elsewhere("feedthrough", fmt::format("{} | python3 {} {}", serve_command(),
                                                              script.string(), closed.string()));
  const auto quick = unit_elsewhere("feedthrough");
  begin(*slow);
  begin(*quick);
  const core::StepInterval interval(Time(), Time(10ms));
  scratch.write("closed", "");
  slow->begin_step(interval, {}, {});
  quick->begin_step(interval, {}, {});
  CHECK(quick->finish_step().reached == Time(10ms));
  fs::remove(closed);
  CHECK(slow->finish_step().reached == Time(10ms));
}

TEST_CASE("a machine whose answer nobody has looked at for long was not silent") {
  const auto unit = unit_elsewhere("feedthrough", serve_command(), 1s);
  begin(*unit);
  unit->begin_step(core::StepInterval(Time(), Time(10ms)), {}, {});
  std::this_thread::sleep_for(1500ms);  // other units step meanwhile
  CHECK(unit->finish_step().reached == Time(10ms));
}

TEST_CASE("a value of many pieces comes back as it was sent") {
  const core::ValueReference in = reference_of("types", "binary"),
                             out = reference_of("types", "binary.echo");
  const auto unit = unit_elsewhere("types");
  core::ValueBlock sent(core::ValueType::Binary, 1), answered(core::ValueType::Binary, 1);
  core::Binary& bytes = sent.binaries()[0];
  bytes.resize(20'000'003);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 7);
  unit->set(std::span(&in, 1), sent);
  unit->get(std::span(&out, 1), answered);
  CHECK((answered == sent));
}

TEST_CASE("an answer to the instantiation that is none is an error of the component") {
  using remote::ReplyCode;
  const auto is_refused = [](const std::string& error, const std::string& why) {
    CHECK_THAT(error, StartsWith("test.ssd:7: unit 'far': ") && Contains(why));
  };
  const auto has = [](std::initializer_list<core::CapabilityId> capabilities) -> Put {
    isolation::CapabilitySet set;
    for (const core::CapabilityId id : capabilities) set.set(static_cast<std::size_t>(id));
    return [set](remote::PacketWriter& to) {
      isolation::Form<isolation::CapabilitySet>::put(to, set);
    };
  };
  constexpr auto kReset = core::CapabilityId::Resetting;
  constexpr auto kDiagnostics = core::CapabilityId::UnitDiagnostics;
  constexpr auto kState = core::CapabilityId::StateSaving;
  constexpr auto kBytes = core::CapabilityId::StateSerialization;
  const auto nothing = [](remote::PacketWriter&) {};
  is_refused(error_of_answer(ReplyCode::Done, nothing),
             "sends what cannot be read in the instantiation: something is missing at the end");
  is_refused(error_of_answer(ReplyCode{77}, nothing), "an answer that nobody has asked for");
  is_refused(error_of_answer(ReplyCode::Done, has({})), "lacks what its description promises: ");
  is_refused(
      error_of_answer(ReplyCode::Done, has({kReset, kDiagnostics, kState, kBytes}), "clocks"),
      "lacks what its description promises: the intervals of clocks");
  is_refused(error_of_answer(ReplyCode::Done, has({kReset, kDiagnostics}), "stateless", true),
             "lacks what its description promises: the saving of its state");
  const auto fail = [](const core::Error& error) -> Put {
    return [error](remote::PacketWriter& to) { isolation::put_error(to, error, {}); };
  };
  for (const core::Error& error :
       {core::Error(core::Error::Kind::Run, {.unit = "another"}, "no such luck"),
        static_cast<core::Error>(core::EnvironmentError({.unit = "another"}, "no such luck"))}) {
    is_refused(error_of_answer(ReplyCode::Failed, fail(error)), "no such luck");
  }
}
