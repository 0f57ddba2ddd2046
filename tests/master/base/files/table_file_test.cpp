#include "master/base/files/table_file.h"

#include <catch2/catch.hpp>

using namespace stride::core;

TEST_CASE("a table is known by the end of its name") {
  for (const char* name : {"cycle.csv", "a/b.CSV", "cycle.parquet", "run.mcap"}) {
    CHECK(is_table_name(name));
  }
  for (const char* name : {"cycle", "csv", "cycle.fmu", "cycle.csv.gz", ""}) {
    CHECK(!is_table_name(name));
  }
  CHECK(is_foreign_table_name("cycle.Parquet"));
  CHECK(!is_foreign_table_name("cycle.csv"));
}
