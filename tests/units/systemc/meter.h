// A device as others write them: it has a clock of its own, samples its inputs at that clock's
// edges, and adds up its charge cycle by cycle. It knows nothing of idle skipping.
#ifndef STRIDE_TESTS_UNITS_SYSTEMC_METER_H
#define STRIDE_TESTS_UNITS_SYSTEMC_METER_H

#include <systemc>
#include <vector>

#include <stride/systemc/time.h>
#include <stride/time.h>

namespace meter {

constexpr stride::Duration kPeriod{20'000};
constexpr double kSleepCurrent = 2e-6;  ///< [A]
constexpr double kBusyCurrent = 1e-3;   ///< [A]
constexpr int kBusyCycles = 300;

/// A rising `request` makes it busy for 300 cycles.
class Meter : public sc_core::sc_module {
 public:
  sc_core::sc_signal<bool> request{"request"};
  sc_core::sc_signal<bool> busy{"busy"};
  sc_core::sc_signal<int> measurements{"measurements"};
  double charge = 400e-6;  ///< [C]

  /// `leakage_time`: of the charge, exponentially [s]; 0: none.
  explicit Meter(sc_core::sc_module_name name, double leakage_time = 0)
      : sc_module(name), leakage_time_(leakage_time) {
    SC_HAS_PROCESS(Meter);
    SC_METHOD(on_clock);
    sensitive << clock_.posedge_event();
    dont_initialize();
  }

  double current() const { return (remaining_ > 0 ? kBusyCurrent : kSleepCurrent) + leakage(); }
  double leakage() const { return leakage_time_ > 0 ? charge / leakage_time_ : 0; }
  double leakage_time() const { return leakage_time_; }
  bool sleeps() const { return remaining_ == 0 && request.read() == requested_; }

  std::vector<stride::Time> edges;
  std::vector<stride::Time> done;

 private:
  void on_clock() {
    edges.push_back(stride::systemc::current_time());
    charge -= current() * stride::to_seconds(kPeriod);
    if (remaining_ > 0 && --remaining_ == 0) finish();
    if (request.read() && !requested_) remaining_ = kBusyCycles;
    requested_ = request.read();
    busy.write(remaining_ > 0);
  }
  void finish() {
    measurements.write(measurements.read() + 1);
    done.push_back(stride::systemc::current_time());
  }

  sc_core::sc_clock clock_{"clock", 20, sc_core::SC_NS};
  double leakage_time_;
  bool requested_ = false;
  int remaining_ = 0;
};

}  // namespace meter

#endif
