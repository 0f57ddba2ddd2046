// The gadget as an FMU, for the suites that run on each unit.
#include "tests/units/systemc/gadget_unit.h"

STRIDE_UNIT(gadget::GadgetUnit)
