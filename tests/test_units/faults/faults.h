/* What units do that harm their process, or those around it. */
#ifndef STRIDE_TESTS_TEST_UNITS_FAULTS_FAULTS_H
#define STRIDE_TESTS_TEST_UNITS_FAULTS_FAULTS_H

#ifdef __cplusplus
#include <string>

namespace stride::tests {

/// Of all faults.
std::string fault_names();
/// Prints its name, and does it. Throws std::out_of_range for any other name, std::runtime_error
/// for what is denied.
void commit_fault(const std::string& name);

}  // namespace stride::tests

extern "C" {
#endif

/* Called by a unit when a function of FMI is called; `call` is "instantiate", "initialize", "step",
 * "event", "get", "set", "get state", "terminate", "free", or "unload", where it is the library's
 * end, `time` the end of its last step [s]. In the first one that is STRIDE_TEST_CALL, and comes at
 * STRIDE_TEST_AT or later, it commits the fault STRIDE_TEST_FAULT; all are environment variables.
 * Returns the status that the function is to return, N for the fault "status N", or 0. May throw.
 */
int stride_test_fault(const char* call, double time);

#ifdef __cplusplus
}
#endif

#endif
