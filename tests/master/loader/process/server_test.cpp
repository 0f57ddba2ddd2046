// Requests that the unit's process has overwritten: errors in words, and not those of a library.
#include "master/loader/process/server.h"

#include <functional>
#include <limits>
#include <thread>

#include "master/loader/wire/codec.h"
#include "tests/master/loader/process/support.h"

using namespace stride;
using namespace stride::isolation;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A server without an instance, in a thread of this process.
class ServerFixture {
 public:
  ~ServerFixture() {
    send(RequestCode::Free, [](PacketWriter&) {});
    thread_.join();
  }

  std::string error_of(RequestCode request, const std::function<void(PacketWriter&)>& put) {
    send(request, put);
    const Turn& reply = link_.memory->reply;
    REQUIRE(reply.what == static_cast<std::uint32_t>(ReplyCode::Failed));
    PacketReader error({link_.packets.data(), reply.size});
    return run_error([&] { throw_error(error); });
  }

 private:
  void send(RequestCode request, const std::function<void(PacketWriter&)>& put) {
    PacketWriter packet(link_.packets);
    put(packet);
    Turn& turn = link_.memory->request;
    turn.what = static_cast<std::uint32_t>(request);
    turn.size = packet.size();
    const std::uint32_t number = ++turn.number;
    turn.doorbell.ring();
    while (link_.memory->reply.number != number) std::this_thread::yield();
  }

  HostLink link_;
  const HostedUnitSpec spec_{importer::Fmu::load(test_fmu("faulty")), "u", {}, {}};
  Server server_{link_, spec_, ::getpid()};
  std::thread thread_{[this] {
    server_.run();
    server_.confirm_end();
  }};
};

void put_nothing(PacketWriter&) {}

}  // namespace

TEST_CASE("a request that cannot be") {
  ServerFixture server;
  constexpr const char* kOverwritten = "unit 'u': the unit's process has written into the shared";
  const auto unknown = static_cast<RequestCode>(999);
  CHECK_THAT(server.error_of(unknown, put_nothing), Contains(kOverwritten));
  for (const RequestCode request :
       {RequestCode::Step, RequestCode::MakePlan, RequestCode::EnterInitialization,
        RequestCode::Get, RequestCode::GetClockInterval, RequestCode::InputsUpdated}) {
    INFO(static_cast<int>(request));
    CHECK_THAT(server.error_of(request, put_nothing), Contains(kOverwritten));
  }
  const auto without_plan = [](PacketWriter& to) { to.put(std::uint32_t{99}); };
  CHECK_THAT(server.error_of(RequestCode::Step, without_plan), Contains(kOverwritten));
  CHECK_THAT(server.error_of(RequestCode::MakePlan, without_plan), Contains(kOverwritten));
  const auto without_time = [](PacketWriter& to) { put_time(to, std::nullopt); };
  CHECK_THAT(server.error_of(RequestCode::EnterInitialization, without_time),
             Contains(kOverwritten));
}

TEST_CASE("a request for more values than there can be") {
  ServerFixture server;
  const auto endless = [](PacketWriter& to) {
    to.put(std::size_t{0});
    to.put(std::numeric_limits<std::size_t>::max());
  };
  CHECK_THAT(server.error_of(RequestCode::GetDerivatives, endless),
             Contains("unit 'u': there is not enough memory for what was requested of it"));
}
