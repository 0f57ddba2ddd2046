// Results that tests of master/study/compare are about.
#ifndef STRIDE_TESTS_MASTER_STUDY_COMPARE_SUPPORT_H
#define STRIDE_TESTS_MASTER_STUDY_COMPARE_SUPPORT_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "master/study/compare/compare.h"
#include "tests/at.h"
#include "tests/master/system/ssp/support.h"

namespace stride::compare {

using tests::at_picosecond;
using tests::at_picoseconds;
using tests::content;
using tests::error_of;
using tests::TemporaryFolder;

constexpr Duration kSecond = std::chrono::seconds(1);

/// "signal a.x": what differs, in the order of the list.
inline std::vector<std::string> names_of(const Differences& differences) {
  std::vector<std::string> names;
  for (const Difference& difference : differences) {
    names.push_back(std::string(name(difference.kind)) + " " + difference.name);
  }
  return names;
}
using Names = std::vector<std::string>;

inline report::Column column(std::string name, core::ValueType type, const Names& fields,
                             bool is_continuous = true, std::string unit = "") {
  report::Column made(report::SignalInfo{std::move(name), std::move(unit), type, is_continuous});
  for (const std::string& field : fields) made.append({field, false});
  return made;
}
inline report::Column reals(const Names& fields, bool is_continuous = true) {
  return column("a.x", core::ValueType::Float64, fields, is_continuous);
}

}  // namespace stride::compare

#endif
