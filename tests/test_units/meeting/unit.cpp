// Waits in each step until another unit has begun the same one.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include <stride/unit.h>

namespace {

class Meeting : public stride::Unit {
 public:
  explicit Meeting(const stride::Setup& setup) : name_(setup.instance_name) {
    describe("Waits in each step until another unit has begun the same one");
    parameter("other", other_).description("the other unit; empty: it waits for none");
    parameter("folder", folder_).description("where both say which steps they have begun");
    parameter("message", message_).description("so many bytes it logs in each step");
    output("steps", steps_).exact().depends_on({});
    state();
  }

  void step(stride::Step&) override {
    ++steps_;
    if (message_ > 0) log(stride::Severity::Warning, std::string(message_, 'x'));
    if (other_.empty()) return;
    const std::ofstream begun(file_of(name_));
    const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!std::filesystem::exists(file_of(other_))) {
      if (std::chrono::steady_clock::now() > limit) {
        throw std::runtime_error("'" + other_ + "' has not begun this step");
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

 private:
  std::filesystem::path file_of(const std::string& unit) const {
    return std::filesystem::path(folder_) / (unit + " " + std::to_string(steps_));
  }

  std::string name_, other_, folder_;
  std::uint32_t message_ = 0;
  std::int32_t steps_ = 0;
};

}  // namespace

STRIDE_UNIT(Meeting)
