#include "master/base/files/sha256.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/scratch_folder.h"

using namespace stride;
using core::sha256;

namespace {

/// FIPS 180-4's examples, and the one with a million bytes.
struct Example {
  std::string bytes;
  const char* digest;
};
const Example kExamples[] = {
    {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
    {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
    {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
     "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
    {std::string(1000000, 'a'), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
};

}  // namespace

TEST_CASE("the digests of the standard's examples") {
  for (const auto& [bytes, digest] : kExamples) CHECK(sha256(bytes) == digest);
}

TEST_CASE("a digest is that of all bytes so far, however they came") {
  core::Sha256 hash;
  CHECK(core::to_hex(hash.digest()) == sha256(""));
  hash.add("a");
  CHECK(core::to_hex(hash.digest()) == sha256("a"));
  hash.add("");
  hash.add("bc");
  CHECK(core::to_hex(hash.digest()) == sha256("abc"));
}

TEST_CASE("the digest of a file is that of its content") {
  const tests::ScratchFolder folder;
  const std::string content(200000, '\0');
  std::ofstream(folder / "zeros") << content;
  CHECK(core::sha256_of_file(folder / "zeros") == sha256(content));
  CHECK_THAT(tests::error_of([&] { core::sha256_of_file(folder / "missing"); }),
             Catch::Contains("missing"));
  CHECK_THAT(tests::error_of([&] { core::sha256_of_file(folder / ""); }),
             Catch::Contains("folder"));
}
