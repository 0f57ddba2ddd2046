#include "units/reader/expectation.h"

#include <algorithm>

#include <stride/nfc/names.h>

#include "units/xml/text.h"

namespace reader {
namespace {

bool is_within(const Expectation& expectation, double temperature) {
  return (!expectation.lowest || temperature >= *expectation.lowest) &&
         (!expectation.highest || temperature <= *expectation.highest);
}

std::string range_text(const Expectation& expectation) {
  if (expectation.lowest && expectation.highest) {
    return xml::shortest(*expectation.lowest) + " to " + xml::shortest(*expectation.highest) +
           " degC";
  }
  if (expectation.lowest) return xml::shortest(*expectation.lowest) + " degC or more";
  if (expectation.highest) return xml::shortest(*expectation.highest) + " degC or less";
  return "";
}

std::string count_text(std::uint32_t samples) {
  return std::to_string(samples) + (samples == 1 ? " sample" : " samples");
}

std::string log_text(const Answer& answer) {
  const std::string text = " " + count_text(answer.sample_count);
  if (answer.sample_count == 0) return text;
  const auto colder = [](const Sample& a, const Sample& b) {
    return a.temperature < b.temperature;
  };
  const auto [coldest, warmest] = std::minmax_element(
      answer.samples.begin(), answer.samples.begin() + answer.sample_count, colder);
  return text + " of " + xml::shortest(coldest->temperature) + " to " +
         xml::shortest(warmest->temperature) + " degC";
}

}  // namespace

bool is_met(const Expectation& expectation, nfc::Command command,
            const std::optional<Answer>& answer) {
  if (!answer) return !expectation.answer;
  if (!expectation.answer || answer->status != expectation.status) return false;
  if (answer->status != nfc::Status::Ok) return true;
  if (expectation.identifier && answer->identifier != *expectation.identifier) return false;
  if (command == nfc::Command::ReadTemperature) return is_within(expectation, answer->temperature);
  if (command != nfc::Command::ReadLog) return true;
  return answer->sample_count >= expectation.samples &&
         std::all_of(
             answer->samples.begin(), answer->samples.begin() + answer->sample_count,
             [&](const Sample& sample) { return is_within(expectation, sample.temperature); });
}

std::string text_of(const Expectation& expectation) {
  if (!expectation.answer) return "no answer";
  std::string text = name_of(expectation.status);
  if (expectation.identifier) text += " identifier " + nfc::hexadecimal(*expectation.identifier);
  if (expectation.samples > 0) text += " " + count_text(expectation.samples) + " or more";
  const std::string range = range_text(expectation);
  if (range.empty()) return text;
  return text + (expectation.samples > 0 ? " of " : " ") + range;
}

std::string text_of(nfc::Command command, const Answer& answer) {
  const std::string text = name_of(answer.status);
  if (answer.status != nfc::Status::Ok) return text;
  if (command == nfc::Command::Identify) {
    return text + " identifier " + nfc::hexadecimal(answer.identifier);
  }
  if (command == nfc::Command::ReadTemperature) {
    return text + " " + xml::shortest(answer.temperature) + " degC";
  }
  if (command == nfc::Command::ReadLog) return text + log_text(answer);
  return text;
}

}  // namespace reader
