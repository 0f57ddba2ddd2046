#include "master/util/file_digests.h"

#include "master/util/input_file.h"
#include "master/util/sha256.h"

namespace stride::core {

const std::string& FileDigests::of(const std::filesystem::path& path) {
  const auto found = known_.find(path);
  if (found != known_.end()) return found->second;
  return known_[path] = is_folder(path) ? sha256_of_folder(path) : sha256_of_file(path);
}

}  // namespace stride::core
