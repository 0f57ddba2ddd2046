// The header for programs: how a Program obeys commands.
#include <functional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <stride/process/program.h>

using stride::Duration;
using stride::Time;
using stride::process::Binary;
using stride::process::Program;

namespace {

class Probe : public Program {
 public:
  Probe(int in, int out) : Program(in, out) {
    parameter("gain", gain_);
    input("u", u_);
    input("on", on_);
    output("y", y_);
    output("count", count_);
    message_input<Binary>("in", [this](const Binary& bytes) {
      send("out", now(), "got " + std::to_string(bytes.size()));
    });
  }

  std::function<Time(Probe&, Time, bool)> on_step = [](Probe& p, Time to, bool) {
    p.y_ = p.gain_ * p.u_;
    return to;
  };
  std::optional<Time> next;
  using Program::end_simulation;
  using Program::instance_name;
  using Program::log;
  using Program::now;
  using Program::resources;
  using Program::send;
  std::string traced;
  bool has_finished = false;
  double gain_ = 1, u_ = 0, y_ = 0;
  bool on_ = false;
  std::uint32_t count_ = 0;

 private:
  void start() override { y_ = gain_ * u_; }
  Time step(Time to, bool may_stop) override {
    ++count_;
    return on_step(*this, to, may_stop);
  }
  std::optional<Time> next_event() override { return next; }
  void trace(const std::string& file, const std::string& signals) override {
    traced = file + ": " + signals;
  }
  void finish() override { has_finished = true; }
};

struct Outcome {
  int exit_code;
  std::string answers;
};

/// Runs it with these commands at once.
Outcome run(const std::string& commands, const std::function<void(Probe&)>& prepare = {},
            const std::function<void(Probe&)>& look = {}) {
  int in[2], out[2];
  REQUIRE(::pipe(in) == 0);
  REQUIRE(::pipe(out) == 0);
  REQUIRE(::write(in[1], commands.data(), commands.size()) ==
          static_cast<ssize_t>(commands.size()));
  ::close(in[1]);
  Probe probe(in[0], out[1]);
  if (prepare) prepare(probe);
  Outcome outcome{probe.run(), ""};
  if (look) look(probe);
  ::close(out[1]);
  char text[4096];
  for (ssize_t size = 0; (size = ::read(out[0], text, sizeof text)) > 0;) {
    outcome.answers.append(text, static_cast<std::size_t>(size));
  }
  ::close(in[0]);
  ::close(out[0]);
  return outcome;
}

constexpr const char* kOpen = "<open protocol=\"1\" instance=\"it\" resources=\"/r\"/>\n";

}  // namespace

TEST_CASE("a whole run: all outputs are sent at the start, then where they change") {
  const Outcome outcome =
      run(std::string(kOpen) +
              "<parameter name=\"gain\" value=\"2\"/>\n"
              "<trace file=\"t.vcd\" signals=\"a b*\"/>\n"
              "<input name=\"u\" value=\"0.25\"/>\n<input name=\"on\" value=\"true\"/>\n"
              "<start time=\"1000\"/>\n"
              "<step size=\"10\" may-stop=\"false\"/>\n"
              "<input name=\"u\" value=\"1\"/>\n<step size=\"10\" may-stop=\"true\"/>\n"
              "<end/>\n",
          {}, [](Probe& probe) {
            CHECK(probe.instance_name() == "it");
            CHECK(probe.resources() == "/r");
            CHECK(probe.traced == "t.vcd: a b*");
            CHECK(probe.on_);
            CHECK(probe.has_finished);
            CHECK(probe.now() == Time(Duration(1020)));
          });
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.answers ==
        "<output name=\"y\" value=\"0.5\"/>\n<output name=\"count\" value=\"0\"/>\n<sync "
        "time=\"1000\"/>\n"
        "<output name=\"count\" value=\"1\"/>\n<sync time=\"1010\"/>\n"
        "<output name=\"y\" value=\"2\"/>\n<output name=\"count\" value=\"2\"/>\n<sync "
        "time=\"1020\"/>\n");
}

TEST_CASE("messages come in, go out, and stop a step") {
  const Outcome outcome =
      run(std::string(kOpen) +
              "<start time=\"0\"/>\n<message name=\"in\" time=\"0\" value=\"00ff\"/>\n"
              "<step size=\"0\" may-stop=\"false\"/>\n<step size=\"100\" may-stop=\"true\"/>\n",
          [](Probe& probe) {
            probe.next = Time(Duration(500));
            probe.on_step = [](Probe& p, Time to, bool may_stop) {
              if (!may_stop) return to;
              const Time at = p.now() + Duration(40);
              p.send("out", at, std::string("<&>"));
              p.log(stride::process::LogLevel::Warning, "hot");
              p.end_simulation();
              return at;
            };
          });
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.answers ==
        "<output name=\"y\" value=\"0\"/>\n<output name=\"count\" value=\"0\"/>\n<sync time=\"0\" "
        "next=\"500\"/>\n"
        "<message name=\"out\" time=\"0\" value=\"got 2\"/>\n<output name=\"count\" value=\"1\"/>\n"
        "<sync time=\"0\" next=\"500\"/>\n"
        "<message name=\"out\" time=\"40\" value=\"&lt;&amp;>\"/>\n<log level=\"warning\" "
        "text=\"hot\"/>\n"
        "<output name=\"count\" value=\"2\"/>\n<sync time=\"40\" next=\"500\" end=\"true\"/>\n");
}

TEST_CASE("an instant that is not a multiple of the unit of time makes that a picosecond") {
  const Outcome outcome = run(std::string(kOpen) +
                                  "<time-unit picoseconds=\"1000\"/>\n<start time=\"1\"/>\n<step "
                                  "size=\"2\" may-stop=\"true\"/>\n"
                                  "<step size=\"4\" may-stop=\"false\"/>\n",
                              [](Probe& probe) {
                                probe.on_step = [](Probe& p, Time to, bool may_stop) {
                                  if (may_stop) p.next = Time(Duration(5'500));
                                  return to;
                                };
                              });
  const std::string answers = outcome.answers;
  CHECK(answers.substr(answers.find("<sync")) ==
        "<sync time=\"1\"/>\n<output name=\"count\" value=\"1\"/>\n<time-unit picoseconds=\"1\"/>\n"
        "<sync time=\"3000\" next=\"5500\"/>\n<output name=\"count\" value=\"2\"/>\n"
        "<sync time=\"3004\" next=\"5500\"/>\n");
}

TEST_CASE("a failure is reported, and the exit code is 1") {
  const auto [commands, expected] = GENERATE(table<std::string, std::string>({
      {"<open protocol=\"2\" instance=\"\" resources=\"\"/>",
       "the program speaks protocol 1, not 2"},
      {"<run/>", "unknown command &lt;run>"},
      {"<time-unit picoseconds=\"0\"/>", "expected at least one picosecond"},
      {"<start time=\"-9999999999999999999999999999\"/>", "time: expected a time within 1e15 s"},
      {"step", "column 1: expected '&lt;'"},
      {"<input name=\"v\" value=\"1\"/>",
       "the program has no input 'v', which its declaration has"},
      {"<parameter name=\"u\" value=\"1\"/>", "the program has no parameter 'u'"},
      {"<message name=\"out\" time=\"0\" value=\"1\"/>", "the program has no message input 'out'"},
      {"<input name=\"u\" value=\"x\"/>", "'x' is not a valid Float64"},
      {"<start time=\"0\"/>\n<step size=\"5\" may-stop=\"false\"/>",
       "step() returned an instant at which it must not stop"},
      {"<start time=\"0\"/>\n<step size=\"6\" may-stop=\"true\"/>", "no more"},
  }));
  const Outcome outcome = run(commands + "\n", [](Probe& probe) {
    probe.on_step = [](Probe& p, Time, bool may_stop) {
      if (may_stop) throw std::runtime_error("no more");
      return p.now();
    };
  });
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.answers, Catch::Contains("<error text=\"") && Catch::Contains(expected));
}

TEST_CASE("lines of any length are read") {
  const std::string bytes(std::size_t{25'000}, 'a');
  const Outcome outcome =
      run(std::string(kOpen) + "<start time=\"0\"/>\n<message name=\"in\" time=\"0\" value=\"" +
          bytes + "\"/>\n<step size=\"0\" may-stop=\"false\"/>\n");
  CHECK_THAT(outcome.answers, Catch::Contains("got 12500"));
}
