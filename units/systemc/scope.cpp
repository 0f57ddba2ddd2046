#include <stride/systemc/scope.h>

// SystemC's library refers to it; a unit has no main program.
int sc_main(int, char*[]) { return 0; }

namespace stride::systemc {

std::unique_lock<std::recursive_mutex> lock_kernel() {
  static std::recursive_mutex mutex;
  return std::unique_lock<std::recursive_mutex>(mutex);
}

Scope::Scope(sc_core::sc_simcontext* context, sc_core::sc_report_handler_proc handler)
    : lock_(lock_kernel()),
      previous_context_(sc_core::sc_curr_simcontext),
      previous_handler_(sc_core::sc_report_handler::get_handler()) {
  sc_core::sc_curr_simcontext = context;
  sc_core::sc_report_handler::set_handler(handler);
}

Scope::~Scope() {
  sc_core::sc_report_handler::set_handler(previous_handler_);
  sc_core::sc_curr_simcontext = previous_context_;
}

}  // namespace stride::systemc
