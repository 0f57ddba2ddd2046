// The process that takes snapshots of itself, without a unit in it.
#include "master/loader/process/snapshots.h"

#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <numeric>
#include <thread>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/shared_memory.h"
#include "master/base/child_process/sibling.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/error.h"
#include "tests/scratch_folder.h"

using namespace stride::isolation;
using Catch::Contains;

namespace {

/// What outlives all processes of a test.
struct World {
  SnapshotBoard board;
  std::atomic<pid_t> active = 0;
  std::atomic<int> passes = 0;
  std::array<std::atomic<int>, 8> seen{};
  std::array<char, 1000> error{};
  int status = 0;          ///< of the active process
  int most_processes = 0;  ///< that the supervisor had at a time, as far as it saw
};

using SharedWorld = Shared<World>;
using Serve = std::function<void(World&, Snapshots&)>;

int count_children() {
  std::ifstream file(fmt::format("/proc/self/task/{}/children", ::getpid()));
  return static_cast<int>(std::distance(std::istream_iterator<int>(file), {}));
}

[[noreturn]] void begin(World& world, const Serve& serve, SnapshotOptions options) {
  Snapshots snapshots(world.board, world.active, ::getppid(), std::move(options));
  world.active = ::getpid();
  try {
    serve(world, snapshots);
  } catch (const std::exception& failure) {
    std::strncpy(world.error.data(), failure.what(), world.error.size() - 1);
  }
  ::_exit(0);
}

/// Serves in a child of a supervisor, until the active process ends. Returns the error that left
/// it.
std::string run(SharedWorld& world, const Serve& serve, SnapshotOptions options = {}) {
  options.context.unit = "u";
  const auto outcome = run_in_child([&] {
    const pid_t server = ::fork();
    if (server == 0) begin(*world, serve, options);
    pid_t nobody = 0;
    world->active.compare_exchange_strong(nobody, server);
    int status = 0;
    for (pid_t ended = -1; ended != world->active;) {
      ended = ::waitpid(-1, &status, 0);
      world->most_processes = std::max(world->most_processes, count_children());
      if (ended != world->active) world->board.note_end(ended);
    }
    world->status = status;
    return std::string(world->error.data());
  });
  REQUIRE(outcome.end == ChildOutcome::End::Answered);
  return outcome.text;
}

}  // namespace

TEST_CASE("a process goes on where it was saved, any number of times") {
  SharedWorld world;
  const auto error = run(world, [](World& w, Snapshots& snapshots) {
    std::vector<int> heap(100000);
    std::iota(heap.begin(), heap.end(), 0);
    int stack = 1;
    const bool is_back = snapshots.save(0);
    w.seen[0] += stack == 1 && heap[77777] == 77777 && heap.size() == 100000;
    w.seen[1] += is_back;
    stack = 2;
    std::fill(heap.begin(), heap.end(), -1);
    heap.resize(7);
    if (++w.passes < 500) snapshots.restore(0);
    w.seen[2] = stack;
  });
  CHECK(error == "");
  CHECK(world->status == 0);
  CHECK(world->seen[0] == 500);
  CHECK(world->seen[1] == 499);
  CHECK(world->seen[2] == 2);
  CHECK(world->board.snapshots == 1);
  CHECK(world->board.restores == 499);
}

TEST_CASE("a slot holds what was saved in it last, whichever process is active") {
  SharedWorld world;
  const auto error = run(world, [](World& w, Snapshots& snapshots) {
    int value = 1;
    snapshots.save(0);
    if (w.passes == 0) {
      value = 2;
      snapshots.save(3);
    }
    const int pass = w.passes++;
    w.seen[static_cast<std::size_t>(pass)] = value;
    if (pass == 0) snapshots.restore(0);
    if (pass == 1) snapshots.restore(3);  // by a process that had not saved it yet
    value = 5;
    if (pass == 2 && !snapshots.save(0)) {
      value = 6;
      snapshots.restore(0);
    }
    w.seen[3] = value;
  });
  CHECK(error == "");
  CHECK(world->seen[0] == 2);
  CHECK(world->seen[1] == 1);
  CHECK(world->seen[2] == 2);
  CHECK(world->seen[3] == 5);
  CHECK(world->board.most_kept == 2);
  CHECK(world->board.snapshots == 3);
}

TEST_CASE("of many snapshots in a slot the last one stays") {
  constexpr int kPasses = 10;
  SharedWorld world;
  const auto error = run(world, [](World& w, Snapshots& snapshots) {
    for (int i = 0; i < 300; ++i) {
      snapshots.save(0);
      w.seen[0] = i;
    }
    if (++w.passes < kPasses) snapshots.restore(0);
  });
  CHECK(error == "");
  CHECK(world->seen[0] == 299);
  CHECK(world->board.snapshots == 300);
  CHECK(world->board.most_kept == 1);
  // Those that were active before a restore may not have been waited for yet.
  CHECK(world->most_processes <= static_cast<int>(SnapshotBoard::kEntries) + kPasses);
}

TEST_CASE("more states than there can be are refused, and so is what was never kept") {
  SharedWorld world;
  CHECK_THAT(run(world, [](World&, Snapshots& snapshots) { snapshots.save(16); }),
             Contains("unit 'u'") && Contains("17 states") && Contains("16 snapshots"));
  CHECK_THAT(run(world, [](World&, Snapshots& snapshots) { snapshots.restore(1); }),
             Contains("unit 'u'") && Contains("nothing was saved"));
}

TEST_CASE("threads and processes of the unit are refused, while there are any") {
  SharedWorld world;
  const auto with_thread = [](World& w, Snapshots& snapshots) {
    std::atomic<bool> is_over = false;
    std::thread thread([&] {
      while (!is_over) ::usleep(100);
    });
    try {
      snapshots.save(0);
    } catch (const stride::core::Error& error) {
      std::strncpy(w.error.data(), error.what(), w.error.size() - 1);
    }
    is_over = true;
    thread.join();
    while (thread_count() > 1) ::usleep(100);
    snapshots.save(0);
    w.seen[0] = 1;
  };
  CHECK_THAT(run(world, with_thread), Contains("runs 2 threads") && Contains("OMP_NUM_THREADS=1"));
  CHECK(world->seen[0] == 1);
  const auto with_child = [](World&, Snapshots& snapshots) {
    if (::fork() == 0) {
      ::pause();
      ::_exit(0);
    }
    snapshots.save(0);
  };
  CHECK_THAT(run(world, with_child), Contains("has started another process"));
}

TEST_CASE("a snapshot that was killed is missed where it is needed") {
  SharedWorld world;
  const auto error = run(world, [](World& w, Snapshots& snapshots) {
    snapshots.save(0);
    ::kill(w.board.entries[0].process, SIGKILL);
    while (w.board.entries[0].state != SnapshotBoard::State::Lost) ::usleep(100);
    snapshots.save(1);
    try {
      snapshots.restore(0);
    } catch (const stride::core::Error&) {
      w.seen[0] = w.active == ::getpid();
    }
    snapshots.save(0);
    if (++w.passes < 2) snapshots.restore(0);
  });
  CHECK(error == "");
  CHECK(world->seen[0] == 1);
  CHECK(world->passes == 2);
}

TEST_CASE("the supervisor sees the crash of a restored process") {
  SharedWorld world;
  run(world, [](World&, Snapshots& snapshots) {
    if (snapshots.save(0)) std::raise(SIGILL);
    snapshots.restore(0);
  });
  CHECK(WIFSIGNALED(world->status));
  CHECK(WTERMSIG(world->status) == SIGILL);
}

TEST_CASE("what a snapshot has to itself is measured, and limited") {
  constexpr std::size_t kSize = std::size_t{32} << 20;
  const auto fill = [](World&, Snapshots& snapshots) {
    std::vector<char> memory(kSize, 'a');
    snapshots.save(0);
    std::fill(memory.begin(), memory.end(), 'b');
    snapshots.measure();
  };
  SharedWorld world;
  CHECK(run(world, fill) == "");
  CHECK(world->board.most_memory >= kSize);
  SnapshotOptions options;
  options.memory_limit = kSize / 2;
  SharedWorld limited;
  CHECK_THAT(run(limited, fill, options), Contains("its limit of 16 MiB"));
}

TEST_CASE("what a process taken back has written is not there twice") {
  const stride::tests::ScratchFolder scratch;
  SharedWorld world;
  const std::string path = (scratch / "trace").string();
  const auto error = run(world, [&](World& w, Snapshots& snapshots) {
    std::ofstream file(path);
    file << "begin " << std::flush << "buffered ";
    snapshots.save(0);
    file << "branch ";
    if (w.passes % 2 == 1) file << std::string(100000, 'x') << std::flush;
    if (++w.passes < 6) snapshots.restore(0);
    file << "end" << std::flush;
  });
  CHECK(error == "");
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK(text == "begin buffered branch " + std::string(100000, 'x') + "end");
}

TEST_CASE("nothing stays when the supervisor is killed") {
  SharedWorld world;
  const auto outcome = run_in_child(
      [&] {
        ::prctl(PR_SET_CHILD_SUBREAPER, 1);
        const pid_t supervisor = ::fork();
        if (supervisor == 0) {
          const Serve serve = [](World& w, Snapshots& snapshots) {
            for (const std::size_t slot : {0, 1, 2}) snapshots.save(slot);
            if (++w.passes < 2) snapshots.restore(1);
            ::kill(::getppid(), SIGKILL);
            for (;;) ::pause();
          };
          if (::fork() == 0) {
            end_with(::getppid());
            begin(*world, serve, {});
          }
          for (;;) ::pause();
        }
        int count = 0;
        for (pid_t ended = 0; (ended = ::wait(nullptr)) > 0;) ++count;
        return std::to_string(count);
      },
      {.limit = std::chrono::seconds(60)});
  CHECK(outcome.end == ChildOutcome::End::Answered);
  CHECK(std::stoi(outcome.text) >= 5);
}
