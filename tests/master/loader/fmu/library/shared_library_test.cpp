#include "master/loader/fmu/library/shared_library.h"

#include <vector>

#include <dlfcn.h>
#include <sys/resource.h>
#include <unistd.h>

#include "master/loader/fmu/library/fmi3_library.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A copy of a library with these bytes in place of others, of the same number.
fs::path altered(const Scratch& scratch, const std::string& library, const std::string& from,
                 const std::string& to) {
  std::string bytes = read(raw_library(library));
  const std::size_t at = bytes.find(from);
  REQUIRE(at != std::string::npos);
  REQUIRE(from.size() == to.size());
  return scratch.write("altered.so", bytes.replace(at, from.size(), to));
}

std::string error_of_loading(const fs::path& path) {
  return input_error([&] { importer::Fmi3Library(path, "", {"system.ssd", 3}); });
}

}  // namespace

TEST_CASE("a missing shared library is named") {
  CHECK_THAT(error_of_loading(raw_library("raw_with_missing_library")),
             Contains("needs the shared library 'libstride_test_absent.so', which was not found") &&
                 Contains("hint: install the package") && Contains("'libstride-test-absent'"));
}

TEST_CASE("an undefined symbol is named") {
  CHECK_THAT(error_of_loading(raw_library("raw_with_undefined_symbol")),
             Contains("needs the symbol 'stride_test_nobody_has_this', which no library"));
}

TEST_CASE("a library that cannot be opened for want of open files is no mistake of the input") {
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &before) == 0);
  const fs::path library = unit_library("minimal");
  const int next = ::dup(STDERR_FILENO);
  ::close(next);
  // one file can be opened, to look at the library, and then no second one
  const rlimit few{static_cast<rlim_t>(next), before.rlim_max};
  std::string failure = "none";
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &few) == 0);
  try {
    const importer::Fmi3Library loaded(library, "", {"system.ssd", 3});
  } catch (const core::EnvironmentError& error) {
    failure = error.what();
  } catch (const core::Error& error) {
    failure = std::string("a mistake: ") + error.what();
  }
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &before) == 0);
  CHECK_THAT(failure, Contains("Too many open files") && !Contains("a mistake"));
}

TEST_CASE("what is not a library for this machine is an error") {
  const Scratch scratch;
  CHECK_THAT(
      error_of_loading(scratch.write("text.so", "this is not a library, whatever its name says")),
      Contains("text.so' cannot be loaded") && Contains(importer::platform()));
  CHECK_THAT(error_of_loading(scratch / "absent.so"), Contains("absent.so' cannot be loaded"));
}

TEST_CASE("the package of a missing library is named as Debian does") {
  const Scratch scratch;
  const auto [library, package] = GENERATE(table<std::string, std::string>({
      {"libgfortran.so.5", "libgfortran5"},
      {"libpython3.9.so.1.0", "libpython3.9"},
      {"liblic2.so.1", "liblic2-1"},
  }));
  const std::string padded = library + std::string(1, '\0');
  const std::string needed = "libstride_test_absent.so" + std::string(1, '\0');
  std::string name = padded + std::string(needed.size() - padded.size(), '\0');
  CHECK_THAT(error_of_loading(altered(scratch, "raw_with_missing_library", needed, name)),
             Contains("needs the shared library '" + library + "'") &&
                 Contains("mostly '" + package + "'"));
}

TEST_CASE("a library that was built on a newer system is an error that says so") {
  const Scratch scratch;
  const std::string version(std::string("GLIBC_2.2.5") + '\0');
  if (read(raw_library("raw")).find(version) == std::string::npos) return;  // other processors
  CHECK_THAT(
      error_of_loading(altered(scratch, "raw", version, std::string("GLIBC_9.9.9") + '\0')),
      Contains("it needs 'GLIBC_9.9.9' of the library 'libc.so.6', and this system's, '/lib") &&
          Contains("built on a newer system than this one; build it here"));
}

TEST_CASE("a library for another number of bits is an error that says so") {
  const Scratch scratch;
  const std::string magic =
      "\x7f"
      "ELF";
  const char here = sizeof(void*) == 8 ? '\2' : '\1';
  const char other = sizeof(void*) == 8 ? '\1' : '\2';
  CHECK_THAT(error_of_loading(altered(scratch, "raw", magic + here, magic + other)),
             Contains("wrong ELF class") && Contains("not for as many bits as this program"));
}

TEST_CASE("a library with an executable stack is loaded, or the error says what to do") {
  try {
    const importer::Fmi3Library library(raw_library("raw_with_executable_stack"));
  } catch (const core::Error& error) {
    CHECK_THAT(error.what(), Contains("executable stack") && Contains("patchelf"));
  }
}

TEST_CASE("a unit that embeds Python without its library gets it, or the error asks for it") {
  try {
    const importer::Fmi3Library library(raw_library("raw_with_python"));
    CHECK_THAT(library.python(), Contains("libpython3."));
  } catch (const core::Error& error) {
    CHECK_THAT(error.what(), Contains("it needs the symbol 'Py_IsInitialized'") &&
                                 Contains("the unit embeds Python"));
  }
}

TEST_CASE("a library that is needed and in the FMU is loaded, whatever name it has of its own") {
  const Scratch scratch;
  fs::copy_file(raw_library("raw_with_missing_library"), scratch / "unit.so");
  std::string bytes = read(raw_library("absent/libstride_test_absent"));
  const std::string name = "libstride_test_absent.so";
  for (std::size_t at = 0; (at = bytes.find(name, at)) != bytes.npos;) {
    bytes.replace(at, name.size(), "libstride_test_others.so");
  }
  const std::string file = name + GENERATE(as<std::string>(), "", ".1.2");
  scratch.write(file, bytes);
  const importer::Fmi3Library library(scratch / "unit.so");
  REQUIRE(library.companions().size() == 1);
  CHECK(fs::equivalent(library.companions()[0], scratch / file));
}

TEST_CASE("another library of the name of one that a unit brings along does not take its place") {
  const Scratch scratch;
  const bool is_other = GENERATE(false, true);
  const std::string name = is_other ? "libstride_test_another.so" : "libstride_test_thesame.so";
  const auto renamed = [&](const fs::path& library) {
    std::string bytes = read(library);
    const std::string own = "libstride_test_bundled.so";
    for (std::size_t at = 0; (at = bytes.find(own, at)) != bytes.npos;) {
      bytes.replace(at, own.size(), name);
    }
    return bytes;
  };
  const fs::path unit = unit_library("bundling");
  std::string bytes = renamed(unit.parent_path() / "libstride_test_bundled.so");
  fs::create_directory(scratch / "unit");
  scratch.write("unit/unit.so", renamed(unit));
  scratch.write("unit/" + name, bytes);
  if (is_other) bytes[bytes.find("__gmon_start__")] = 'x';  // a weak reference
  const fs::path loaded = scratch.write(name, bytes);
  REQUIRE(::dlopen(loaded.c_str(), RTLD_NOW) != nullptr);
  const importer::Fmi3Library library(scratch / "unit/unit.so");
  CHECK(library.warnings().empty());
  CHECK(library.namesakes() == (is_other ? std::vector{name} : std::vector<std::string>{}));
  CHECK((library.path() == scratch / "unit/unit.so") == !is_other);
}

TEST_CASE("a library that is needed, in the FMU and damaged is named") {
  const Scratch scratch;
  fs::copy_file(raw_library("raw_with_missing_library"), scratch / "unit.so");
  const std::string bytes = read(raw_library("absent/libstride_test_absent"));
  scratch.write("libstride_test_absent.so", bytes.substr(0, bytes.size() / 8));
  CHECK_THAT(error_of_loading(scratch / "unit.so"),
             Contains("needs the shared library 'libstride_test_absent.so', which is there") &&
                 Contains("and damaged: its file has"));
}

TEST_CASE("a library that is needed and in the FMU is loaded from there") {
  const Scratch scratch;
  const std::string folder = std::string("unit/binaries/") + importer::platform();
  const std::string place =
      GENERATE_COPY(as<std::string>(), folder, folder + "/lib/deep", "unit/resources");
  fs::create_directories(scratch / folder);
  fs::create_directories(scratch / place);
  fs::copy_file(raw_library("raw_with_missing_library"), scratch / (folder + "/unit.so"));
  const fs::path needed = scratch / (place + "/libstride_test_absent.so");
  fs::copy_file(raw_library("absent/libstride_test_absent"), needed);
  const importer::Fmi3Library library(scratch / (folder + "/unit.so"));
  REQUIRE(library.companions().size() == 1);
  CHECK(fs::equivalent(library.companions()[0], needed));
}

TEST_CASE("a library that is needed and elsewhere in the FMU is named with its places") {
  const Scratch scratch;
  const std::string folder = std::string("unit/binaries/") + importer::platform();
  fs::create_directories(scratch / folder);
  fs::copy_file(raw_library("raw_with_missing_library"), scratch / (folder + "/unit.so"));
  scratch.write("unit/resources/lib/libstride_test_absent.so", "x");
  scratch.write("unit/binaries/aarch64-linux.old/libstride_test_absent.so", "x");
  CHECK_THAT(error_of_loading(scratch / (folder + "/unit.so")),
             Contains("which was not found; the FMU has a file of this name as "
                      "'binaries/aarch64-linux.old/libstride_test_absent.so', "
                      "'resources/lib/libstride_test_absent.so'") &&
                 Contains("put it beside the unit's library"));
}

TEST_CASE("a pointer of Git LFS in place of a library is named") {
  const Scratch scratch;
  CHECK_THAT(error_of_loading(scratch.write("unit.so",
                                            "version https://git-lfs.github.com/spec/v1\n"
                                            "oid sha256:0\nsize 12345\n")),
             Contains("a pointer of Git LFS, not the library") && Contains("git lfs pull"));
}
