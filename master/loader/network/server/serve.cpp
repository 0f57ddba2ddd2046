#include "master/loader/network/server/serve.h"

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/loader/network/server/server_channel.h"
#include "master/loader/network/server/unit_server.h"

namespace stride::remote {
namespace {

/// Both versions of each side are said on both sides.
void require_same_protocol(const Greeting& master) {
  const Greeting own = own_greeting();
  if (master.protocol == own.protocol) return;
  core::fail_run({}, fmt::format("stride {} here has protocol {}, and stride {} of the master has "
                                 "protocol {}",
                                 own.build, own.protocol, master.build, master.protocol));
}

}  // namespace

void serve(int in, int out, const ServeOptions& options,
           const volatile std::sig_atomic_t& interrupted) {
  try {
    ServerChannel channel(in, out, interrupted);
    UnitServer server(channel, options);
    require_same_protocol(channel.greet());
    channel.begin();
    server.run();
  } catch (const LinkEnded&) {
  } catch (const BadGreeting& mistake) {
    core::fail_run({}, fmt::format("what came is not from a master: {}", mistake.what()),
                   "stride serve is started by stride run, for <stride:Host at=\"ssh://…\"/>");
  } catch (const BadPacket& mistake) {
    core::fail_run({}, fmt::format("the master's message cannot be read: {}", mistake.what()));
  }
}

}  // namespace stride::remote
