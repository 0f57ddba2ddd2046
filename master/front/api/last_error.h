// What stride_last_error() returns.
#ifndef STRIDE_MASTER_FRONT_API_LAST_ERROR_H
#define STRIDE_MASTER_FRONT_API_LAST_ERROR_H

#include <exception>
#include <string>

#include <stride/master.h>

namespace stride::api {

/// Of this thread. Returns its status.
stride_status note_error(const std::exception& error) noexcept;
stride_status note_misuse(const std::string& message) noexcept;
const stride_error* last_error() noexcept;

}  // namespace stride::api

#endif
