#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_DESCRIPTION_FILE_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_DESCRIPTION_FILE_H

#include <string>

namespace stride::importer {

/// A file of an FMU that describes it, and has nothing of its code.
struct DescriptionFile {
  std::string name;  ///< its path within the FMU
  std::string text;
};

/// All that there may be.
inline constexpr const char* kDescriptionFiles[] = {"modelDescription.xml",
                                                    "extra/org.stride.idle/fmi-ls-manifest.xml",
                                                    "terminalsAndIcons/terminalsAndIcons.xml"};

}  // namespace stride::importer

#endif
