#include "master/front/cli/campaign/cluster/called_program.h"

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/files/input_file.h"

namespace stride::cli {
namespace {

[[noreturn]] void fail_call(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Those of a child, from the numbers that they have here.
class StreamActions {
 public:
  StreamActions(int out, int errors) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
  }
  ~StreamActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  StreamActions(const StreamActions&) = delete;
  StreamActions& operator=(const StreamActions&) = delete;

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// From its beginning, whoever has written it.
std::string text_of(const core::Descriptor& file) {
  std::string text(static_cast<std::size_t>(::lseek(file.number(), 0, SEEK_END)), '\0');
  ::lseek(file.number(), 0, SEEK_SET);
  text.resize(core::read_from(file, text.data(), text.size()));
  return text;
}

}  // namespace

CalledProgram::CalledProgram(std::vector<std::string> words)
    : errors_file_(::memfd_create("errors", MFD_CLOEXEC)) {
  std::array<int, 2> ends{};
  if (!errors_file_.is_open() || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
    fail_call(errno, words.front().c_str());
  }
  out_ = core::Descriptor(ends[0]);
  const core::Descriptor written(ends[1]);
  const StreamActions actions(written.number(), errors_file_.number());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error =
      ::posix_spawnp(&process_, arguments[0], actions.get(), nullptr, arguments.data(), ::environ);
  if (error != 0) fail_call(error, words.front().c_str());
}

CalledProgram::~CalledProgram() { wait(); }

std::optional<std::string> CalledProgram::read_line() {
  std::size_t end = 0;
  while ((end = read_.find('\n')) == std::string::npos) {
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(out_.number(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    read_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  if (read_.empty()) return std::nullopt;
  std::string line = read_.substr(0, end);
  read_.erase(0, end == std::string::npos ? end : end + 1);
  return line;
}

int CalledProgram::wait() {
  if (process_ < 0) return 0;
  while (read_line()) {
  }
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  errors_ = text_of(errors_file_);
  constexpr int kOfSignal = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kOfSignal + WTERMSIG(status);
}

ProgramOutput output_of(std::vector<std::string> words) {
  CalledProgram program(std::move(words));
  ProgramOutput output;
  while (auto line = program.read_line()) output.lines.push_back(std::move(*line));
  output.has_failed = program.wait() != 0;
  output.errors = program.errors();
  return output;
}

}  // namespace stride::cli
