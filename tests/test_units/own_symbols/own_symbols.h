/* Functions of a unit, called by names that other libraries have, too. */
#ifndef STRIDE_TESTS_TEST_UNITS_OWN_SYMBOLS_OWN_SYMBOLS_H
#define STRIDE_TESTS_TEST_UNITS_OWN_SYMBOLS_OWN_SYMBOLS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int called;   /* how many of them */
  int own;      /* how many of these are the unit's own */
  double value; /* what the first one returns */
} OwnSymbols;

OwnSymbols call_own_symbols(void);

#ifdef __cplusplus
}
#endif

#endif
