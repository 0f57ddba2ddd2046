#include "master/front/cli/campaign/cluster/slurm_script.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride;
using namespace stride::cli;
using Catch::Contains;
using stride::tests::error_of;

namespace {

JobArray array() {
  return {.name = "c",
          .comment = "Cases of c.xosc",
          .working_folder = "/work",
          .log_folder = "/work/campaigns/c/slurm",
          .environment = {},
          .command = {"/bin/stride", "campaign", "run", "c.xosc", "--cases"},
          .ranges = {{0, 3}, {5, 5}},
          .request = {}};
}

JobArray with_further(const std::string& option) {
  JobArray made = array();
  made.request.further = {option};
  return made;
}

}  // namespace

TEST_CASE("a script of Slurm has all that a job needs") {
  CHECK(slurm_script(array()) ==
        "#!/bin/bash\n"
        "# Cases of c.xosc\n"
        "#SBATCH --job-name=c\n"
        "#SBATCH --array=0-1\n"
        "#SBATCH --chdir=/work\n"
        "#SBATCH --output=/work/campaigns/c/slurm/%A_%a.log\n"
        "#SBATCH --cpus-per-task=1\n"
        "\n"
        "ranges=(\n"
        "  0-3 5\n"
        ")\n"
        "cd /work || exit\n"
        "exec /bin/stride campaign run c.xosc --cases \"${ranges[SLURM_ARRAY_TASK_ID]}\"\n");
}

TEST_CASE("a script of Slurm has what is asked for, in quotation marks where it needs them") {
  JobArray made = array();
  made.working_folder = "/a \"b\" 50%";
  made.log_folder = "/a \"b\" 50%/slurm";
  made.environment = {"STRIDE_UNITS=/u=1:/an engineer's"};
  made.request = {
      .partition = "short",
      .time = "1-12",
      .licenses = "matlab:2",
      .account = "we",
      .further = {"mem=4G", "--exclusive", "C fast", "comment=a b", "--reservation=\"x y\""},
      .processors = 8};
  const std::string text = slurm_script(made);
  for (const char* line :
       {"#SBATCH --chdir=\"/a \\\"b\\\" 50%\"",
        "#SBATCH --output=\"/a \\\"b\\\" 50%%/slurm/%A_%a.log\"", "#SBATCH --cpus-per-task=8",
        "#SBATCH --partition=short", "#SBATCH --time=1-12", "#SBATCH --licenses=matlab:2",
        "#SBATCH --account=we", "#SBATCH --mem=4G", "#SBATCH --exclusive", "#SBATCH -C fast",
        "#SBATCH --comment=\"a b\"", "#SBATCH --reservation=\"x y\"", "cd '/a \"b\" 50%' || exit",
        "export STRIDE_UNITS='/u=1:/an engineer'\\''s'"}) {
    CHECK_THAT(text, Contains("\n" + std::string(line) + "\n"));
  }
}

TEST_CASE("ranges of a script of Slurm are in lines that can be read") {
  JobArray made = array();
  made.ranges.clear();
  for (std::uint64_t i = 0; i < 1000; ++i) made.ranges.push_back({10 * i, 10 * i + 9});
  const std::string text = slurm_script(made);
  std::size_t longest = 0;
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos;
       at = end + 1) {
    longest = std::max(longest, end - at);
  }
  CHECK(longest <= 102);
  CHECK_THAT(text, Contains("  0-9 10-19 20-29 ") && Contains(" 9990-9999\n)\n"));
}

TEST_CASE("options that a script of Slurm gives itself are refused") {
  for (const char* option : {"array=0-9", "--array=0-9", "-a 0-9", "wrap=x", "output=x", "c 4"}) {
    INFO(option);
    CHECK_THAT(error_of([&] { slurm_script(with_further(option)); }),
               Contains("which stride gives itself"));
  }
  CHECK_THAT(error_of([] { slurm_script(with_further("--")); }), Contains("names no option"));
  CHECK_THAT(error_of([] { slurm_script(with_further("mem=1\nrm -r /")); }),
             Contains("has more than one line"));
  JobArray made = array();
  made.request.partition = "a\n#SBATCH --wrap=x";
  CHECK_THAT(error_of([&] { slurm_script(made); }), Contains("has more than one line"));
}
