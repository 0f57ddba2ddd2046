#define SC_INCLUDE_DYNAMIC_PROCESSES
#include <algorithm>
#include <stdexcept>
#include <vector>

#include <dlfcn.h>
#include <tlm_core/tlm_2/tlm_quantum/tlm_global_quantum.h>

#include <stride/systemc/kernel.h>
#include <stride/systemc/time.h>
#include <stride/systemc/timer.h>

#include "units/systemc/kernel_internals.h"
#include "units/systemc/sanitizer.h"

namespace stride::systemc {
namespace {

using sc_core::sc_process_handle;

constexpr const char* kTimers = "stride_timers";

/// Each before those that it has spawned.
void collect_threads(const std::vector<sc_core::sc_object*>& objects,
                     std::vector<sc_process_handle>& threads) {
  for (sc_core::sc_object* object : objects) {
    const sc_process_handle process(object);
    if (process.valid() && process.proc_kind() != sc_core::SC_METHOD_PROC_) {
      threads.push_back(process);
    }
    collect_threads(object->get_child_objects(), threads);
  }
}

void collect_clock_events(const std::vector<sc_core::sc_object*>& objects,
                          std::vector<const sc_core::sc_event*>& events) {
  for (const sc_core::sc_object* object : objects) {
    if (const auto* clock = dynamic_cast<const sc_core::sc_clock*>(object)) {
      for (const sc_core::sc_event* event : own_events(*clock)) events.push_back(event);
    }
    collect_clock_events(object->get_child_objects(), events);
  }
}

std::string file_of(const void* address) {
  Dl_info info{};
  return ::dladdr(address, &info) != 0 && info.dli_fname != nullptr ? info.dli_fname
                                                                    : "the program";
}

void require_same_systemc(const void* systemc) {
  if (systemc == &sc_core::sc_curr_simcontext) return;
  throw std::runtime_error(
      "its SystemC is " + file_of(systemc) +
      ", and units that were in this process before have brought another copy, " +
      file_of(&sc_core::sc_curr_simcontext) +
      ": a process can have one only; link all units with the same, or run these "
      "in a process that has had no others");
}

}  // namespace

Kernel* Kernel::active_ = nullptr;

Kernel::Entry::Entry(Kernel& kernel)
    : scope_(kernel.context_.get(), &Kernel::handle), previous_(active_) {
  active_ = &kernel;
  if (previous_ == &kernel) return;
  outer_quantum_ = tlm::tlm_global_quantum::instance().get();
  tlm::tlm_global_quantum::instance().set(kernel.quantum_);
}

Kernel::Entry::~Entry() {
  if (previous_ != active_) {
    active_->quantum_ = tlm::tlm_global_quantum::instance().get();
    tlm::tlm_global_quantum::instance().set(outer_quantum_);
  }
  active_ = previous_;
  if (previous_ == nullptr) restore_stack_bounds();
}

Kernel::Kernel(Log log, const void* systemc) : log_(std::move(log)) {
  require_same_systemc(systemc);
  const auto lock = lock_kernel();
  context_ = std::make_unique<sc_core::sc_simcontext>();
  within([this] { make_alarm(); });
}

Kernel::~Kernel() {
  const Entry entry(*this);
  alarm_.reset();
  owned_.clear();
  // the modules have cancelled their events; this gives them back to the kernel's pool
  sc_core::sc_time ignored;
  context_->next_time(ignored);
  context_.reset();
}

void Kernel::handle(const sc_core::sc_report& report, const sc_core::sc_actions& actions) {
  const bool error = report.get_severity() >= sc_core::SC_ERROR;
  if (!error && active_ != nullptr && active_->log_ &&
      (actions & (sc_core::SC_DISPLAY | sc_core::SC_LOG)) != 0) {
    active_->log_(report.get_severity(), active_->describe(report));
  }
  const bool stops = (actions & sc_core::SC_STOP) != 0;
  if (stops && !error) sc_core::sc_stop();
  if ((stops && error) || (actions & (sc_core::SC_THROW | sc_core::SC_ABORT)) != 0) {
    sc_core::sc_report_handler::default_handler(report, sc_core::SC_THROW);
  }
}

std::string Kernel::true_time(const sc_core::sc_time& kernel_time) const {
  return to_sc_time(to_duration(kernel_time) + skipped_ * ticks_).to_string();
}

std::string Kernel::describe(const sc_core::sc_report& report) const {
  std::string text = report.get_msg_type();
  if (*report.get_msg() != '\0') text += std::string(": ") + report.get_msg();
  if (report.get_process_name() != nullptr) {
    text += std::string(" (in ") + report.get_process_name() + ")";
  }
  return text + " at " + true_time(report.get_time());
}

void Kernel::fail(const std::string& message) {
  restore_stack_bounds();
  failure_ = message;
  throw DeviceError("the SystemC device failed: " + message);
}

void Kernel::require_usable() const {
  if (!failure_.empty()) {
    throw DeviceError("the SystemC device has failed before and cannot go on: " + failure_);
  }
}

void Kernel::initialize() {
  require_usable();
  within([this] {
    if (context_->get_status() == sc_core::SC_PAUSED) {
      fail("it called sc_start before it was complete; the unit runs the simulation");
    }
    ticks_ = systemc::ticks_per_picosecond();
    if (ticks_ == 0) {
      fail("its time resolution is coarser than 1 ps; let it use the default");
    }
    context_->elaborate();
    forget_reset_finders(*context_);
    context_->initialize(true);
    require_not_stopped();
    find_clocks();
    settle();
  });
  initialized_ = true;
}

// sc_start stops before the processes that are due at its last instant run
void Kernel::settle() {
  while (!has_stopped() && !at_rest()) sc_core::sc_start(sc_core::SC_ZERO_TIME);
}

bool Kernel::has_stopped() {
  if (!stopped_ && context_->sim_status() == sc_core::SC_SIM_USER_STOP) {
    stopped_ = now();
    allow_start_after_stop(*context_);
  }
  return stopped_.has_value();
}

void Kernel::require_not_stopped() {
  if (context_->sim_status() == sc_core::SC_SIM_USER_STOP) {
    fail(
        "it called sc_stop before a process ran; call it in a process, where the design has "
        "finished");
  }
}

void Kernel::add_clock(const sc_core::sc_event& edge) { clock_events_.push_back(&edge); }

void Kernel::find_clocks() {
  collect_clock_events(sc_core::sc_get_top_level_objects(context_.get()), clock_events_);
  std::sort(clock_events_.begin(), clock_events_.end());
}

void Kernel::require_not_before_now(Time to) const {
  require_usable();
  if (!initialized_) throw std::logic_error("initialize() comes before advance()");
  if (to < now()) {
    throw std::invalid_argument("SystemC cannot go back from " + decimal_seconds(now()) + " s to " +
                                decimal_seconds(to) + " s");
  }
}

Time Kernel::advance(Time to, bool may_stop_early) {
  require_not_before_now(to);
  within([&] {
    settle();
    if (approach(to, may_stop_early) == to) settle();
  });
  return now();
}

Time Kernel::approach(Time to, bool may_stop_early) {
  require_not_before_now(to);
  within([&] {
    horizon_ = to;
    set_alarm();
    const sc_core::sc_time end = to_kernel_time(to);
    while (!has_stopped() && context_->time_stamp() < end) {
      sc_core::sc_start(end - context_->time_stamp());
      if (has_stopped()) break;
      if (may_stop_early && context_->time_stamp() < end) {
        settle();
        withdraw_alarm();
        break;
      }
    }
  });
  return now();
}

sc_core::sc_time Kernel::to_kernel_time(Time time) const {
  return to_sc_time(time.time_since_epoch() - skipped(), ticks_);
}

Time Kernel::now() const { return Time(to_duration(context_->time_stamp(), ticks_) + skipped()); }

bool Kernel::at_rest() const {
  return !sc_core::sc_pending_activity_at_current_time(context_.get());
}

std::optional<Time> Kernel::next_event() {
  if (!at_rest()) return now();
  const std::optional<Time> timer = next_timer();
  const std::optional<Time> other = next_notification();
  return timer && other ? std::min(timer, other) : timer ? timer : other;
}

std::optional<Time> Kernel::next_timer() const {
  std::optional<Time> next;
  for (const Timer* timer : timers_) {
    const std::optional<Time> due = timer->due();
    if (due && *due > now() && (!next || *due < *next)) next = due;
  }
  return next;
}

std::optional<Time> Kernel::next_notification() {
  const Entry entry(*this);
  sc_core::sc_time next;
  if (!context_->next_time(next)) return std::nullopt;
  return Time(to_duration(next, ticks_) + skipped());
}

std::optional<Kernel::Span> Kernel::unclocked_notifications(Duration period) {
  const Entry entry(*this);
  std::optional<Span> span;
  for (const Notification& notification : pending_notifications(*context_)) {
    if (notification.event == alarm_.get()) continue;
    const Time due(to_duration(notification.time, ticks_) + skipped());
    const bool may_be_edge =
        clock_events_.empty()
            ? due <= now() + period
            : std::binary_search(clock_events_.begin(), clock_events_.end(), notification.event);
    if (may_be_edge) continue;
    span = span ? Span{std::min(span->first, due), std::max(span->last, due)} : Span{due, due};
  }
  return span;
}

void Kernel::skip(Duration duration) {
  require_usable();
  if (!initialized_ || !at_rest()) throw std::logic_error("only a device at rest can be skipped");
  if (duration < Duration{}) throw std::logic_error("a skip must not be negative");
  const std::optional<Time> timer = next_timer();
  if (timer && *timer <= now() + duration) {
    throw std::logic_error("a timer is due within the time that is to be skipped");
  }
  skipped_ += duration;
  if (is_traced_) advance_time_ = to_sc_time(skipped_, ticks_).value();
}

void Kernel::trace_skipped(sc_core::sc_trace_file* file, const char* name) {
  is_traced_ = true;
  advance_time_ = to_sc_time(skipped_, ticks_).value();
  sc_core::sc_trace(file, advance_time_, name);
}

// One process for all timers: they go off in the order of their construction, wherever the
// simulation was cut into steps; and what SystemC still has to notify, it notifies by itself.
void Kernel::make_alarm() {
  alarm_ = std::make_unique<sc_core::sc_event>("stride_alarm");
  sc_core::sc_spawn_options options;
  options.spawn_method();
  options.dont_initialize();
  options.set_sensitivity(alarm_.get());
  sc_core::sc_spawn([this] { ring(); }, kTimers, &options);
}

void Kernel::ring() {
  for (Timer* timer : timers_) {
    const std::optional<Time> due = timer->due();
    if (due && *due <= now()) timer->go_off();
  }
  set_alarm();
}

void Kernel::set_alarm() {
  const std::optional<Time> next = next_timer();
  if (next && *next <= horizon_) alarm_->notify(to_kernel_time(*next) - context_->time_stamp());
}

// so that it does not ring for a step that will not be made
void Kernel::withdraw_alarm() {
  alarm_->cancel();
  horizon_ = now();
}

void Kernel::set_quantum(Duration quantum) {
  const Entry entry(*this);
  tlm::tlm_global_quantum::instance().set(to_sc_time(quantum, ticks_));
}

void Kernel::write_traces() noexcept {
  if (!initialized_ || !failure_.empty() || !at_rest()) return;
  try {
    within([] { sc_core::sc_start(sc_core::sc_time::from_value(1)); });
  } catch (const DeviceError&) {  // a warning about the file that has been made an error
  }
}

void Kernel::end_threads() noexcept {
  const Entry entry(*this);
  if (!sc_core::sc_is_running(context_.get())) return;
  if (failure_.empty()) failure_ = "its threads have been ended";
  try {
    std::vector<sc_process_handle> threads;
    collect_threads(sc_core::sc_get_top_level_objects(context_.get()), threads);
    // a thread may use what is on the stack of the one that spawned it, as SC_JOIN does
    std::reverse(threads.begin(), threads.end());
    systemc::end_threads(*context_, threads, sc_process_handle(sc_core::sc_find_object(kTimers)));
  } catch (...) {  // a destructor of the device threw; the error can no longer be reported
  }
}

}  // namespace stride::systemc
