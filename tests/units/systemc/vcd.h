// What a device's trace file says, in true time.
#ifndef STRIDE_TESTS_UNITS_SYSTEMC_VCD_H
#define STRIDE_TESTS_UNITS_SYSTEMC_VCD_H

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stride::tests {

struct Vcd {
  using Changes = std::vector<std::pair<std::int64_t, std::string>>;  ///< true time, new value

  std::string timescale;
  std::map<std::string, Changes> signals;  ///< by full name, `advanceTime` among them
  std::int64_t last_stamp = 0;             ///< of the file, not true time
  std::size_t bytes = 0;

  /// The changes of one signal; throws std::out_of_range if the file has none of that name.
  const Changes& of(const std::string& name) const { return signals.at(name); }
};

/// All changes at the stamp #t happened at t + advanceTime, as that is after them. Throws
/// std::runtime_error for a file that is not complete, or not increasing in true time.
Vcd read_vcd(const std::string& path);

}  // namespace stride::tests

#endif
