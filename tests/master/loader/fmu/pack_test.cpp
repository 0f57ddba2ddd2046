#include "master/loader/fmu/pack.h"

#include <ctime>

#include "master/base/archive/zip.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

importer::PackRequest stateless(const Scratch& scratch, const std::string& output = "unit.fmu") {
  scratch.write("resources/note.txt", "a note");
  scratch.write("resources/deep/b.txt", "b");
  return {unit_library("stateless"), scratch / "resources", {}, scratch / output};
}

std::vector<std::string> names_in(const fs::path& path) {
  ::archive* zip = archive_read_new();
  archive_read_support_format_zip(zip);
  REQUIRE(archive_read_open_filename(zip, path.c_str(), 4096) == ARCHIVE_OK);
  std::vector<std::string> names;
  archive_entry* entry = nullptr;
  while (archive_read_next_header(zip, &entry) == ARCHIVE_OK) {
    names.emplace_back(archive_entry_pathname(entry));
  }
  archive_read_free(zip);
  return names;
}

}  // namespace

TEST_CASE("a packed unit has the layout of FMI 3.0, in the order of the names") {
  const Scratch scratch;
  auto request = stateless(scratch);
  request.bundled = {raw_library("raw")};
  importer::pack(request);
  const std::string binaries = std::string("binaries/") + importer::platform() + "/";
  CHECK(names_in(request.output) ==
        std::vector<std::string>{binaries + "raw.so", binaries + "stateless.so",
                                 "modelDescription.xml", "resources/deep/b.txt",
                                 "resources/note.txt"});
  const importer::UnpackedFmu unpacked(request.output);
  CHECK(read(unpacked.folder() / binaries / "stateless.so") == read(unit_library("stateless")));
  CHECK(read(unpacked.folder() / "resources/note.txt") == "a note");
}

TEST_CASE("a unit that can promise to be idle is packed with its manifest") {
  const Scratch scratch;
  importer::pack({unit_library("idler"), {}, {}, scratch / "idler.fmu"});
  const std::string binaries = std::string("binaries/") + importer::platform() + "/";
  CHECK(names_in(scratch / "idler.fmu") == std::vector<std::string>{binaries + "idler.so",
                                                                    STRIDE_IDLE_MANIFEST,
                                                                    "modelDescription.xml"});
}

TEST_CASE("a packed unit runs with the resources that it was packed with") {
  const Scratch scratch;
  const auto request = stateless(scratch);
  importer::pack(request);
  const auto fmu = importer::Fmu::load(request.output);
  CHECK(fmu->description()->model_identifier == "stateless");
  const auto unit = fmu->instantiate("unit");
  const auto& variable = fmu->description()->variables[*fmu->description()->find("note")];
  core::ValueBlock note(core::ValueType::String, 1);
  unit->get(std::span(&variable.reference, 1), note);
  CHECK(note.strings()[0] == "a note");
}

TEST_CASE("a unit finds the shared library that it is packed with") {
  const Scratch scratch;
  const auto fmu = importer::Fmu::load(test_fmu("bundling"));
  const auto unit = fmu->instantiate("unit");
  unit->enter_initialization({}, std::nullopt);
  core::ValueBlock answer(core::ValueType::Int32, 1);
  unit->get(std::span(&fmu->description()->variables.back().reference, 1), answer);
  CHECK(answer.numbers<std::int32_t>()[0] == 42);
}

TEST_CASE("a .fmu is packed again with other resources") {
  const Scratch scratch;
  auto first = stateless(scratch, "first.fmu");
  first.bundled = {raw_library("raw")};
  importer::pack(first);
  scratch.write("other/note.txt", "another note");
  importer::pack({scratch / "first.fmu", scratch / "other", {}, scratch / "second.fmu"});

  const importer::UnpackedFmu unpacked(scratch / "second.fmu");
  const auto binaries = unpacked.folder() / "binaries" / importer::platform();
  CHECK(read(binaries / "stateless.so") == read(unit_library("stateless")));
  CHECK(read(binaries / "raw.so") == read(raw_library("raw")));
  CHECK(read(unpacked.folder() / "resources/note.txt") == "another note");
  CHECK_FALSE(fs::exists(unpacked.folder() / "resources/deep"));

  CHECK_THAT(input_error([&] {
               importer::pack({scratch / "first.fmu", {}, {}, scratch / "x.fmu"});
             }),
             Contains("is packed already") && Contains("--resources"));
}

TEST_CASE("a .fmu that is packed again keeps all of its binaries") {
  const Scratch scratch;
  importer::pack(stateless(scratch, "first.fmu"));
  const importer::UnpackedFmu first(scratch / "first.fmu");
  archive::Contents contents;
  archive::add_folder(contents, "", first.folder());
  const std::string here = std::string("binaries/") + importer::platform();
  for (const std::string& name : {here + "/libshared.so.1", here + "/data/table.txt",
                                  std::string("binaries/x86-windows/a.dll")}) {
    contents[name].text = "not loaded to describe the unit: " + name;
  }
  archive::write_zip(scratch / "more.fmu", contents);
  importer::pack(
      {scratch / "more.fmu", scratch / "resources", {}, scratch / "again.fmu", "named & so"});
  const importer::UnpackedFmu again(scratch / "again.fmu");
  for (const auto& [name, content] : contents) {
    if (!name.starts_with("binaries/") || content.text.empty()) continue;
    CHECK(read(again.folder() / name) == content.text);
  }
  CHECK(read(again.folder() / here / "stateless.so") == read(unit_library("stateless")));
  CHECK(importer::Fmu::load(scratch / "again.fmu")->description()->model_name == "named & so");
}

TEST_CASE("an FMU whose description has another case is packed again, with a warning") {
  const Scratch scratch;
  importer::pack(stateless(scratch, "plain.fmu"));
  const importer::UnpackedFmu plain(scratch / "plain.fmu");
  archive::Contents contents;
  archive::add_folder(contents, "", plain.folder());
  contents["ModelDescription.xml"] = contents["modelDescription.xml"];
  contents.erase("modelDescription.xml");
  archive::write_zip(scratch / "other.FMU", contents);
  const auto warnings =
      importer::pack({scratch / "other.FMU", scratch / "resources", {}, scratch / "again.fmu"});
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("has its modelDescription.xml as 'ModelDescription.xml'"));
  CHECK(read(scratch / "again.fmu") == read(scratch / "plain.fmu"));
}

TEST_CASE("the same input gives the same bytes, at any time and in any time zone") {
  const Scratch scratch;
  importer::pack(stateless(scratch, "a.fmu"));
  fs::last_write_time(scratch / "resources/note.txt",
                      fs::file_time_type::clock::now() - std::chrono::hours(100));
  setenv("TZ", "Asia/Tokyo", 1);
  tzset();
  auto again = stateless(scratch, "b.fmu");
  fs::last_write_time(scratch / "resources/note.txt",
                      fs::file_time_type::clock::now() - std::chrono::hours(100));
  importer::pack(again);
  unsetenv("TZ");
  tzset();
  CHECK(read(scratch / "a.fmu") == read(scratch / "b.fmu"));
  CHECK(read(scratch / "a.fmu").size() > 1000);
}

TEST_CASE("a failed packing leaves the old archive and nothing else") {
  const Scratch scratch;
  auto request = stateless(scratch);
  scratch.write("unit.fmu", "old");
  fs::remove(scratch / "resources/note.txt");
  CHECK_THAT(input_error([&] { importer::pack(request); }), Contains("note.txt is missing"));
  scratch.write("resources/note.txt", "a note");
  request.bundled = {scratch / "absent.so"};
  CHECK_THAT(input_error([&] { importer::pack(request); }),
             Contains("absent.so") && Contains("the file does not exist"));
  CHECK(read(scratch / "unit.fmu") == "old");
  for (const auto& entry : fs::directory_iterator(scratch.path())) {
    CHECK(entry.path().extension() != ".tmp");
  }
}

TEST_CASE("what cannot be packed is an error with its cause") {
  const Scratch scratch;
  auto request = stateless(scratch);
  SECTION("two files of one name") {
    request.bundled = {unit_library("stateless")};
    CHECK_THAT(input_error([&] { importer::pack(request); }), Contains("two files would be"));
  }
  SECTION("resources that are not a folder") {
    request.library = unit_library("types");
    request.resources = scratch / "resources/note.txt";
    CHECK_THAT(input_error([&] { importer::pack(request); }),
               Contains("note.txt' is not a folder"));
  }
  SECTION("a library without the kit") {
    request.library = raw_library("raw");
    CHECK_THAT(input_error([&] { importer::pack(request); }),
               Contains("made with stride's unit kit"));
  }
  SECTION("an output folder that does not exist") {
    request.output = scratch / "absent/unit.fmu";
    CHECK_THAT(run_error([&] { importer::pack(request); }), Contains("cannot write"));
  }
}
