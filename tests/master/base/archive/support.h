// Scratch folders, archives, and errors, for tests of what reads them.
#ifndef STRIDE_TESTS_MASTER_BASE_ARCHIVE_SUPPORT_H
#define STRIDE_TESTS_MASTER_BASE_ARCHIVE_SUPPORT_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <archive.h>
#include <archive_entry.h>
#include <catch2/catch.hpp>

#include "master/base/error.h"

namespace stride::tests {

namespace fs = std::filesystem;

/// A folder for one test. TMPDIR points into it while it lives.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "stride-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
    if (const char* before = std::getenv("TMPDIR")) tmpdir_ = before;
    fs::create_directory(path_ / "tmp");
    setenv("TMPDIR", (path_ / "tmp").c_str(), 1);
  }
  ~Scratch() {
    tmpdir_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", tmpdir_.c_str(), 1);
    fs::remove_all(path_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const fs::path& path() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
  std::string tmpdir_;
};

inline std::string read(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// An entry of a test's archive.
struct Entry {
  std::string name;
  std::string text = "";
  mode_t type = AE_IFREG;
  std::string target = "";  ///< of a symbolic link
};

inline fs::path make_zip(const fs::path& path, const std::vector<Entry>& entries) {
  ::archive* zip = archive_write_new();
  REQUIRE(archive_write_set_format_zip(zip) == ARCHIVE_OK);
  REQUIRE(archive_write_open_filename(zip, path.c_str()) == ARCHIVE_OK);
  for (const Entry& entry : entries) {
    archive_entry* header = archive_entry_new();
    archive_entry_set_pathname(header, entry.name.c_str());
    archive_entry_set_filetype(header, entry.type);
    archive_entry_set_perm(header, 0644);
    archive_entry_set_size(header, static_cast<la_int64_t>(entry.text.size()));
    if (entry.type == AE_IFLNK) archive_entry_set_symlink(header, entry.target.c_str());
    REQUIRE(archive_write_header(zip, header) == ARCHIVE_OK);
    archive_write_data(zip, entry.text.data(), entry.text.size());
    archive_entry_free(header);
  }
  REQUIRE(archive_write_free(zip) == ARCHIVE_OK);
  return path;
}

/// The text of the core::Error that the call throws, which must be of this kind.
template <class Call>
std::string error_of(core::Error::Kind kind, Call&& call) {
  try {
    call();
  } catch (const core::Error& error) {
    CHECK(error.kind() == kind);
    return error.what();
  }
  FAIL("no error was thrown");
  return {};
}
template <class Call>
std::string input_error(Call&& call) {
  return error_of(core::Error::Kind::Input, call);
}
template <class Call>
std::string run_error(Call&& call) {
  return error_of(core::Error::Kind::Run, call);
}

}  // namespace stride::tests

#endif
