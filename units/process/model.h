// The protocol of docs/process-protocol.md, from the side of the unit.
#ifndef STRIDE_UNITS_PROCESS_MODEL_H
#define STRIDE_UNITS_PROCESS_MODEL_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <stride/process/tag.h>
#include <stride/time.h>

#include "units/process/declaration.h"
#include "units/process/program_lines.h"

namespace process {

/// What a program is started with, beside the values of its variables.
struct Opening {
  std::string instance_name;
  std::string resources;
  std::string trace_file;  ///< none if empty
  std::string trace_signals;
};

/// A message that a program has sent.
struct Message {
  std::size_t variable = 0;
  stride::Time time;  ///< at which it was produced
  Value value;
};

/// How a step has ended.
struct Sync {
  stride::Time time;                 ///< that the program has reached
  std::optional<stride::Time> next;  ///< when something happens next, if that is known
  bool ends = false;                 ///< the program requests the end of the simulation
};

/// A program from its start to its end. Values are read from and written to `values`, one for each
/// variable of the declaration, in its order; both must outlive the session. All functions throw
/// std::runtime_error as ProgramLines does.
class Session {
 public:
  using Log = std::function<void(bool is_warning, const std::string& text)>;

  /// `command` and `variables` are those of Child.
  Session(const Declaration& declaration, std::vector<Value>& values,
          const std::vector<std::string>& command, const Limits& limits, Log log,
          const std::vector<std::string>& variables = {});

  /// Sends parameters and inputs; the program answers with its outputs.
  Sync start(const Opening& opening, stride::Time time);
  /// Whether an input differs from what was sent last.
  bool has_news() const;
  /// Hands over a message that has come at the present instant; a step follows.
  void receive(std::size_t variable);
  /// Sends the inputs that have changed, and a step from the present instant to `to`, which may be
  /// the same.
  Sync step(stride::Time to, bool may_stop);
  void finish();

  /// What the program has sent and is not yet taken out, in the order in which it was produced.
  std::deque<Message>& sent() { return sent_; }

 private:
  using Tag = stride::process::Tag;

  void set_time_unit(stride::Time now, stride::Time to);
  void tell_inputs(bool all);
  void tell_value(std::string_view tag, std::size_t variable,
                  std::optional<stride::Time> time = std::nullopt);
  stride::Picoseconds count(stride::Duration duration) const { return duration / unit_; }

  Sync read_answer(stride::Time to, bool may_stop);
  void read_tag(std::string_view line);
  void take_last(std::string_view line);
  void take_output();
  void take_message(stride::Time to);
  void take_log();
  Sync take_sync(stride::Time to, bool may_stop);
  stride::Time take_time(std::string_view attribute) const;
  std::size_t find(std::string_view name, Role role);
  [[noreturn]] void refuse_name(std::string_view name, Role role) const;
  void require_all_outputs() const;

  const Declaration& declaration_;
  std::vector<Value>& values_;
  std::vector<Value> told_;  ///< of inputs: what was sent last
  std::vector<std::size_t> inputs_;
  std::map<std::string, std::size_t, std::less<>> places_;
  std::vector<bool> has_come_;  ///< of outputs, in the answer to the start
  std::size_t guess_ = 0;       ///< the variable that the program will probably send next
  Log log_;
  ProgramLines lines_;
  Tag tag_;
  stride::Duration unit_{1};  ///< of the times in the lines
  stride::Time now_;
  stride::Time last_sent_;  ///< the time of the last message
  std::deque<Message> sent_;
};

}  // namespace process

#endif
