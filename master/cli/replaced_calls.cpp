#include "master/cli/replaced_calls.h"

#include <atomic>
#include <cstdarg>
#include <cstdlib>

#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace stride::cli {
namespace {

using Words = char* const*;

std::atomic<void (*)(const char*)> report{nullptr};

template <class Function>
Function* original(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// Looked up before main(): a fork of a process with threads can look up nothing.
struct Originals {
  decltype(&::syscall) syscall = original(::syscall, "syscall");
  decltype(&::daemon) daemon = original(::daemon, "daemon");
  decltype(&::execve) execve = original(::execve, "execve");
  decltype(&::execv) execv = original(::execv, "execv");
  decltype(&::execvp) execvp = original(::execvp, "execvp");
  decltype(&::execvpe) execvpe = original(::execvpe, "execvpe");
  decltype(&::fexecve) fexecve = original(::fexecve, "fexecve");
  decltype(&::execveat) execveat = original(::execveat, "execveat");
};

const Originals& originals() {
  static const Originals all;
  return all;
}
[[maybe_unused]] const Originals& looked_up = originals();

/// The words of a call such as execl(), which end with a null pointer. Allocates nothing: the
/// caller may share its memory with another process (vfork()).
class WordList {
 public:
  WordList(const char* first, va_list& others) {
    const char* word = first;
    while (word != nullptr && count_ < kMost) {
      words_[count_++] = const_cast<char*>(word);
      word = va_arg(others, const char*);
    }
    words_[count_] = nullptr;
  }
  Words words() const { return words_; }

 private:
  static constexpr int kMost = 4095;

  int count_ = 0;
  char* words_[kMost + 1];
};

void report_end(const char* function) {
  if (const auto present = report.load()) present(function);
}

/// The name of the call that ends or replaces the process; null for others.
const char* name_of_end(long number) {
  switch (number) {
    case SYS_exit_group:
      return "exit";
    case SYS_exit:
      return ::gettid() == ::getpid() ? "exit" : nullptr;
    case SYS_execve:
      return "execve";
    case SYS_execveat:
      return "execveat";
    default:
      return nullptr;
  }
}

}  // namespace

void watch_ends(void (*function)(const char*)) { report = function; }

long system_call(long number, long argument) { return originals().syscall(number, argument); }

}  // namespace stride::cli

// Exported, so that a unit which calls them reaches these.

using stride::cli::originals;
using stride::cli::report_end;

extern "C" {

void _exit(int code) {
  report_end("exit");
  for (;;) stride::cli::system_call(SYS_exit_group, code);
}
void _Exit(int code) noexcept { ::_exit(code); }

int daemon(int keeps_folder, int keeps_files) noexcept {
  report_end("daemon");
  return originals().daemon(keeps_folder, keeps_files);
}

int execve(const char* path, char* const words[], char* const variables[]) noexcept {
  report_end("execve");
  return originals().execve(path, words, variables);
}
int execv(const char* path, char* const words[]) noexcept {
  report_end("execv");
  return originals().execv(path, words);
}
int execvp(const char* file, char* const words[]) noexcept {
  report_end("execvp");
  return originals().execvp(file, words);
}
int execvpe(const char* file, char* const words[], char* const variables[]) noexcept {
  report_end("execvpe");
  return originals().execvpe(file, words, variables);
}
int fexecve(int file, char* const words[], char* const variables[]) noexcept {
  report_end("fexecve");
  return originals().fexecve(file, words, variables);
}
int execveat(int folder, const char* path, char* const words[], char* const variables[],
             int flags) noexcept {
  report_end("execveat");
  return originals().execveat(folder, path, words, variables, flags);
}

int execl(const char* path, const char* word, ...) noexcept {
  report_end("execl");
  va_list others;
  va_start(others, word);
  const stride::cli::WordList list(word, others);
  va_end(others);
  return originals().execv(path, list.words());
}
int execlp(const char* file, const char* word, ...) noexcept {
  report_end("execlp");
  va_list others;
  va_start(others, word);
  const stride::cli::WordList list(word, others);
  va_end(others);
  return originals().execvp(file, list.words());
}
int execle(const char* path, const char* word, ...) noexcept {
  report_end("execle");
  va_list others;
  va_start(others, word);
  const stride::cli::WordList list(word, others);
  char* const* const variables = va_arg(others, char* const*);
  va_end(others);
  return originals().execve(path, list.words(), variables);
}

long syscall(long number, ...) noexcept {
  if (const char* const name = stride::cli::name_of_end(number)) report_end(name);
  long arguments[6];
  va_list others;
  va_start(others, number);
  for (long& argument : arguments) argument = va_arg(others, long);
  va_end(others);
  return originals().syscall(number, arguments[0], arguments[1], arguments[2], arguments[3],
                             arguments[4], arguments[5]);
}
}
