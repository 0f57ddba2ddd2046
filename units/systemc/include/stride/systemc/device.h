// An sc_module with a kernel of its own.
#ifndef STRIDE_SYSTEMC_DEVICE_H
#define STRIDE_SYSTEMC_DEVICE_H

#include <memory>
#include <optional>
#include <type_traits>
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
  Device(Kernel::Log log, const char* name, Arguments&&... arguments)
      : Device(std::move(log), [&](Kernel&) {
          return std::make_unique<Module>(name, std::forward<Arguments>(arguments)...);
        }) {}

  /// `make(kernel)` returns the module, with channels bound to its ports that the kernel owns.
  template <class Make, std::enable_if_t<std::is_invocable_v<Make, Kernel&>, int> = 0>
  Device(Kernel::Log log, Make&& make) : kernel_(std::move(log)) {
    kernel_.within([&] { module_ = make(kernel_); });
    try {
      kernel_.initialize();
    } catch (...) {
      kernel_.end_threads();
      destroy_module();
      throw;
    }
  }

  ~Device() {
    kernel_.end_threads();
    destroy_module();
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
  void destroy_module() noexcept {
    try {
      kernel_.within([this] { module_.reset(); });
    } catch (const DeviceError&) {  // reported while it was destroyed
    }
  }

  Kernel kernel_;
  std::unique_ptr<Module> module_;
};

}  // namespace stride::systemc

#endif
