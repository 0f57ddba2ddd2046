#include "master/front/api/last_error.h"

#include <stdexcept>

#include "master/base/error.h"
#include "master/front/api/c_time.h"

namespace stride::api {
namespace {

/// The error with the texts that it points to.
struct Kept {
  std::string message, text, hint, file, component, variable;
  stride_error error{};
};

thread_local Kept kept;

stride_status keep(stride_status status, const std::string& message) {
  kept = {};
  kept.message = kept.text = message;
  kept.error.status = status;
  kept.error.time = kNoTime;
  return status;
}

/// At the texts.
void point() {
  stride_error& error = kept.error;
  error.message = kept.message.c_str();
  error.text = kept.text.c_str();
  error.hint = kept.hint.c_str();
  error.file = kept.file.c_str();
  error.component = kept.component.c_str();
  error.variable = kept.variable.c_str();
}

void add(const core::Error& error) {
  const core::Context& context = error.context();
  kept.text = error.message();
  kept.hint = error.hint();
  kept.file = context.where.file;
  kept.component = context.unit;
  kept.variable = context.variable;
  kept.error.line = context.where.line;
  if (context.time) kept.error.time = c_time(*context.time);
}

}  // namespace

stride_status note_error(const std::exception& error) noexcept {
  const auto* known = dynamic_cast<const core::Error*>(&error);
  const bool is_misuse = dynamic_cast<const std::logic_error*>(&error) != nullptr;
  const bool is_input = known != nullptr && known->kind() == core::Error::Kind::Input;
  keep(is_misuse  ? STRIDE_MISUSE
       : is_input ? STRIDE_INVALID_INPUT
                  : STRIDE_RUN_FAILED,
       error.what());
  if (known != nullptr) add(*known);
  return kept.error.status;
}

stride_status note_misuse(const std::string& message) noexcept {
  return keep(STRIDE_MISUSE, message);
}

const stride_error* last_error() noexcept {
  point();
  return &kept.error;
}

}  // namespace stride::api
