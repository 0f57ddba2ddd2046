#include "master/study/compare/inputs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/study/compare/json_entries.h"

namespace stride::compare {
namespace {

using report::Json;

/// Options that say where results go and what is printed.
constexpr std::array<std::string_view, 5> kOutputOptions = {"--out", "--output", "-o", "--junit",
                                                            "--progress"};
constexpr std::array<std::string_view, 7> kOutputFlags = {
    "-q", "--quiet", "--open", "--live", "--verbose", "--no-report", "--no-trace"};

/// Each name with its values, in the order of the file.
using Named = std::map<std::string, std::vector<std::string>>;

bool is_one_of(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// The words of one command line: options with their values, without the scenario, which is among
/// the sources.
void add_options(const std::vector<std::string>& words, Named& options) {
  const auto is_option = [](const std::string& word) {
    return word.size() > 1 && word[0] == '-' && (word[1] < '0' || word[1] > '9');
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!is_option(words[i])) continue;
    const bool has_equals = words[i].starts_with("--") && words[i].find('=') != std::string::npos;
    const std::string name = words[i].substr(0, has_equals ? words[i].find('=') : words[i].size());
    if (is_one_of(kOutputFlags, name)) continue;
    std::string value;
    if (has_equals) {
      value = words[i].substr(words[i].find('=') + 1);
    } else if (i + 1 < words.size() && !is_option(words[i + 1])) {
      value = words[++i];
    }
    if (is_one_of(kOutputOptions, name)) continue;
    options[name].push_back(value.empty() ? "given" : std::move(value));
  }
}

Named options_of(const RunRecord& run) {
  Named options;
  for (const Json* command :
       json_entries(json_member(run.json, "provenance"), "commands", run.file)) {
    std::vector<std::string> words;
    const Json& list = json_member(*command, "words");
    for (std::size_t i = 1; list.is_array() && i < list.size(); ++i) {
      if (list[i].is_string()) words.push_back(list[i].get<std::string>());
    }
    // the first one is the scenario, or the results that a run goes on from
    if (!words.empty() && !words[0].starts_with("-")) words.erase(words.begin());
    add_options(words, options);
  }
  return options;
}

Named sources_of(const RunRecord& run) {
  Named sources;
  for (const Json* source :
       json_entries(json_member(run.json, "provenance"), "sources", run.file)) {
    const std::filesystem::path path = json_word(*source, "path");
    sources[path.filename().string()].push_back(json_word(*source, "sha256"));
  }
  return sources;
}

Named units_of(const RunRecord& run) {
  Named units;
  for (const Json* unit : json_entries(run.json, "units", run.file)) {
    units[json_word(*unit, "name")].push_back(
        fmt::format("{}, FMI {}", json_word(*unit, "model"), json_word(*unit, "fmi_version")));
  }
  return units;
}

Named connections_of(const RunRecord& run) {
  Named connections;
  for (const Json* connection : json_entries(run.json, "connections", run.file)) {
    connections[json_word(*connection, "to")].push_back("from " + json_word(*connection, "from"));
  }
  return connections;
}

Named interventions_of(const RunRecord& run) {
  Named interventions;
  for (const Json* entry : json_entries(run.json, "interventions", run.file)) {
    std::string text = json_word(*entry, "kind");
    for (const auto& [name, value] : entry->items()) {
      if (name == "kind" || name == "variable") continue;
      text += fmt::format(" {} {}", name, json_word(*entry, name.c_str()));
    }
    interventions[json_word(*entry, "variable")].push_back(std::move(text));
  }
  return interventions;
}

Named settings_of(const RunRecord& run) {
  Named settings;
  const auto add = [&](const std::string& name, std::string value) {
    if (!value.empty()) settings[name].push_back(std::move(value));
  };
  for (const char* name : {"system", "start", "stop"}) add(name, json_word(run.json, name));
  const Json& step = json_member(run.json, "step");
  if (!step.is_object()) return settings;
  for (const auto& [name, value] : step.items()) {
    if (!value.is_object()) add("step." + name, json_word(step, name.c_str()));
  }
  const Json& components = json_member(step, "components");
  if (!components.is_object()) return settings;
  for (const auto& [name, value] : components.items()) {
    add("step of " + name, json_word(components, name.c_str()));
  }
  return settings;
}

Named version_of(const RunRecord& run) {
  return {{"stride", {json_word(json_member(run.json, "provenance"), "version")}}};
}

std::string joined(std::vector<std::string> values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return text;
}

/// Of values of one name those that only one run has.
void add_differences(const char* kind, const Named& a, const Named& b,
                     std::vector<InputDifference>& differences) {
  Named names = a;
  names.insert(b.begin(), b.end());
  for (const auto& [name, values] : names) {
    const auto mine = a.find(name);
    const auto other = b.find(name);
    std::vector<std::string> only_a = mine == a.end() ? std::vector<std::string>() : mine->second;
    std::vector<std::string> only_b;
    if (other != b.end()) {
      for (const std::string& value : other->second) {
        const auto same = std::ranges::find(only_a, value);
        if (same == only_a.end()) {
          only_b.push_back(value);
        } else {
          only_a.erase(same);
        }
      }
    }
    if (only_a.empty() && only_b.empty()) continue;
    differences.push_back({kind, name, joined(std::move(only_a)), joined(std::move(only_b))});
  }
}

}  // namespace

std::vector<InputDifference> compare_inputs(const RunRecord& a, const RunRecord& b) {
  std::vector<InputDifference> differences;
  const auto compare = [&](const char* kind, Named (*read)(const RunRecord&)) {
    add_differences(kind, read(a), read(b), differences);
  };
  compare("source", &sources_of);
  compare("option", &options_of);
  compare("setting", &settings_of);
  compare("intervention", &interventions_of);
  compare("unit", &units_of);
  compare("connection", &connections_of);
  compare("version", &version_of);
  return differences;
}

}  // namespace stride::compare
