/* Calls the functions of the library that the unit brings along. */
#include "tests/test_units/own_symbols/own_symbols.h"

int stride_test_shared_answer(void);
unsigned long crc32(unsigned long sum, const unsigned char* bytes, unsigned size);

OwnSymbols call_own_symbols(void) {
  OwnSymbols found = {1, 0, stride_test_shared_answer()};
  found.own = found.value == ANSWER;
#ifdef WITH_CHECKSUM
  ++found.called;
  found.own += crc32(0, (const unsigned char*)"", 0) == ANSWER;
#endif
  return found;
}
