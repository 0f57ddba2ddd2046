// Entering and leaving the SystemC kernel, which is one per process and holds its state in globals.
#ifndef STRIDE_SYSTEMC_SCOPE_H
#define STRIDE_SYSTEMC_SCOPE_H

#include <mutex>
#include <systemc>

namespace stride::systemc {

/// Locks the kernel for the calling thread: one lock per process, which a thread may take again.
std::unique_lock<std::recursive_mutex> lock_kernel();

/// While it lives, the calling thread holds the kernel's lock, the given context is the current one
/// and reports go to the given handler. On leaving, all three are as they were, so a program that
/// uses SystemC itself is not disturbed. Scopes nest.
class Scope {
 public:
  Scope(sc_core::sc_simcontext* context, sc_core::sc_report_handler_proc handler);
  ~Scope();

  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  std::unique_lock<std::recursive_mutex> lock_;
  sc_core::sc_simcontext* previous_context_;
  sc_core::sc_report_handler_proc previous_handler_;
};

}  // namespace stride::systemc

#endif
