#include "master/study/campaign/cases/chunks.h"

#include <catch2/catch.hpp>

using namespace stride::campaign;

namespace {

std::vector<std::string> texts(const std::vector<CaseRange>& ranges) {
  std::vector<std::string> texts;
  for (const CaseRange& range : ranges) texts.push_back(to_text(range));
  return texts;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("a chunk holds so many missing cases, whatever is between them") {
  CHECK(texts(chunks(std::vector<bool>(7, true), 3)) == Texts{"0-2", "3-5", "6"});
  CHECK(texts(chunks({false, true, false, true, true, false, true, false}, 2)) ==
        Texts{"1-3", "4-6"});
  CHECK(texts(chunks({true, false, true}, 9)) == Texts{"0-2"});
  CHECK(chunks({false, false}, 3).empty());
}

TEST_CASE("a job takes some minutes where the time of a case is known") {
  CHECK(chunk_length(100'000, {.wall_time = 10, .most_chunks = 1'000'000}) == 30);
  CHECK(chunk_length(100'000, {.wall_time = 1000, .most_chunks = 1'000'000}) == 1);
  CHECK(chunk_length(50, {.wall_time = 1e-9, .most_chunks = 1000}) == 50);
  CHECK(chunk_length(100'000, {.wall_time = 10, .side_by_side = 8, .most_chunks = 1'000'000}) ==
        240);
  CHECK(chunk_length(100, {.wall_time = 1000, .side_by_side = 8, .most_chunks = 1000}) == 8);
}

TEST_CASE("a job takes no longer than half of its limit") {
  CHECK(chunk_length(100'000, {.wall_time = 10, .time_limit = 100, .most_chunks = 1'000'000}) == 5);
  CHECK(chunk_length(100'000, {.wall_time = 10, .time_limit = 9000, .most_chunks = 1'000'000}) ==
        30);
  CHECK(chunk_length(10, {.wall_time = 10, .time_limit = 12, .most_chunks = 100}) == 1);
}

TEST_CASE("a job that is waited for has one case, or as many as it runs at the same time") {
  CHECK(chunk_length(8, {.wall_time = 0.1, .job_time = 0, .most_chunks = 100}) == 1);
  CHECK(chunk_length(8, {.wall_time = 9, .time_limit = 60, .job_time = 0, .most_chunks = 4}) == 2);
  CHECK(chunk_length(9, {.wall_time = 9, .job_time = 0, .side_by_side = 3, .most_chunks = 100}) ==
        3);
}

TEST_CASE("there are a hundred jobs where no time is known") {
  CHECK(chunk_length(100'000, {.most_chunks = 1001}) == 1000);
  CHECK(chunk_length(8, {.most_chunks = 1001}) == 1);
  CHECK(chunk_length(8, {.side_by_side = 4, .most_chunks = 1001}) == 4);
}

TEST_CASE("there are no more jobs than may be, and they are of one length") {
  CHECK(chunk_length(100'000, {.wall_time = 300, .most_chunks = 1001}) == 100);
  CHECK(chunk_length(1002, {.wall_time = 300, .most_chunks = 1001}) == 2);
  CHECK(chunk_length(101, {.most_chunks = 10}) == 11);
  CHECK(chunk_length(31, {.wall_time = 10, .most_chunks = 100}) == 16);
  CHECK(chunk_length(5, {.most_chunks = 1}) == 5);
}
