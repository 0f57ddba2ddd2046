// Where parsers of files find what they read.
#ifndef STRIDE_TESTS_FUZZ_WORKING_FOLDER_H
#define STRIDE_TESTS_FUZZ_WORKING_FOLDER_H

#include <filesystem>
#include <string>

#include "tests/scratch_folder.h"

namespace stride::tests {

/// A folder, and one for temporary files in it, to which TMPDIR points, that go with the object. A
/// program has one, which is there while parsers are called.
class WorkingFolder {
 public:
  WorkingFolder();
  ~WorkingFolder();
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  ScratchFolder folder_;
};

/// A path in the folder.
std::filesystem::path working_path(const std::string& name);
/// Writes such a file anew.
std::filesystem::path write_file(const std::string& name, const std::string& bytes);
/// Copies a file from tests/fuzz/seeds, unless it is there already.
std::filesystem::path copy_seed(const std::string& seed, const std::string& name);
/// Throws std::runtime_error if it cannot be read.
std::string content_of(const std::filesystem::path& file);
/// Nothing has stayed in the folder for temporary files.
bool is_tidy();

}  // namespace stride::tests

#endif
