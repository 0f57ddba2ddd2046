// Has a thread beside the one that calls it, from its start to its end, if it is told to. It lists
// no state, and a fork of its process would be without the thread.
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include <stride/unit.h>

namespace {

/// Waits in the background until it is destroyed.
class Background {
 public:
  Background() : thread_([this] { wait(); }) {}
  ~Background() {
    {
      const std::lock_guard lock(mutex_);
      is_over_ = true;
    }
    change_.notify_one();
    thread_.join();
  }

 private:
  void wait() {
    std::unique_lock lock(mutex_);
    change_.wait(lock, [this] { return is_over_; });
  }

  std::mutex mutex_;
  std::condition_variable change_;
  bool is_over_ = false;
  std::thread thread_;
};

class Threader : public stride::Unit {
 public:
  Threader() {
    describe("Has a thread in the background").may_reject = true;
    parameter("has_thread", has_thread_);
    output("steps", steps_).exact().depends_on({});
  }

  void initialize(stride::Time) override {
    if (has_thread_) background_.emplace();
  }
  void step(stride::Step&) override { ++steps_; }

 private:
  bool has_thread_ = false;
  std::int32_t steps_ = 0;
  std::optional<Background> background_;
};

}  // namespace

STRIDE_UNIT(Threader)
