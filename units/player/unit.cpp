// The player as an FMU. Its variable table comes from the stimuli in its resources.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <stride/unit.h>

#include "units/player/model.h"

namespace {

/// An item of an Enumeration, whichever it is.
enum class Item : std::int64_t {};

std::filesystem::path stimuli_file(const std::filesystem::path& resources) {
  if (resources.empty()) {
    throw std::runtime_error(
        "the player has no resources folder: expected one with stimuli.csv, which `stride run "
        "--capture COMPONENT=stimuli.csv` writes");
  }
  return resources / "stimuli.csv";
}

/// The elements of one output, and how they are set.
class Output {
 public:
  virtual ~Output() = default;
  /// Values of the input, from this one on.
  virtual void show(const player::Values& values, std::size_t first) = 0;
  /// Of a floating-point number.
  virtual void show(double number) = 0;
};

template <class T, class Source>
class OutputOf final : public Output {
 public:
  explicit OutputOf(std::size_t size) : size_(size), elements_(std::make_unique<T[]>(size)) {}
  T* elements() { return elements_.get(); }
  void show(const player::Values& values, std::size_t first) override {
    const auto& list = std::get<std::vector<Source>>(values);
    for (std::size_t i = 0; i < size_; ++i) elements_[i] = static_cast<T>(list[first + i]);
  }
  void show(double number) override {
    if constexpr (std::is_floating_point_v<T>) elements_[0] = static_cast<T>(number);
  }

 private:
  std::size_t size_;
  std::unique_ptr<T[]> elements_;
};

}  // namespace

class PlayerUnit : public stride::Unit {
 public:
  explicit PlayerUnit(const stride::Setup& setup)
      : stimuli_(player::load_stimuli(stimuli_file(setup.resources).string())),
        playback_(stimuli_),
        outputs_(stimuli_.inputs.size()),
        slopes_(stimuli_.inputs.size()),
        clocks_(stimuli_.inputs.size()) {
    auto& info = describe(origin_text());
    info.split_invariant = true;
    info.promises_idle = true;
    if (has_values() && stimuli_.begin != stride::Time{}) info.default_start = stimuli_.begin;
    if (stimuli_.begin < stimuli_.end()) info.default_stop = stimuli_.end();
    for (std::size_t i = 0; i < stimuli_.inputs.size(); ++i) list_clock(i);
    for (std::size_t i = 0; i < stimuli_.inputs.size(); ++i) list_value(i);
    state(playback_.position());
    if (stimuli_.is_table) {
      state(slopes_);
    } else {
      list_origin();
    }
    show_start_values();
  }

  void initialize(stride::Time start) override {
    show_start_values();
    playback_.begin(start, [this](const player::Entry& entry) { play(entry); });
    follow_curves(start);
    const bool has_ticks = !stimuli_.is_table || has_clock();
    if (start <= stimuli_.start() || !has_ticks) return;
    warn_once(told_start_, "the stimuli begin at " + text(stimuli_.start()) + " s, the run at " +
                               text(start) + " s, so what ticked before is not played");
  }

  void step(stride::Step& step) override {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (const auto& curve = stimuli_.inputs[i].curve) {
        outputs_[i]->show(curve->before(step.to()));
        slopes_[i] = curve->at(step.to()).slope;
      }
    }
    if (play_until(step.to())) step.need_event();
  }

  void event(stride::Event& event) override {
    playback_.iterate(event.time(), [this](const player::Entry& entry) { play(entry); });
    follow_curves(event.time());
    report();
    if (playback_.has_more(event.time())) return event.iterate();
    const auto next = stop_at_stimuli_ ? playback_.following() : playback_.target();
    next ? event.next_event(*next) : event.no_next_event();
  }

  stride::Time idle_until(stride::Time now) const override {
    stride::Time until = playback_.following().value_or(stride::Time::max());
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      const player::Input& input = stimuli_.inputs[i];
      if (!input.curve) continue;
      if (input.type == player::Type::Float32 && slopes_[i] != 0) return now;  // it has no tangent
      until = std::min(until, input.curve->next(now).value_or(stride::Time::max()));
    }
    return until;
  }

 private:
  static std::string text(stride::Time time) {
    char digits[32];
    const double seconds = stride::to_seconds(time);
    const auto fixed = std::chars_format::fixed;
    return {digits, std::to_chars(digits, digits + sizeof digits, seconds, fixed).ptr};
  }

  std::string origin_text() const {
    if (stimuli_.is_table) return "Plays a table of values over time";
    return "Plays to '" + stimuli_.unit + "' what '" + stimuli_.component + "' received in '" +
           stimuli_.system + "'";
  }

  /// Outside of messages, so that it says something of each instant.
  bool has_values() const {
    return std::any_of(stimuli_.inputs.begin(), stimuli_.inputs.end(), [](const auto& input) {
      return !input.clock && input.type != player::Type::Clock;
    });
  }

  bool has_clock() const {
    return std::any_of(clocks_.begin(), clocks_.end(),
                       [](const auto& clock) { return clock != nullptr; });
  }

  void follow_curves(stride::Time now) {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (!stimuli_.inputs[i].curve) continue;
      const auto [value, slope] = stimuli_.inputs[i].curve->at(now);
      outputs_[i]->show(value);
      slopes_[i] = slope;
    }
  }

  void list_clock(std::size_t i) {
    const player::Input& input = stimuli_.inputs[i];
    if (input.type != player::Type::Clock) return;
    clocks_[i] = std::make_unique<stride::Clock>();
    output(input.name, *clocks_[i])
        .description(stimuli_.is_table ? "ticks in each row with a message"
                                       : "ticks as that of the captured unit");
  }

  void list_value(std::size_t i) {
    const player::Input& input = stimuli_.inputs[i];
    if (input.type == player::Type::Clock) return;
    auto row = add_output(i);
    row.depends_on({}).description(stimuli_.is_table ? "a column of the table"
                                                     : "as the captured unit received it");
    if (!input.unit.empty()) row.unit(input.unit);
    if (!input.items.empty()) row.items(input.items);
    if (!input.is_continuous) row.discrete();
    if (input.clock) row.clocked_by(*clocks_[*input.clock]);
    if (!input.curve || input.type != player::Type::Float64) return;
    row.derivative(slopes_[i]).tolerance(tangent_tolerance(*input.curve));
  }

  /// Of rounding alone.
  static double tangent_tolerance(const player::Curve& curve) {
    constexpr double kRelative = 1e-12;
    return kRelative * std::max(curve.magnitude(), 1.0);
  }

  stride::VariableBuilder add_output(std::size_t i) {
    if (stimuli_.inputs[i].type == player::Type::Enumeration) {
      return add_output<Item, std::int64_t>(i);
    }
    return std::visit(
        [&](const auto& list) {
          return add_output<typename std::decay_t<decltype(list)>::value_type>(i);
        },
        stimuli_.inputs[i].values);
  }
  template <class T, class Source = T>
  stride::VariableBuilder add_output(std::size_t i) {
    const player::Input& input = stimuli_.inputs[i];
    auto made = std::make_unique<OutputOf<T, Source>>(input.size);
    T* const elements = made->elements();
    outputs_[i] = std::move(made);
    if (input.dimensions.empty()) return output(input.name, *elements);
    return output(input.name, elements, input.size).dimensions(input.dimensions);
  }
  void list_origin() {
    const auto constant = [this](const char* name, std::string& text, const char* meaning) {
      local(name, text).constant().description(meaning);
    };
    constant("captured.unit", stimuli_.unit, "model of the unit that received them");
    constant("captured.component", stimuli_.component, "its name in its system");
    constant("captured.system", stimuli_.system, "the system");
    parameter("stop_at_stimuli", stop_at_stimuli_)
        .description("a communication point at each stimulus: for another unit than that one");
  }

  void show_start_values() {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      const player::Input& input = stimuli_.inputs[i];
      if (outputs_[i]) outputs_[i]->show(input.values, 0);
      if (input.curve) outputs_[i]->show(input.curve->first());
    }
  }

  bool play_until(stride::Time now) {
    return playback_.play_until(now, [this](const player::Entry& entry) { play(entry); });
  }
  void play(const player::Entry& entry) {
    if (entry.kind == player::Entry::Kind::Tick) return clocks_[entry.input]->tick();
    if (entry.kind == player::Entry::Kind::Jump) return;  // see follow_curves()
    outputs_[entry.input]->show(stimuli_.inputs[entry.input].values, entry.first);
  }

  /// From event() only, because a step may be taken back.
  void report() {
    player::Playback::Position& position = playback_.position();
    if (position.late >= 0) {
      const auto& entry = stimuli_.entries[static_cast<std::size_t>(position.late)];
      warn_once(told_late_, "what the captured unit received at " + text(entry.time) +
                                " s, where it stopped by itself, comes late: the unit that it is "
                                "played to does not stop there (see stop_at_stimuli)");
    }
    if (position.beside != player::kNowhere) {
      warn_once(told_beside_, "there is a communication point at " + text(position.beside) +
                                  " s where the captured unit had none, so steps are cut otherwise "
                                  "than they were; let the step policy be event-driven");
    }
    position.late = -1;
    position.beside = player::kNowhere;
  }

  void warn_once(bool& has_warned, const std::string& message) const {
    if (!std::exchange(has_warned, true)) log(stride::Severity::Warning, message);
  }

  player::Stimuli stimuli_;
  player::Playback playback_;
  std::vector<std::unique_ptr<Output>> outputs_;        ///< by input; none of clocks
  std::vector<double> slopes_;                          ///< by input; of curves only
  std::vector<std::unique_ptr<stride::Clock>> clocks_;  ///< by input; of clocks only
  bool stop_at_stimuli_ = false;
  bool told_start_ = false;
  bool told_late_ = false;
  bool told_beside_ = false;
};

STRIDE_UNIT(PlayerUnit)
