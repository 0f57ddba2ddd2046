// What the two ends of a link to another machine read.
#include <csignal>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "master/loader/network/codec.h"
#include "master/loader/network/description_files.h"
#include "master/loader/network/greeting.h"
#include "master/loader/network/place.h"
#include "master/loader/network/server/serve.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"

namespace stride::tests {
namespace {

using namespace remote;

template <class Root, class Fill>
std::string message_bytes(Fill&& fill) {
  std::string bytes;
  Scratch scratch;
  append_message<Root>(bytes, scratch, fill);
  return bytes;
}

// ---- The server ----

/// A whole session of a server that has no units.
void serve_bytes(const std::string& bytes) {
  const core::Descriptor in(::memfd_create("in", MFD_CLOEXEC));
  const core::Descriptor out(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  const std::string all = greeting_line(Side::Master, own_greeting()) + bytes;
  ensure(::write(in.number(), all.data(), all.size()) == static_cast<ssize_t>(all.size()),
         "the bytes are in the file");
  ::lseek(in.number(), 0, SEEK_SET);
  ServeOptions options;
  options.find = [](const std::string&) -> std::filesystem::path {
    core::fail_input({}, "there is no unit");
  };
  static const volatile std::sig_atomic_t kNotInterrupted = 0;
  refusing<core::Error>("", [&] { serve(in.number(), out.number(), options, kNotInterrupted); });
}

std::string request_bytes() {
  std::string bytes = message_bytes<wire::Request>([](wire::Request::Builder request) {
    request.setIsAwaited(true);
    request.setDescribe("sensor.fmu");
  });
  bytes += message_bytes<wire::Request>([](wire::Request::Builder request) {
    request.setIsAwaited(true);
    request.initInstantiate().setName("sensor");
  });
  return bytes + message_bytes<wire::Request>([](wire::Request::Builder request) {
           request.setIsAwaited(true);
           request.initStep().initInputs().initNumbers(16);
         });
}

// ---- The master ----

void take_error(wire::Error::Reader from) {
  try {
    throw_error(from, {.where = {"x.ssd", 3}, .unit = "sensor"}, "box");
  } catch (const core::Error&) {
  }
}

/// The parts of answers, as loader/network/remote_unit.cpp takes them.
void take_result_parts(wire::Result::Reader result) {
  switch (result.which()) {
    case wire::Result::VALUES: {
      core::ValueBlock numbers(core::ValueType::Float64, 3);
      return take_values(result.getValues(), numbers);
    }
    case wire::Result::STEP: {
      core::ValueBlock truth(core::ValueType::Boolean, 2), text(core::ValueType::String, 1);
      const std::vector<core::BoundValues> outputs{{{}, truth}, {{}, text}};
      const auto step = result.getStep();
      take_result(step, core::StepInterval(Time{}, Time(std::chrono::seconds(1))));
      return take_values(step.getOutputs(), outputs);
    }
    case wire::Result::INSTANCE: {
      core::HostStatistics host;
      take_capabilities(result.getInstance(), {});
      return take_protections(result.getInstance(), host);
    }
    case wire::Result::EVENTS:
      take_events(result.getEvents());
      return;
    case wire::Result::CLOCK:
      take_clock(result.getClock());
      return;
    case wire::Result::NUMBERS:
      take_doubles(result.getNumbers());
      return;
    case wire::Result::DESCRIPTION:
      for (const auto file : result.getDescription().getFiles()) to_string(file.getName());
      return;
    default:
      return;
  }
}

void read_replies(const std::string& bytes) {
  refusing<BadMessage>("", [&] {
    FrameReader reader;
    reader.put(bytes);
    while (const auto words = reader.next()) {
      with_checked_messages([&] {
        IncomingMessage message(*words);
        const auto reply = message.root<wire::Reply>();
        if (reply.isDone()) take_result_parts(reply.getDone());
        if (reply.isFailed()) take_error(reply.getFailed());
        if (reply.isLog()) to_string(reply.getLog().getText());
      });
    }
  });
}

std::string reply_bytes() {
  std::string bytes = message_bytes<wire::Reply>([](wire::Reply::Builder reply) {
    auto step = reply.initDone().initStep();
    step.setReached(5);
    step.initOutputs().initNumbers(2);
    step.getOutputs().initTexts(1);
  });
  bytes += message_bytes<wire::Reply>([](wire::Reply::Builder reply) {
    put_error(
        reply.initFailed(),
        core::Error(core::Error::Kind::Input, {.where = {"x.ssd", 12}, .unit = "u"}, "m", "h"), {});
  });
  return bytes + message_bytes<wire::Reply>([](wire::Reply::Builder reply) {
           put_clock(reply.initDone().initClock(),
                     {core::ClockInterval::State::Changed, core::Interval::from_fraction(1, 3)});
         });
}

// ---- Greetings and places ----

void read_greeting(const std::string& bytes) {
  refusing<BadGreeting>("", [&] {
    GreetingScanner scanner(Side::Server);
    for (const char byte : bytes) {
      if (scanner.take({&byte, 1})) return;
    }
  });
}

void read_place(const std::string& text) {
  refusing<std::invalid_argument>("", [&] {
    const Place place = parse_place(text);
    const bool is_ssh = place.command.front() == "ssh";
    ensure(!is_ssh || !place.command.at(place.command.size() - 2).starts_with("-"),
           "the machine is no option of ssh");
  });
}

const Registration kRemoteParsers(
    "remote",
    {
        {.name = "remote_requests", .read = serve_bytes, .make_seed = request_bytes},
        {.name = "remote_replies", .read = read_replies, .make_seed = reply_bytes},
        {.name = "greeting",
         .read = read_greeting,
         .make_seed = [] { return "Welcome\n" + greeting_line(Side::Server, own_greeting()); },
         .alphabet = "\x01STRIDE-V protocl,bu019.\n"},
        {.name = "place",
         .read = read_place,
         .make_seed = [] { return std::string("ssh://me@box:2222"); },
         .alphabet = "sh:/@[]-%.e12 x"},
    });

}  // namespace
}  // namespace stride::tests
