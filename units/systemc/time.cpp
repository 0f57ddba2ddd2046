#include <stride/systemc/kernel.h>
#include <stride/systemc/time.h>

namespace stride::systemc {

Time current_time() {
  const Kernel* const kernel = Kernel::current();
  return kernel != nullptr ? kernel->now() : Time(to_duration(sc_core::sc_time_stamp()));
}

}  // namespace stride::systemc
