#include "tests/fuzz/working_folder.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace stride::tests {
namespace {

namespace fs = std::filesystem;

fs::path& path_of_folder() {
  static fs::path path;
  return path;
}

}  // namespace

WorkingFolder::WorkingFolder() {
  path_of_folder() = folder_ / "";
  fs::create_directory(working_path("tmp"));
  ::setenv("TMPDIR", working_path("tmp").c_str(), 1);
}

WorkingFolder::~WorkingFolder() { path_of_folder().clear(); }

fs::path working_path(const std::string& name) {
  if (path_of_folder().empty()) throw std::logic_error("there is no working folder");
  return path_of_folder() / name;
}

fs::path write_file(const std::string& name, const std::string& bytes) {
  const fs::path file = working_path(name);
  fs::create_directories(file.parent_path());
  fs::remove(file);  // replacing a file makes some file systems wait for the disk
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

fs::path copy_seed(const std::string& seed, const std::string& name) {
  const fs::path file = working_path(name);
  fs::create_directories(file.parent_path());
  fs::copy_file(fs::path(STRIDE_SOURCE_DIR) / "tests/fuzz/seeds" / seed, file,
                fs::copy_options::skip_existing);
  return file;
}

std::string content_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  if (!text) throw std::runtime_error(file.string() + " cannot be read");
  return std::move(text).str();
}

bool is_tidy() {
  for (const auto& entry : fs::recursive_directory_iterator(working_path("tmp"))) {
    if (entry.is_directory() && entry.path().parent_path() != working_path("tmp")) return false;
  }
  return true;
}

}  // namespace stride::tests
