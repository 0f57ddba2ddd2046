// An sc_module with a kernel of its own.
#ifndef STRIDE_SYSTEMC_DEVICE_H
#define STRIDE_SYSTEMC_DEVICE_H

#include <memory>
#include <optional>
#include <utility>

#include <stride/systemc/kernel.h>

namespace stride::systemc {

/// Makes a Module inside a fresh kernel, and destroys both in the right order.
template <class Module>
class Device {
 public:
  /// `name` is the module's name; the other arguments follow it in Module's constructor. Throws
  /// DeviceError if elaboration fails.
  template <class... Arguments>
  Device(Kernel::Log log, const char* name, Arguments&&... arguments) : kernel_(std::move(log)) {
    kernel_.within(
        [&] { module_ = std::make_unique<Module>(name, std::forward<Arguments>(arguments)...); });
    kernel_.initialize();
  }

  ~Device() {
    kernel_.end_threads();
    try {
      kernel_.within([this] { module_.reset(); });
    } catch (const DeviceError&) {  // reported while it was destroyed
    }
  }

  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// Calls f(module) in the device's context.
  template <class Function>
  decltype(auto) within(Function&& f) {
    return kernel_.within([&]() -> decltype(auto) { return f(*module_); });
  }

  Time advance(Time to, bool may_stop_early = false) { return kernel_.advance(to, may_stop_early); }
  Time now() const { return kernel_.now(); }
  std::optional<Time> next_event() { return kernel_.next_event(); }

  Kernel& kernel() { return kernel_; }
  Module& module() { return *module_; }

 private:
  Kernel kernel_;
  std::unique_ptr<Module> module_;
};

}  // namespace stride::systemc

#endif
