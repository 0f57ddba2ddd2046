#include "master/report/run_file.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "master/recorders/results_folder.h"
#include "master/util/error.h"

namespace stride::report {
namespace {

/// The type with this name; an unknown one is text.
core::ValueType type_of(const std::string& text) {
  for (std::size_t i = 0; i < core::kValueTypeCount; ++i) {
    if (core::name(static_cast<core::ValueType>(i)) == text) return static_cast<core::ValueType>(i);
  }
  return core::ValueType::String;
}

const Json& entries(const Json& json, const char* name) {
  static const Json kNone = Json::array();
  const auto found = json.find(name);
  return found == json.end() ? kNone : *found;
}

void read_files(const Json& json, recorders::ResultFiles& files) {
  if (!json.contains("files")) return;
  for (const auto& [what, member] : recorders::kResultFiles) {
    const std::string name = json["files"].value(what, std::string());
    if (!recorders::is_plain_file_name(name)) {
      throw std::invalid_argument(fmt::format("'{}' is not a file of this folder", name));
    }
    files.*member = name;
  }
}

void read_entries(RunFile& run) {
  read_files(run.json, run.files);
  for (const Json& entry : entries(run.json, "signals")) {
    run.signals.push_back({entry.at("name"), entry.at("unit"), type_of(entry.at("type")),
                           entry.at("variability") == core::name(core::Variability::Continuous)});
  }
  for (const Json& entry : entries(run.json, "units")) {
    run.components.push_back({entry.at("name"), entry.at("model")});
  }
  for (const Json& entry : entries(run.json, "connections")) {
    run.connections.push_back({entry.at("from"), entry.at("to"), entry.value("kind", "value")});
  }
  for (const Json& entry : entries(run.json, "plots")) {
    run.plots.push_back({entry.at("title"), entry.at("signals")});
  }
}

/// What is nested any deeper was not written by stride, and would take its stack.
bool refuse_depth(int depth, Json::parse_event_t, Json&) {
  constexpr int kDeepest = 64;
  if (depth > kDeepest) throw std::length_error("it is nested too deeply");
  return true;
}

/// Thousands of signals take a few MiB.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;

std::string content(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    core::fail_input({.where = {file.string(), 0}},
                     "cannot read the file: it is not a regular file");
  }
  if (std::filesystem::file_size(file, error) > kMostBytes && !error) {
    core::fail_input({.where = {file.string(), 0}},
                     "this is not what `stride run` writes: it has more than 64 MiB");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream) core::fail_input({.where = {file.string(), 0}}, "cannot read the file");
  return text;
}

bool is_run_file(const std::filesystem::path& file) {
  try {
    return read_run_file(file).files.statistics == file.filename();
  } catch (const core::Error&) {
    return false;
  }
}

}  // namespace

RunFile read_run_file(const std::filesystem::path& file) {
  const std::string text = content(file);
  const char* const hint = "run the scenario again";
  try {
    RunFile run{Json::parse(text, refuse_depth)};
    if (!run.json.is_object()) {
      core::fail_input({.where = {file.string(), 0}}, "this is not a JSON object", hint);
    }
    read_entries(run);
    return run;
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    core::fail_input({.where = {file.string(), static_cast<int>(line)}},
                     fmt::format("this is not JSON: {}", error.what()), hint);
  } catch (const std::logic_error& error) {
    core::fail_input({.where = {file.string(), 0}},
                     fmt::format("this is not what `stride run` writes: {}", error.what()), hint);
  } catch (const Json::exception& error) {
    core::fail_input({.where = {file.string(), 0}},
                     fmt::format("this is not what `stride run` writes: {}", error.what()), hint);
  }
}

std::filesystem::path find_run_file(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path usual = folder / recorders::ResultFiles().statistics;
  if (std::filesystem::exists(usual, error)) return usual;
  for (const std::filesystem::path& other : recorders::folder_entries(folder)) {
    if (other.extension() == ".json" && is_run_file(other)) return other;
  }
  return {};
}

}  // namespace stride::report
