// A static variable of a template, of which a process has one whichever libraries define it, with a
// class that is another one in each unit.
#include "tests/test_units/own_symbols/own_symbols.h"

struct Register {
#if ANSWER > 1
  int size = 0x7fffffff;
#endif
  double value = ANSWER;
};

template <class T>
T& only_one() {
  static T one;
  return one;
}

template <class T>
struct Table {
  static double value;
};
template <class T>
double Table<T>::value = ANSWER;

OwnSymbols call_own_symbols(void) {
  OwnSymbols found = {2, 0, only_one<Register>().value};
  found.own = (found.value == ANSWER) + (Table<Register>::value == ANSWER);
  return found;
}
