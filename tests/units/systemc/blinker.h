// Small devices for the tests of the SystemC kit.
#ifndef STRIDE_TESTS_UNITS_SYSTEMC_BLINKER_H
#define STRIDE_TESTS_UNITS_SYSTEMC_BLINKER_H

#include <memory>
#include <systemc>
#include <vector>

namespace blinker {

/// A clock, a thread and a method: counts its clock's rising edges.
class Blinker : public sc_core::sc_module {
 public:
  sc_core::sc_signal<bool> enable{"enable"};
  sc_core::sc_signal<int> edges{"edges"};

  Blinker(sc_core::sc_module_name name, double period_ns)
      : sc_module(name), clock_("clock", period_ns, sc_core::SC_NS) {
    SC_HAS_PROCESS(Blinker);
    SC_THREAD(count);
    SC_METHOD(watch);
    sensitive << enable;
    dont_initialize();
  }

  std::vector<sc_core::sc_time> changes;  ///< of enable

 private:
  void count() {
    for (;;) {
      wait(clock_.posedge_event());
      edges.write(edges.read() + 1);
    }
  }
  void watch() { changes.push_back(sc_core::sc_time_stamp()); }

  sc_core::sc_clock clock_;
};

/// Calls `action` at 1 us, in a thread or in a method.
class Actor : public sc_core::sc_module {
 public:
  Actor(sc_core::sc_module_name name, void (*action)(), bool in_thread)
      : sc_module(name), action_(action) {
    SC_HAS_PROCESS(Actor);
    if (in_thread) {
      SC_THREAD(act);
    } else {
      SC_METHOD(act);
      dont_initialize();
      sensitive << when_;
      when_.notify(1, sc_core::SC_US);
    }
    waits_ = in_thread;
  }

 private:
  void act() {
    if (waits_) wait(1, sc_core::SC_US);
    action_();
  }

  void (*action_)();
  bool waits_ = false;
  sc_core::sc_event when_{"when"};
};

/// Sets a flag when what lives on its thread's stack is destroyed.
class Owner : public sc_core::sc_module {
 public:
  Owner(sc_core::sc_module_name name, std::shared_ptr<int> object)
      : sc_module(name), object_(std::move(object)) {
    SC_HAS_PROCESS(Owner);
    SC_THREAD(hold);
  }

 private:
  void hold() {
    const std::shared_ptr<int> held = std::move(object_);
    wait();
  }

  std::shared_ptr<int> object_;
};

}  // namespace blinker

#endif
