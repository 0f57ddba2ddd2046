#ifndef STRIDE_MASTER_STUDY_VERIFY_START_VALUES_H
#define STRIDE_MASTER_STUDY_VERIFY_START_VALUES_H

#include <string>

#include "master/study/verify/test_instance.h"

namespace stride::verify {

/// Whether its value before the start is that of the description.
bool has_exact_start(const core::Variable& variable);

/// Throws Failure: "'y' is 1 WHEN, though REASON 0".
void expect_value(TestInstance& instance, const core::Variable& variable,
                  const core::ValueBlock& expected, const std::string& when,
                  const std::string& reason);
/// Of all that have an exact one, in an instance in which none was set.
void expect_start_values(const core::UnitDescription& unit, TestInstance& instance,
                         const std::string& when);

}  // namespace stride::verify

#endif
