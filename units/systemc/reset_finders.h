#ifndef STRIDE_UNITS_SYSTEMC_RESET_FINDERS_H
#define STRIDE_UNITS_SYSTEMC_RESET_FINDERS_H

#include <systemc>

namespace stride::systemc {

/// To be called when a context has been elaborated. SystemC up to 2.3.4 deletes then what
/// reset_signal_is() has noted of ports, but keeps the pointer, and deletes it again with the
/// context; a program that ends with its simulation is not affected.
void forget_reset_finders(sc_core::sc_simcontext& context);

}  // namespace stride::systemc

#endif
