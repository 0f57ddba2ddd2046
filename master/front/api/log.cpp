#include "master/front/api/log.h"

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace stride::api {
namespace {

/// One at a time, so that the function need not be safe against others.
class FunctionSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  FunctionSink(stride_log log, void* user) : log_(log), user_(user) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string text(message.payload.data(), message.payload.size());
    log_(user_, level_of(message.level), text.c_str());
  }
  void flush_() override {}

  static stride_level level_of(spdlog::level::level_enum level) {
    if (level >= spdlog::level::err) return STRIDE_ERROR;
    return level >= spdlog::level::warn ? STRIDE_WARNING : STRIDE_INFO;
  }

  stride_log log_;
  void* user_;
};

void set_sink(std::shared_ptr<spdlog::sinks::sink> sink) {
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("stride", std::move(sink)));
}

void set_stream() {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  sink->set_pattern("stride: %l: %v");
  set_sink(std::move(sink));
}

std::once_flag is_set;

}  // namespace

void set_log(stride_log log, void* user) {
  std::call_once(is_set, [] {});
  if (log == nullptr) return set_stream();
  set_sink(std::make_shared<FunctionSink>(log, user));
}

void set_default_log() { std::call_once(is_set, set_stream); }

}  // namespace stride::api
