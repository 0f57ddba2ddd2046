// What units do that ends their process, or makes others.
#ifndef STRIDE_TESTS_TEST_UNITS_FAULTS_PROCESS_FAULTS_H
#define STRIDE_TESTS_TEST_UNITS_FAULTS_PROCESS_FAULTS_H

namespace stride::tests {

/// Each puts another program in the place of the process: one that sleeps, and one that ends.
void become_program();
void become_program_by_system_call();
/// The process goes on in a fork of it, and this one ends.
void become_daemon();
void exit_by_system_call();
void exit_of_looked_up_name();
/// One that nothing handles.
void raise_default_signal();
/// The same after the end of the command.
void exit_by_system_call_at_exit();

/// By each of the usual ways. Throws std::runtime_error where one does not work.
void run_programs();
/// Returns in both processes, where the first one goes on when the other one is gone.
void fork_by_system_call();

/// A signal that comes by itself, in the middle of something.
void await_alarm();
void leave_alarms();
/// One that the C library keeps to itself.
void raise_hidden_signal();

}  // namespace stride::tests

#endif
