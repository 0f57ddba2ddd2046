#ifndef STRIDE_UNITS_SYSTEMC_SANITIZER_H
#define STRIDE_UNITS_SYSTEMC_SANITIZER_H

namespace stride::systemc {

/// Informs AddressSanitizer that this thread is back on its own stack. SystemC announces the switch
/// to a device's thread, but returns from it without saying where to. Does nothing in other builds.
void restore_stack_bounds();

}  // namespace stride::systemc

#endif
