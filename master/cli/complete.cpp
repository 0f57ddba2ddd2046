// stride complete: writes into a scenario what its author left out.
#include "master/io/complete.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/cli/commands.h"
#include "master/cli/loaded_scenario.h"
#include "master/io/output_file.h"

namespace stride::cli {
namespace {

struct Request {
  std::filesystem::path scenario;
  std::filesystem::path output;
};

/// All or nothing: a file that cannot be written whole leaves the old one as it is.
void replace_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    core::fail_input({.where = {path.string(), 0}}, "the folder of this file does not exist",
                     "make the folder, or choose another output file");
  }
  const std::filesystem::path fresh = path.string() + ".new";
  try {
    io::OutputFile file(fresh);
    file.write(text);
    file.close();
    std::filesystem::rename(fresh, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(fresh, ignored);
    throw;
  }
}

void complete(const Request& request) {
  const io::Scenario scenario = io::read_scenario(request.scenario);
  io::Descriptions descriptions;
  const auto fmus = load_fmus(scenario);
  for (std::size_t i = 0; i < fmus.size(); ++i) {
    descriptions[scenario.system.components[i].name] = fmus[i]->description();
  }
  const std::string text = io::complete(request.scenario, descriptions);
  replace_file(request.output.empty() ? request.scenario : request.output, text);
}

}  // namespace

void add_complete(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "complete",
      "Write the connectors that a scenario leaves out into it, as other SSP tools want them");
  const auto request = std::make_shared<Request>();
  command->add_option("FILE", request->scenario, "The scenario, an SSP system file (.ssd)")
      ->required()
      ->type_name("");
  command->add_option("--output,-o", request->output, "Write there instead of into FILE itself")
      ->type_name("FILE");
  command->callback([request] { complete(*request); });
}

}  // namespace stride::cli
