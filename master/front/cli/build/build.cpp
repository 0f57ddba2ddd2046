// stride build: a copy of an FMU with the library that its sources make.
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/archive/zip.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/output.h"
#include "master/loader/fmu/description/binaries.h"
#include "master/loader/fmu/description/build_description.h"
#include "master/loader/fmu/description/model_description.h"
#include "master/loader/fmu/library/exported_functions.h"
#include "master/loader/fmu/library/unpacked_fmu.h"
#include "master/loader/process/source_build/source_build.h"
#include "master/study/results/output_paths.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

struct BuildRequest {
  fs::path fmu;
  fs::path output;
  std::vector<std::string> definitions;
  std::vector<fs::path> includes;
};

void build(BuildRequest request) {
  const CrashGuard guard;
  request.fmu = scenario::find_unit(request.fmu, {});
  const results::OutputPath output{"--output " + request.output.string(), request.output};
  results::refuse_kept_paths({&output, 1},
                             std::vector<results::KeptPath>{{request.fmu, "the FMU itself"}});
  for (fs::path& folder : request.includes) folder = fs::absolute(folder);
  const importer::UnpackedFmu fmu(request.fmu);
  const auto unit = importer::read_model_description(fmu.description());
  const importer::BuildDescription description =
      importer::read_build_description(fmu.description(), unit);
  if (!fmu.warning().empty()) print_warnings({&fmu.warning(), 1});
  print_warnings(unit.warnings);
  print_warnings(description.warnings);
  const archive::TemporaryFolder folder;
  const std::string name = unit.model_identifier + ".so";
  isolation::build_library({.description = description,
                            .sources = fs::absolute(fmu.folder()) / "sources",
                            .definitions = request.definitions,
                            .includes = request.includes,
                            .folder = folder.path(),
                            .library = folder.path() / name});
  const std::string prefix = importer::check_exported_functions(folder.path() / name, unit);
  if (!prefix.empty()) print_warnings(std::vector{prefix});
  const std::string place =
      fmt::format("binaries/{}/{}", importer::platform_of(unit.fmi_version), name);
  archive::Contents contents;
  importer::add_fmu(contents, fmu);
  contents.erase(place);
  archive::add_file(contents, place, folder.path() / name, true);
  archive::write_zip(request.output, contents);
  print_text("{} has {}\n", request.output.string(), place);
}

}  // namespace

void add_build(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "build", "Compile the sources of an FMU, into a copy that has a library for this platform");
  const auto request = std::make_shared<BuildRequest>();
  command->add_option("FILE", request->fmu, "An FMU with sources: a .fmu, or its unpacked folder")
      ->required()
      ->type_name("");
  command->add_option("--output,--out,-o", request->output, "The .fmu to write")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--define,-D", request->definitions,
                   "A definition for the preprocessor, which its build description does not have; "
                   "may be given several times")
      ->type_name("NAME[=VALUE]")
      ->allow_extra_args(false);
  command
      ->add_option("--include,-I", request->includes,
                   "A folder with headers that are not in the FMU; may be given several times")
      ->type_name("FOLDER")
      ->allow_extra_args(false);
  command->footer(
      "The compilers are those that CC and CXX name, or cc and c++. They run in a sandbox, in "
      "which "
      "nothing is written but the library.\n");
  command->callback([request] { build(*request); });
}

}  // namespace stride::cli
