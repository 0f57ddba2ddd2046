/* A library that a unit brings along: others have its name, and other functions of these names. */
int stride_test_shared_answer(void);
int stride_test_shared_answer(void) { return ANSWER; }

#ifdef WITH_CHECKSUM
unsigned long crc32(unsigned long sum, const unsigned char* bytes, unsigned size);
unsigned long crc32(unsigned long sum, const unsigned char* bytes, unsigned size) {
  (void)sum, (void)bytes, (void)size;
  return ANSWER;
}
#endif
