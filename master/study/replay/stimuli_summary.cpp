#include "master/study/replay/stimuli_summary.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "master/base/files/csv_reader.h"
#include "master/base/files/input_file.h"

namespace stride::replay {
namespace {

/// Whether the input is a clock, or belongs to one.
bool is_message(const std::vector<core::CsvReader::Field>& fields) {
  constexpr std::size_t kType = 2, kClock = 5;
  return fields.size() > kClock && (fields[kType].text == "Clock" || !fields[kClock].text.empty());
}

/// Adds the names of messages.
void read_head(core::CsvReader& reader, StimuliSummary& summary, std::set<std::string>& messages) {
  while (reader.next()) {
    const auto& fields = reader.fields();
    if (fields.size() < 2) reader.fail("this is no line of captured stimuli");
    const std::string_view key = fields[0].text;
    if (key == "time") return;
    const std::string value = fields[1].value();
    if (key == "component") summary.component = value;
    if (key == "input") summary.inputs.push_back(value);
    if (key == "input" && is_message(fields)) messages.insert(value);
    if (key == "skip") summary.max_skip = value;
  }
}

bool is_number(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0;
}

}  // namespace

StimuliSummary summarise_stimuli(const std::filesystem::path& file) {
  StimuliSummary summary;
  core::CsvReader reader(file);
  std::set<std::string> played;
  read_head(reader, summary, played);
  bool has_step = false, has_end = false;
  while (reader.next()) {
    const auto& fields = reader.fields();
    if (fields.size() < 3) reader.fail("this is no row of captured stimuli");
    const std::string time = fields[0].value();
    const std::string_view event = fields[1].text;
    if (summary.start.empty()) summary.start = time;
    summary.end = time;
    summary.instants.insert(time);
    if (!fields[2].text.empty()) played.insert(fields[2].value());
    if (is_number(event)) summary.event_instants.insert(time);
    has_step = has_step || event == "step";
    has_end = event == "end";
  }
  if (!has_step || !has_end || summary.start == summary.end) {
    reader.fail(has_end ? "it has no step, so there is nothing to play"
                        : "it has no end mark, so it is not whole");
  }
  std::erase_if(summary.inputs, [&](const std::string& input) { return !played.contains(input); });
  return summary;
}

/// Those of inputs come from the player, which sets them otherwise.
std::string repeated_part(const std::filesystem::path& file) {
  std::set<std::string> inputs, settings;
  core::CsvReader reader(file);
  while (reader.next() && reader.fields().front().text != "time") {
    const auto& fields = reader.fields();
    const std::string_view key = fields[0].text;
    if (fields.size() < 2) continue;
    if (key == "input") inputs.insert(fields[1].value());
    const bool is_setting = key == "set" || key == "skip" || key == "tolerance";
    if (!is_setting || inputs.contains(fields[1].value())) continue;
    std::string line;
    for (const auto& field : fields) line += (line.empty() ? "" : ",") + field.value();
    settings.insert(std::move(line));
  }
  std::string part;
  for (const std::string& setting : settings) part += setting + "\n";
  const std::string text = core::read_input(file);
  const std::size_t rows = std::min(text.find("\ntime,"), text.size());
  return part + text.substr(rows, text.rfind(",end,,") - rows);
}

}  // namespace stride::replay
