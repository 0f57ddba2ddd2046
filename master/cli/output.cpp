#include "master/cli/output.h"

#include <memory>
#include <string>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "master/util/message_text.h"
#include "master/util/readable_text.h"

namespace stride::cli {
namespace {

std::FILE* const own_output = stdout;
std::FILE* const own_errors = stderr;
char output_buffer[BUFSIZ];

void give_buffer() {
  const int mode = ::isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF;
  std::setvbuf(stdout, output_buffer, mode, sizeof output_buffer);
}

/// The text of a message.
class SafeText final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& line) override {
    const std::string text =
        core::terminal_text(core::log_text({message.payload.data(), message.payload.size()}));
    line.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<SafeText>();
  }
};

}  // namespace

void put(std::FILE* stream, std::string_view text) {
  const std::string safe = core::terminal_text(text);
  std::fwrite(safe.data(), 1, safe.size(), stream);
}

void print_error(std::string_view text) {
  put(stderr, fmt::format("stride: error: {}\n", core::message_text(text)));
}

void set_up_output() {
  give_buffer();
  auto log = spdlog::stderr_color_mt("stride");
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<SafeText>('*').set_pattern("%^%l%$: %*");
  log->set_formatter(std::move(formatter));
  log->set_level(spdlog::level::warn);
  spdlog::set_default_logger(log);
}

void restore_streams() {
  stdout = own_output;
  stderr = own_errors;
  std::setvbuf(stderr, nullptr, _IONBF, 0);
  if (stdout->_IO_buf_base == output_buffer) return;
  std::fflush(stdout);
  give_buffer();
}

}  // namespace stride::cli
