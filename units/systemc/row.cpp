#define SC_INCLUDE_DYNAMIC_PROCESSES
#include <cstdlib>

#include <cxxabi.h>

#include <stride/systemc/row.h>
#include <stride/systemc/time.h>

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

}  // namespace

void fail_range(const std::string& value, const std::string& type, const std::string& range) {
  throw std::out_of_range(value + " does not fit into " + type + ", which hold " + range);
}

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

const sc_core::sc_object* ClockRow::connect(Kernel& kernel, sc_core::sc_module& module) {
  const Place<bool> place = find_(module);
  port_ = place.object;
  if (place.in == nullptr) {
    throw std::invalid_argument(std::string("clock() is for an sc_in<bool>, and ") + port_->name() +
                                " is a " + port_->kind());
  }
  current_period_ = period_();
  if (current_period_ < Duration(2)) {
    throw std::invalid_argument(std::string("the clock of ") + port_->name() +
                                " has a period of less than 2 ps");
  }
  auto clock = std::make_unique<sc_core::sc_clock>(
      sc_core::sc_gen_unique_name("clock"), to_sc_time(current_period_, ticks_per_picosecond()));
  clock_ = clock.get();
  kernel.own(std::move(clock));
  place.in->bind(*clock_);
  return port_;
}

void ClockRow::list_signals(SignalList& signals) const { signals.add_port(*port_, *clock_); }

const sc_core::sc_object* ResetRow::connect(Kernel& kernel, sc_core::sc_module& module) {
  const Place<bool> place = find_(module);
  port_ = place.object;
  if (place.in == nullptr) {
    throw std::invalid_argument(std::string("reset() is for an sc_in<bool>, and ") + port_->name() +
                                " is a " + port_->kind());
  }
  auto signal =
      std::make_unique<sc_core::sc_signal<bool>>(sc_core::sc_gen_unique_name("reset"), level_);
  signal_ = signal.get();
  kernel.own(std::move(signal));
  place.in->bind(*signal_);
  const sc_core::sc_time length = to_sc_time(length_, ticks_per_picosecond());
  sc_core::sc_spawn(
      [signal = signal_, after = !level_, length] {
        sc_core::wait(length);
        signal->write(after);
      },
      sc_core::sc_gen_unique_name("end_of_reset"));
  return port_;
}

void ResetRow::list_signals(SignalList& signals) const { signals.add_port(*port_, *signal_); }

}  // namespace stride::systemc::detail
