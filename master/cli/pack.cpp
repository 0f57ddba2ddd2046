// stride pack: a library made with the unit kit becomes a .fmu.
#include "master/fmi/pack.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/cli/commands.h"

namespace stride::cli {

void add_pack(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "pack", "Make a .fmu from a library of the unit kit and a resources folder");
  const auto request = std::make_shared<fmi::PackRequest>();
  command->add_option("LIBRARY", request->library, "The unit's shared library (.so)")
      ->required()
      ->check(CLI::ExistingFile)
      ->type_name("");
  command->add_option("--output,-o", request->output, "The .fmu to write")
      ->required()
      ->type_name("FILE.fmu");
  command
      ->add_option("--resources", request->resources, "The unit's resources: an MJCF, a program, …")
      ->type_name("FOLDER");
  command
      ->add_option("--bundle", request->bundled,
                   "Shared library to put beside the unit's own; may be given several times")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->callback([request] { fmi::pack(*request); });
}

}  // namespace stride::cli
