#include "master/loader/process/log_message.h"

#include <array>
#include <cstdint>
#include <memory>
#include <thread>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::isolation;

namespace {

std::vector<LogMessage> read(LogReader& reader) {
  std::vector<LogMessage> messages;
  reader.read([&](LogMessage&& message) { messages.push_back(std::move(message)); });
  return messages;
}

}  // namespace

TEST_CASE("messages come over one by one") {
  const isolation::Shared<HostLinkMemory> link;
  LogWriter writer(*link);
  LogReader reader(*link);
  CHECK(reader.is_empty());
  writer.write({importer::Status::Warning, "category", "text"});
  writer.write({importer::Status::Pending, "", ""});
  CHECK_FALSE(reader.is_empty());
  const auto messages = read(reader);
  REQUIRE(messages.size() == 2);
  CHECK(messages[0].status == importer::Status::Warning);
  CHECK(messages[0].category == "category");
  CHECK(messages[0].text == "text");
  CHECK(messages[1].status == importer::Status::Pending);
  CHECK(messages[1].text.empty());
}

TEST_CASE("messages of several threads, longer than there is room for, come over whole") {
  const isolation::Shared<HostLinkMemory> link;
  LogWriter writer(*link);
  LogReader reader(*link);
  const auto write = [&](char letter) {
    for (int i = 0; i < 5; ++i)
      writer.write({importer::Status::Ok, "", std::string(200'000, letter)});
  };
  std::thread first(write, 'a');
  std::thread second(write, 'b');
  std::size_t whole = 0;
  while (whole < 10) {
    for (const LogMessage& message : read(reader)) {
      CHECK(message.text == std::string(200'000, message.text[0]));
      ++whole;
    }
  }
  first.join();
  second.join();
}

TEST_CASE("an invalid status is refused, and a message without an end takes no memory") {
  const isolation::Shared<HostLinkMemory> link;
  LogReader reader(*link);
  link->logged.write(std::string(16, '\xff'));
  link->logged.write(std::string(1000, 'x'));
  CHECK(read(reader).empty());
}

TEST_CASE("a message that would be longer than any is dropped, and not waited for") {
  const isolation::Shared<HostLinkMemory> link;
  LogReader reader(*link);
  const std::array<std::uint64_t, 2> head{0, std::uint64_t{1} << 40};
  link->logged.write({reinterpret_cast<const char*>(head.data()), sizeof head});
  CHECK(read(reader).empty());
  LogWriter(*link).write({importer::Status::Ok, "", "the next"});
  const auto messages = read(reader);
  REQUIRE(messages.size() == 1);
  CHECK(messages[0].text == "the next");
}
