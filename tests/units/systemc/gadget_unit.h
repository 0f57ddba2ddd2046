#ifndef STRIDE_TESTS_UNITS_SYSTEMC_GADGET_UNIT_H
#define STRIDE_TESTS_UNITS_SYSTEMC_GADGET_UNIT_H

#include <stride/systemc/module_unit.h>

#include "tests/units/systemc/gadget.h"

namespace gadget {

/// One row of each kind.
class GadgetUnit : public stride::systemc::ModuleUnit<Gadget> {
 public:
  explicit GadgetUnit(stride::Duration period = stride::Duration(100'000))
      : ModuleUnit("gadget", "A gadget") {
    parameter("scale", scale_);
    construct(scale_);
    clock(&Gadget::clk, period);
    reset(&Gadget::rst_n, stride::Duration(1'050'000), false);
    input("step", &Gadget::step, 1);
    input("offset", &Gadget::offset);
    input("level", &Gadget::level, stride::systemc::Logic::Z);
    input("bus", &Gadget::bus);
    input("converter.temperature", &temperature).unit("degC");
    output("count", &Gadget::count);
    output("wide", &Gadget::wide);
    output("level_out", &Gadget::level_out);
    output("bus_out", &Gadget::bus_out);
    output("code", stride::systemc::inner<sc_dt::sc_uint<12>>("code"));
    output("converter.code", &converter_code);
    output("charge", &Gadget::charge).unit("C");
    output("current", &Gadget::current).unit("A");
    output("doubled", [](const Gadget& g) { return 2 * g.charge; });
    message_input("rx.data", &Gadget::rx, 4);
    message_output("tx.data", &Gadget::tx);
  }

 private:
  static sc_core::sc_in<double>& temperature(Gadget& g) { return g.converter.temperature; }
  static sc_core::sc_out<sc_dt::sc_uint<12>>& converter_code(Gadget& g) { return g.converter.code; }

  int scale_ = 1;
};

}  // namespace gadget

#endif
