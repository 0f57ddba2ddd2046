#include "master/observe/trace/spool.h"

#include <cstdlib>

#include <catch2/catch.hpp>

#include "master/base/error.h"
#include "tests/master/observe/trace/support.h"

using namespace stride;
using namespace stride::trace;
using Catch::Contains;

namespace {

std::string text_of(const Spool& spool) {
  const TemporaryFolder folder;
  core::OutputFile file(folder / "x");
  spool.copy_to(file);
  file.close();
  return content(folder / "x");
}

/// 10 MB of lines that differ.
std::string much() {
  std::string text;
  for (int i = 0; text.size() < 10'000'000; ++i) text += std::to_string(i) + "\n";
  return text;
}

void write_in_pieces(Spool& spool, std::string_view text) {
  for (std::size_t length = 1; !text.empty(); length = length * 5 % 10'007 + 1) {
    spool.write(text.substr(0, length));
    text.remove_prefix(std::min(length, text.size()));
  }
}

/// The environment variable has this value while an object of this class lives.
class TemporaryFolderVariable {
 public:
  explicit TemporaryFolderVariable(const std::string& value) {
    const char* before = std::getenv("TMPDIR");
    if (before != nullptr) before_ = before;
    ::setenv("TMPDIR", value.c_str(), 1);
  }
  ~TemporaryFolderVariable() {
    if (before_) {
      ::setenv("TMPDIR", before_->c_str(), 1);
    } else {
      ::unsetenv("TMPDIR");
    }
  }

 private:
  std::optional<std::string> before_;
};

}  // namespace

TEST_CASE("What is written comes out again, and may be copied twice") {
  Spool spool;
  CHECK(spool.empty());
  spool.write("text");
  spool.write('\n');
  CHECK_FALSE(spool.empty());
  CHECK(text_of(spool) == "text\n");
  CHECK(text_of(spool) == "text\n");
  spool.clear();
  CHECK(spool.empty());
  CHECK(text_of(spool).empty());
}

TEST_CASE("What is too much for memory comes out again, and the next text, too") {
  const std::string text = much();
  Spool spool;
  write_in_pieces(spool, text);
  CHECK(text_of(spool) == text);
  spool.clear();
  CHECK(spool.empty());
  spool.write("short");
  CHECK(text_of(spool) == "short");
  spool.clear();
  write_in_pieces(spool, text.substr(3));
  CHECK(text_of(spool) == text.substr(3));
}

TEST_CASE("Its file has no name, so nothing can be left of it") {
  const TemporaryFolder folder;
  const TemporaryFolderVariable variable((folder / "").string());
  Spool spool;
  spool.write(much());
  CHECK(std::filesystem::is_empty(folder / ""));
}

TEST_CASE("A folder in which no file can be made is named, with what can be done") {
  const TemporaryFolderVariable variable("/nowhere");
  Spool spool;
  CHECK_THROWS_WITH(spool.write(much()),
                    Contains("/nowhere: cannot make a temporary file: No such file or directory") &&
                        Contains("TMPDIR"));
}
