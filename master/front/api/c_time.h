// Times of the C interface.
#ifndef STRIDE_MASTER_FRONT_API_C_TIME_H
#define STRIDE_MASTER_FRONT_API_C_TIME_H

#include <chrono>

#include <stride/master.h>
#include <stride/time.h>

namespace stride::api {

inline constexpr stride_time kNoTime = {STRIDE_NO_TIME, 0};

inline stride_time c_time(Time time) {
  const auto [seconds, picoseconds] = split(time.time_since_epoch());
  if (picoseconds >= 0) return {seconds, picoseconds};
  return {seconds - 1, picoseconds + Duration::period::den};
}

inline Duration duration_of(stride_time time) {
  return std::chrono::seconds(time.seconds) + Duration(time.picoseconds);
}

}  // namespace stride::api

#endif
