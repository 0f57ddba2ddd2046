/* What C sees of <stride/fmi2.h>, for a C++ program to compare with what it sees itself. */
#ifndef STRIDE_TESTS_INTERFACES_FMI2_HEADER_TEST_H
#define STRIDE_TESTS_INTERFACES_FMI2_HEADER_TEST_H

#include <stride/fmi2.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PLATFORM_TYPES(X) \
  X(Component)            \
  X(ComponentEnvironment) \
  X(FMUstate)             \
  X(ValueReference)       \
  X(Real)                 \
  X(Integer)              \
  X(Boolean)              \
  X(Char)                 \
  X(String)               \
  X(Byte)                 \
  X(Status)               \
  X(Type)                 \
  X(StatusKind)           \
  X(EventInfo)            \
  X(CallbackFunctions)

#define DECLARE_SIZE(T)       \
  size_t c_size_of_##T(void); \
  size_t c_align_of_##T(void);
PLATFORM_TYPES(DECLARE_SIZE)
#undef DECLARE_SIZE

/* The values of all enumerators, in the order of the header. */
extern const int c_enumerators[];

/* Calls each callback once, so that the arguments travel from C to C++. */
void c_call_back(const fmi2CallbackFunctions* functions);

/* Functions with the header's types: if C and C++ did not agree on a type, C++ could not pass on
 * what it gets. Each gives back a number made of all its arguments. */
fmi2DoStepTYPE c_do_step;
fmi2SetRealInputDerivativesTYPE c_set_input_derivatives;
fmi2GetBooleanTYPE c_get_boolean;
fmi2GetRealStatusTYPE c_get_real_status;
fmi2NewDiscreteStatesTYPE c_new_discrete_states;

/* The number of functions in the entry table. */
size_t c_function_count(void);

#ifdef __cplusplus
}
#endif

#endif
