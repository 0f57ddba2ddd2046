/* A checksum with the name and the arguments of zlib's, and another polynomial: CRC-32C. Its text
 * is in memory of the allocator. */
#include <stdlib.h>
#include <string.h>

#include "tests/test_units/own_symbols/own_symbols.h"

unsigned long crc32(unsigned long sum, const unsigned char* bytes, unsigned size);

unsigned long crc32(unsigned long sum, const unsigned char* bytes, unsigned size) {
  sum = ~sum & 0xffffffffu;
  for (unsigned i = 0; i < size; ++i) {
    sum ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (sum & 1 ? 0x82f63b78u : 0);
  }
  return ~sum & 0xffffffffu;
}

OwnSymbols call_own_symbols(void) {
  unsigned char* const digits = malloc(9);
  memcpy(digits, "123456789", 9);
  const double sum = (double)crc32(0, digits, 9);
  free(digits);
  const OwnSymbols found = {1, sum == 0xe3069283u, sum};
  return found;
}
