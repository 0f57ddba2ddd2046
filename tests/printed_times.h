// How Catch2 prints times: the << that libstdc++ declares for durations does not compile for 128
// bits. All tests are compiled with this header (cmake/StrideTestHeaders.cmake).
#ifndef STRIDE_TESTS_PRINTED_TIMES_H
#define STRIDE_TESTS_PRINTED_TIMES_H

#include <string>

#include <catch2/catch.hpp>

#include <stride/time_text.h>

namespace Catch {

template <>
struct StringMaker<stride::Duration> {
  static std::string convert(stride::Duration duration) {
    return stride::decimal_seconds(duration) + " s";
  }
};

template <>
struct StringMaker<stride::Time> {
  static std::string convert(stride::Time time) { return stride::decimal_seconds(time) + " s"; }
};

}  // namespace Catch

#endif
