// The headers of FMI, as sources include them.
#ifndef STRIDE_MASTER_LOADER_PROCESS_SOURCE_BUILD_FMI_HEADERS_H
#define STRIDE_MASTER_LOADER_PROCESS_SOURCE_BUILD_FMI_HEADERS_H

#include <string>
#include <vector>

namespace stride::isolation {

/// The folder that they are written to, within that of a build.
inline constexpr const char* kHeaders = "fmi";

struct FmiHeader {
  std::string name;  ///< "fmi3Functions.h", "stride/fmi3.h"
  std::string text;
};

/// By the names of the standards. They declare the types and functions of interfaces/stride, which
/// are exported without a prefix, whatever FMI3_FUNCTION_PREFIX and FMI2_FUNCTION_PREFIX are.
const std::vector<FmiHeader>& fmi_headers();

}  // namespace stride::isolation

#endif
