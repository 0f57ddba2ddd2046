#ifndef STRIDE_MASTER_FRONT_CLI_RUN_LIVE_LIVE_REPORT_H
#define STRIDE_MASTER_FRONT_CLI_RUN_LIVE_LIVE_REPORT_H

#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include <stride/time.h>

#include "master/engine/port/observer.h"
#include "master/front/cli/run/live/live_server.h"
#include "master/study/results/results_target.h"

namespace stride::cli {

/// The report of a run while it goes on: about once a second what is recorded so far is in its
/// files, of which the server makes the page.
class LiveReport : public core::Observer {
 public:
  /// `flush` writes what is recorded. The server must outlive it.
  LiveReport(LiveServer& server, const results::ResultsTarget& results,
             std::function<void()> flush);

  /// What is called with the address when the page is there.
  void set_ready(std::function<void(const std::string&)> ready) { ready_ = std::move(ready); }

  void on_communication_point(Time time) override;

 private:
  LiveServer& server_;
  const results::ResultsTarget& results_;
  const std::function<void()> flush_;
  std::function<void(const std::string&)> ready_{};
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace stride::cli

#endif
