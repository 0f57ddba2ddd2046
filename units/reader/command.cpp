#include "units/reader/command.h"

#include <vector>

#include <stride/nfc/commands.h>
#include <stride/nfc/names.h>
#include <stride/nfc/numbers.h>
#include <stride/value_text.h>

#include "units/xml/text.h"

namespace reader {

using xml::Element;

namespace {

constexpr double kDefaultTimeout = 0.05;  // [s]
constexpr double kDefaultPause = 0.01;    // [s]
constexpr double kLongestTime = 3600;     // of a time limit and a pause [s]
constexpr std::uint64_t kMostRetries = 1000;
constexpr std::size_t kMostBytes = 32;         // of a raw command
constexpr double kLeastTemperature = -327.68;  // what 16 bits of 1/100 degC hold
constexpr double kMostTemperature = 327.67;
constexpr const char* kRaw = "raw";

/// A command byte and its arguments.
struct Request {
  nfc::Command command;
  nfc::Bytes arguments;
};

const std::vector<std::string> kCommonAttributes = {"at",       "name",    "timeout",
                                                    "bit_rate", "retries", "pause"};

void allow_attributes(const Element& element, std::vector<std::string> further = {}) {
  further.insert(further.begin(), kCommonAttributes.begin(), kCommonAttributes.end());
  element.allow_only(further);
}

std::uint32_t identifier(const Element& element) {
  return static_cast<std::uint32_t>(element.whole_number("identifier", 0, 0xFFFFFFFF));
}

nfc::Bytes led(const Element& element) {
  const std::string led = element.text("led");
  if (led != "on" && led != "off") element.fail("led=\"" + led + "\": expected 'on' or 'off'");
  return {static_cast<std::uint8_t>(led == "on" ? 1 : 0)};
}

Request raw_request(const Element& element) {
  const std::string text = element.text("bytes");
  nfc::Bytes bytes;
  if (!stride::parse_hexadecimal(text, bytes) || bytes.empty() || bytes.size() > kMostBytes) {
    element.fail("bytes=\"" + text + "\": expected 1 to " + std::to_string(kMostBytes) +
                 " bytes of two hexadecimal digits each, such as \"7F01\"");
  }
  return {static_cast<nfc::Command>(bytes.front()), nfc::Bytes(bytes.begin() + 1, bytes.end())};
}

nfc::Command to_command(const Element& element) {
  const std::string name = element.text("name");
  std::vector<std::string> known;
  for (const nfc::CommandFormat& format : nfc::kCommands) {
    if (name == format.name) return format.command;
    known.push_back(format.name);
  }
  known.push_back(kRaw);
  element.fail("unknown command '" + name + "': expected one of " + xml::quoted_list(known));
}

Request request(const Element& element) {
  if (element.text("name") == kRaw) {
    allow_attributes(element, {"bytes"});
    return raw_request(element);
  }
  const nfc::Command command = to_command(element);
  switch (command) {
    case nfc::Command::SetLed:
      allow_attributes(element, {"led"});
      return {command, led(element)};
    case nfc::Command::Select:
      allow_attributes(element, {"identifier"});
      return {command, nfc::most_significant_first(identifier(element))};
    case nfc::Command::SetSamplingPeriod:
      allow_attributes(element, {"period"});
      return {command, nfc::most_significant_first(
                           static_cast<std::uint16_t>(element.whole_number("period", 0, 0xFFFF)))};
    default:
      allow_attributes(element);
      return {command, {}};
  }
}

stride::Duration timeout(const Element& element) {
  const double timeout = element.number("timeout", kDefaultTimeout);
  if (!(timeout > 0.0 && timeout <= kLongestTime)) {
    element.fail("timeout=\"" + element.text("timeout") +
                 "\": expected more than 0 seconds, and 3600 at most");
  }
  return stride::duration_from_seconds(timeout);
}

stride::Duration pause(const Element& element) {
  if (!element.has("pause")) return stride::duration_from_seconds(kDefaultPause);
  return stride::duration_from_seconds(element.number_within("pause", 0, kLongestTime));
}

std::uint32_t retries(const Element& element) {
  if (element.has("retries")) {
    return static_cast<std::uint32_t>(element.whole_number("retries", 0, kMostRetries));
  }
  if (element.has("pause"))
    element.fail("pause=\"" + element.text("pause") + "\": expected retries with it");
  return 0;
}

std::uint32_t bit_rate(const Element& element) {
  const double rate = element.number("bit_rate", 106);
  for (const std::uint32_t known : {106, 212, 424, 848}) {
    if (rate == known) return known;
  }
  element.fail("bit_rate=\"" + element.text("bit_rate") +
               "\": expected 106, 212, 424 or 848 kbit/s");
}

/// The attributes of an <expect> that are about the data.
std::vector<std::string> data_attributes(nfc::Command command) {
  switch (command) {
    case nfc::Command::Identify:
      return {"identifier"};
    case nfc::Command::ReadTemperature:
      return {"lowest", "highest"};
    case nfc::Command::ReadLog:
      return {"lowest", "highest", "samples"};
    default:
      return {};
  }
}

void read_status(const Element& element, Expectation& expectation) {
  const std::string name = element.has("status") ? element.text("status") : "ok";
  std::vector<std::string> known;
  for (const nfc::Status status : nfc::kStatuses) {
    if (name == name_of(status)) {
      expectation.status = status;
      return;
    }
    known.push_back(name_of(status));
  }
  known.push_back("none");
  if (name != "none") {
    element.fail("unknown status '" + name + "': expected one of " + xml::quoted_list(known));
  }
  expectation.answer = false;
}

void read_temperatures(const Element& element, Expectation& expectation) {
  const auto read = [&](const char* attribute) {
    return element.number_within(attribute, kLeastTemperature, kMostTemperature);
  };
  if (element.has("lowest")) expectation.lowest = read("lowest");
  if (element.has("highest")) expectation.highest = read("highest");
  if (expectation.lowest && expectation.highest && *expectation.lowest > *expectation.highest) {
    element.fail("expected lowest not to be more than highest");
  }
}

Expectation parse_expectation(const Element& element, nfc::Command command) {
  Expectation expectation;
  read_status(element, expectation);
  auto attributes = data_attributes(command);
  if (!expectation.answer || expectation.status != nfc::Status::Ok) attributes.clear();
  attributes.insert(attributes.begin(), "status");
  element.allow_only_leaf(attributes);
  if (element.has("identifier")) expectation.identifier = identifier(element);
  if (element.has("samples")) {
    expectation.samples =
        static_cast<std::uint32_t>(element.whole_number("samples", 0, nfc::kLogSamples));
  }
  read_temperatures(element, expectation);
  return expectation;
}

Expectation expectation(const Element& element, nfc::Command command) {
  Expectation expectation;
  bool is_given = false;
  for (const auto& child : element.children()) {
    if (child.name() != "expect") child.fail("unknown element: expected <expect>");
    if (is_given) child.fail("expected one <expect> at most");
    expectation = parse_expectation(child, command);
    is_given = true;
  }
  return expectation;
}

}  // namespace

ProgramCommand parse_command(const Element& element) {
  ProgramCommand command;
  command.at = element.time("at");
  Request content = request(element);
  command.command = content.command;
  command.arguments = std::move(content.arguments);
  command.timeout = timeout(element);
  command.bit_rate = bit_rate(element);
  command.retries = retries(element);
  command.pause = pause(element);
  command.expectation = expectation(element, command.command);
  return command;
}

}  // namespace reader
