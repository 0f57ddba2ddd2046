// The C interface of the master, as a program that links libstride uses it.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <stride/master.h>

#include "tests/build.h"
#include "tests/scratch_folder.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;
using Settings = std::vector<stride_setting>;

struct Closing {
  void operator()(stride_simulation* simulation) const { stride_close(simulation); }
};
using Simulation = std::unique_ptr<stride_simulation, Closing>;

std::string unit(const std::string& name) {
  const fs::path own = unit_folder() / (name + ".fmu");
  return (fs::exists(own) ? own : test_unit_folder() / (name + ".fmu")).string();
}

stride_options options_of(const Settings& settings) {
  stride_options options{};
  options.size = sizeof(options);
  options.settings = settings.data();
  options.setting_count = settings.size();
  return options;
}

Simulation open(const std::string& scenario, const Settings& settings = {},
                stride_options further = {}) {
  stride_options options = options_of(settings);
  options.results = further.results;
  options.checkpoint = further.checkpoint;
  options.can_save = further.can_save;
  options.message_limit = further.message_limit;
  options.progress = further.progress;
  options.user = further.user;
  stride_simulation* simulation = nullptr;
  INFO(stride_last_error()->message);
  REQUIRE(stride_open(scenario.c_str(), &options, &simulation) == STRIDE_OK);
  return Simulation(simulation);
}

std::string failure(stride_status wanted, stride_status status) {
  CHECK(status == wanted);
  CHECK(stride_last_error()->status == wanted);
  return stride_last_error()->message;
}

std::string open_failure(const std::string& scenario, const Settings& settings = {}) {
  const stride_options options = options_of(settings);
  stride_simulation* simulation = nullptr;
  const auto text =
      failure(STRIDE_INVALID_INPUT, stride_open(scenario.c_str(), &options, &simulation));
  CHECK(simulation == nullptr);
  return text;
}

double at(stride_time time) {
  return static_cast<double>(time.seconds) + 1e-12 * static_cast<double>(time.picoseconds);
}

std::size_t find(const Simulation& simulation, const std::string& name) {
  std::size_t index = 0;
  REQUIRE(stride_find(simulation.get(), name.c_str(), &index) == STRIDE_OK);
  return index;
}

template <class T = double>
T get(const Simulation& simulation, const std::string& name) {
  T value{};
  INFO(stride_last_error()->message);
  REQUIRE(stride_get(simulation.get(), find(simulation, name), &value, 1) == STRIDE_OK);
  return value;
}

template <class T>
stride_status set(const Simulation& simulation, const std::string& name, T value) {
  return stride_set(simulation.get(), find(simulation, name), &value, 1);
}

void step_to(const Simulation& simulation, double seconds) {
  INFO(stride_last_error()->message);
  REQUIRE(stride_advance(simulation.get(), stride_seconds(seconds)) == STRIDE_OK);
}

/// Two filters in a row, judged.
const char* const kScenario = R"(<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="test" version="2.0"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
<ssd:System name="root"><ssd:Elements>
<ssd:Component name="first" source="minimal.fmu"/>
<ssd:Component name="second" source="minimal.fmu"/>
<ssd:Component name="judge" source="judge.fmu"/>
</ssd:Elements><ssd:Connections>
<ssd:Connection startElement="first" startConnector="y" endElement="second" endConnector="u"/>
<ssd:Connection startElement="second" startConnector="y" endElement="judge" endConnector="u"/>
</ssd:Connections></ssd:System><ssd:DefaultExperiment stopTime="1"/>
<ssd:Annotations><ssc:Annotation type="org.stride">
<stride:Scenario xmlns:stride="urn:org.stride:scenario:1"><stride:Step size="0.125"/>
</stride:Scenario></ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>)";

class Folder : public ScratchFolder {
 public:
  Folder() {
    ::setenv("STRIDE_UNITS", (test_unit_folder().string() + ":" + unit_folder().string()).c_str(),
             1);
    std::ofstream(*this / "test.ssd") << kScenario;
  }
  std::string scenario() const { return (*this / "test.ssd").string(); }
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

const Settings kRising{{"set", "first.u=1"}, {"set", "judge.limit=0.3"}};

}  // namespace

TEST_CASE("a scenario is opened, advanced, looked at and ended") {
  const Folder folder;
  const Simulation simulation = open(folder.scenario(), kRising);
  CHECK(at(stride_now(simulation.get())) == 0);
  CHECK(at(stride_stop_time(simulation.get())) == 1);
  CHECK_FALSE(stride_is_over(simulation.get()));
  CHECK(stride_end_reason(simulation.get()) == std::string());
  step_to(simulation, 0.5);
  CHECK(at(stride_now(simulation.get())) == 0.5);
  CHECK(get(simulation, "second.u") == get(simulation, "first.y"));
  CHECK(get(simulation, "first.y") == Approx(1 - std::exp(-0.5)));
  step_to(simulation, 3);
  CHECK(stride_is_over(simulation.get()));
  REQUIRE(stride_end(simulation.get()) == STRIDE_OK);
  CHECK(stride_end_reason(simulation.get()) == std::string("completed"));
  REQUIRE(stride_verdict_count(simulation.get()) == 1);
  stride_verdict verdict{};
  verdict.size = sizeof(verdict);
  REQUIRE(stride_get_verdict(simulation.get(), 0, &verdict) == STRIDE_OK);
  CHECK(verdict.name == std::string("judge"));
  CHECK(verdict.passed == 1);
  CHECK(verdict.time.seconds == STRIDE_NO_TIME);
  CHECK(std::isnan(verdict.margin));
}

TEST_CASE("a unit calls its own functions, whatever names those of the program's libraries have") {
  if (kSanitized) return;  // whose functions come before all others
  const std::string name = GENERATE("own_checksum", "own_names", "every_symbol");
  CAPTURE(name);
  const Simulation simulation = open(unit(name));
  step_to(simulation, 0.5);
  CHECK(get(simulation, name + ".called") >= 1);
  CHECK(get(simulation, name + ".own") == get(simulation, name + ".called"));
}

TEST_CASE("results are those of stride run, if the steps are") {
  const Folder folder;
  const std::string results = (folder / "results").string();
  stride_options options{};
  options.results = results.c_str();
  Simulation simulation = open(folder.scenario(), kRising, options);
  step_to(simulation, 0.25);
  step_to(simulation, 1);
  REQUIRE(stride_end(simulation.get()) == STRIDE_OK);
  simulation.reset();
  const std::string command = stride_program().string() + " run " + folder.scenario() +
                              " -q --set first.u=1 --set judge.limit=0.3 -o " +
                              (folder / "program").string();
  REQUIRE(std::system(command.c_str()) == 0);
  for (const char* const file : {"signals.csv", "events.csv", "signals.vcd", "activity.csv"}) {
    CHECK(text_of(folder / "results" / file) == text_of(folder / "program" / file));
  }
  CHECK_THAT(text_of(folder / "results" / "run.json"),
             Contains("\"outcome\": \"completed\"") && Contains("--set=first.u=1"));
  CHECK(fs::exists(folder / "results" / "report.html") ==
        fs::exists(folder / "program" / "report.html"));
}

TEST_CASE("an instant between two communication points is one, and what is set there counts") {
  const Folder folder;
  const Simulation simulation = open(folder.scenario());
  step_to(simulation, 0.3);
  CHECK(set(simulation, "first.u", 2.0) == STRIDE_OK);
  CHECK(get(simulation, "first.u") == 2);
  CHECK(get(simulation, "first.y") == 0);
  step_to(simulation, 0.8);
  CHECK(get(simulation, "first.y") == Approx(2 * (1 - std::exp(-0.5))));
}

TEST_CASE("an end before the stop time is said, and judges nothing that is not decided") {
  const Folder folder;
  const std::string results = (folder / "results").string();
  stride_options options{};
  options.results = results.c_str();
  Simulation simulation = open(folder.scenario(), kRising, options);
  step_to(simulation, 0.5);
  REQUIRE(stride_end(simulation.get()) == STRIDE_OK);
  CHECK(stride_end_reason(simulation.get()) == std::string("ended early"));
  CHECK_THAT(text_of(folder / "results" / "run.json"), Contains("\"outcome\": \"ended early\""));
  CHECK_THAT(failure(STRIDE_MISUSE, stride_advance(simulation.get(), stride_seconds(1))),
             Contains("the run has ended"));
}

TEST_CASE("values of each type are set, and read as the unit gives them back") {
  const Simulation simulation = open(unit("types"), {{"stop", "1"}, {"step", "0.1"}});
  const auto echoes = [&](const std::string& name, auto value) {
    CHECK(set(simulation, "types." + name, value) == STRIDE_OK);
    CHECK(get<decltype(value)>(simulation, "types." + name + ".echo") == value);
  };
  echoes("float64", 1.5);
  echoes("float32", 2.5F);
  echoes("int8", std::int8_t{-8});
  echoes("uint8", std::uint8_t{200});
  echoes("int16", std::int16_t{-300});
  echoes("uint16", std::uint16_t{60000});
  echoes("int32", std::int32_t{-70000});
  echoes("uint32", std::uint32_t{4000000000});
  echoes("int64", std::int64_t{1} << 60);
  echoes("uint64", std::uint64_t{1} << 63);
  echoes("boolean", std::uint8_t{1});
  echoes("colour", std::int64_t{4});
  CHECK(set<const char*>(simulation, "types.string", "größer") == STRIDE_OK);
  CHECK(get<const char*>(simulation, "types.string.echo") == std::string("größer"));
  const std::vector<std::uint8_t> bytes{0, 255, 7};
  CHECK(set<stride_bytes>(simulation, "types.binary", {bytes.data(), bytes.size()}) == STRIDE_OK);
  const auto echo = get<stride_bytes>(simulation, "types.binary.echo");
  CHECK(std::vector(echo.data, echo.data + echo.size) == bytes);
  const std::size_t matrix = find(simulation, "types.matrix");
  const std::vector<double> numbers{6, 5, 4, 3, 2, 1};
  CHECK(stride_set(simulation.get(), matrix, numbers.data(), 6) == STRIDE_OK);
  std::vector<double> back(6);
  CHECK(stride_get(simulation.get(), find(simulation, "types.matrix.echo"), back.data(), 6) ==
        STRIDE_OK);
  CHECK(back == numbers);
}

TEST_CASE("elements that are none are refused, with their component and variable") {
  const Simulation simulation = open(unit("types"), {{"stop", "1"}, {"step", "0.1"}});
  const auto refuses = [&](const std::string& name, auto value, const char* mistake) {
    CHECK_THAT(failure(STRIDE_INVALID_INPUT, set(simulation, "types." + name, value)),
               Contains(mistake));
    CHECK(stride_last_error()->component == std::string("types"));
    CHECK(stride_last_error()->variable == name);
  };
  refuses("string", static_cast<const char*>(nullptr), "a text is NULL");
  refuses("string", "\xff", "not UTF-8");
  refuses("binary", stride_bytes{nullptr, 1}, "bytes are NULL");
  refuses("boolean", std::uint8_t{2}, "neither 0 nor 1");
}

TEST_CASE("variables are described") {
  const Simulation simulation = open(unit("types"), {{"stop", "1"}, {"step", "0.1"}});
  stride_variable variable{};
  variable.size = sizeof(variable);
  REQUIRE(stride_describe(simulation.get(), find(simulation, "types.matrix"), &variable) ==
          STRIDE_OK);
  CHECK(variable.name == std::string("types.matrix"));
  CHECK(variable.component == std::string("types"));
  CHECK(variable.type == STRIDE_FLOAT64);
  CHECK(variable.causality == STRIDE_INPUT);
  CHECK(variable.count == 6);
  REQUIRE(variable.dimension_count == 2);
  CHECK(variable.dimensions[0] == 2);
  CHECK(variable.dimensions[1] == 3);
  REQUIRE(stride_describe(simulation.get(), find(simulation, "types.receive.frame"), &variable) ==
          STRIDE_OK);
  CHECK(variable.is_message);
  REQUIRE(variable.clock_count == 1);
  CHECK(variable.clocks[0] == find(simulation, "types.receive.clock"));
  REQUIRE(stride_describe(simulation.get(), find(simulation, "types.gained"), &variable) ==
          STRIDE_OK);
  CHECK(variable.unit == std::string("m"));
  CHECK_FALSE(variable.is_relative);
  const Simulation other = open(unit("gain"), {{"stop", "1"}, {"step", "0.1"}});
  REQUIRE(stride_describe(other.get(), find(other, "gain.k"), &variable) == STRIDE_OK);
  CHECK(variable.is_relative);
}

TEST_CASE("a structure of an earlier version is filled as far as it goes") {
  const Simulation simulation = open(unit("types"), {{"stop", "1"}, {"step", "0.1"}});
  stride_variable variable{};
  CHECK_THAT(failure(STRIDE_MISUSE, stride_describe(simulation.get(), 0, &variable)),
             Contains("sizeof"));
  variable.size = offsetof(stride_variable, type);
  variable.count = 77;
  REQUIRE(stride_describe(simulation.get(), 0, &variable) == STRIDE_OK);
  CHECK(variable.size == offsetof(stride_variable, type));
  CHECK(variable.name != nullptr);
  CHECK(variable.count == 77);
}

TEST_CASE("messages are sent and received, and the oldest are dropped where there are too many") {
  stride_options options{};
  options.message_limit = 3;
  const Simulation simulation = open(unit("types"), {{"stop", "1"}, {"step", "0.1"}}, options);
  step_to(simulation, 0.25);
  const std::vector<std::uint8_t> bytes{7, 8};
  const stride_bytes frame{bytes.data(), bytes.size()};
  const stride_value value{find(simulation, "types.receive.frame"), &frame, 1};
  const std::size_t clock = find(simulation, "types.receive.clock");
  CHECK(stride_send(simulation.get(), clock, &value, 1) == STRIDE_OK);
  CHECK(stride_send(simulation.get(), clock, &value, 1) == STRIDE_OK);
  step_to(simulation, 0.5);
  stride_message message{};
  message.size = sizeof(message);
  std::vector<std::string> seen;
  std::size_t dropped = 0;
  while (stride_next_message(simulation.get(), &message) == 1) {
    CHECK(at(message.time) == 0.25);
    REQUIRE(message.count == 1);
    const auto& content = *static_cast<const stride_bytes*>(message.elements);
    CHECK(std::vector(content.data, content.data + content.size) == bytes);
    CHECK(message.is_received == (message.index == value.index));
    seen.emplace_back(message.content);
    dropped += message.dropped;
  }
  CHECK(seen.size() + dropped >= 2);
  CHECK(seen.size() <= 3);
  CHECK_THAT(seen.back(), Contains("2 bytes in"));
}

TEST_CASE("a message that no component can receive is refused") {
  const Simulation simulation = open(unit("types"), {{"stop", "1"}, {"step", "0.1"}});
  const double number = 1;
  const stride_value value{find(simulation, "types.float64"), &number, 1};
  const std::size_t clock = find(simulation, "types.receive.clock");
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, stride_send(simulation.get(), clock, &value, 1)),
             Contains("'float64'") && Contains("no input that belongs to the clock"));
  const std::size_t sender = find(simulation, "types.send.clock");
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, stride_send(simulation.get(), sender, nullptr, 0)),
             Contains("no input clock"));
}

TEST_CASE("interventions are made from now on") {
  const Folder folder;
  const Simulation simulation = open(folder.scenario());
  step_to(simulation, 0.25);
  CHECK(stride_intervene(simulation.get(), "force", "second.u=3@0.5..0.75") == STRIDE_OK);
  step_to(simulation, 0.625);
  CHECK(get(simulation, "second.u") == 3);
  step_to(simulation, 1);
  CHECK(get(simulation, "second.u") == 0);
}

TEST_CASE("a wrong intervention is refused, and changes nothing") {
  const Folder folder;
  const Simulation simulation = open(folder.scenario());
  step_to(simulation, 0.25);
  const auto refused = [&](const char* option, const char* text) {
    return failure(STRIDE_INVALID_INPUT, stride_intervene(simulation.get(), option, text));
  };
  CHECK_THAT(refused("force", "second.u=3@0.1..0.2"), Contains("0.1 s, which is over"));
  CHECK_THAT(refused("force", "second.v=3@0.5.."), Contains("did you mean"));
  CHECK_THAT(refused("forse", "second.u=3@0.5.."), Contains("did you mean 'force'"));
  CHECK(stride_intervene(simulation.get(), "force", "second.u=3@0.5..0.75") == STRIDE_OK);
  CHECK_THAT(refused("force", "second.u=4@0.6.."), Contains("contradicts"));
  step_to(simulation, 0.625);
  CHECK(get(simulation, "second.u") == 3);
}

TEST_CASE("a simulation that goes on from a checkpoint is the same as one that has not ended") {
  const Folder folder;
  const std::string file = (folder / "saved.zip").string();
  stride_options saving{};
  saving.can_save = 1;
  const Simulation whole = open(folder.scenario(), kRising, saving);
  step_to(whole, 0.5);
  CHECK(set(whole, "first.u", 2.0) == STRIDE_OK);
  INFO(stride_last_error()->message);
  REQUIRE(stride_save(whole.get(), file.c_str()) == STRIDE_OK);
  step_to(whole, 1);
  stride_options going_on{};
  going_on.checkpoint = file.c_str();
  const Simulation rest = open(folder.scenario(), kRising, going_on);
  CHECK(at(stride_now(rest.get())) == 0.5);
  step_to(rest, 1);
  CHECK(get(rest, "second.y") == get(whole, "second.y"));
}

TEST_CASE("a checkpoint is not made, or not taken, where it would be a wrong one") {
  const Folder folder;
  const std::string file = (folder / "saved.zip").string();
  const Simulation plain = open(folder.scenario(), kRising);
  CHECK_THAT(failure(STRIDE_MISUSE, stride_save(plain.get(), file.c_str())), Contains("can_save"));
  stride_options saving{};
  saving.can_save = 1;
  const Simulation simulation = open(folder.scenario(), kRising, saving);
  step_to(simulation, 0.25);
  CHECK(stride_intervene(simulation.get(), "force", "second.u=3@0.5..0.75") == STRIDE_OK);
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, stride_save(simulation.get(), file.c_str())),
             Contains("has not ended"));
  std::ofstream(file) << "nothing";
  stride_options going_on = options_of(kRising);
  going_on.checkpoint = file.c_str();
  stride_simulation* none = nullptr;
  CHECK_THAT(
      failure(STRIDE_INVALID_INPUT, stride_open(folder.scenario().c_str(), &going_on, &none)),
      Contains("saved.zip"));
}

TEST_CASE("a checkpoint is of the same settings, but for those that may differ") {
  const Folder folder;
  const std::string file = (folder / "saved.zip").string();
  stride_options saving{};
  saving.can_save = 1;
  const Simulation whole = open(folder.scenario(), kRising, saving);
  step_to(whole, 0.5);
  REQUIRE(stride_save(whole.get(), file.c_str()) == STRIDE_OK);
  const auto opened = [&](const Settings& settings) {
    stride_options options = options_of(settings);
    options.checkpoint = file.c_str();
    stride_simulation* simulation = nullptr;
    const stride_status status = stride_open(folder.scenario().c_str(), &options, &simulation);
    stride_close(simulation);
    return status;
  };
  CHECK_THAT(
      failure(STRIDE_INVALID_INPUT, opened({{"set", "first.u=2"}, {"set", "judge.limit=0.3"}})),
      Contains("other settings: that one has --set=first.u=1, this one --set=first.u=2"));
  CHECK(opened({kRising[1], kRising[0], {"stop", "2"}, {"threads", "2"}}) == STRIDE_OK);
}

TEST_CASE("the folder of a simulation that has ended is free, though it is still looked at") {
  const Folder folder;
  const std::string results = (folder / "results").string();
  stride_options writing{};
  writing.results = results.c_str();
  const Simulation first = open(folder.scenario(), kRising, writing);
  stride_options again = options_of(kRising);
  again.results = results.c_str();
  stride_simulation* none = nullptr;
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, stride_open(folder.scenario().c_str(), &again, &none)),
             Contains("locked this folder"));
  step_to(first, 1);
  REQUIRE(stride_end(first.get()) == STRIDE_OK);
  const Simulation second = open(folder.scenario(), kRising, writing);
  CHECK(at(stride_now(second.get())) == 0);
}

TEST_CASE("mistakes in the input are told with what would be right") {
  const Folder folder;
  CHECK_THAT(open_failure("nowhere.ssd"), Contains("nowhere.ssd"));
  CHECK_THAT(open_failure(folder.scenario(), {{"sett", "first.u=1"}}),
             Contains("there is no setting 'sett'") && Contains("did you mean 'set'"));
  CHECK_THAT(open_failure(folder.scenario(), {{"set", "first.v=1"}}), Contains("first.v"));
  CHECK_THAT(open_failure(folder.scenario(), {{"stop", "soon"}}), Contains("soon"));
  CHECK_THAT(open_failure(folder.scenario(), {{"threads", "none"}}), Contains("threads"));
  CHECK_THAT(open_failure(folder.scenario(), {{"out", "x"}}), Contains("no setting 'out'"));
  const Simulation simulation = open(folder.scenario());
  std::size_t index = 0;
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, stride_find(simulation.get(), "first.yy", &index)),
             Contains("did you mean 'first.y'"));
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, set(simulation, "second.u", 1.0)),
             Contains("is fed by 'first.y'") && Contains("--force"));
  CHECK(stride_last_error()->component == std::string("second"));
  CHECK(stride_last_error()->variable == std::string("u"));
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, set(simulation, "first.y", 1.0)),
             Contains("is computed by the unit"));
}

TEST_CASE("what makes no sense is misuse, and changes nothing") {
  const Folder folder;
  const Simulation simulation = open(folder.scenario());
  stride_simulation* none = nullptr;
  double value = 0;
  CHECK_THAT(failure(STRIDE_MISUSE, stride_open(nullptr, nullptr, &none)), Contains("NULL"));
  CHECK_THAT(failure(STRIDE_MISUSE, stride_open("x", nullptr, nullptr)), Contains("no place"));
  CHECK_THAT(failure(STRIDE_MISUSE, stride_advance(nullptr, stride_seconds(1))), Contains("NULL"));
  CHECK_THAT(failure(STRIDE_MISUSE, stride_get(simulation.get(), 12345, &value, 1)),
             Contains("no variable with this index"));
  CHECK_THAT(
      failure(STRIDE_MISUSE, stride_get(simulation.get(), find(simulation, "first.y"), &value, 2)),
      Contains("'first.y' has 1 elements, not 2"));
  stride_options sizeless{};
  CHECK_THAT(failure(STRIDE_MISUSE, stride_open("x", &sizeless, &none)), Contains("sizeof"));
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, stride_advance(simulation.get(), stride_seconds(-1))),
             Contains("later than"));
  step_to(simulation, 1);
  CHECK_THAT(failure(STRIDE_INVALID_INPUT, set(simulation, "first.u", 1.0)),
             Contains("at its end"));
}

TEST_CASE("a unit that fails ends its simulation, whose results contain why") {
  const Folder folder;
  const std::string results = (folder / "results").string();
  stride_options options{};
  options.results = results.c_str();
  const Simulation simulation = open(
      unit("thrower"), {{"stop", "1"}, {"step", "0.1"}, {"set", "thrower.throw_at=0.5"}}, options);
  const std::string text =
      failure(STRIDE_RUN_FAILED, stride_advance(simulation.get(), stride_seconds(1)));
  CHECK_THAT(text, Contains("unit 'thrower'") && Contains("the fuse has blown"));
  CHECK(stride_last_error()->component == std::string("thrower"));
  CHECK(stride_is_over(simulation.get()));
  CHECK(stride_end_reason(simulation.get()) == std::string("failed"));
  CHECK_THAT(text_of(folder / "results" / "run.json"), Contains("\"error\""));
  CHECK_THAT(failure(STRIDE_MISUSE, stride_end(simulation.get())), Contains("has failed"));
}

TEST_CASE("a run can be interrupted while it is simulated") {
  stride_options options{};
  options.progress = [](void*, stride_time time) { return at(time) > 0 ? 1 : 0; };
  const Simulation simulation = open(unit("minimal"), {{"stop", "9e6"}, {"step", "1e-3"}}, options);
  CHECK_THAT(failure(STRIDE_RUN_FAILED, stride_advance(simulation.get(), stride_end_of_time())),
             Contains("interrupted"));
  CHECK(stride_is_over(simulation.get()));
  CHECK(stride_end(simulation.get()) == STRIDE_OK);
  CHECK(stride_end_reason(simulation.get()) == std::string("interrupted"));
}

TEST_CASE("another thread can interrupt a run") {
  const Simulation simulation = open(unit("minimal"), {{"stop", "9e6"}, {"step", "1e-3"}});
  std::thread other([&] { stride_interrupt(simulation.get()); });
  CHECK_THAT(failure(STRIDE_RUN_FAILED, stride_advance(simulation.get(), stride_end_of_time())),
             Contains("interrupted"));
  other.join();
}

TEST_CASE("what is called during a call is misuse, and the run goes on") {
  struct During {
    stride_simulation* simulation = nullptr;
    stride_status closed = STRIDE_OK, read = STRIDE_OK;
  } during;
  stride_options options{};
  options.user = &during;
  options.progress = [](void* user, stride_time) {
    auto& seen = *static_cast<During*>(user);
    double value = 0;
    seen.closed = stride_close(seen.simulation);
    seen.read = stride_get(seen.simulation, 0, &value, 1);
    return 1;
  };
  const Simulation simulation = open(unit("minimal"), {{"stop", "9e6"}, {"step", "1e-3"}}, options);
  during.simulation = simulation.get();
  CHECK(stride_advance(simulation.get(), stride_end_of_time()) == STRIDE_RUN_FAILED);
  CHECK(during.closed == STRIDE_MISUSE);
  CHECK(during.read == STRIDE_MISUSE);
  CHECK(stride_end_reason(simulation.get()) == std::string("interrupted"));
  CHECK(stride_end(simulation.get()) == STRIDE_OK);
}

TEST_CASE("units get processes of their own when no other thread is in the library") {
  const Folder folder;
  const Simulation busy = open(folder.scenario(), {{"stop", "1000"}, {"step", "1e-4"}});
  std::thread other([&] { stride_advance(busy.get(), stride_end_of_time()); });
  const Simulation isolated = open(folder.scenario(), {{"isolate", nullptr}});
  step_to(isolated, 1);
  other.join();
  CHECK(stride_is_over(busy.get()));
}

TEST_CASE("two simulations are advanced in turns, and in threads") {
  const Folder folder;
  const Simulation one = open(folder.scenario(), kRising), other = open(folder.scenario(), kRising);
  for (const double time : {0.25, 0.5}) {
    step_to(one, time);
    step_to(other, time);
  }
  double results[2]{};
  const auto finish = [&](const Simulation& simulation, double& result) {
    stride_advance(simulation.get(), stride_seconds(1));
    std::size_t index = 0;
    stride_find(simulation.get(), "second.y", &index);
    stride_get(simulation.get(), index, &result, 1);
  };
  std::thread thread([&] { finish(other, results[1]); });
  finish(one, results[0]);
  thread.join();
  CHECK(results[0] == results[1]);
  CHECK(results[0] > 0);
}

TEST_CASE("a fork of the process cannot use the simulation, and leaves it alone") {
  const Folder folder;
  const Simulation simulation = open(folder.scenario(), kRising);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const bool is_refused = stride_advance(simulation.get(), stride_seconds(1)) == STRIDE_MISUSE;
    stride_close(simulation.get());
    ::_exit(is_refused ? 0 : 1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(status == 0);
  step_to(simulation, 1);
}

TEST_CASE("a unit in a process of its own that crashes leaves the caller alive") {
  const Simulation simulation = open(unit("faulty"), {{"stop", "1"},
                                                      {"step", "0.1"},
                                                      {"isolate", nullptr},
                                                      {"set", "faulty.fault=segfault"},
                                                      {"set", "faulty.call=step"}});
  CHECK_THAT(failure(STRIDE_RUN_FAILED, stride_advance(simulation.get(), stride_seconds(1))),
             Contains("SIGSEGV"));
}

TEST_CASE("messages go to a function") {
  struct Log {
    std::vector<std::string> texts;
  } log;
  stride_set_log(
      [](void* user, stride_level level, const char* text) {
        if (level == STRIDE_WARNING) static_cast<Log*>(user)->texts.emplace_back(text);
      },
      &log);
  const Folder folder;
  std::string text(kScenario);
  text.replace(text.find("<stride:Step "), 0, "<stride:Unknown/>");
  std::ofstream(folder / "test.ssd") << text;
  stride_simulation* simulation = nullptr;
  const stride_status status = stride_open(folder.scenario().c_str(), nullptr, &simulation);
  stride_close(simulation);
  stride_set_log(nullptr, nullptr);
  CHECK((status == STRIDE_INVALID_INPUT || !log.texts.empty()));
}

TEST_CASE("seconds become the nearest picosecond") {
  const auto is = [](stride_time time, std::int64_t seconds, std::int64_t picoseconds) {
    return time.seconds == seconds && time.picoseconds == picoseconds;
  };
  CHECK(is(stride_seconds(0.1), 0, 100'000'000'000));
  CHECK(is(stride_seconds(-1.5), -2, 500'000'000'000));
  CHECK(is(stride_seconds(3.2e9), 3'200'000'000, 0));
  CHECK(is(stride_seconds(1e300), 1'000'000'000'000'000, 0));
  CHECK(is(stride_seconds(-1e300), -1'000'000'000'000'000, 0));
  CHECK(stride_seconds(std::nan("")).seconds == STRIDE_NO_TIME);
}

TEST_CASE("sums of times are exact") {
  const stride_time sum = stride_sum({3'200'000'000, 999'999'999'999}, {0, 1});
  CHECK(sum.seconds == 3'200'000'001);
  CHECK(sum.picoseconds == 0);
  const stride_time negative = stride_sum(stride_seconds(-1.5), stride_seconds(0.25));
  CHECK(negative.seconds == -2);
  CHECK(negative.picoseconds == 750'000'000'000);
  CHECK(stride_sum({STRIDE_NO_TIME, 0}, stride_seconds(1)).seconds == STRIDE_NO_TIME);
}
