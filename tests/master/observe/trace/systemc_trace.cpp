#include "tests/master/observe/trace/systemc_trace.h"

#include <string>
#include <systemc>

#include <stride/systemc/device.h>

namespace stride::trace {
namespace {

using sc_core::sc_time;

class Sleeper : public sc_core::sc_module {
 public:
  Sleeper(const sc_core::sc_module_name& name, const std::string& file, bool skips)
      : sc_module(name), skips_(skips), file_(sc_core::sc_create_vcd_trace_file(file.c_str())) {
    SC_HAS_PROCESS(Sleeper);
    SC_THREAD(live);
    file_->set_time_unit(1, sc_core::SC_PS);
    if (skips) sc_trace(file_, advance_time_, "advanceTime");
    sc_trace(file_, busy_, busy_.name());
    sc_trace(file_, count_, count_.name());
    sc_trace(file_, voltage_, voltage_.name());
    sc_trace(file_, bus_, bus_.name());
    sc_trace(file_, line_, line_.name());
    sc_trace(file_, done_, done_.name());
    sc_trace(file_, offset_, "offset");
  }
  ~Sleeper() override { sc_core::sc_close_vcd_trace_file(file_); }

  sc_time skipped() const {
    return sc_time::from_value(advance_time_.read());  // both are in picoseconds
  }

 private:
  void live() {
    for (int i = 0; i < 40; ++i) {
      work(i);
      rest(sc_time(1 + 37 * (i % 5), sc_core::SC_MS));
    }
  }

  void work(int i) {
    busy_ = true;
    for (int j = 0; j < 20; ++j) {
      wait(sc_time(20, sc_core::SC_NS));
      count_ = i * 20 + j;
      bus_ = j % 7 == 0 ? sc_dt::sc_lv<12>("XXXX0101ZZZZ") : sc_dt::sc_lv<12>(i * 91 + j);
      line_ = sc_dt::sc_logic("01ZX"[j % 4]);
      voltage_ = 3.0 / (i * 20 + j + 1);
      offset_ = -j;
    }
    busy_ = false;
    done_.notify();
    sc_core::sc_write_comment(file_, "burst " + std::to_string(i));
  }

  void rest(const sc_time& duration) {
    if (!skips_) return wait(duration);
    const sc_time kept(100, sc_core::SC_NS);
    wait(kept);
    advance_time_ = advance_time_.read() + (duration - kept).value();
  }

  bool skips_;
  sc_core::sc_trace_file* file_;
  sc_core::sc_signal<sc_dt::uint64> advance_time_{"advance_time", 0};
  sc_core::sc_signal<bool> busy_{"busy"};
  sc_core::sc_signal<sc_dt::sc_uint<10>> count_{"count"};
  sc_core::sc_signal<double> voltage_{"voltage"};
  sc_core::sc_signal<sc_dt::sc_lv<12>> bus_{"bus"};
  sc_core::sc_signal<sc_dt::sc_logic> line_{"line"};
  sc_core::sc_event done_{"done"};
  int offset_ = 0;
};

}  // namespace

void write_systemc_trace(const std::filesystem::path& file, bool skips) {
  const std::string stem = (file.parent_path() / file.stem()).string();
  systemc::Device<Sleeper> device({}, "sleeper", stem, skips);
  const Time end = time_from_seconds(5);
  constexpr Duration kWorkIsOver{1'000'000'000'000};
  if (!skips) {
    device.advance(end);
    return;
  }
  device.advance(Time(kWorkIsOver));
  const auto skipped = device.within([](Sleeper& sleeper) { return sleeper.skipped(); });
  device.advance(end - Duration(static_cast<std::int64_t>(skipped.value())));
}

}  // namespace stride::trace
