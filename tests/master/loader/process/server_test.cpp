// Requests that the unit's process has overwritten: errors in words, and not those of a library.
#include "master/loader/process/server.h"

#include <functional>
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
    send(code_of<&core::Unit::free>(), [](PacketWriter&) {});
    thread_.join();
  }

  std::string error_of(RequestCode request, const std::function<void(PacketWriter&)>& put) {
    send(request, put);
    const Turn& reply = link_.memory->reply;
    REQUIRE(reply.what == static_cast<std::uint32_t>(ReplyCode::Failed));
    PacketReader error({link_.packets.data(), reply.size});
    return run_error([&] { take_error(error).raise(); });
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
       {RequestCode::Step, RequestCode::MakePlan, RequestCode::InputsUpdated,
        code_of<&core::Unit::enter_initialization>(), code_of<&core::Unit::get>(),
        code_of<&core::ClockIntervals::clock_interval>()}) {
    INFO(static_cast<int>(request));
    CHECK_THAT(server.error_of(request, put_nothing), Contains(kOverwritten));
  }
}

TEST_CASE("a request for more values than there can be") {
  Fixture unit("idler");
  unit.start();
  double none = 0;
  auto& promises = unit->require_capability<core::IdlePromises>();
  const auto error = run_error([&] {
    promises.get_derivatives({}, {&none, std::size_t{1} << 60});
  });
  CHECK_THAT(error,
             Contains("unit 'u', at 0 s: there is not enough memory for what was requested"));
}
