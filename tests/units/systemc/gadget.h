// A device as others write them, with ports of many types, a private submodule and FIFOs.
#ifndef STRIDE_TESTS_UNITS_SYSTEMC_GADGET_H
#define STRIDE_TESTS_UNITS_SYSTEMC_GADGET_H

#include <cstdint>
#include <string>
#include <systemc>

namespace gadget {

/// A converter that the gadget does not connect on one side: its temperature stays open.
class Converter : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<double> temperature{"temperature"};
  sc_core::sc_out<sc_dt::sc_uint<12>> code{"code"};

  explicit Converter(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Converter);
    SC_METHOD(convert);
    sensitive << clk.pos();
    dont_initialize();
  }

 private:
  void convert() {
    state_.write(state_.read() == kOdd ? kEven : kOdd);
    code.write(static_cast<unsigned>(temperature.read() * 16));
  }

  enum State { kEven, kOdd };
  sc_core::sc_signal<State> state_{"state"};
};

/// Counts its clock's edges outside of reset, echoes what comes through its FIFO one clock later,
/// and passes values of many types on.
class Gadget : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> clk{"clk"};
  sc_core::sc_in<bool> rst_n{"rst_n"};
  sc_core::sc_in<sc_dt::sc_uint<4>> step{"step"};
  sc_core::sc_in<sc_dt::sc_int<12>> offset{"offset"};
  sc_core::sc_in<sc_dt::sc_logic> level{"level"};
  sc_core::sc_in<sc_dt::sc_lv<4>> bus{"bus"};
  sc_core::sc_out<std::uint32_t> count{"count"};
  sc_core::sc_out<sc_dt::sc_bv<40>> wide{"wide"};
  sc_core::sc_out<sc_dt::sc_logic> level_out{"level_out"};
  sc_core::sc_out<sc_dt::sc_lv<4>> bus_out{"bus_out"};
  sc_core::sc_fifo_in<unsigned char> rx{"rx"};
  sc_core::sc_fifo_out<unsigned char> tx{"tx"};

  double charge = 3;

  explicit Gadget(sc_core::sc_module_name name, int scale = 1)
      : sc_module(name), converter("converter"), scale_(scale) {
    converter.clk(clk);
    converter.code(code_);
    SC_HAS_PROCESS(Gadget);
    SC_METHOD(on_clock);
    sensitive << clk.pos();
    dont_initialize();
    SC_METHOD(pass_on);
    sensitive << level << bus;
    SC_THREAD(echo);
  }

  double current() const { return 0.5 * scale_; }

  Converter converter;

 private:
  void on_clock() {
    if (!rst_n.read()) return;
    count.write(count.read() + static_cast<std::uint32_t>(step.read() * scale_));
    wide.write(static_cast<sc_dt::uint64>(offset.read() + 2048) << 28);
  }
  void pass_on() {
    level_out.write(level.read());
    bus_out.write(bus.read());
  }
  void echo() {
    for (;;) {
      const unsigned char byte = rx.read();
      wait(100, sc_core::SC_NS);
      tx.write(byte);
    }
  }

  int scale_;
  sc_core::sc_signal<sc_dt::sc_uint<12>> code_{"code"};
};

}  // namespace gadget

#endif
