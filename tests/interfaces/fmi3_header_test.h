/* What C sees of <stride/fmi3.h> and <stride/idle.h>, for a C++ program to compare with what it
 * sees itself. */
#ifndef STRIDE_TESTS_INTERFACES_FMI3_HEADER_TEST_H
#define STRIDE_TESTS_INTERFACES_FMI3_HEADER_TEST_H

#include <stride/fmi3.h>
#include <stride/idle.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PLATFORM_TYPES(X) \
  X(Instance)             \
  X(InstanceEnvironment)  \
  X(FMUState)             \
  X(ValueReference)       \
  X(Float32)              \
  X(Float64)              \
  X(Int8)                 \
  X(UInt8)                \
  X(Int16)                \
  X(UInt16)               \
  X(Int32)                \
  X(UInt32)               \
  X(Int64)                \
  X(UInt64)               \
  X(Boolean)              \
  X(Char)                 \
  X(String)               \
  X(Byte)                 \
  X(Binary)               \
  X(Clock)                \
  X(Status)               \
  X(DependencyKind)       \
  X(IntervalQualifier)

#define DECLARE_SIZE(T)       \
  size_t c_size_of_##T(void); \
  size_t c_align_of_##T(void);
PLATFORM_TYPES(DECLARE_SIZE)
#undef DECLARE_SIZE

/* The values of all enumerators, in the order of the header. */
extern const int c_enumerators[];

/* Calls each callback type once, so that the arguments travel from C to C++. */
void c_log(fmi3LogMessageCallback log, fmi3InstanceEnvironment environment);
void c_intermediate_update(fmi3IntermediateUpdateCallback update,
                           fmi3InstanceEnvironment environment);

/* Functions with the header's types: if C and C++ did not agree on a type, C++ could not pass on
 * what it gets. Each gives back a number made of all its arguments. */
fmi3DoStepTYPE c_do_step;
fmi3GetBinaryTYPE c_get_binary;
fmi3SetClockTYPE c_set_clock;
strideSetIdleTolerancesTYPE c_set_idle_tolerances;
strideGetIdlePromiseTYPE c_get_idle_promise;

/* The number of functions in the entry table. */
size_t c_function_count(void);

#ifdef __cplusplus
}
#endif

#endif
