// What the runs were made from: what can explain that they differ.
#ifndef STRIDE_MASTER_STUDY_COMPARE_INPUTS_H
#define STRIDE_MASTER_STUDY_COMPARE_INPUTS_H

#include <string>
#include <vector>

#include "master/study/compare/outcomes.h"

namespace stride::compare {

struct InputDifference {
  /// "version", "source", "option", "setting", "unit", "connection" or "intervention".
  std::string kind;
  std::string name;  ///< "sensor.fmu", "--set", "step.size"
  std::string a;     ///< empty where the run has none
  std::string b;     ///< likewise
  bool operator==(const InputDifference&) const = default;
};

/// Of run.json: the version of stride, the digests of files, the options of the command line (but
/// for those that say where results go and what is printed), settings, units, connections and
/// interventions. Paths do not count: files are paired by what they are and their names. Throws
/// core::Error (Input) for lists that are none.
std::vector<InputDifference> compare_inputs(const RunRecord& a, const RunRecord& b);

}  // namespace stride::compare

#endif
