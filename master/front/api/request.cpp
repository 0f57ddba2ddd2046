#include "master/front/api/request.h"

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/suggest.h"
#include "master/system/settings/scenario_options.h"

namespace stride::api {
namespace {

/// Those with dashes, without them; the file is none.
std::vector<std::string> names(const CLI::App& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options.get_options()) {
    if (!option->get_lnames().empty()) names.push_back(option->get_lnames().front());
  }
  return names;
}

std::string word(const stride_setting& setting, std::span<const std::string> known) {
  if (setting.name == nullptr) core::fail_input({}, "a setting has no name");
  const std::string name = setting.name;
  if (std::ranges::find(known, name) == known.end()) {
    core::fail_input({}, fmt::format("there is no setting '{}'", name),
                     core::suggestion(name, known));
  }
  return setting.value == nullptr ? "--" + name : fmt::format("--{}={}", name, setting.value);
}

}  // namespace

Request read_request(const std::filesystem::path& scenario,
                     std::span<const stride_setting> settings) {
  Request request;
  CLI::App options("", "stride");
  options.set_help_flag();
  settings::add_scenario_options(options, request.scenario);
  settings::add_observation_options(options, request.scenario);
  settings::add_thread_option(options, request.threads);
  const std::vector<std::string> known = names(options);
  std::vector<std::string>& words = request.command.words;
  words = {"run", scenario.string()};
  for (const stride_setting& setting : settings) words.push_back(word(setting, known));
  request.command.folder = std::filesystem::current_path();
  std::vector<std::string> reversed(words.rbegin(), words.rend() - 1);  // as CLI11 takes them
  try {
    options.parse(std::move(reversed));
  } catch (const CLI::ParseError& mistake) {
    core::fail_input({}, mistake.what());
  }
  return request;
}

}  // namespace stride::api
