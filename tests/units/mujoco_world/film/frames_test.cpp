#include "units/mujoco_world/film/frames.h"

#include <fstream>
#include <iterator>
#include <set>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/at.h"
#include "tests/scratch_folder.h"

namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using mujoco_world::film::Frames;

namespace {

using stride::tests::at;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

}  // namespace

TEST_CASE("each frame is a picture and a line") {
  const stride::tests::ScratchFolder scratch;
  Frames frames(scratch / "film/arm");
  frames.begin();
  CHECK(text_of(scratch / "film/arm/frames.csv") == "time,file\n");
  frames.add(at(0), {'a'});
  frames.add(at(0.1), {'b', 'c'});
  CHECK(text_of(scratch / "film/arm/frames.csv") == "time,file\n0,00000.jpg\n0.1,00001.jpg\n");
  CHECK(text_of(scratch / "film/arm/00001.jpg") == "bc");
  CHECK(frames.ends_at(at(0.1)));
  CHECK_FALSE(frames.ends_at(at(0)));
}

TEST_CASE("what is taken back is gone, and its places are taken again") {
  const stride::tests::ScratchFolder scratch;
  Frames frames(scratch / "arm");
  frames.begin();
  for (int i = 0; i < 5; ++i) frames.add(at(i), {'a'});
  frames.remove_after(at(1.5));
  CHECK(text_of(scratch / "arm/frames.csv") == "time,file\n0,00000.jpg\n1,00001.jpg\n");
  CHECK(files_in(scratch / "arm") == std::set<std::string>{"00000.jpg", "00001.jpg", "frames.csv"});
  frames.add(at(1.75), {'b'});
  CHECK(text_of(scratch / "arm/frames.csv") ==
        "time,file\n0,00000.jpg\n1,00001.jpg\n1.75,00002.jpg\n");
  CHECK(text_of(scratch / "arm/00002.jpg") == "b");
}

TEST_CASE("the last frame may get another picture") {
  const stride::tests::ScratchFolder scratch;
  Frames frames(scratch / "arm");
  frames.begin();
  frames.add(at(0), {'a'});
  frames.add(at(0.5), {'b', 'c'});
  frames.replace_last({'d'});
  frames.add(at(1), {'e'});
  CHECK(text_of(scratch / "arm/frames.csv") ==
        "time,file\n0,00000.jpg\n0.5,00001.jpg\n1,00002.jpg\n");
  CHECK(text_of(scratch / "arm/00000.jpg") == "a");
  CHECK(text_of(scratch / "arm/00001.jpg") == "d");
}

TEST_CASE("a film replaces the one that was there, and no other file") {
  const stride::tests::ScratchFolder scratch;
  {
    Frames frames(scratch / "arm");
    frames.begin();
    for (int i = 0; i < 5; ++i) frames.add(at(i), {'a'});
  }
  std::ofstream(scratch / "arm/notes.txt") << "mine";
  Frames frames(scratch / "arm");
  frames.begin();
  frames.add(at(0), {'b'});
  CHECK(files_in(scratch / "arm") == std::set<std::string>{"00000.jpg", "frames.csv", "notes.txt"});
}

TEST_CASE("a film is adopted up to a time, as far as it is whole") {
  const stride::tests::ScratchFolder scratch;
  const auto write = [&] {
    Frames frames(scratch / "arm");
    frames.begin();
    for (int i = 0; i < 5; ++i) frames.add(at(i - 1), {'a'});
  };
  const auto adopted_at = [&](double time) {
    Frames frames(scratch / "arm");
    frames.adopt(at(time));
    CHECK(files_in(scratch / "arm").size() == frames.size() + 1);
    const std::size_t adopted = frames.size();
    frames.add(at(10), {'b'});
    return std::pair(adopted, text_of(scratch / "arm/frames.csv"));
  };
  write();
  CHECK(adopted_at(1.5) ==
        std::pair(std::size_t{3}, std::string("time,file\n-1,00000.jpg\n0,00001.jpg\n1,00002.jpg\n"
                                              "10,00003.jpg\n")));
  CHECK(text_of(scratch / "arm/00003.jpg") == "b");
  CHECK(text_of(scratch / "arm/00002.jpg") == "a");
  write();
  CHECK(adopted_at(3).first == 5);
  write();
  CHECK(adopted_at(-2).first == 0);
  const std::pair<const char*, std::size_t> damaged[] = {
      {"", 0},
      {"time\n-1,00000.jpg\n", 0},
      {"time,file\n-1,00000.jpg\n0,00001", 1},
      {"time,file\n-1,00000.jpg\n0,00001.jpg", 1},
      {"time,file\n-1,00000.jpg\n0.0,00001.jpg\n", 1},
      {"time,file\n-1,00000.jpg\n0,00002.jpg\n", 1},
      {"time,file\n-1,00000.jpg\n-1,00001.jpg\n", 1},
      {"time,file\n-1,00000.jpg\n\n", 1},
      {"time,file\n-1,00000.jpg\n1e1,00001.jpg\n", 1},
      {"time,file\n-1,00000.jpg\n99999999999,00001.jpg\n", 1},
  };
  for (const auto& [list, whole] : damaged) {
    CAPTURE(list);
    write();
    std::ofstream(scratch / "arm/frames.csv") << list;
    CHECK(adopted_at(3).first == whole);
  }
}

TEST_CASE("a process that goes on from a fork goes on with the film of then") {
  const stride::tests::ScratchFolder scratch;
  auto frames = std::make_unique<Frames>(scratch / "arm");
  frames->begin();
  frames->add(at(0), {'a'});
  int go[2];
  REQUIRE(::pipe(go) == 0);
  const pid_t snapshot = ::fork();
  if (snapshot == 0) {
    char byte;
    if (::read(go[0], &byte, 1) == 1) {
      frames->add(at(0.5), {'c'});
      frames.reset();
    }
    ::_exit(0);
  }
  for (int i = 1; i < 4; ++i) frames->add(at(i), {'b'});
  REQUIRE(::write(go[1], "!", 1) == 1);
  REQUIRE(::waitpid(snapshot, nullptr, 0) == snapshot);
  CHECK(text_of(scratch / "arm/frames.csv") == "time,file\n0,00000.jpg\n0.5,00001.jpg\n");
  CHECK(text_of(scratch / "arm/00001.jpg") == "c");
  CHECK(files_in(scratch / "arm") == std::set<std::string>{"00000.jpg", "00001.jpg", "frames.csv"});
  ::close(go[0]);
  ::close(go[1]);
}

TEST_CASE("a disk that takes no more is an error with the file") {
  const stride::tests::ScratchFolder scratch;
  Frames frames(scratch / "arm");
  frames.begin();
  fs::create_symlink("/dev/full", scratch / "arm/00000.jpg");
  CHECK_THROWS_WITH(frames.add(at(0), {'a'}),
                    Contains("arm/00000.jpg'") && Contains("No space left on device"));
  std::ofstream(scratch / "file") << "no folder";
  CHECK_THROWS_WITH(Frames(scratch / "file/arm"), Contains("file/arm'"));
}
