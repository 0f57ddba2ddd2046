#include "master/loader/network/remote_spec.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/loader/network/description_files.h"

namespace stride::remote {
namespace {

/// Of a request that belongs to no unit.
PacketReader take_done(Connection& connection, const core::Location& where) {
  for (;;) {
    Message<ReplyHead> reply = connection.receive();
    if (reply.head.code == ReplyCode::Done) return reply.packet;
    if (reply.head.code == ReplyCode::Failed) {
      isolation::SentError error = isolation::take_error(reply.packet);
      supplement(error, {.where = where}, connection.machine());
      error.raise();
    }
    if (reply.head.code != kLog) {
      connection.fail_bad_message("an answer that nobody has asked for");
    }
  }
}

std::vector<importer::DescriptionFile> take_files(PacketReader& from) {
  std::vector<importer::DescriptionFile> files(from.take_count(2 * sizeof(std::size_t)));
  for (importer::DescriptionFile& file : files) {
    file.name = from.take_text();
    file.text = from.take_text();
  }
  from.require_end();
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
  PacketWriter request = connection.write();
  request.put(spec.fmu);
  connection.send(kDescribe, request, "the description");
  return checked(connection, [&] {
    PacketReader answer = take_done(connection, where);
    const std::string path = answer.take_text();
    return make_described_fmu(take_files(answer), where,
                              fmt::format("{}:{}", spec.place.machine, path));
  });
}

void supplement(isolation::SentError& error, const core::Context& here,
                const std::string& machine) {
  core::Location there = error.context.where;
  if (there.file == here.where.file && there.line == here.where.line) there = {};
  error.context.where = here.where;
  if (!here.unit.empty()) error.context.unit = here.unit;
  error.message = fmt::format("{}: {}{}", machine, core::to_text({.where = there}), error.message);
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
    connection.send(kPing, connection.write(), "a round trip");
    checked(connection, [&] { take_done(connection, where); });
    times.push_back(Clock::now() - sent);
  }
  std::ranges::sort(times);
  return {connected - begin, times[times.size() / 2]};
}

}  // namespace stride::remote
