// What units do about memory, and what other faults need, too.
#ifndef STRIDE_TESTS_TEST_UNITS_FAULTS_MEMORY_FAULTS_H
#define STRIDE_TESTS_TEST_UNITS_FAULTS_MEMORY_FAULTS_H

#include <string>

namespace stride::tests {

[[noreturn]] void sleep_for_ever();
/// Throws std::runtime_error with the reason that errno has.
[[noreturn]] void fail(const std::string& what);

/// Private memory without end.
void allocate();
/// The others take up to half a GiB of memory that the limit of a process does not cover, so that a
/// machine without any other limit bears it, and return never.
[[noreturn]] void allocate_shared();
/// By processes, each of them within its limit.
[[noreturn]] void allocate_in_children();
[[noreturn]] void write_nameless_file();
[[noreturn]] void write_temporary_file();
/// Through a socket: no process has them open while they are on their way.
[[noreturn]] void send_nameless_files();

/// No memory can be allocated any more, and the process crashes.
[[noreturn]] void damage_free_memory();
/// What has been allocated can neither be read nor written any more.
void lock_memory();

}  // namespace stride::tests

#endif
