#include "master/base/archive/unpacked_archive.h"

#include <sys/stat.h>

#include "tests/master/base/archive/support.h"

using namespace stride;
using namespace stride::tests;
using archive::UnpackedArchive;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kExpected = "a unit";

const Entry kDescription{"modelDescription.xml", "<x/>"};

std::string unpack_error(const fs::path& path, const archive::UnpackLimits& limits = {}) {
  return input_error([&] { UnpackedArchive(path, kExpected, {"system.ssd", 7}, limits); });
}

/// Every file below a folder, with its text.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().lexically_relative(folder).string()] = read(entry.path());
  }
  return files;
}

}  // namespace

TEST_CASE("an archive is unpacked into a folder that goes with the object") {
  const Scratch scratch;
  const std::string large(300'000, 'x');
  const auto path = make_zip(scratch / "unit.fmu", {kDescription,
                                                    {"resources/", "", AE_IFDIR},
                                                    {"resources/deep/er/data.bin", large},
                                                    {"./documentation/index.html", "text"},
                                                    {"resources/grüße.txt", "hallo"}});
  fs::path folder;
  {
    const UnpackedArchive fmu(path, kExpected);
    folder = fmu.folder();
    CHECK(folder.is_absolute());
    CHECK(files_in(folder) ==
          std::map<std::string, std::string>{{"modelDescription.xml", "<x/>"},
                                             {"resources/deep/er/data.bin", large},
                                             {"documentation/index.html", "text"},
                                             {"resources/grüße.txt", "hallo"}});
  }
  CHECK_FALSE(fs::exists(folder));
}

TEST_CASE("names that are marked as UTF-8 are taken whatever the locale is") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {{"grüße", "hallo"}});
  std::string bytes = read(path);
  // general purpose bit 11, in the local header and in the central directory
  constexpr std::size_t kLocalFlags = 6, kCentralFlags = 8;
  bytes[kLocalFlags + 1] |= 0x08;
  bytes[bytes.rfind("PK\x01\x02") + kCentralFlags + 1] |= 0x08;
  const UnpackedArchive fmu(scratch.write("marked.fmu", bytes), kExpected);
  CHECK(files_in(fmu.folder()) == std::map<std::string, std::string>{{"grüße", "hallo"}});
}

TEST_CASE("two objects of the same archive have folders of their own") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {kDescription});
  const UnpackedArchive first(path, kExpected);
  const UnpackedArchive second(path, kExpected);
  CHECK(first.folder() != second.folder());
  CHECK(fs::exists(first.folder() / "modelDescription.xml"));
}

TEST_CASE("a folder is used where it is, and stays") {
  const Scratch scratch;
  scratch.write("unit/modelDescription.xml", "<x/>");
  { CHECK(UnpackedArchive(scratch / "unit", kExpected).folder() == scratch / "unit"); }
  CHECK(fs::exists(scratch / "unit/modelDescription.xml"));
}

TEST_CASE("entries that reach out of the folder are refused, and nothing is written outside") {
  const Scratch scratch;
  struct Case {
    Entry entry;
    const char* complaint;
  };
  const Case cases[] = {
      {{"../evil.txt", "x"}, "'../evil.txt', which leads out"},
      {{"resources/../../evil.txt", "x"}, "leads out of the archive's folder"},
      {{"resources/..", "x"}, "leads out"},
      {{(scratch / "evil.txt").string(), "x"}, "which is an absolute path"},
      {{"link", "", AE_IFLNK, "/etc"}, "'link', a symbolic link to '/etc', which is no file"},
      {{"link", "", AE_IFLNK, "/etc/passwd"}, "'link', a symbolic link"},
      {{"resources", "", AE_IFLNK, ".."}, "'resources', a symbolic link"},
      {{"a/link", "", AE_IFLNK, "../../../../../../../etc/passwd"}, "'a/link', a symbolic link"},
      {{"link", "", AE_IFLNK, "none"}, "'link', a symbolic link to 'none'"},
      {{"modelDescription.xml", "", AE_IFLNK, "modelDescription.xml"}, "which it holds twice"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.entry.name);
    const auto path = make_zip(scratch / "evil.fmu", {kDescription, c.entry});
    const auto before = files_in(scratch.path());
    const std::string error = unpack_error(path);
    CHECK_THAT(error, Contains(c.complaint));
    CHECK_THAT(error, Contains("system.ssd:7: ") && Contains("evil.fmu"));
    const auto after = files_in(scratch.path());
    CHECK(after == before);
  }
}

TEST_CASE("a symbolic link to a file of the archive is this file") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {{"libx.so", "", AE_IFLNK, "more/libx.so.1"},
                                                    {"more/libx.so.1", "code"},
                                                    {"more/up", "", AE_IFLNK, "../libx.so"}});
  const UnpackedArchive unpacked(path, kExpected);
  CHECK(files_in(unpacked.folder()) ==
        std::map<std::string, std::string>{
            {"libx.so", "code"}, {"more/libx.so.1", "code"}, {"more/up", "code"}});
  CHECK_FALSE(fs::is_symlink(unpacked.folder() / "libx.so"));
}

TEST_CASE("devices and sockets are refused") {
  // Zip keeps the file's type in the upper half of a field of the central directory.
  const Scratch scratch;
  for (const unsigned type : {0020000U, 0060000U, 0140000U}) {
    const auto path = make_zip(scratch / "unit.fmu", {kDescription, {"node", ""}});
    std::string bytes = read(path);
    const std::size_t last = bytes.rfind("PK\x01\x02");
    const unsigned mode = type | 0644U;
    bytes[last + 40] = static_cast<char>(mode & 0xff);
    bytes[last + 41] = static_cast<char>(mode >> 8);
    std::ofstream(path, std::ios::binary) << bytes;
    CAPTURE(type);
    CHECK_THAT(unpack_error(path), Contains("'node', "));
  }
}

TEST_CASE("an archive may hold a file twice if it is the same, but not as a folder") {
  const Scratch scratch;
  const std::string large(100'000, 'x');
  const auto twice =
      make_zip(scratch / "a.fmu", {{"a", large}, {"b", ""}, {"a", large}, {"b", ""}});
  CHECK(read(UnpackedArchive(twice, kExpected).folder() / "a") == large);
  for (const std::string& other : {large.substr(1), large + "x", std::string(100'000, 'y')}) {
    CHECK_THAT(unpack_error(make_zip(scratch / "b.fmu", {{"a", large}, {"a", other}})),
               Contains("'a', which it holds twice, with different contents"));
  }
  CHECK_THAT(unpack_error(make_zip(scratch / "d.fmu", {{"a/b", ""}, {"a", ""}})),
             Contains("'a', which it holds twice"));
  CHECK_THAT(
      unpack_error(make_zip(scratch / "b.fmu", {kDescription, {"modelDescription.xml/x", ""}})),
      Contains("'modelDescription.xml/x', but also a file"));
}

TEST_CASE("an archive larger than the limits is refused") {
  const Scratch scratch;
  const auto bomb = make_zip(scratch / "bomb.fmu", {{"zeros", std::string(1 << 20, '\0')}});
  CHECK(fs::file_size(bomb) < 10'000);
  CHECK_THAT(unpack_error(bomb, {.bytes = 1 << 19}), Contains("unpacks to more than 524288 bytes"));
  const auto many = make_zip(scratch / "many.fmu", {kDescription, {"a"}, {"b"}});
  CHECK_THAT(unpack_error(many, {.entries = 2}), Contains("more than 2 entries"));
  CHECK_NOTHROW(UnpackedArchive(many, kExpected, {}, {.bytes = 4, .entries = 3}));
  std::string announcing = read(many);
  announcing.replace(announcing.rfind("PK\x05\x06") + 10, 1, "\xC8");
  CHECK_THAT(unpack_error(scratch.write("200.fmu", announcing), {.entries = 100}),
             Contains("more than 100 entries"));
}

TEST_CASE("a file that is not an archive is an error") {
  const Scratch scratch;
  CHECK_THAT(unpack_error(scratch / "absent.fmu"), Contains("there is no file"));
  const std::string text =
      unpack_error(scratch.write("text.fmu", "This is not an archive at all."));
  CHECK_THAT(text, Contains("text.fmu' is not a zip archive") && Contains("hint: expected a unit"));
  CHECK_THAT(unpack_error(scratch.write("empty.fmu", "")), Contains("is not a zip archive"));
  CHECK_THAT(unpack_error(scratch.write("lfs.fmu", "version https://git-lfs.github.com/spec/v1\n")),
             Contains("is a pointer of Git LFS") && Contains("hint: ") && Contains("git lfs pull"));
}

TEST_CASE("a damaged archive is an error") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {{"modelDescription.xml", "0123456789abcdef"}});
  std::string bytes = read(path);
  SECTION("the contents do not fit the checksum") {
    bytes[bytes.find("modelDescription.xml") + 45] ^= 0x55;
  }
  SECTION("it is cut off") { bytes.resize(bytes.find("modelDescription.xml") + 35); }
  std::ofstream(path, std::ios::binary) << bytes;
  CHECK_THAT(unpack_error(path), Contains("damaged"));
}

TEST_CASE("an archive without all of its directory is an error") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {kDescription, {"resources/a", "x"}});
  const std::string bytes = read(path);
  for (const std::size_t missing : {1, 22, 60}) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() - missing);
    CHECK_THAT(unpack_error(path), Contains("is cut off: it has no directory at its end"));
  }
}

TEST_CASE("no folder is left when unpacking fails") {
  const Scratch scratch;
  unpack_error(make_zip(scratch / "evil.fmu", {kDescription, {"../evil", "x"}}));
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(archive::TemporaryFolder::parent())) {
    left += entry.is_directory() ? 1 : 0;
  }
  CHECK(left == 0);
}

TEST_CASE("what is no regular file is refused and not waited for") {
  const Scratch scratch;
  REQUIRE(::mkfifo((scratch / "fifo.fmu").c_str(), 0600) == 0);
  fs::create_symlink("loop.fmu", scratch / "loop.fmu");
  CHECK_THAT(unpack_error(scratch / "fifo.fmu"),
             Contains("system.ssd:7: ") && Contains("fifo.fmu': this is a FIFO, not a"));
  CHECK_THAT(unpack_error("/dev/zero"), Contains("'/dev/zero': this is a device"));
  CHECK_THAT(unpack_error(scratch / "loop.fmu"), Contains("cannot reach '"));
  CHECK_THAT(unpack_error(scratch / std::string(300, 'n')), Contains("File name too long"));
}
