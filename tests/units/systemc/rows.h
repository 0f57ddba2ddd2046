// Units of a few rows, for the tests of these.
#ifndef STRIDE_TESTS_UNITS_SYSTEMC_ROWS_H
#define STRIDE_TESTS_UNITS_SYSTEMC_ROWS_H

#include <memory>

#include <stride/systemc/module_unit.h>

#include "tests/units/systemc/unit_driver.h"

namespace stride::tests {

/// A unit whose constructor is the function, for one row at a time.
template <class Module>
class Rows : public systemc::ModuleUnit<Module> {
  using Base = systemc::ModuleUnit<Module>;

 public:
  template <class Function>
  explicit Rows(Function list) : Base("device", "A device") {
    list(*this);
  }
  using Base::bind;
  using Base::clock;
  using Base::construct;
  using Base::construct_by;
  using Base::idle_when;
  using Base::input;
  using Base::inputs;
  using Base::message_input;
  using Base::message_output;
  using Base::output;
  using Base::outputs;
  using Base::reset;
  using Base::tie;
};

template <class Module, class Function>
UnitDriver driver_of(Function list) {
  return UnitDriver(std::make_unique<Rows<Module>>(list));
}

}  // namespace stride::tests

#endif
