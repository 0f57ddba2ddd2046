// What a caller of the library asks for.
#ifndef STRIDE_MASTER_FRONT_API_REQUEST_H
#define STRIDE_MASTER_FRONT_API_REQUEST_H

#include <cstddef>
#include <filesystem>
#include <span>

#include <stride/master.h>

#include "master/observe/recorders/provenance.h"
#include "master/system/plan/request.h"

namespace stride::api {

struct Request {
  scenario::ScenarioRequest scenario;
  std::size_t threads = 1;
  recorders::Command command;  ///< of `stride run` that does the same
};

/// Takes the settings as the options of `stride run`. Throws core::Error (Input).
Request read_request(const std::filesystem::path& scenario,
                     std::span<const stride_setting> settings);

}  // namespace stride::api

#endif
