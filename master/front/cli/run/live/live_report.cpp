#include "master/front/cli/run/live/live_report.h"

#include <filesystem>
#include <string>
#include <utility>

#include "master/study/results/report_page.h"

namespace stride::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kBetweenUpdates = 1s;

}  // namespace

LiveReport::LiveReport(LiveServer& server, const results::ResultsTarget& results,
                       std::function<void()> flush)
    : server_(server), results_(results), flush_(std::move(flush)) {}

void LiveReport::on_communication_point(Time) {
  const auto now = std::chrono::steady_clock::now();
  if (server_.has_started() && now - last_ < kBetweenUpdates) return;
  last_ = now;
  flush_();
  if (server_.has_started()) return server_.announce_update();
  // a unit may change the working folder
  server_.start([folder = std::filesystem::absolute(results_.folder), files = results_.files](
                    bool is_over) { return results::live_report(folder, files, is_over); });
  if (ready_) ready_(server_.address());
}

}  // namespace stride::cli
