// run.json, read back.
#ifndef STRIDE_MASTER_REPORT_RUN_FILE_H
#define STRIDE_MASTER_REPORT_RUN_FILE_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/observe/recorders/results_folder.h"
#include "master/report/column.h"
#include "master/report/page_data.h"

namespace stride::report {

struct RunFile {
  struct Component {
    std::string name;
    std::string model;
  };
  struct Connection {
    std::string from;
    std::string to;
    std::string kind;  ///< "value", "message" or "clock"
  };

  Json json;  ///< all of it; null where there is none
  recorders::ResultFiles files{};
  std::vector<SignalInfo> signals{};
  std::vector<Component> components{};
  std::vector<Connection> connections{};
  std::vector<recorders::Plot> plots{};
};

/// What there is of it: an older program wrote less. Throws core::Error (Input) that names the
/// file, the line for what is no JSON, and the member that is missing or has another type.
RunFile read_run_file(const std::filesystem::path& file);

/// That of a results folder: run.json, or the file that contains it under another name.
/// An empty path where there is none.
std::filesystem::path find_run_file(const std::filesystem::path& folder);

}  // namespace stride::report

#endif
