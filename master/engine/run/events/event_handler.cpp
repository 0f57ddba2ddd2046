#include "master/engine/run/events/event_handler.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/base/text/readable_text.h"
#include "master/engine/run/exchange/item_check.h"

namespace stride::core {
namespace {

/// Event iterations at one instant after which the run fails.
constexpr std::uint32_t kEventLimit = 1000;

/// By reference, since a copy of an optional value that was just written stalls the processor.
void bring_forward(Time& time, const std::optional<Time>& event) {
  if (event && *event < time) time = *event;
}

std::vector<Grid> step_grids(const RunContext& context) {
  const RunOptions& options = context.options;
  std::vector<Grid> grids;
  if (options.step.policy->has_grid) grids.emplace_back(options.start, options.step.size);
  for (const Component& component : context.system.components()) {
    if (component.own_step) grids.emplace_back(options.start, *component.own_step);
  }
  return grids;
}

}  // namespace

EventHandler::EventHandler(RunContext& context, IdleScheduler* idle, OwnSteps* own_steps)
    : system_(context.system),
      units_(context.units),
      exchange_(context.exchange),
      messages_(system_, units_, *this),
      texts_(capabilities<MessageText>(units_)),
      clocks_(system_, units_, step_grids(context)),
      observers_(context.observers),
      activities_(context.activities),
      statistics_(context.statistics),
      clock_(context.clock),
      idle_(idle),
      own_steps_(own_steps),
      active_(units_.size()),
      in_event_mode_(units_.size()),
      had_event_(units_.size()),
      polled_(units_.size()),
      next_event_(units_.size()) {
  for (std::size_t i = 0; i < count(); ++i) {
    if (!description(i).has_event_mode) continue;
    event_units_.push_back(i);
    if (exchange_.has_discrete_inputs(i)) discrete_units_.push_back(i);
  }
  if (own_steps_ != nullptr) {
    for (const ContinuousLink& link : exchange_.jumping_links()) {
      const std::size_t to = link.to.component;
      if (own_steps_->keeps(to) && description(to).has_event_mode) jumping_links_.push_back(link);
    }
  }
  evaluation_.emplace(context, Phase::Events, &UnitStatistics::event_time);
  if (!evaluation_->is_trivial()) return;
  evaluation_.reset();
  for (const ContinuousLink& link : exchange_.continuous_links()) {
    if (description(link.to.component).has_event_mode) links_.push_back(link);
  }
}

void EventHandler::begin() {
  for (const std::size_t i : event_units_) {
    activate(i);
    in_event_mode_[i] = has_event_ = true;
  }
  for (std::size_t i = 0; i < count(); ++i) exchange_.read_outputs(i, *units_[i]);
}

void EventHandler::persist(StateArchive& state, Time start, Time now) {
  state.mark("events");
  time_ = now;
  state.value(index_);
  state.fixed(event_units_, [&](std::size_t i) {
    state.value(next_event_[i]);
    if (next_event_[i] && *next_event_[i] <= now) state.fail("an event has not been handled");
  });
  update_announced();
  clocks_.persist(state, start, now);
  messages_.persist(state, now);
}

Time EventHandler::next_event(Time target) const {
  bring_forward(target, clocks_.next());
  bring_forward(target, announced_);
  return messages_.has_delivery(target) ? messages_.next_delivery() : target;
}

Time EventHandler::quiet_until() const {
  const bool may_be_any = idle_ != nullptr || !discrete_units_.empty() || has_active_ ||
                          had_any_event_ || !clocks_.is_settled();
  return may_be_any ? Time::min() : next_event(Time::max());
}

void EventHandler::begin_instant(Time time) {
  if (time != time_) index_ = 0;
  time_ = time;
  if (std::exchange(had_any_event_, false)) std::fill(had_event_.begin(), had_event_.end(), false);
  if (announced_ && *announced_ <= time) activate_announced();
  if (idle_ != nullptr) {
    for (const std::size_t i : idle_->advance_to(time)) request_event(i);
  }
  route();
}

void EventHandler::handle_events() {
  for (std::uint32_t count = 0; prepare_events(); ++count) {
    if (count == kEventLimit) fail_ticking();
    const bool terminates = event_iteration();
    exchange_after_events();
    ++index_;
    if (terminates) break;
  }
  if (has_event_) leave_event_mode();
  if (idle_ != nullptr) idle_->suspend_idle(time_);
}

/// A suspended unit that catches up has new outputs, which may end the suspension of others.
void EventHandler::route() {
  exchange_.route(time_);
  if (idle_ == nullptr) return;
  while (idle_->catch_up_disturbed(time_)) exchange_.route(time_);
}

void EventHandler::activate_announced() {
  for (const std::size_t i : event_units_) {
    if (next_event_[i] && *next_event_[i] <= time_) activate(i);
  }
}

void EventHandler::leave_event_mode() {
  for (const std::size_t i : event_units_) {
    had_event_[i] = in_event_mode_[i];
    if (!in_event_mode_[i]) continue;
    // FMI allows Step Mode only when no update is pending; the run ends in Event Mode then
    if (!active_[i]) units_[i]->enter_step_mode();
    in_event_mode_[i] = false;
    activities_.report({i, Activity::Kind::Event, time_, time_});
  }
  has_event_ = false;
  had_any_event_ = true;
  update_announced();
}

void EventHandler::update_announced() {
  announced_.reset();
  for (const std::size_t i : event_units_) {
    if (own_steps_ != nullptr) own_steps_->set_event(i, next_event_[i]);
    if (!next_event_[i]) continue;
    announced_ = std::min(*next_event_[i], announced_.value_or(*next_event_[i]));
  }
}

/// Puts the units with an event or a discrete change of an input into Event Mode and writes their
/// inputs. Returns whether another event iteration is needed.
bool EventHandler::prepare_events() {
  for (const std::size_t i : clocks_.due(time_)) activate(i);
  for (const std::size_t i : discrete_units_) {
    if (exchange_.has_discrete_change(i) && !must_wait(i)) activate(i);
  }
  const bool has_delivery = messages_.has_delivery(time_);
  if (!has_active_ && !has_event_ && !has_delivery) return false;
  for (const std::size_t i : event_units_) {
    if (in_event_mode_[i]) exchange_.write_inputs(i, *units_[i]);
    if (active_[i]) enter_event_mode(i);
  }
  make_assignments();
  return has_active_ || has_delivery;
}

void EventHandler::make_assignments() {
  for (const auto& [id, value] : assignments_) {
    units_[id.component]->set({&system_.variable(id).reference, 1}, *value);
  }
  assignments_.clear();
  for (const SentMessage* message : sent_) messages_.deliver(*message);
  sent_.clear();
}

void EventHandler::enter_event_mode(std::size_t i) {
  if (in_event_mode_[i]) return;
  catch_up(i, time_);
  units_[i]->enter_event_mode();
  in_event_mode_[i] = has_event_ = true;
  exchange_.write_inputs(i, *units_[i]);
}

void EventHandler::catch_up(std::size_t component, Time time) {
  if (idle_ != nullptr && idle_->is_suspended(component)) {
    idle_->catch_up_and_report(component, time);
  }
  if (own_steps_ == nullptr || !own_steps_->is_behind(component, time)) return;
  const bool ends = own_steps_->catch_up(component, time).terminate_simulation;
  if (ends) statistics_.end = RunEnd::EndedByUnit;
}

/// One super-dense instant: ticks with the values sampled at them, messages, then the units'
/// discrete states. `active_` are then the units that need another iteration. Returns whether a
/// unit requests the end of the simulation.
bool EventHandler::event_iteration() {
  bool terminates = false;
  ++statistics_.event_iterations;
  has_active_ = false;
  tick_clocks();
  exchange_messages();
  for (const std::size_t i : event_units_) {
    if (!in_event_mode_[i]) continue;
    const EventResult result = clock_.timed(statistics_.units[i].event_time,
                                            [&] { return units_[i]->update_discrete_states(); });
    ++statistics_.units[i].events;
    terminates |= result.terminate_simulation;
    next_event_[i] = result.next_event_time;
    const bool is_due = result.next_event_time && *result.next_event_time <= time_;
    active_[i] = result.discrete_states_need_update || is_due;
    has_active_ |= static_cast<bool>(active_[i]);
    clocks_.update(i, time_);
  }
  if (terminates) statistics_.end = RunEnd::EndedByUnit;
  return terminates;
}

/// A value between two ticking clocks is that of this instant. Without a loop it crosses each
/// connection once.
void EventHandler::tick_clocks() {
  const std::span<const std::size_t> ticking = clocks_.tick(time_);
  if (ticking.empty()) return;
  for (std::size_t pass = 0; pass <= system_.connections().size() + 1; ++pass) {
    if (!exchange_samples(ticking)) return;
  }
  fail_sample_loop(ticking);
}

/// One pass. Returns whether an input has yet to be written.
bool EventHandler::exchange_samples(std::span<const std::size_t> ticking) {
  for (const std::size_t i : ticking) {
    exchange_.write_sampled_inputs(i, *units_[i], clocks_.ticking(i));
  }
  for (const std::size_t i : ticking) {
    exchange_.read_sampled_outputs(i, *units_[i], clocks_.ticking(i));
  }
  exchange_.route(time_);
  return std::any_of(ticking.begin(), ticking.end(), [&](std::size_t i) {
    return exchange_.has_sampled_change(i, clocks_.ticking(i));
  });
}

/// A unit that is included may update outputs that are earlier in the order.
void EventHandler::exchange_after_events() {
  for (bool again = evaluation_.has_value(); again; again = has_new_participant_) {
    has_new_participant_ = false;
    evaluation_->run(time_, *this);
  }
  for (const std::size_t i : event_units_) {
    if (in_event_mode_[i]) exchange_.read_outputs(i, *units_[i]);
  }
  find_discontinuities(jumping_links_);
  if (evaluation_) return exchange_.check_values(time_);
  find_discontinuities(links_);
  route();
}

/// A change of a continuous output by an event is an event of the units that receive it.
void EventHandler::find_discontinuities(std::span<const ContinuousLink> links) {
  for (const auto& [from, to, source, target, conversion] : links) {
    if (!in_event_mode_[from.component] || exchange_.is_forced(to)) continue;
    const double value = conversion.factor * real(source) + conversion.offset;
    if (would_change(target, value)) on_discontinuity(to, false);
  }
}

/// FMI requires Event Mode where a continuous input is discontinuous; at once if an output depends
/// on the input.
void EventHandler::on_discontinuity(VariableId input, bool is_followed) {
  if (must_wait(input.component)) return;
  if (is_followed) include(input.component);
  activate(input.component);
}

bool EventHandler::include(std::size_t i) {
  if (in_event_mode_[i]) return false;
  enter_event_mode(i);
  activate(i);
  has_new_participant_ = true;
  return true;
}

/// What is sent at a tick may depend on the messages of this instant, so those of triggered clocks
/// are handed over before.
void EventHandler::exchange_messages() {
  messages_.begin_instant(time_);
  polled_ = in_event_mode_;
  messages_.deliver_delayed();
  transmit_triggered();
  for (const std::size_t i : event_units_) {
    if (const auto ticking = clocks_.ticking(i); !ticking.empty()) {
      messages_.transmit_ticks(i, ticking);
    }
  }
  transmit_triggered();
}

/// A clock that is set may make the receiver's own clocks tick at once, so these are read again.
void EventHandler::transmit_triggered() {
  for (bool again = true; again;) {
    again = false;
    for (const std::size_t i : event_units_) {
      if (!polled_[i]) continue;
      polled_[i] = false;
      again = true;
      messages_.transmit(i);
    }
  }
}

void EventHandler::receive(std::size_t receiver) {
  enter_event_mode(receiver);
  polled_[receiver] = true;
}

void EventHandler::report(VariableId id, bool received, const ValueBlock* block) {
  if (!received && block != nullptr) check_sent(id, *block);
  UnitStatistics& statistics = statistics_.units[id.component];
  ++(received ? statistics.messages_received : statistics.messages_sent);
  notify_observers(id, received, block);
}

void EventHandler::check_sent(VariableId id, const ValueBlock& block) const {
  if (has_nan(block)) fail_nan(id);
  check_items(system_, id, block, time_);
}

void EventHandler::report_disturbed(VariableId id, const std::string& text) {
  for (Observer* observer : observers_) observer->on_intervention(time_, index_, id, text);
}

void EventHandler::notify_observers(VariableId id, bool received, const ValueBlock* block) {
  Message message{time_, index_, id, received, block, 0};
  std::string content;
  if (block != nullptr && std::ranges::any_of(observers_, &Observer::wants_content)) {
    content = content_of(id, *block);
    message.content = content;
  }
  for (Observer* observer : observers_) observer->on_message(message);
}

/// A unit at the other end of a connection can describe the same bytes.
std::string EventHandler::content_of(VariableId id, const ValueBlock& block) const {
  if (block.type() != ValueType::Binary) return {};
  std::string content = described_by(id, block);
  for (const Connection& connection : system_.connections()) {
    if (!content.empty()) break;
    if (connection.from == id) content = described_by(connection.to, block);
    if (connection.to == id) content = described_by(connection.from, block);
  }
  return readable_text(content, kLongestContent);
}

/// The texts of all elements of an array, in their order.
std::string EventHandler::described_by(VariableId id, const ValueBlock& block) const {
  MessageText* const unit = texts_[id.component];
  if (unit == nullptr) return {};
  std::string text;
  for (const Binary& value : block.binaries()) {
    const std::string described = unit->describe_message(system_.variable(id).reference, value);
    if (!described.empty()) text.append(text.empty() ? "" : "; ").append(described);
  }
  return text;
}

void EventHandler::fail_nan(VariableId id) const {
  fail_run({{}, system_.components()[id.component].name, system_.variable(id).name, time_},
           "the unit sends NaN (not a number) to another unit",
           "look at what this unit received before this instant");
}

void EventHandler::fail_ticking() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count(); ++i) {
    if (active_[i]) names.push_back(system_.components()[i].name);
  }
  fail_run(
      {{}, {}, {}, time_},
      fmt::format("after {} event iterations at one instant these units still require another: "
                  "{}",
                  kEventLimit, quoted(names)),
      "look for messages or values that cause each other without any delay, and for units that "
      "announce an event for an instant that is not later than now");
}

void EventHandler::fail_sample_loop(std::span<const std::size_t> ticking) const {
  std::vector<std::string> names;
  for (const std::size_t i : ticking) {
    for (const VariableId id : exchange_.sampled_changes(i, clocks_.ticking(i))) {
      names.push_back(system_.full_name(id));
    }
  }
  fail_run({{}, {}, {}, time_},
           fmt::format("the values that are sampled at one instant do not settle: units feed each "
                       "other in an algebraic loop, through the inputs {}",
                       quoted(names)),
           "let the clocks of the units in the loop tick at different instants, or give one of the "
           "units an output that does not depend on its input");
}

}  // namespace stride::core
