// What must not cross the C interface, and does with a unit that is careless.
#include <stdexcept>

extern "C" void stride_test_throw() { throw std::runtime_error("thrown across the C interface"); }
