// A program that runs beside this one, with pipes to its standard input, output and error.
#ifndef STRIDE_UNITS_PROCESS_CHILD_H
#define STRIDE_UNITS_PROCESS_CHILD_H

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace process {

/// A file descriptor that is closed with the object.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept;
  /// Closes its own file first.
  Descriptor& operator=(Descriptor&& other) noexcept;

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close();

 private:
  int number_ = -1;
};

/// It leads a process group of its own, so that a terminal's Ctrl-C reaches it through its unit
/// only; what is left of the group when it ends is killed. It is killed itself when the thread that
/// has started it ends, however that happens.
class Child {
 public:
  /// Starts the program with its arguments; `command.front()` is a path, or a name that is looked
  /// for in PATH. `variables` ("NAME=value") replace those of its environment. Throws
  /// std::runtime_error with the reason if it cannot be started.
  explicit Child(const std::vector<std::string>& command,
                 const std::vector<std::string>& variables = {});
  /// Kills it, unless it has ended.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// To its standard input, from its output and its error; they do not block.
  Descriptor& input() { return input_; }
  Descriptor& output() { return output_; }
  Descriptor& error() { return error_; }

  /// Waits for its end; returns whether it has come.
  bool wait(std::chrono::milliseconds limit);
  void kill();
  /// Once it has ended: "ended with the exit code 3", "was killed by signal 11 (SIGSEGV)".
  std::string ending() const;
  bool has_succeeded() const { return has_ended_ && status_ == 0; }

 private:
  bool reap(bool blocks);

  Descriptor input_;
  Descriptor output_;
  Descriptor error_;
  pid_t id_ = -1;
  bool has_ended_ = false;
  int status_ = 0;  ///< as waitpid() gives it; -1 if it was fetched elsewhere in this process
};

}  // namespace process

#endif
