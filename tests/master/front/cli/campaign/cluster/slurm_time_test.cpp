#include "master/front/cli/campaign/cluster/slurm_time.h"

#include <limits>

#include <catch2/catch.hpp>

using stride::cli::slurm_seconds;

TEST_CASE("limits of time are those of Slurm") {
  CHECK(slurm_seconds("90") == 5400);
  CHECK(slurm_seconds("1:30") == 90);
  CHECK(slurm_seconds("1:00:30") == 3630);
  CHECK(slurm_seconds("2-3") == 183600);
  CHECK(slurm_seconds("2-3:30") == 185400);
  CHECK(slurm_seconds("2-3:30:05") == 185405);
  CHECK(slurm_seconds("UNLIMITED") == std::numeric_limits<double>::infinity());
  for (const char* text : {"", "1h", "1.5", "-1", "1-", "1:2:3:4", "1:2-3", "1-2-3", ":5", "1:"}) {
    INFO(text);
    CHECK_FALSE(slurm_seconds(text));
  }
}
