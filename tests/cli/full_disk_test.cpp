// A disk that is full: exit code 1, an error that names the file, and what was written before can
// be read.
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <sys/mount.h>

#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A file system of 64 KiB in a folder, where this process may make one.
class SmallDisk {
 public:
  explicit SmallDisk(const fs::path& folder) : folder_(folder) {
    fs::create_directory(folder);
    is_there_ = ::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=64k") == 0;
    if (!is_there_) WARN("SKIPPED: no file system can be mounted: " << std::strerror(errno));
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_there() const { return is_there_; }

 private:
  fs::path folder_;
  bool is_there_ = false;
};

/// `stride` in a process that may write a few KiB into a file, so messages have room.
Outcome run_without_room(const Workspace& workspace, const Arguments& arguments) {
  std::string command = "ulimit -f 8; exec";
  for (const std::string& word : stride_command(arguments)) command += " '" + word + "'";
  return Process({"sh", "-c", command}, workspace.scratch().path()).wait();
}

/// Makes a file larger than that.
const std::string kPadding(100'000, 'x');

}  // namespace

TEST_CASE("a run onto a full disk leaves what can be read") {
  const Workspace workspace(two_filters());
  const SmallDisk disk(workspace / "out");
  if (!disk.is_there()) return;
  const Outcome outcome =
      workspace.run({"--stop", "100", "--quiet", "--junit", (workspace / "junit.xml").string()});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: out/s") && Contains(": at ") &&
                              Contains("No space left on device") && Contains("make room"));
  CHECK_THAT(read(workspace / "junit.xml"), Contains("No space left on device"));
  CHECK_FALSE(fs::exists(workspace / "out/run.json.stride-new"));
  CHECK(workspace.signals().size() > 100);  // which throws for a row that is cut
  const Outcome report = workspace.stride({"report", "out", "-o", "page.html"});
  CHECK(report.exit_code == 0);
  CHECK_THAT(report.err, Contains("run.json: this file is missing"));
}

TEST_CASE("whatever a command writes, a full disk is an error that names the file") {
  const Workspace workspace(scenario_text({component("x", "raw")}) + "<!-- " + kPadding + " -->\n");
  make_raw_fmu(workspace.scratch(), "raw");
  workspace.scratch().write("in.vcd", "$comment " + kPadding +
                                          " $end\n$timescale 1 ns $end\n$var wire 1 ! x $end\n"
                                          "$enddefinitions $end\n#0\n1!\n#9\n0!\n");
  workspace.scratch().write("out/signals.csv", "time,a\n0,1\n");
  const auto [file, arguments] = GENERATE(table<std::string, Arguments>({
      {"x.vcd", {"trace", "compress", "in.vcd", "x.vcd"}},
      {"x.ssd", {"complete", "test.ssd", "-o", "x.ssd"}},
      {"x.ssp", {"pack", "test.ssd", "-o", "x.ssp"}},
      {"page.html", {"report", "out", "-o", "page.html"}},
  }));
  INFO(file);
  const Outcome outcome = run_without_room(workspace, arguments);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("stride: error: ") && Contains("cannot write") && Contains("File too large"));
  if (arguments.front() != "pack") CHECK_THAT(outcome.err, Contains(file));
  CHECK_FALSE(fs::exists(workspace / file));
  CHECK_FALSE(fs::exists(workspace / (file + ".stride-new")));
}

TEST_CASE("where a capture cannot be ended, run.json contains that") {
  const Workspace workspace(two_filters());
  CHECK(workspace.run({"--quiet", "--capture", "second=/dev/full"}).exit_code == 1);
  CHECK(run_json(workspace)["outcome"] == "failed");
  CHECK_THAT(run_json(workspace)["error"], Contains("/dev/full: "));
}

TEST_CASE("the report of a run whose run.json is broken shows the rest") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string broken = GENERATE("", "{\"outcome\": \"comp", "[]");
  workspace.scratch().write("out/run.json", broken);
  const Outcome outcome = workspace.stride({"report", "out", "-o", "page.html"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: run.json") && Contains("this is not ") &&
                              Contains("the report is without what it holds"));
  CHECK_THAT(read(workspace / "page.html"), Contains("second.y"));
}
