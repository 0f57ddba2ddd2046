// A program that is a unit: derive from Program, list your variables, write step(), and call run()
// in main() or sc_main().
//
//   class Integrator : public stride::process::Program {
//    public:
//     Integrator() {
//       input("rate", rate_);
//       output("sum", sum_);
//     }
//
//    private:
//     stride::Time step(stride::Time to, bool /*may_stop*/) override {
//       sum_ += rate_ * stride::to_seconds(to - now());
//       return to;
//     }
//     double rate_ = 0, sum_ = 0;
//   };
//   int main() { return Integrator().run(); }
//
// What is to be declared of it, and how it is packed: docs/process-protocol.md.
#ifndef STRIDE_PROCESS_PROGRAM_H
#define STRIDE_PROCESS_PROGRAM_H

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include <stride/process/tag.h>
#include <stride/process/value.h>
#include <stride/time.h>

namespace stride::process {

enum class LogLevel { Info, Warning };

/// The program's side of the protocol: executes the commands on its standard input. Its virtual
/// functions are called in the order start, then steps, finish; parameters are in their members
/// before start(), inputs and messages before the step that they are for. An exception that leaves
/// one of them ends the program, and its text is what the run fails with.
class Program {
 public:
  /// From here on the standard output is the protocol's: what the program prints goes to its
  /// standard error, which is stride's log.
  Program() : in_(STDIN_FILENO), out_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  /// On other descriptors, which stay the caller's.
  Program(int in, int out) : in_(in), out_(out) {}
  virtual ~Program() = default;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Runs until <end/> or the end of its standard input. Returns the exit code of the program.
  int run() noexcept;

 protected:
  /// Bind a member, or anything that lives as long, to a declared variable. T: double, float, any
  /// integer type, bool, std::string, stride::process::Binary, std::array of a number or bool.
  template <class T>
  void parameter(std::string name, T& member) {
    add_input(parameters_, std::move(name), member);
  }
  template <class T>
  void input(std::string name, T& member) {
    add_input(inputs_, std::move(name), member);
  }
  /// Read when start() or step() has returned.
  template <class T>
  void output(std::string name, T& member) {
    outputs_.push_back(std::make_unique<OutputRow<T>>(std::move(name), member));
  }
  /// Messages of a declared message-input: `receive` is called at now(), in the order in which they
  /// arrive; a step of size 0 follows.
  template <class T>
  void message_input(std::string name, std::function<void(const T&)> receive) {
    messages_[std::move(name)] = [receive = std::move(receive)](const Tag& tag) {
      receive(tag.value<T>("value"));
    };
  }

  /// Sends a message on a declared message-output. To be called within start(), step() or a
  /// receiver, in the order of time; `at` is the instant at which it was produced, from now() to
  /// where the step will end. A step that may stop should stop there: only then it is an event at
  /// that instant.
  template <class T>
  void send(std::string_view name, Time at, const T& value) {
    const std::int64_t time = count(at);
    TagWriter(answer_, "message")
        .value("name", name)
        .value("time", time)
        .value("value", value)
        .end();
  }
  /// A line of stride's log.
  void log(LogLevel level, std::string_view text) {
    const bool is_warning = level == LogLevel::Warning;
    TagWriter(answer_, "log")
        .value("level", is_warning ? "warning" : "info")
        .value("text", text)
        .end();
  }
  /// Stride is to end the simulation where this step ends.
  void end_simulation() { wants_end_ = true; }

  /// The present instant: the start, or where the last step ended.
  Time now() const { return now_; }
  const std::string& instance_name() const { return instance_name_; }
  /// The folder with the files that were packed with the program.
  const std::string& resources() const { return resources_; }

  /// Computes the initial values of the outputs.
  virtual void start() {}
  /// Advances from now() to `to`, which may be now() itself: what happens at this very instant,
  /// with the inputs as they are. Returns `to`, or an earlier instant at which it stopped if it
  /// may.
  virtual Time step(Time to, bool may_stop) = 0;
  /// Asked where a step ends: when something happens next, later than now(), if that is known;
  /// there will be a communication point there.
  virtual std::optional<Time> next_event() { return std::nullopt; }
  /// Called before start() where a trace is wanted: signals are patterns, separated by spaces.
  virtual void trace(const std::string& /*file*/, const std::string& /*signals*/) {}
  /// The run has ended well; the program ends after it.
  virtual void finish() {}

 private:
  using Reader = std::function<void(const Tag&)>;
  using Readers = std::map<std::string, Reader, std::less<>>;

  class Row {
   public:
    virtual ~Row() = default;
    virtual void tell(std::string& answer, bool always) = 0;
  };
  template <class T>
  class OutputRow final : public Row {
   public:
    OutputRow(std::string name, const T& member) : name_(std::move(name)), member_(member) {}
    void tell(std::string& answer, bool always) override {
      if (!always && is_same(member_, told_)) return;
      told_ = member_;
      TagWriter(answer, "output").value("name", name_).value("value", member_).end();
    }

   private:
    std::string name_;
    const T& member_;
    T told_{};
  };

  template <class T>
  static void add_input(Readers& readers, std::string name, T& member) {
    readers[std::move(name)] = [&member](const Tag& tag) {
      parse_value(tag.text("value"), member);
    };
  }

  bool read_line(std::string_view& line);
  bool obey(std::string_view line);
  void open();
  void read(const Readers& readers, const char* what);
  void make_step();
  void answer(bool all);
  void write_answer();

  Time time_of(std::string_view attribute) const { return Time(picoseconds_of(attribute)); }
  Duration duration_of(std::string_view attribute) const {
    const Duration duration = picoseconds_of(attribute);
    if (duration >= Duration()) return duration;
    throw std::invalid_argument(std::string(attribute) + ": expected at least 0");
  }
  Duration picoseconds_of(std::string_view attribute) const {
    const auto number = tag_.value<Picoseconds>(attribute);
    const Picoseconds most = duration_from_seconds(kMaxSeconds).count() / unit_;
    if (number >= -most && number <= most) return Duration(number * unit_);
    throw std::invalid_argument(std::string(attribute) + ": expected a time within 1e15 s");
  }
  /// Makes the unit of time a picosecond if the instant is not a multiple of it.
  void fit_unit_to(Time time) {
    if (time.time_since_epoch().count() % unit_ == 0) return;
    unit_ = 1;
    TagWriter(answer_, "time-unit").value("picoseconds", unit_).end();
  }
  Picoseconds count(Time time) {
    fit_unit_to(time);
    return time.time_since_epoch().count() / unit_;
  }

  int in_;
  int out_;
  std::vector<char> buffer_ = std::vector<char>(1 << 16);
  std::size_t begin_ = 0;  ///< of what has been read and not yet obeyed
  std::size_t end_ = 0;
  Tag tag_;
  std::string answer_;

  Readers parameters_;
  Readers inputs_;
  Readers messages_;
  std::vector<std::unique_ptr<Row>> outputs_;
  std::string instance_name_;
  std::string resources_;
  Picoseconds unit_ = 1;  ///< [ps]
  Time now_{};
  bool wants_end_ = false;
};

inline int Program::run() noexcept {
  try {
    std::string_view line;
    while (read_line(line)) {
      if (!obey(line)) return 0;
    }
    return 0;
  } catch (const std::exception& failure) {
    try {
      TagWriter(answer_, "error").value("text", std::string_view(failure.what())).end();
      write_answer();
    } catch (const std::exception&) {  // it cannot be reported
    }
    return 1;
  }
}

/// Returns whether there is another line; it stays until the next call.
inline bool Program::read_line(std::string_view& line) {
  std::size_t seen = begin_;
  while (true) {
    const void* const feed = std::memchr(buffer_.data() + seen, '\n', end_ - seen);
    if (feed != nullptr) {
      const auto size = static_cast<std::size_t>(static_cast<const char*>(feed) - buffer_.data());
      line = {buffer_.data() + begin_, size - begin_};
      begin_ = size + 1;
      return true;
    }
    if (begin_ != 0) std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    seen = end_;
    if (end_ == buffer_.size()) buffer_.resize(2 * end_);
    ssize_t size = 0;
    do {
      size = ::read(in_, buffer_.data() + end_, buffer_.size() - end_);
    } while (size < 0 && errno == EINTR);
    if (size < 0) throw std::system_error(errno, std::generic_category(), "read");
    if (size == 0) return false;
    end_ += static_cast<std::size_t>(size);
  }
}

inline bool Program::obey(std::string_view line) {
  tag_.parse(line);
  const std::string_view command = tag_.name();
  if (command == "input") {
    read(inputs_, "input");
  } else if (command == "step") {
    make_step();
  } else if (command == "message") {
    now_ = time_of("time");
    read(messages_, "message input");
  } else if (command == "time-unit") {
    unit_ = tag_.value<Picoseconds>("picoseconds");
    if (unit_ < 1) throw std::invalid_argument("expected at least one picosecond");
  } else if (command == "parameter") {
    read(parameters_, "parameter");
  } else if (command == "open") {
    open();
  } else if (command == "trace") {
    trace(std::string(tag_.text("file")), std::string(tag_.text("signals")));
  } else if (command == "start") {
    now_ = time_of("time");
    start();
    answer(true);
  } else if (command == "end") {
    finish();
    return false;
  } else {
    throw std::runtime_error("unknown command <" + std::string(command) + ">");
  }
  return true;
}

inline void Program::open() {
  if (tag_.text("protocol") != "1") {
    throw std::runtime_error("the program speaks protocol 1, not " +
                             std::string(tag_.text("protocol")));
  }
  instance_name_ = tag_.text("instance");
  resources_ = tag_.text("resources");
}

inline void Program::read(const Readers& readers, const char* what) {
  const std::string_view name = tag_.text("name");
  const auto found = readers.find(name);
  if (found == readers.end()) {
    throw std::runtime_error("the program has no " + std::string(what) + " '" + std::string(name) +
                             "', which its declaration has");
  }
  found->second(tag_);
}

inline void Program::make_step() {
  const Time to = later(now_, duration_of("size"));
  const bool may_stop = tag_.value<bool>("may-stop");
  const Time reached = step(to, may_stop);
  if (reached < now_ || reached > to || (reached != to && !may_stop)) {
    throw std::logic_error("step() returned an instant at which it must not stop");
  }
  now_ = reached;
  answer(false);
}

inline void Program::answer(bool all) {
  for (const auto& row : outputs_) row->tell(answer_, all);
  const std::optional<Time> next = next_event();
  if (next) fit_unit_to(*next);
  const Picoseconds time = count(now_);
  TagWriter sync(answer_, "sync");
  sync.value("time", time);
  if (next) sync.value("next", count(*next));
  if (wants_end_) sync.value("end", true);
  sync.end();
  write_answer();
}

inline void Program::write_answer() {
  for (std::size_t at = 0; at < answer_.size();) {
    const ssize_t size = ::write(out_, answer_.data() + at, answer_.size() - at);
    if (size < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "write");
    if (size > 0) at += static_cast<std::size_t>(size);
  }
  answer_.clear();
}

}  // namespace stride::process

#endif
