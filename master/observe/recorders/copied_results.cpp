#include "master/observe/recorders/copied_results.h"

#include <string>
#include <system_error>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/observe/recorders/unit_folders.h"

namespace stride::recorders {

void copy_records(const std::filesystem::path& from, const std::filesystem::path& to,
                  const ResultFiles& files) {
  for (const std::string* const name :
       {&files.signals, &files.events, &files.trace, &files.activity}) {
    if (!name->empty() && core::is_file(from / *name)) core::copy_input(from / *name, to / *name);
  }
}

void copy_unit_files(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (!core::is_folder(from / kUnitsFolder)) return;
  std::error_code error;
  std::filesystem::copy(from / kUnitsFolder, to / kUnitsFolder,
                        std::filesystem::copy_options::recursive |
                            std::filesystem::copy_options::skip_symlinks |
                            std::filesystem::copy_options::overwrite_existing,
                        error);
  if (!error) return;
  const core::Context where{.where = {(to / kUnitsFolder).string(), 0}};
  const std::string message =
      fmt::format("cannot copy the files of units to here: {}", error.message());
  if (core::is_shortage(error.value())) throw core::EnvironmentError(where, message);
  core::fail_run(where, message);
}

}  // namespace stride::recorders
