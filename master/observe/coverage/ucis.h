// Coverage in the interchange format of Accellera's UCIS 1.0.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_UCIS_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_UCIS_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/observe/coverage/report.h"

namespace stride::coverage {

/// Where coverage comes from, as UCIS wants to have it.
struct UcisOrigin {
  std::vector<std::filesystem::path> files;  ///< a history node for each
  std::string version;                       ///< of this program
  std::string date;                          ///< "2026-01-01T00:00:00"
};

/// An XML document (UCIS 1.0, chapter 9): an instance and a covergroup for each component, a
/// coverpoint or a cross for each point. Bins are known by their names; as ranges of integers,
/// which UCIS has for them, they are numbered. Points without any bin are left out, which the
/// format cannot hold; those without a percentage have no weight.
std::string ucis_document(const Report& report, const UcisOrigin& origin);

}  // namespace stride::coverage

#endif
