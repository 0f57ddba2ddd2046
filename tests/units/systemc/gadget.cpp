// The gadget as an FMU, for the suites that run on each unit: they take seconds of its time, so its
// clock is slow.
#include "tests/units/systemc/gadget_unit.h"

namespace {

class SlowGadget : public gadget::GadgetUnit {
 public:
  SlowGadget() : GadgetUnit(stride::Duration(20'000'000)) {}
};

}  // namespace

STRIDE_UNIT(SlowGadget)
