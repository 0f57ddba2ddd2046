#include "master/front/cli/run/idle_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/files/csv_reader.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/engine/run/idle/idle_agreement.h"
#include "master/front/cli/run/idle_cause.h"

namespace stride::cli {
namespace {

using core::CsvReader;

/// Of the greatest value, for what has no tolerance of its own.
constexpr double kEffect = 1e-3;

struct Difference {
  Time time;
  std::string text;
  std::optional<core::VariableId> id{};  ///< what differs, if it is a variable
};

Time time_of(const CsvReader& reader) { return core::parse_time(reader.fields().front().text); }

std::string value_of(const CsvReader& reader, std::size_t column) {
  return reader.fields().at(column).value();
}

/// A recorded element, and how far it may be off.
struct Column {
  core::VariableId id;
  bool is_real = false;
  double absolute = 0;
  double relative = 0;  ///< of the greatest value
};

/// What idle skipping may do in this system.
class Allowances {
 public:
  explicit Allowances(const scenario::RunPlan& loaded)
      : system_(loaded.system()), idle_(loaded.options().idle) {
    for (std::size_t i = 0; i < system_.components().size(); ++i) {
      const auto& variables = system_.components()[i].description->variables;
      if (!idle_.longest_suspension(system_, i)) continue;
      inexact_units_ += std::ranges::any_of(
          variables, [](const core::Variable& variable) { return variable.tolerance.has_value(); });
      has_deadbands_ |= std::ranges::any_of(
          variables, [](const core::Variable& variable) { return variable.deadband > 0; });
    }
    has_deadbands_ |= !idle_.deadbands.empty();
  }

  Column of(core::VariableId id) const {
    Column column{id, core::is_real(system_.variable(id).type)};
    const auto tolerance = tolerance_of(id);
    if (tolerance) {
      column.absolute = *tolerance * static_cast<double>(std::max<std::size_t>(1, inexact_units_));
    }
    const bool has_effects = inexact_units_ > 0 || has_deadbands_;
    if (has_effects && !tolerance) column.relative = kEffect;
    return column;
  }

 private:
  /// That of an output, also where its value is that of an input.
  std::optional<double> tolerance_of(core::VariableId id) const {
    if (system_.is_output(id) || system_.variable(id).causality != core::Causality::Input) {
      return idle_.tolerance(system_, id);
    }
    std::optional<double> tolerance;
    for (const core::Connection& connection : system_.connections_to(id)) {
      const auto own = idle_.tolerance(system_, connection.from);
      if (!own) continue;
      const double converted = *own * std::abs(connection.conversion.linear.factor);
      tolerance = std::max(converted, tolerance.value_or(0));
    }
    return tolerance;
  }

  const core::System& system_;
  const core::IdleOptions& idle_;
  std::size_t inexact_units_ = 0;  ///< with outputs that have tolerances
  bool has_deadbands_ = false;
};

class SignalComparison {
 public:
  SignalComparison(const scenario::RunPlan& loaded, const std::filesystem::path& skipping,
                   const std::filesystem::path& full)
      : system_(loaded.system()), full_file_(full), skipping_(skipping), full_(full) {
    const Allowances allowances(loaded);
    for (const core::VariableId id : loaded.options().recorded) {
      columns_.insert(columns_.end(), system_.variable(id).size, allowances.of(id));
    }
    greatest_.resize(columns_.size());
    skipping_.next();
    full_.next();
  }

  /// Of the rows of an instant the last one counts, which has what it settled to.
  std::optional<Difference> first() {
    find_greatest();
    for (bool has_row = skipping_.next(); has_row;) {
      const Time time = time_of(skipping_);
      const std::vector<std::string> values = values_at(skipping_, time, has_row);
      if (!go_to(time)) {
        return Difference{time, "there is a communication point with skipping only"};
      }
      if (auto difference = compare(time, values)) return difference;
      ++points_;
    }
    return std::nullopt;
  }

  std::size_t points() const { return points_; }

 private:
  void find_greatest() {
    CsvReader reader(full_file_);
    reader.next();
    while (reader.next()) {
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (!columns_[i].is_real) continue;
        const double value = std::abs(std::strtod(value_of(reader, i + 1).c_str(), nullptr));
        if (std::isfinite(value)) greatest_[i] = std::max(greatest_[i], value);
      }
    }
  }

  /// Reads on beyond the rows of this time, and returns the values of the last one.
  std::vector<std::string> values_at(CsvReader& reader, Time time, bool& has_row) const {
    std::vector<std::string> values(columns_.size());
    while (has_row && time_of(reader) == time) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_of(reader, i + 1);
      has_row = reader.next();
    }
    return values;
  }

  bool go_to(Time time) {
    if (!has_begun_) has_full_row_ = full_.next();
    has_begun_ = true;
    while (has_full_row_ && time_of(full_) < time) has_full_row_ = full_.next();
    if (!has_full_row_ || time_of(full_) != time) return false;
    full_values_ = values_at(full_, time, has_full_row_);
    return true;
  }

  std::optional<Difference> compare(Time time, const std::vector<std::string>& values) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (values[i] == full_values_[i] || is_near(i, values[i], full_values_[i])) continue;
      return Difference{time,
                        fmt::format("'{}' is {} with skipping, and {} without it",
                                    system_.full_name(columns_[i].id), values[i], full_values_[i]),
                        columns_[i].id};
    }
    return std::nullopt;
  }

  bool is_near(std::size_t i, const std::string& one, const std::string& other) const {
    const Column& column = columns_[i];
    if (!column.is_real) return false;
    return core::agree_when_idle(std::strtod(one.c_str(), nullptr),
                                 std::strtod(other.c_str(), nullptr),
                                 column.absolute + column.relative * greatest_[i], greatest_[i]);
  }

  const core::System& system_;
  std::filesystem::path full_file_;
  CsvReader skipping_, full_;
  std::vector<Column> columns_;
  std::vector<double> greatest_;
  std::vector<std::string> full_values_;
  bool has_begun_ = false;
  bool has_full_row_ = false;
  std::size_t points_ = 0;
};

bool may_suspend(const scenario::RunPlan& loaded) {
  if (!loaded.options().may_skip_idle_time()) return false;
  for (std::size_t i = 0; i < loaded.system().components().size(); ++i) {
    if (loaded.options().idle.longest_suspension(loaded.system(), i)) return true;
  }
  return false;
}

std::string message_text(const CsvReader& reader) {
  return fmt::format("{} {} {} {}", value_of(reader, 0), value_of(reader, 2), value_of(reader, 3),
                     value_of(reader, 4));
}

std::optional<core::VariableId> variable_of(const core::System& system, const CsvReader& reader) {
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const core::Component& component = system.components()[i];
    if (component.name != value_of(reader, 2)) continue;
    const auto variable = component.description->find(value_of(reader, 3));
    if (variable) return core::VariableId{i, *variable};
  }
  return std::nullopt;
}

/// "a message of 'unit.variable' …"
Difference message_difference(const core::System& system, const CsvReader& reader,
                              const std::string& what) {
  return {time_of(reader),
          fmt::format("a message of '{}.{}' {}", value_of(reader, 2), value_of(reader, 3), what),
          variable_of(system, reader)};
}

/// Of the messages that both have; nothing if they are equal.
std::optional<Difference> message_difference(const core::System& system, const CsvReader& skipping,
                                             const CsvReader& full) {
  for (std::size_t i = 0; i < full.fields().size(); ++i) {
    if (value_of(skipping, i) == value_of(full, i)) continue;
    const bool is_other = message_text(skipping) != message_text(full);
    return message_difference(
        system, time_of(skipping) < time_of(full) ? skipping : full,
        is_other ? fmt::format("differs: it is '{}' with skipping, and '{}' without it",
                               message_text(skipping), message_text(full))
                 : fmt::format("is {} with skipping, and {} without it", value_of(skipping, i),
                               value_of(full, i)));
  }
  return std::nullopt;
}

/// The first difference of the messages; counts those that are equal.
std::optional<Difference> first_message(const core::System& system,
                                        const std::filesystem::path& skipping_file,
                                        const std::filesystem::path& full_file,
                                        std::size_t& count) {
  CsvReader skipping(skipping_file);
  CsvReader full(full_file);
  while (true) {
    const bool has_skipping = skipping.next();
    const bool has_full = full.next();
    if (!has_skipping && !has_full) return std::nullopt;
    if (!has_full) return message_difference(system, skipping, "is there with skipping only");
    if (!has_skipping) return message_difference(system, full, "is missing with skipping");
    if (auto difference = message_difference(system, skipping, full)) return difference;
    ++count;
  }
}

}  // namespace

std::string compare_with_full_run(const scenario::RunPlan& loaded,
                                  const core::RunStatistics& statistics,
                                  const results::ResultsTarget& skipping,
                                  const std::filesystem::path& full) {
  const auto& [folder, files] = skipping;
  std::optional<Difference> first;
  std::size_t messages = 0, points = 0;
  if (!files.events.empty()) {
    first = first_message(loaded.system(), folder / files.events, full / files.events, messages);
  }
  if (!files.signals.empty()) {
    SignalComparison signals(loaded, folder / files.signals, full / files.signals);
    const auto difference = signals.first();
    if (difference && (!first || difference->time <= first->time)) first = difference;
    points = signals.points();
  }
  if (first) {
    core::fail_run({.time = first->time},
                   "the results with and without idle skipping differ by more than skipping may "
                   "change: " +
                       first->text,
                   hint_on_cause(loaded.system(), statistics, first->id));
  }
  if (!may_suspend(loaded)) {
    spdlog::warn(
        "--check-idle has tested nothing: no unit can be suspended in this run (idle skipping "
        "needs units that promise to be idle, fixed or event-driven steps, Jacobi and held inputs, "
        "and must not be switched off)");
  }
  return fmt::format(
      "Idle skipping changes nothing but what tolerances allow: {} and {} agree with those in {}",
      core::counted(points, "communication point"),
      core::counted(messages == 0 ? 0 : messages - 1, "message"), full.string());
}

}  // namespace stride::cli
