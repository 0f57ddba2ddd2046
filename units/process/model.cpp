#include "units/process/model.h"

#include <stdexcept>
#include <utility>

namespace process {
namespace {

using stride::Duration;
using stride::Time;
using stride::process::TagWriter;

std::string seconds(Time time) {
  std::string text;
  stride::process::append_value(text, stride::to_seconds(time));
  return text + " s";
}

/// With its article.
const char* with_article(Role role) {
  switch (role) {
    case Role::Parameter:
      return "a parameter";
    case Role::Input:
      return "an input";
    case Role::Output:
      return "an output";
    case Role::MessageInput:
      return "a message input";
    case Role::MessageOutput:
      break;
  }
  return "a message output";
}

}  // namespace

Session::Session(const Declaration& declaration, std::vector<Value>& values,
                 const std::vector<std::string>& command, const Limits& limits, Log log,
                 const std::vector<std::string>& variables)
    : declaration_(declaration),
      values_(values),
      told_(values),
      has_come_(values.size()),
      log_(std::move(log)),
      lines_(
          command, limits, [this](const std::string& line) { log_(false, line); }, variables) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    places_.emplace(declaration.variables[i].name, i);
    if (declaration.variables[i].role == Role::Input) inputs_.push_back(i);
  }
}

// ---- Commands ----

Sync Session::start(const Opening& opening, Time time) {
  std::string& text = lines_.commands();
  now_ = last_sent_ = time;
  TagWriter(text, "open")
      .value("protocol", 1)
      .value("instance", opening.instance_name)
      .value("resources", opening.resources)
      .end();
  set_time_unit(time, time);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (declaration_.variables[i].role == Role::Parameter) tell_value("parameter", i);
  }
  if (!opening.trace_file.empty()) {
    TagWriter(text, "trace")
        .value("file", opening.trace_file)
        .value("signals", opening.trace_signals)
        .end();
  }
  tell_inputs(true);
  TagWriter(text, "start").value("time", count(time.time_since_epoch())).end();
  lines_.send("start");
  const Sync sync = read_answer(time, false);
  require_all_outputs();
  return sync;
}

/// That of the declaration, where all instants are multiples of it.
void Session::set_time_unit(Time now, Time to) {
  const Duration wanted = declaration_.time_unit;
  const auto is_multiple = [&](Time time) {
    return time.time_since_epoch() % wanted == Duration{};
  };
  const Duration unit = is_multiple(now) && is_multiple(to) ? wanted : Duration(1);
  if (unit == unit_) return;
  unit_ = unit;
  TagWriter(lines_.commands(), "time-unit").value("picoseconds", unit.count()).end();
}

bool Session::has_news() const {
  for (const std::size_t i : inputs_) {
    if (!is_same(values_[i], told_[i])) return true;
  }
  return false;
}

void Session::tell_inputs(bool all) {
  for (const std::size_t i : inputs_) {
    if (!all && is_same(values_[i], told_[i])) continue;
    tell_value("input", i);
    told_[i] = values_[i];
  }
}

void Session::tell_value(std::string_view tag, std::size_t variable, std::optional<Time> time) {
  const std::string& name = declaration_.variables[variable].name;
  TagWriter writer(lines_.commands(), tag);
  writer.value("name", name);
  if (time) writer.value("time", count(time->time_since_epoch()));
  try {
    write(writer, "value", values_[variable]);
  } catch (const std::invalid_argument& mistake) {
    throw std::runtime_error("'" + name + "': " + mistake.what());
  }
  writer.end();
}

void Session::receive(std::size_t variable) {
  set_time_unit(now_, now_);
  tell_value("message", variable, now_);
}

Sync Session::step(Time to, bool may_stop) {
  set_time_unit(now_, to);
  tell_inputs(false);
  TagWriter(lines_.commands(), "step")
      .value("size", count(to - now_))
      .value("may-stop", may_stop)
      .end();
  lines_.send("make a step");
  return read_answer(to, may_stop);
}

void Session::finish() {
  TagWriter(lines_.commands(), "end").end();
  lines_.finish();
  while (const auto line = lines_.next_last_line()) take_last(*line);
  lines_.require_success();
}

// ---- Answers ----

Sync Session::read_answer(Time to, bool may_stop) {
  while (true) {
    const std::string_view line = lines_.next_line();
    try {
      tag_.parse(line);
      const std::string_view name = tag_.name();
      if (name == "sync") return take_sync(to, may_stop);
      if (name == "output") {
        take_output();
      } else if (name == "message") {
        take_message(to);
      } else {
        read_tag(name);
      }
    } catch (const std::invalid_argument& mistake) {
      lines_.fail_line(mistake.what());
    }
  }
}

/// What a program that is about to end may say; nobody waits for anything else.
void Session::take_last(std::string_view line) {
  try {
    tag_.parse(line);
    read_tag(tag_.name());
  } catch (const std::invalid_argument&) {
  }
}

void Session::read_tag(std::string_view name) {
  if (name == "log") return take_log();
  if (name == "time-unit") {
    const auto picoseconds = tag_.value<stride::Picoseconds>("picoseconds");
    if (picoseconds < 1) throw std::invalid_argument("expected at least one picosecond");
    unit_ = Duration(picoseconds);
    return;
  }
  if (name == "error") lines_.fail("fails: " + std::string(tag_.text("text")));
  throw std::invalid_argument("<" + std::string(name) +
                              "> is not known: expected <output>, <message>, <log>, <time-unit>, "
                              "<error> or <sync>");
}

/// The values of variables probably come in the order of their declaration.
std::size_t Session::find(std::string_view name, Role role) {
  if (guess_ >= values_.size() || declaration_.variables[guess_].name != name) {
    const auto found = places_.find(name);
    if (found == places_.end()) refuse_name(name, role);
    guess_ = found->second;
  }
  if (declaration_.variables[guess_].role != role) refuse_name(name, role);
  return guess_++;
}

void Session::refuse_name(std::string_view name, Role role) const {
  const auto found = places_.find(name);
  std::string text = "'" + std::string(name) + "' is not " + with_article(role);
  if (found != places_.end()) {
    text += std::string(", but ") + with_article(declaration_.variables[found->second].role);
  }
  std::string known;
  for (const Variable& variable : declaration_.variables) {
    if (variable.role == role) known += (known.empty() ? "'" : ", '") + variable.name + "'";
  }
  throw std::invalid_argument(text + "; declared are " + (known.empty() ? "none" : known));
}

void Session::take_output() {
  tag_.allow_only({"name", "value"});
  const std::size_t variable = find(tag_.text("name"), Role::Output);
  parse(tag_.text("value"), values_[variable]);
  has_come_[variable] = true;
}

void Session::take_message(Time to) {
  tag_.allow_only({"name", "time", "value"});
  const std::size_t variable = find(tag_.text("name"), Role::MessageOutput);
  Message message{variable, take_time("time"), declaration_.variables[variable].start};
  parse(tag_.text("value"), message.value);
  if (message.time < last_sent_ || message.time < now_ || message.time > to) {
    throw std::invalid_argument("a message of " + seconds(message.time) +
                                ", expected in the order of time, from " +
                                seconds(std::max(now_, last_sent_)) + " to " + seconds(to));
  }
  last_sent_ = message.time;
  sent_.push_back(std::move(message));
}

void Session::take_log() {
  tag_.allow_only({"level", "text"});
  const std::string_view level = tag_.text("level");
  if (level != "info" && level != "warning") {
    throw std::invalid_argument("level=\"" + std::string(level) + "\": expected info or warning");
  }
  log_(level == "warning", std::string(tag_.text("text")));
}

Sync Session::take_sync(Time to, bool may_stop) {
  tag_.allow_only({"time", "next", "end"});
  Sync sync{take_time("time"), std::nullopt, tag_.has("end") && tag_.value<bool>("end")};
  const Time least = may_stop ? std::max(now_, last_sent_) : to;
  if (sync.time < least || sync.time > to) {
    throw std::invalid_argument("the step ended at " + seconds(sync.time) + ", expected " +
                                (may_stop
                                     ? "from " + seconds(least) + " to " + seconds(to)
                                     : seconds(to) + ", where the command required it to end"));
  }
  if (tag_.has("next")) {
    sync.next = take_time("next");
    if (*sync.next <= sync.time) {
      throw std::invalid_argument("next: expected an instant behind " + seconds(sync.time));
    }
  }
  now_ = sync.time;
  return sync;
}

Time Session::take_time(std::string_view attribute) const {
  const auto number = tag_.value<stride::Picoseconds>(attribute);
  const stride::Picoseconds most = stride::duration_from_seconds(stride::kMaxSeconds) / unit_;
  if (number < -most || number > most) {
    throw std::invalid_argument(std::string(attribute) + "=\"" + std::string(tag_.text(attribute)) +
                                "\": expected a time within 1e15 s");
  }
  return Time(number * unit_);
}

void Session::require_all_outputs() const {
  std::string missing;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Variable& variable = declaration_.variables[i];
    if (variable.role != Role::Output || has_come_[i]) continue;
    missing += (missing.empty() ? "'" : ", '") + variable.name + "'";
  }
  if (missing.empty()) return;
  lines_.fail("has not sent the outputs " + missing +
              " before it answered <start/>; expected each of them there");
}

}  // namespace process
