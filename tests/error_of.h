// The errors that tests provoke.
#ifndef STRIDE_TESTS_ERROR_OF_H
#define STRIDE_TESTS_ERROR_OF_H

#include <exception>
#include <string>

namespace stride::tests {

/// What() of the exception that the call throws; "(no error)" if it throws none.
template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "(no error)";
}

}  // namespace stride::tests

#endif
