#include "master/base/files/file_digests.h"

#include "master/base/files/input_file.h"
#include "master/base/files/sha256.h"

namespace stride::core {

const std::string& FileDigests::of(const std::filesystem::path& path) {
  const std::filesystem::path key = std::filesystem::absolute(path).lexically_normal();
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  return known_[key] = is_folder(path) ? sha256_of_folder(path) : sha256_of_file(path);
}

}  // namespace stride::core
