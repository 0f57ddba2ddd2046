#include "master/loader/wire/packet.h"

#include <limits>

#include <catch2/catch.hpp>

using namespace stride::isolation;

namespace {

PacketReader reader(const stride::isolation::GrowingMemory& memory, const PacketWriter& written) {
  return PacketReader({memory.data(), written.size()});
}

}  // namespace

TEST_CASE("what is put comes out again, in the same order") {
  stride::isolation::GrowingMemory memory("test", 16);
  PacketWriter out(memory);
  const std::vector<double> numbers{1, -0.0, std::numeric_limits<double>::infinity()};
  out.put(std::uint8_t{7});
  out.put(3.5);
  out.put_all(std::span(numbers));
  out.put(true);
  out.put(std::string(100'000, 'x'));
  out.put(std::string());
  PacketReader in = reader(memory, out);
  CHECK(in.take<std::uint8_t>() == 7);
  CHECK(in.take<double>() == 3.5);
  CHECK(in.take_all<double>() == numbers);
  CHECK(in.take<bool>());
  CHECK(in.take_text() == std::string(100'000, 'x'));
  CHECK(in.take_text().empty());
  CHECK_THROWS_AS(in.take<char>(), BadPacket);
}

TEST_CASE("a size that is none is an error, and takes no memory") {
  stride::isolation::GrowingMemory memory("test", 16);
  for (const std::size_t size : {std::size_t{9}, std::size_t{1} << 60, ~std::size_t{0}}) {
    PacketWriter out(memory);
    out.put(size);
    out.put(std::uint64_t{0});
    CHECK_THROWS_AS(reader(memory, out).take_text(), BadPacket);
    CHECK_THROWS_AS(reader(memory, out).take_all<double>(), BadPacket);
  }
}
