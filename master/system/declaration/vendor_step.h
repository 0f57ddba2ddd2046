// The communication step in annotations of other tools.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_VENDOR_STEP_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_VENDOR_STEP_H

#include <optional>
#include <string>

#include "master/base/error.h"
#include "master/base/xml/element.h"
#include "master/engine/model/time/interval.h"

namespace stride::scenario {

struct VendorStep {
  core::Interval size{};
  std::string tag;  ///< of the element that gives it
  core::Location where;
};

/// The fixed step of a <ssd:SystemStructureDescription>: the attribute baseStepSize of a
/// FixedStepAlgorithm (Open Simulation Platform), or stepSize of a FixedStepMaster (OMSimulator),
/// the first one in any annotation. One that is no step is ignored.
std::optional<VendorStep> find_vendor_step(const xml::Element& root);

}  // namespace stride::scenario

#endif
