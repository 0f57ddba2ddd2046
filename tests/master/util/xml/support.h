// What the tests of master/util/xml share.
#ifndef STRIDE_TESTS_MASTER_UTIL_XML_SUPPORT_H
#define STRIDE_TESTS_MASTER_UTIL_XML_SUPPORT_H

#include <string>

#include <catch2/catch.hpp>

#include "master/util/error.h"

namespace stride::tests {

/// The text of the error that the call throws; empty if it throws none.
template <class Call>
std::string xml_error(Call&& call) {
  try {
    call();
  } catch (const core::Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace stride::tests

#endif
