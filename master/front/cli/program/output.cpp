#include "master/front/cli/program/output.h"

#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <system_error>

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <stdio_ext.h>
#include <unistd.h>

#include "master/base/files/file_identity.h"
#include "master/base/message_text.h"
#include "master/base/process/loaded_object.h"
#include "master/base/text/readable_text.h"
#include "master/front/cli/program/memory_limits.h"

namespace stride::cli {
namespace {

std::FILE* const own_output = stdout;
std::FILE* const own_errors = stderr;
char output_buffer[BUFSIZ];
std::optional<core::FileIdentity> error_file;  ///< at the beginning

bool is_error_file_own() { return core::FileIdentity::of(STDERR_FILENO) == error_file; }

void give_buffer() {
  const int mode = ::isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF;
  std::setvbuf(stdout, output_buffer, mode, sizeof output_buffer);
}

/// A standard stream of C++, as it is at the beginning.
template <class Stream>
class OwnStream {
 public:
  explicit OwnStream(Stream& stream) : stream_(stream) {}

  /// A buffer of the C++ library may stay: std::ios::sync_with_stdio() puts another one there.
  void restore() const {
    stream_.exceptions(std::ios::goodbit);
    stream_.tie(tie_);
    if (core::loaded_object_at(stream_.rdbuf()) == core::loaded_object_at(buffer_)) {
      stream_.clear();
    } else {
      stream_.rdbuf(buffer_);
    }
  }

 private:
  Stream& stream_;
  decltype(stream_.rdbuf()) buffer_ = stream_.rdbuf();
  decltype(stream_.tie()) tie_ = stream_.tie();
};

const OwnStream own_cout(std::cout), own_cerr(std::cerr), own_clog(std::clog);
const OwnStream own_wcout(std::wcout), own_wcerr(std::wcerr), own_wclog(std::wclog);

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

bool is_lack_of_memory(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         (system != nullptr && system->code() == std::errc::not_enough_memory);
}

/// What a call of the system could not have; empty for other reasons.
const char* lacking_of(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system == nullptr) return "";
  if (system->code() == std::errc::resource_unavailable_try_again) {
    return "there can be no more processes or threads\n  hint: raise the limit of processes "
           "(ulimit -u), or run fewer at the same time";
  }
  if (system->code() == std::errc::too_many_files_open) {
    return "this process can have no more open files\n  hint: raise the limit of open files "
           "(ulimit -n)";
  }
  if (system->code() == std::errc::too_many_files_open_in_system) {
    return "the system can have no more open files\n  hint: end other programs";
  }
  return "";
}

}  // namespace

bool put(std::FILE* stream, std::string_view text) {
  const std::string safe = core::terminal_text(text);
  return std::fwrite(safe.data(), 1, safe.size(), stream) == safe.size();
}

bool print_error(std::string_view text) {
  const std::string line =
      core::terminal_text(fmt::format("{}{}\n", kErrorMark, core::message_text(text)));
  return is_error_file_own() &&
         ::write(STDERR_FILENO, line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

std::optional<std::string> last_error_in(const std::string& printed) {
  const std::size_t mark = printed.rfind(kErrorMark);
  if (mark == std::string::npos) return std::nullopt;
  std::string text = printed.substr(mark + kErrorMark.size());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (text.empty()) return std::nullopt;
  return text;
}

std::string in_words(const std::exception& error) {
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    const std::string path = file->path1().string();
    return fmt::format("{}: {}", path.empty() ? "the working folder" : path,
                       file->code().message());
  }
  if (is_lack_of_memory(error)) {
    return fmt::format("there is not enough memory\n  hint: {}", memory_hint());
  }
  const std::string lacking = lacking_of(error);
  return lacking.empty() ? error.what() : lacking;
}

void print_warnings(std::span<const std::string> warnings) {
  for (const std::string& warning : warnings) spdlog::warn("{}", core::message_text(warning));
}

void set_up_output() {
  error_file = core::FileIdentity::of(STDERR_FILENO);
  give_buffer();
  auto log = spdlog::stderr_color_mt("stride");
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<SafeText>('*').set_pattern("stride: %^%l%$: %*");
  log->set_formatter(std::move(formatter));
  log->set_level(spdlog::level::warn);
  spdlog::set_default_logger(log);
}

void restore_streams() {
  own_cout.restore(), own_cerr.restore(), own_clog.restore();
  own_wcout.restore(), own_wcerr.restore(), own_wclog.restore();
  stdout = own_output;
  stderr = own_errors;
  std::setvbuf(stderr, nullptr, _IONBF, 0);
  ::flockfile(stdout);  // to be had, as for what is still printed
  ::funlockfile(stdout);
  if (stdout->_IO_buf_base == output_buffer) return;
  std::fflush(stdout);
  give_buffer();
}

bool is_output_locked() {
  for (std::FILE* const stream : {own_output, own_errors}) {
    if (::ftrylockfile(stream) != 0) return true;
    ::funlockfile(stream);
  }
  return false;
}

void ignore_output_locks() {
  for (std::FILE* const stream : {own_output, own_errors}) {
    ::__fsetlocking(stream, FSETLOCKING_BYCALLER);
  }
}

}  // namespace stride::cli
