#include "master/replay/stimuli_summary.h"

#include <algorithm>
#include <cctype>

#include "master/util/csv_reader.h"
#include "master/util/input_file.h"

namespace stride::replay {
namespace {

void read_head(core::CsvReader& reader, StimuliSummary& summary) {
  while (reader.next()) {
    const auto& fields = reader.fields();
    if (fields.size() < 2) reader.fail("this is no line of captured stimuli");
    const std::string_view key = fields[0].text;
    if (key == "time") return;
    const std::string value = fields[1].value();
    if (key == "component") summary.component = value;
    if (key == "input") summary.inputs.push_back(value);
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
  read_head(reader, summary);
  bool has_step = false, has_end = false;
  while (reader.next()) {
    const auto& fields = reader.fields();
    if (fields.size() < 2) reader.fail("this is no row of captured stimuli");
    const std::string time = fields[0].value();
    const std::string_view event = fields[1].text;
    if (summary.start.empty()) summary.start = time;
    summary.end = time;
    summary.instants.insert(time);
    if (is_number(event)) summary.event_instants.insert(time);
    has_step = has_step || event == "step";
    has_end = event == "end";
  }
  if (!has_step || !has_end || summary.start == summary.end) {
    reader.fail(has_end ? "it has no step, so there is nothing to play"
                        : "it has no end mark, so it is not whole");
  }
  return summary;
}

std::string repeated_part(const std::filesystem::path& file) {
  const std::string text = core::read_input(file);
  constexpr std::string_view kSetting = "\nset,", kSkip = "\nskip,", kRows = "\ntime,";
  const std::size_t settings =
      std::min({text.find(kSetting), text.find(kSkip), text.find(kRows), text.size()});
  const std::size_t end = text.rfind(",end,,");
  return text.substr(settings, end == std::string::npos ? end : end - settings);
}

}  // namespace stride::replay
