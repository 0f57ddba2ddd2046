#include "master/io/results_folder.h"

#include <cerrno>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "master/core/error.h"

namespace stride::io {

void make_results_folder(const std::filesystem::path& folder) {
  const auto fail = [&](const std::string& reason) {
    core::fail_input({.where = {folder.string(), 0}},
                     fmt::format("cannot write results into this folder: {}", reason),
                     "choose another results folder");
  };
  if (folder.empty()) fail("its name is empty");
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) {
    fail("it is a file");
  }
  std::filesystem::create_directories(folder, error);
  if (error) fail(error.message());
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail(std::generic_category().message(errno));
}

}  // namespace stride::io
