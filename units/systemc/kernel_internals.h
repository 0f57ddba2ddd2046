// What SystemC keeps to itself, and a kernel among others has to know.
#ifndef STRIDE_UNITS_SYSTEMC_KERNEL_INTERNALS_H
#define STRIDE_UNITS_SYSTEMC_KERNEL_INTERNALS_H

#include <array>
#include <cstdint>
#include <systemc>
#include <vector>

namespace stride::systemc {

/// To be called when a context has been elaborated. SystemC up to 2.3.4 deletes then what
/// reset_signal_is() has noted of ports, but keeps the pointer, and deletes it again with the
/// context; a program that ends with its simulation is not affected.
void forget_reset_finders(sc_core::sc_simcontext& context);

/// After sc_stop(), SystemC starts no process any more. Withdraws this, so that threads can be
/// ended and the last values be traced. To be called outside of all processes.
void allow_start_after_stop(sc_core::sc_simcontext& context);

/// Ends threads at once, in this order, so that what is on their stacks is destroyed; no other
/// process runs any more, then or later. One that has not begun ends without having begun: a
/// SystemC that is built with POSIX threads would wait for it in the destructor of the context.
/// `method` is any process of this kind, in whose name it is done. To be called outside of all
/// processes, after the simulation has begun.
void end_threads(sc_core::sc_simcontext& context,
                 const std::vector<sc_core::sc_process_handle>& threads,
                 const sc_core::sc_process_handle& method);

/// What will be notified at a later time.
struct Notification {
  const sc_core::sc_event* event;
  sc_core::sc_time time;
};
/// In no particular order.
std::vector<Notification> pending_notifications(const sc_core::sc_simcontext& context);

/// Those that a clock notifies itself with.
std::array<const sc_core::sc_event*, 2> own_events(const sc_core::sc_clock& clock);

/// Another number after each change of the signal's value.
std::uint64_t change_stamp(const sc_core::sc_signal_channel& signal);

}  // namespace stride::systemc

#endif
