#include "master/report/message_rows.h"

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/master/report/support.h"

using namespace stride::report;
using Catch::Contains;

namespace {

MessageRows rows_of(const std::string& text) {
  const TemporaryFolder folder;
  return MessageRows(folder.write("events.csv", text));
}

const std::string kMessageHeader = "time,index,component,variable,direction,payload,content\n";

}  // namespace

TEST_CASE("a row of messages is read, whatever the order of the columns") {
  MessageRows rows =
      rows_of("index,time,component,variable,direction,content,payload\n3,0.5,a,y,sent,hi,00ff\n");
  REQUIRE(rows.table().next());
  const RecordedMessage message = rows.message();
  CHECK(message.time == stride::tests::at(0.5));
  CHECK(message.index == 3);
  CHECK(message.component == "a");
  CHECK(message.variable == "y");
  CHECK(message.direction == "sent");
  CHECK(message.payload == "00ff");
  CHECK(message.content == "hi");
  CHECK_FALSE(rows.table().next());
}

TEST_CASE("a direction that is none is refused") {
  MessageRows rows = rows_of(kMessageHeader + "0,0,a,y,c,,\n0,0,a,y,intervention,,\n");
  rows.table().next();
  CHECK_THAT(error_of([&] { rows.message(); }),
             Contains("events.csv:2: ") && Contains("sent, received or intervention, found 'c'"));
  rows.table().next();
  CHECK(rows.message().direction == "intervention");
}

TEST_CASE("an index or a time that is none is refused") {
  MessageRows rows = rows_of(kMessageHeader + "0,-1,a,y,sent,,\nx,1,a,y,sent,,\n");
  rows.table().next();
  CHECK_THAT(error_of([&] { rows.message(); }), Contains("events.csv:2: ") && Contains("index"));
  rows.table().next();
  CHECK_THAT(error_of([&] { rows.message(); }), Contains("events.csv:3: ") && Contains("time"));
}

TEST_CASE("a file needs its columns, but for the content, or is empty") {
  CHECK_THAT(error_of([] { rows_of("time,index\n"); }), Contains("no column 'component'"));
  CHECK_NOTHROW(rows_of("time,index,component,variable,direction,payload\n"));
  CHECK(rows_of("").table().columns().empty());
}
