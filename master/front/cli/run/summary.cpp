#include "master/front/cli/run/summary.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/front/cli/terminal/table.h"
#include "master/observe/recorders/message_summary.h"

namespace stride::cli {
namespace {

constexpr std::size_t kMostMessages = 40;
constexpr std::size_t kMostSignals = 30;
constexpr std::size_t kMostHosts = 6;
constexpr std::size_t kLongestText = 200;  // of a message

std::string end_text(const core::RunStatistics& statistics) {
  if (statistics.end == core::RunEnd::Completed) return "";
  return fmt::format(", {}", name(statistics.end));
}

/// With what it may be off by, where it was measured in some steps only.
std::string wall_text(std::chrono::nanoseconds time, std::chrono::nanoseconds uncertainty) {
  const std::string text = core::wall_seconds(time);
  const std::string error = core::wall_seconds(uncertainty);
  return error == core::wall_seconds({}) ? text : text + " ± " + error;
}

bool is_text(core::ValueType type) {
  return type == core::ValueType::String || type == core::ValueType::Binary;
}

/// Numbers beyond 2^53 are rounded.
template <class T>
double number_at(const void* value) {
  return static_cast<double>(*static_cast<const T*>(value));
}

Summary::Value reader_of(const core::Signal& signal) {
  return core::visit(*signal.block, [&](auto elements) -> Summary::Value {
    using T = typename decltype(elements)::value_type;
    if constexpr (std::is_arithmetic_v<T>) return {&elements[signal.first], &number_at<T>};
    return {};
  });
}

std::string value_text(core::ValueType type, double value) {
  if (type == core::ValueType::Boolean) return value != 0 ? "true" : "false";
  return core::is_real(type) ? fmt::format("{:.5g}", value) : fmt::format("{:.0f}", value);
}

}  // namespace

Summary::Summary(const core::System& system, std::span<const core::VariableId> recorded)
    : system_(system) {
  for (const core::VariableId id : recorded) {
    const core::Variable& variable = system_.variable(id);
    if (variable.size != 1 || is_text(variable.type)) {
      ++arrays_and_texts_;
    } else if (signals_.size() < kMostSignals) {
      signals_.push_back(id);
    } else {
      ++other_signals_;
    }
  }
}

void Summary::on_start(std::span<const core::Signal> signals) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const core::Signal& signal : signals) {
    ranges_.push_back({signal.id, reader_of(signal), kInfinity, -kInfinity});
  }
}

bool Summary::wants_content() const { return messages_.size() < kMostMessages; }

void Summary::on_message(const core::Message& message) {
  if (!message.received) {
    ++message_count_;
    if (messages_.size() < kMostMessages) {
      messages_.push_back({message.id,
                           message.time,
                           recorders::message_summary(system_, message, kLongestText),
                           {}});
    }
  } else if (message_count_ <= kMostMessages) {
    note_receiver(message.id);
  }
}

void Summary::note_receiver(core::VariableId receiver) {
  for (const core::Connection& connection : system_.connections()) {
    if (connection.to != receiver) continue;
    const auto sent = std::find_if(messages_.rbegin(), messages_.rend(),
                                   [&](const Sent& s) { return s.id == connection.from; });
    if (sent != messages_.rend()) sent->receivers.push_back(receiver.component);
  }
}

void Summary::on_communication_point(Time) {
  for (Range& range : ranges_) {
    const double value = range.value.read();
    range.least = std::min(range.least, value);
    range.most = std::max(range.most, value);
  }
}

void Summary::begin_late(Time time) {
  since_ = time;
  for (Range& range : ranges_) range.is_whole = false;
}

void Summary::persist_ranges(core::StateArchive& state) {
  std::vector<Range> kept;
  if (!state.is_reading()) kept = ranges_;
  state.sequence(kept, [&](Range& range) {
    state.value(range.id.component);
    state.value(range.id.variable);
    state.value(range.least);
    state.value(range.most);
    state.value(range.is_whole);
  });
  if (!state.is_reading()) return;
  for (const Range& range : kept) {
    const auto found = std::ranges::find(ranges_, range.id, &Range::id);
    if (found == ranges_.end()) continue;
    found->least = range.least;
    found->most = range.most;
    found->is_whole = range.is_whole;
  }
}

void Summary::persist(core::StateArchive& state) {
  state.mark("summary");
  persist_ranges(state);
  state.sequence(messages_, [&](Sent& sent) {
    state.value(sent.id.component);
    state.value(sent.id.variable);
    state.value(sent.time);
    state.value(sent.text);
    state.values(sent.receivers);
    const auto has = [&](std::size_t component) { return component < system_.components().size(); };
    if (!has(sent.id.component) || !std::ranges::all_of(sent.receivers, has)) {
      state.fail("there is no such component");
    }
    const auto& variables = system_.components()[sent.id.component].description->variables;
    if (sent.id.variable >= variables.size()) state.fail("there is no such variable");
  });
  state.value(message_count_);
}

std::string Summary::text(const core::RunStatistics& statistics) const {
  const double simulated = to_seconds(statistics.reached - statistics.start);
  const double wall = std::chrono::duration<double>(statistics.wall_time).count();
  std::string text = fmt::format(
      "{}: {:.6g} s simulated in {:.3g} s ({:.3g} times real time), {}{}\n", system_.name(),
      simulated, wall, wall > 0 ? simulated / wall : 0.0,
      core::counted(statistics.communication_steps, "communication step"), end_text(statistics));
  text += idle_line(statistics) + host_line(statistics);
  if (!messages_.empty()) text += "\nMessages\n" + message_table();
  if (!ranges_.empty() || arrays_and_texts_ > 0) text += "\nSignals\n" + signal_table();
  text += "\nUnits\n" + unit_table(statistics);
  return text;
}

std::string Summary::message_table() const {
  Table table({{"time [s]", Table::Align::Right},
               {"message"},
               {"content", Table::Align::Left, true},
               {"received by"}});
  for (const Sent& sent : messages_) {
    std::string receivers;
    for (const std::size_t i : sent.receivers) {
      receivers += (receivers.empty() ? "" : ", ") + system_.components()[i].name;
    }
    table.add({core::to_text(sent.time), system_.full_name(sent.id), sent.text,
               receivers.empty() ? "none" : receivers});
  }
  std::string text = table.text(output_width());
  if (message_count_ > messages_.size()) {
    text += fmt::format("  … and {} more\n", message_count_ - messages_.size());
  }
  return text;
}

std::string Summary::signal_table() const {
  Table table({{"signal"},
               {"least", Table::Align::Right},
               {"most", Table::Align::Right},
               {"last", Table::Align::Right},
               {"unit"}});
  bool are_whole = true;
  for (const Range& range : ranges_) {
    const bool is_known = range.least <= range.most;  // a point at least
    const core::Variable& variable = system_.variable(range.id);
    const auto text = [&](double value) { return value_text(variable.type, value); };
    table.add({system_.full_name(range.id) + (range.is_whole ? "" : " *"),
               is_known ? text(range.least) : "", is_known ? text(range.most) : "",
               text(range.value.read()), variable.unit});
    are_whole = are_whole && range.is_whole;
  }
  std::string text = ranges_.empty() ? "" : table.text();
  if (!are_whole) text += fmt::format("  * least and most since {} s\n", core::to_text(since_));
  if (other_signals_ > 0) text += fmt::format("  … and {} more\n", other_signals_);
  if (arrays_and_texts_ > 0) {
    text += fmt::format("  {} recorded, not shown here\n",
                        core::counted(arrays_and_texts_, "array or text", "arrays and texts"));
  }
  return text;
}

/// Empty if no unit was suspended.
std::string Summary::idle_line(const core::RunStatistics& statistics) const {
  Duration skipped{};
  const core::UnitStatistics* longest = nullptr;
  for (const core::UnitStatistics& unit : statistics.units) {
    skipped += unit.suspended_time;
    if (unit.suspensions > 0 && (!longest || unit.longest_suspension > longest->longest_suspension))
      longest = &unit;
  }
  if (longest == nullptr) return "";
  const double whole = to_seconds(statistics.reached - statistics.start);
  const double all = whole * static_cast<double>(statistics.units.size());
  const auto index = static_cast<std::size_t>(longest - statistics.units.data());
  return fmt::format(
      "Idle units were suspended for {:.3g} % of their time; the longest time was {:.6g} s ({})\n",
      all > 0 ? 100 * to_seconds(skipped) / all : 0.0, to_seconds(longest->longest_suspension),
      system_.components()[index].name);
}

/// Empty if all units were in this process.
std::string Summary::host_line(const core::RunStatistics& statistics) const {
  std::vector<std::string> hosted;
  for (std::size_t i = 0; i < statistics.units.size(); ++i) {
    const std::optional<core::HostStatistics>& host = statistics.units[i].host;
    if (!host) continue;
    std::string& text = hosted.emplace_back(system_.components()[i].name);
    if (host->link) {
      text += fmt::format(" (on {}: {}, {:.3g} s lost to the network)", host->link->machine,
                          core::counted(host->link->round_trips, "round trip"),
                          std::chrono::duration<double>(host->link->lost).count());
    }
    if (host->snapshots == 0) continue;
    text += fmt::format(" ({}, {} restored)", core::counted(host->snapshots, "snapshot"),
                        host->restores);
  }
  if (hosted.empty()) return "";
  std::string text = "Processes of their own: ";
  if (hosted.size() > kMostHosts) {
    text += fmt::format("{} of {} units: ", hosted.size(), statistics.units.size());
    hosted.resize(kMostHosts);
    hosted.push_back("…");
  }
  return fmt::format("{}{}\n", text, fmt::join(hosted, ", "));
}

std::string Summary::unit_table(const core::RunStatistics& statistics) const {
  Table table({{"unit"},
               {"steps", Table::Align::Right},
               {"early", Table::Align::Right},
               {"rejected", Table::Align::Right},
               {"undone", Table::Align::Right},
               {"events", Table::Align::Right},
               {"idle [s]", Table::Align::Right},
               {"sent", Table::Align::Right},
               {"received", Table::Align::Right},
               {"start [s]", Table::Align::Right},
               {"steps [s]", Table::Align::Right},
               {"events [s]", Table::Align::Right}});
  for (std::size_t i = 0; i < statistics.units.size(); ++i) {
    const core::UnitStatistics& unit = statistics.units[i];
    table.add({system_.components()[i].name, std::to_string(unit.steps),
               std::to_string(unit.early_returns), std::to_string(unit.rejections),
               std::to_string(unit.rollbacks), std::to_string(unit.events),
               fmt::format("{:.6g}", to_seconds(unit.suspended_time)),
               std::to_string(unit.messages_sent), std::to_string(unit.messages_received),
               core::wall_seconds(unit.initialization_time),
               wall_text(unit.step_time, unit.step_time_uncertainty),
               wall_text(unit.event_time, unit.event_time_uncertainty)});
  }
  return table.text();
}

}  // namespace stride::cli
