#define SC_INCLUDE_DYNAMIC_PROCESSES
#include <cstdlib>
#include <memory>
#include <utility>

#include <cxxabi.h>

#include <stride/systemc/row.h>
#include <stride/systemc/time.h>
#include <stride/systemc/timer.h>

namespace stride::systemc::detail {
namespace {

std::string names_of(const sc_core::sc_object& module, const std::string& prefix) {
  std::string names;
  for (const sc_core::sc_object* child : module.get_child_objects()) {
    const std::string name = prefix + child->basename();
    const bool is_module = dynamic_cast<const sc_core::sc_module*>(child) != nullptr;
    const bool is_port = dynamic_cast<const sc_core::sc_port_base*>(child) != nullptr;
    const bool is_channel = dynamic_cast<const sc_core::sc_interface*>(child) != nullptr;
    const std::string inner = is_module ? names_of(*child, name + ".") : "";
    if (is_port || (is_channel && !is_module)) names += (names.empty() ? "" : ", ") + name;
    if (!inner.empty()) names += (names.empty() ? "" : ", ") + inner;
  }
  return names;
}

std::string readable(const char* type) {
  int status = 0;
  char* const name = abi::__cxa_demangle(type, nullptr, nullptr, &status);
  const std::string text = status == 0 ? name : type;
  std::free(name);
  return text;
}

template <class T>
void require_in(const Place<T>& place, const char* row) {
  if (place.in != nullptr) return;
  throw std::invalid_argument(std::string(row) +
                              " is for an sc_in<bool> or an sc_in<sc_logic>, and " +
                              place.object->name() + " is a " + place.object->kind());
}

sc_core::sc_signal_in_if<bool>& make_clock(Kernel& kernel, const sc_core::sc_object& /*port*/,
                                           Duration period, bool) {
  auto clock = std::make_unique<sc_core::sc_clock>(sc_core::sc_gen_unique_name("clock"),
                                                   to_sc_time(period, ticks_per_picosecond()));
  auto& kept = *clock;
  kernel.own(std::move(clock));
  return kept;
}

/// As an sc_clock, which there is for bool only.
sc_core::sc_signal_in_if<sc_dt::sc_logic>& make_clock(Kernel& kernel,
                                                      const sc_core::sc_object& port,
                                                      Duration period, sc_dt::sc_logic) {
  auto& signal = make_signal(kernel, port, sc_dt::sc_logic(false));
  auto tick = std::make_shared<sc_core::sc_event>(sc_core::sc_gen_unique_name("edge"));
  kernel.own(tick);
  kernel.add_clock(*tick);
  const sc_core::sc_time high = to_sc_time(period / 2, ticks_per_picosecond());
  const sc_core::sc_time low = to_sc_time(period - period / 2, ticks_per_picosecond());
  sc_core::sc_spawn_options options;
  options.spawn_method();
  options.dont_initialize();
  options.set_sensitivity(tick.get());
  sc_core::sc_spawn(
      [&signal, edge = tick.get(), high, low, level = std::make_shared<bool>(false)] {
        *level = !*level;
        signal.write(sc_dt::sc_logic(*level));
        edge->notify(*level ? high : low);
      },
      sc_core::sc_gen_unique_name("clock"), &options);
  tick->notify(sc_core::SC_ZERO_TIME);
  return signal;
}

}  // namespace

sc_core::sc_object& find_below(const sc_core::sc_object& module, const std::string& name) {
  sc_core::sc_object* const object =
      sc_core::sc_find_object((std::string(module.name()) + "." + name).c_str());
  if (object != nullptr) return *object;
  throw std::invalid_argument("the module has no port or signal " + name + "; it has " +
                              names_of(module, ""));
}

void fail_type(const sc_core::sc_object& object, const char* type) {
  throw std::invalid_argument(std::string(object.name()) + " is a " + object.kind() +
                              ", but no port or signal of the type " + readable(type));
}

void pause_on_change(sc_core::sc_port_base* port, sc_core::sc_interface* channel,
                     bool& has_changed) {
  sc_core::sc_spawn_options options;
  options.spawn_method();
  options.dont_initialize();
  if (port != nullptr) {
    options.set_sensitivity(port);
  } else {
    options.set_sensitivity(channel);
  }
  sc_core::sc_spawn(
      [&has_changed] {
        has_changed = true;
        sc_core::sc_pause();
      },
      sc_core::sc_gen_unique_name("change"), &options);
}

template <class T>
void ClockRowOf<T>::connect(Elaboration& elaboration) {
  const Place<T> place = find_(elaboration.module());
  port_ = place.object;
  require_in(place, "clock()");
  current_period_ = period_();
  if (current_period_ < Duration(2)) {
    throw std::invalid_argument(std::string("the clock of ") + port_->name() +
                                " has a period of less than 2 ps");
  }
  elaboration.take(*port_, name());
  clock_ = &make_clock(elaboration.kernel(), *port_, current_period_, T());
  place.in->bind(*clock_);
}

template <class T>
void ResetRow<T>::connect(Elaboration& elaboration) {
  const Place<T> place = find_(elaboration.module());
  port_ = place.object;
  require_in(place, "reset()");
  elaboration.take(*port_, name());
  signal_ = &make_signal(elaboration.kernel(), *port_, T(level_));
  signal_->write(T(level_));
  place.in->bind(*signal_);
  // exact over skips of idle time
  auto timer = std::make_shared<Timer>(sc_core::sc_gen_unique_name("end_of_reset"));
  sc_core::sc_spawn_options options;
  options.spawn_method();
  options.dont_initialize();
  options.set_sensitivity(&timer->event());
  sc_core::sc_spawn([signal = signal_, after = T(!level_)] { signal->write(after); },
                    sc_core::sc_gen_unique_name("reset"), &options);
  timer->set(Time(length_));
  elaboration.kernel().own(std::move(timer));
}

template class ClockRowOf<bool>;
template class ClockRowOf<sc_dt::sc_logic>;
template class ResetRow<bool>;
template class ResetRow<sc_dt::sc_logic>;

}  // namespace stride::systemc::detail
