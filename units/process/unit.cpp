// A program as an FMU. Its variable table comes from the declaration in its resources.
#include <cmath>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <valarray>
#include <variant>
#include <vector>

#include <stride/unit.h>

#include "units/process/model.h"

namespace {

using process::Role;
using process::Value;
using process::Variable;

bool is_message(const Variable& variable) {
  return variable.role == Role::MessageInput || variable.role == Role::MessageOutput;
}

std::vector<Value> start_values(const process::Declaration& declaration) {
  std::vector<Value> values;
  for (const Variable& variable : declaration.variables) values.push_back(variable.start);
  return values;
}

}  // namespace

class ProcessUnit : public stride::Unit {
 public:
  explicit ProcessUnit(const stride::Setup& setup)
      : declaration_(process::load_declaration(setup.resources)),
        resources_(std::filesystem::absolute(setup.resources)),
        results_(setup.results),
        values_(start_values(declaration_)),
        clocks_(values_.size()) {
    opening_.instance_name = setup.instance_name;
    opening_.resources = resources_.string();
    auto& info = describe(declaration_.description);
    info.early_return = declaration_.may_stop;
    info.split_invariant = declaration_.split_invariant;
    info.allows_snapshots = false;  // which would not hold the program
    info.maximum_step = declaration_.maximum_step;
    for (const auto& [name, factor, in, offset] : declaration_.units_of_measure) {
      unit_of_measure(name, factor, in, offset);
    }
    for (std::size_t i = 0; i < values_.size(); ++i) list(i);
    list_own_parameters();
  }

  /// The program begins anew, unless it has only been started, with the same values.
  void initialize(stride::Time start) override {
    const Beginning beginning{start, values_, opening_, program_, time_limit_, answer_limit_};
    if (session_ && beginning_ && is_same(beginning, *beginning_)) return;
    session_.reset();
    beginning_.reset();
    begin(start);
    beginning_ = beginning;
  }

  void step(stride::Step& step) override {
    const bool may_stop = declaration_.may_stop && step.early_return_allowed();
    advance(step.to(), may_stop);
    if (sync_.time < step.to()) step.return_early(sync_.time);
    if (sync_.ends) step.terminate_simulation();
    if (sync_.next != announced_) step.need_event();
    publish();
  }

  void update_outputs() override {
    if (has_news()) advance(sync_.time, false);
  }

  void event(stride::Event& event) override {
    bool has_message = false;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (declaration_.variables[i].role != Role::MessageInput || !clocks_[i]->ticked()) continue;
      in_session([i](process::Session& session) { session.receive(i); });
      has_message = true;
    }
    if (has_message || has_news()) advance(event.time(), false);
    publish();
    announced_ = sync_.next;
    announced_ ? event.next_event(*announced_) : event.no_next_event();
    if (sync_.ends) event.terminate_simulation();
  }

  void terminate() override {
    in_session([](process::Session& session) { session.finish(); });
    session_.reset();
  }

 private:
  /// All that decides how a program begins.
  struct Beginning {
    stride::Time start;
    std::vector<Value> values;
    process::Opening opening;
    std::string program;
    double time_limit;
    std::uint64_t answer_limit;
  };

  void begin(stride::Time start) {
    announced_.reset();
    has_told_late_ = false;
    const process::Limits limits{
        std::chrono::milliseconds(std::llround(std::ceil(time_limit_ * 1e3))), answer_limit_};
    session_ = std::make_unique<process::Session>(
        declaration_, values_, process::command_line(declaration_, resources_, program_), limits,
        [this](bool is_warning, const std::string& text) {
          log(is_warning ? stride::Severity::Warning : stride::Severity::Info, text);
        },
        environment());
    process::Opening opening = opening_;
    if (!opening.trace_file.empty()) {
      opening.trace_file = std::filesystem::absolute(results_ / opening.trace_file).string();
    }
    sync_ = in_session([&](process::Session& session) { return session.start(opening, start); });
  }

  /// What the program gets, whatever the variable names in this process by then.
  std::vector<std::string> environment() const {
    if (results_.empty()) return {};
    return {"STRIDE_RESULTS=" + results_.string()};
  }

  bool is_same(const Beginning& one, const Beginning& other) const {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Role role = declaration_.variables[i].role;
      if (role != Role::Parameter && role != Role::Input) continue;
      if (!process::is_same(one.values[i], other.values[i])) return false;
    }
    return one.start == other.start && one.opening.trace_file == other.opening.trace_file &&
           one.opening.trace_signals == other.opening.trace_signals &&
           one.program == other.program && one.time_limit == other.time_limit &&
           one.answer_limit == other.answer_limit;
  }

  void list(std::size_t i) {
    const Variable& variable = declaration_.variables[i];
    if (is_message(variable)) clocks_[i] = std::make_unique<stride::Clock>();
    if (variable.role == Role::MessageInput) {
      input(variable.clock, *clocks_[i]).description("ticks when a message has come");
    }
    if (variable.role == Role::MessageOutput) {
      output(variable.clock, *clocks_[i]).description("ticks when the program has sent one");
    }
    auto row = std::visit([&](auto& member) { return add(variable, member); }, values_[i]);
    row.description(variable.description);
    if (!variable.unit.empty()) row.unit(variable.unit);
    if (variable.is_relative) row.relative();
    if (!variable.mime_type.empty()) row.mime_type(variable.mime_type);
    if (variable.min) row.min(*variable.min);
    if (variable.max) row.max(*variable.max);
    if (variable.is_discrete) row.discrete();
    if (is_message(variable)) row.clocked_by(*clocks_[i]);
    if (variable.role == Role::MessageOutput) row.depends_on({});
    if (variable.depends_on) row.depends_on(*variable.depends_on);
  }
  template <class T>
  stride::VariableBuilder add(const Variable& variable, T& member) {
    switch (variable.role) {
      case Role::Parameter:
        return parameter(variable.name, member);
      case Role::Input:
      case Role::MessageInput:
        return input(variable.name, member);
      case Role::Output:
      case Role::MessageOutput:
        break;
    }
    return output(variable.name, member);
  }
  template <class T>
  stride::VariableBuilder add(const Variable& variable, std::valarray<T>& array) {
    T* const elements = std::begin(array);
    const auto listed = [&] {
      switch (variable.role) {
        case Role::Parameter:
          return parameter(variable.name, elements, array.size());
        case Role::Input:
        case Role::MessageInput:
          return input(variable.name, elements, array.size());
        case Role::Output:
        case Role::MessageOutput:
          break;
      }
      return output(variable.name, elements, array.size());
    };
    return listed().dimensions(variable.dimensions);
  }

  void list_own_parameters() {
    parameter("process.program", program_)
        .description("run in the place of the declared program: a path, or a name in PATH");
    parameter("process.time_limit", time_limit_)
        .unit("s")
        .range(0, 1e6)
        .description("maximum time without output while an answer is expected; 0: no limit");
    parameter("process.answer_limit", answer_limit_)
        .description("how many bytes it may write until it has answered");
    if (!declaration_.has_trace) return;
    parameter("trace.file", opening_.trace_file)
        .description("file of a trace, in the unit's own folder of results; none if empty");
    parameter("trace.signals", opening_.trace_signals)
        .description("which signals: patterns with * and ?, separated by spaces");
  }

  /// Calls f(session). A program that has failed is ended.
  template <class Function>
  std::invoke_result_t<Function, process::Session&> in_session(Function&& f) {
    if (!session_) throw std::runtime_error("the program has failed, and cannot go on");
    try {
      return f(*session_);
    } catch (...) {
      session_.reset();
      throw;
    }
  }
  bool has_news() {
    return in_session([](process::Session& session) { return session.has_news(); });
  }
  void advance(stride::Time to, bool may_stop) {
    beginning_.reset();
    sync_ = in_session([&](process::Session& session) { return session.step(to, may_stop); });
    note_late();
  }

  /// A message that could not have its instant.
  void note_late() {
    if (session_->sent().empty() || has_told_late_) return;
    const process::Message& first = session_->sent().front();
    if (first.time >= sync_.time) return;
    has_told_late_ = true;
    log(stride::Severity::Warning,
        "the message '" + declaration_.variables[first.variable].name + "' of " +
            std::to_string(stride::to_seconds(first.time)) +
            " s is an event at the end of the step only, for the program did not stop where it "
            "sent "
            "it" +
            (declaration_.may_stop ? "" : " (its declaration has no may-stop=\"true\")"));
  }

  /// Messages of one instant tick together, each clock once; the others follow in the next
  /// iterations, in their order.
  void publish() {
    auto& sent = session_->sent();
    if (sent.empty()) return;
    const stride::Time time = sent.front().time;
    while (!sent.empty() && sent.front().time == time) {
      process::Message& message = sent.front();
      if (clocks_[message.variable]->ticked()) break;
      values_[message.variable] = message.value;  // a copy leaves the elements where they are
      clocks_[message.variable]->tick();
      sent.pop_front();
    }
  }

  process::Declaration declaration_;
  std::filesystem::path resources_;
  std::filesystem::path results_;
  std::vector<Value> values_;  ///< whose alternatives stay what they are, and arrays where they are
  std::vector<std::unique_ptr<stride::Clock>> clocks_;  ///< of messages
  process::Opening opening_{"", "", "", "*"};
  std::string program_;
  double time_limit_ = 60;
  std::uint64_t answer_limit_ = process::Limits{}.answer;

  std::unique_ptr<process::Session> session_;
  std::optional<Beginning> beginning_;  ///< as long as the program has only begun
  process::Sync sync_;
  std::optional<stride::Time> announced_;
  bool has_told_late_ = false;
};

STRIDE_UNIT(ProcessUnit)
