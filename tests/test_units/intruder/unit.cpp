// Tries to reach files outside of its own folder of results, in one call of its life.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

#include <stride/results.h>
#include <stride/unit.h>

namespace {

namespace fs = std::filesystem;

constexpr const char* kMasterFiles[] = {
    "signals.csv", "events.csv",          "activity.csv", "signals.vcd",           "run.json",
    "report.html", "run.json.stride-new", "junit.xml",    "report.html.stride-new"};

/// The folder that it was given, and the file outside that it is after.
struct Places {
  fs::path own;
  fs::path target;
};

void write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text << std::flush;
  if (!stream) throw std::runtime_error("cannot write " + file.string() + ": Permission denied");
}

/// `put` is called for what was removed before, if that was possible. What is denied is tried
/// nevertheless, and not reported.
template <class Put>
void replace_master_files(const Places& places, Put&& put) {
  const fs::path units = places.own.parent_path();
  for (const fs::path& folder : {places.own, units, units.parent_path()}) {
    for (const char* name : kMasterFiles) {
      const fs::path file = folder / name;
      ::unlink(file.c_str());
      put(file);
    }
  }
}

void plant_links(const Places& places) {
  replace_master_files(
      places, [&](const fs::path& file) { ::symlink(places.target.c_str(), file.c_str()); });
}

void plant_fifos(const Places& places) {
  replace_master_files(places, [&](const fs::path& file) { ::mkfifo(file.c_str(), 0600); });
}

/// Its own folder, and that of all units, become links to the folder of the target.
void replace_folders(const Places& places) {
  for (const fs::path& folder : {places.own, places.own.parent_path()}) {
    ::rename(folder.c_str(), (folder.string() + ".old").c_str());
    ::rmdir(folder.c_str());
    ::symlink(places.target.parent_path().c_str(), folder.c_str());
  }
}

/// A film of a picture, a link to the target, a FIFO, and what is not there.
void make_film(const Places& places) {
  const fs::path film = places.own / "film";
  fs::create_directories(film);
  write(film / "frames.csv", "time,file\n0,0.jpg\n0.1,1.jpg\n0.2,2.jpg\n0.3,3.jpg\n");
  write(film / "0.jpg", "picture");
  ::symlink(places.target.c_str(), (film / "1.jpg").c_str());
  ::mkfifo((film / "2.jpg").c_str(), 0600);
}

void link_film(const Places& places) {
  ::symlink(places.target.parent_path().c_str(), (places.own / "film").c_str());
}

void make_fifo_film(const Places& places) {
  fs::create_directories(places.own / "film");
  ::mkfifo((places.own / "film/frames.csv").c_str(), 0600);
}

/// As a unit does that expects no harm.
void write_note(const Places& places) { write(places.own / "note.txt", "written\n"); }
void write_picture(const Places& places) {
  fs::create_directories(places.own / "film");
  write(places.own / "film/1.jpg", "written\n");
}
void write_target(const Places& places) { write(places.target, "written\n"); }

const std::map<std::string, std::function<void(const Places&)>> kAttacks{
    {"links", plant_links}, {"FIFOs", plant_fifos},     {"folders", replace_folders},
    {"film", make_film},    {"linked film", link_film}, {"FIFO film", make_fifo_film},
    {"note", write_note},   {"picture", write_picture}, {"target", write_target},
};

class Intruder : public stride::Unit {
 public:
  explicit Intruder(const stride::Setup& setup) : own_(setup.results) {
    describe("Tries to reach files outside of its own folder of results");
    output("y", y_).exact().depends_on({});
    parameter("attack", attack_).description("what it does");
    parameter("call", call_).description("in which call: initialize, step or terminate");
    parameter("target", target_).description("a file outside");
    state();
    // parameters come later
    const char* const attack = std::getenv("STRIDE_TEST_ATTACK");
    const char* const target = std::getenv("STRIDE_TEST_TARGET");
    if (attack == nullptr || target == nullptr) return;
    kAttacks.at(attack)({stride::results_folder(), target});
  }

  void initialize(stride::Time) override { act("initialize"); }
  void step(stride::Step&) override { act("step"); }
  void terminate() override { act("terminate"); }

 private:
  void act(const std::string& call) const {
    if (call == call_) kAttacks.at(attack_)({own_, target_});
  }

  fs::path own_;
  double y_ = 0;
  std::string attack_;
  std::string call_;
  std::string target_;
};

}  // namespace

STRIDE_UNIT(Intruder)
