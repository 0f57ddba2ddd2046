// Campaigns with a unit on another machine: `exec:` with the program of this build in its place.
#include <algorithm>
#include <string>
#include <vector>

#include "tests/cli/campaigns.h"
#include "tests/cli/leftovers.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Four cases, one after the other. The unit `second` is behind link.sh, which is called once for
/// its description and then once for each case.
class FarCampaign : public Workspace {
 public:
  FarCampaign() : Workspace(far_filters()) {
    scratch().write("c.xosc", drawn_input("4", "<stride:Keep results='none'/>"));
    restore_links();
  }

  void restore_links() const {
    scratch().write("link.sh", "exec " + stride_program().string() + " serve\n");
  }
  /// From here on, links are counted, and these are killed when the first 20000 bytes have gone
  /// through them, which is within the steps of a case.
  void kill_links(unsigned first, unsigned last) const {
    std::error_code none;
    fs::remove(*this / "links", none);
    scratch().write("link.sh",
                    "echo >> links\nnumber=$(wc -l < links)\n"
                    "test $number -lt " +
                        std::to_string(first) + " || test $number -gt " + std::to_string(last) +
                        " && exec " + stride_program().string() +
                        " serve\n"
                        "(dd bs=1 count=20000 2> /dev/null; kill -9 $$) | " +
                        stride_program().string() + " serve\n");
  }
  std::size_t links() const {
    if (!fs::exists(*this / "links")) return 0;
    const std::string lines = read(*this / "links");
    return static_cast<std::size_t>(std::ranges::count(lines, '\n'));
  }
  Outcome campaign(const std::string& out) const {
    return stride({"campaign", "run", "c.xosc", "--quiet", "--jobs", "1", "--out", out});
  }
  std::string table(const std::string& out) const {
    return without_wall_times(read(*this / (out + "/cases.csv")));
  }

 private:
  static Parts far_filters() {
    Parts parts = two_filters();
    parts.annotation = "<stride:Host components='second' at='exec:exec sh link.sh'/>\n";
    return parts;
  }
};

}  // namespace

TEST_CASE("a machine that stays lost ends a campaign, and is no outcome of a case") {
  const Leftovers leftovers;
  const FarCampaign space;
  REQUIRE(space.campaign("whole").exit_code == 0);
  space.kill_links(4, 1000);
  const Outcome outcome = space.campaign("out");
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("a machine of one of its units is lost, so case 2 is not done: ") &&
                 Contains("unit 'second', at 0.") &&
                 Contains("the link to exec sh link.sh has ended in a step") &&
                 Contains("hint: see to it, and run the campaign again: it goes on"));
  CHECK(space.links() == 6);  // the description, four cases, and one of them once more
  CHECK(records_in(space / "out") == 2);
  CHECK(leftovers.after_a_while().empty());

  space.restore_links();
  CHECK(space.campaign("out").exit_code == 0);
  CHECK(space.table("out") == space.table("whole"));
}

TEST_CASE("who reads the records of a campaign needs no machine") {
  const FarCampaign space;
  REQUIRE(space.campaign("out").exit_code == 0);
  const std::string table = space.table("out");
  space.kill_links(1, 1000);
  std::vector<std::string> commands{"status"};
  if (fs::exists(space / "out/campaign.html")) commands.push_back("report");  // of this build
  for (const std::string& command : commands) {
    for (const Arguments& of : {Arguments{"out"}, Arguments{"c.xosc", "--out", "out"}}) {
      Arguments arguments{"campaign", command};
      arguments.insert(arguments.end(), of.begin(), of.end());
      const Outcome outcome = space.stride(arguments);
      CHECK(outcome.err == "");
      CHECK(outcome.exit_code == 0);
    }
  }
  CHECK_THAT(space.stride({"campaign", "status", "out"}).out,
             Contains("4 of 4 cases done, 4 passed"));
  CHECK(space.links() == 0);
  CHECK(space.table("out") == table);
  CHECK(space.campaign("out").exit_code == 0);
  CHECK(space.links() == 1);  // what runs looks whether the unit is the same
}

TEST_CASE("a case that loses its machine once is run once more") {
  const FarCampaign space;
  REQUIRE(space.campaign("whole").exit_code == 0);
  space.kill_links(4, 4);
  const Outcome outcome = space.campaign("out");
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
  CHECK(space.links() == 6);
  CHECK(space.table("out") == space.table("whole"));
}
