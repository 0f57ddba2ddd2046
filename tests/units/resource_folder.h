#ifndef STRIDE_TESTS_UNITS_RESOURCE_FOLDER_H
#define STRIDE_TESTS_UNITS_RESOURCE_FOLDER_H

#include <fstream>
#include <string>

#include "tests/scratch_folder.h"

namespace stride::tests {

/// A unit's resources: one file, or none if its text is empty.
class ResourceFolder {
 public:
  ResourceFolder(const std::string& file, const std::string& text) {
    if (!text.empty()) std::ofstream(folder_ / file) << text;
  }

  std::string path() const { return (folder_ / "").string(); }

 private:
  ScratchFolder folder_;
};

}  // namespace stride::tests

#endif
