#include "master/loader/network/remote_spec.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/loader/network/codec.h"
#include "master/loader/network/description_files.h"

namespace stride::remote {
namespace {

/// The messages of a connection that belong to no unit, handled as they come.
wire::Result::Reader take_done(Connection& connection, const core::Location& where) {
  for (;;) {
    const wire::Reply::Reader reply = connection.receive();
    if (reply.isDone()) return reply.getDone();
    if (reply.isFailed()) throw_error(reply.getFailed(), {.where = where}, connection.machine());
    if (!reply.isLog()) connection.fail_bad_message("an answer that nobody has asked for");
  }
}

std::vector<importer::DescriptionFile> take_files(wire::Description::Reader description) {
  std::vector<importer::DescriptionFile> files;
  for (const auto file : description.getFiles()) {
    const auto text = file.getBytes().asChars();
    files.push_back({to_string(file.getName()), std::string(text.begin(), text.size())});
  }
  return files;
}

}  // namespace

ConnectionOptions connection_options(const RemoteSpec& spec, const core::Location& where) {
  return {.place = spec.place,
          .context = {.where = where},
          .connect_limit = spec.connect_limit,
          .silence_limit = spec.silence_limit,
          .interrupted = spec.interrupted};
}

std::shared_ptr<importer::Fmu> describe(const RemoteSpec& spec, const core::Location& where) {
  if (!spec.sent.empty()) return importer::Fmu::load(spec.sent, where);
  Connection connection(connection_options(spec, where));
  connection.greet();
  connection.ask("the description",
                 [&](wire::Request::Builder request) { request.setDescribe(spec.fmu); });
  return checked(connection, [&] {
    const wire::Result::Reader result = take_done(connection, where);
    if (!result.isDescription()) throw BadMessage("an answer of another kind");
    const auto description = result.getDescription();
    return make_described_fmu(
        take_files(description), where,
        fmt::format("{}:{}", spec.place.machine, to_string(description.getPath())));
  });
}

Trial try_connection(const RemoteSpec& spec, const core::Location& where) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kTrials = 15;
  const auto begin = Clock::now();
  Connection connection(connection_options(spec, where));
  connection.greet();
  const auto connected = Clock::now();
  std::vector<std::chrono::nanoseconds> times;
  while (times.size() < kTrials) {
    const auto sent = Clock::now();
    connection.ask("a round trip", [](wire::Request::Builder request) { request.setPing(); });
    checked(connection, [&] { take_done(connection, where); });
    times.push_back(Clock::now() - sent);
  }
  std::ranges::sort(times);
  return {connected - begin, times[times.size() / 2]};
}

}  // namespace stride::remote
