// A run for recorders, by hand: the signals of component "a" of sample_system().
#ifndef STRIDE_TESTS_MASTER_OBSERVE_RECORDERS_RECORDER_SUPPORT_H
#define STRIDE_TESTS_MASTER_OBSERVE_RECORDERS_RECORDER_SUPPORT_H

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "master/base/files/output_file.h"
#include "master/base/state_archive.h"
#include "master/engine/port/observer.h"
#include "tests/master/system/ssp/support.h"

namespace stride::tests {

inline Time milliseconds(std::int64_t count) { return Time(std::chrono::milliseconds(count)); }

struct SampleRun {
  core::System system = sample_system();
  core::ValueBlock numbers{core::ValueType::Float64, 5};  ///< position, then distance twice
  core::ValueBlock led{core::ValueType::Boolean, 1};
  core::ValueBlock count{core::ValueType::Int32, 1};
  core::ValueBlock label{core::ValueType::String, 1};
  core::ValueBlock digest{core::ValueType::Binary, 1};
  core::ValueBlock frame{core::ValueType::Binary, 1};

  std::vector<core::Signal> signals() const {
    return {{{0, 1}, &numbers, 3}, {{0, 2}, &led, 0},   {{0, 3}, &count, 0},
            {{0, 4}, &numbers, 0}, {{0, 5}, &label, 0}, {{0, 6}, &digest, 0},
            {{1, 1}, &numbers, 4}};
  }
  core::Message frame_at(Time time, bool received, std::size_t component, std::uint32_t index = 0) {
    return {time, index, {component, 8}, received, &frame, 0};
  }
  core::Message tick_at(Time time) { return {time, 0, {0, 9}, false, nullptr, 0}; }

  void set_first() {
    numbers.numbers<double>()[0] = 1;
    numbers.numbers<double>()[1] = -0.5;
    numbers.numbers<double>()[2] = 1e-9;
    numbers.numbers<double>()[3] = 0.1;
    label.strings()[0] = "a \"b\"\\";
    digest.binaries()[0] = {0x0a, 0xff};
  }
  void set_second() {
    numbers.numbers<double>()[3] = 0.30000000000000004;
    led.numbers<bool>()[0] = true;
    count.numbers<std::int32_t>()[0] = -3;
    label.strings()[0] = "";
  }
};

/// The file of a recorder that sees the run of this helper.
template <class Recorder>
class ContinuedRecorder {
 public:
  explicit ContinuedRecorder(std::filesystem::path file) : file_(std::move(file)) {}

  std::string whole() {
    Recorder recorder(run_.system, file_);
    recorder.on_start(run_.signals());
    make_first_part(recorder);
    make_second_part(recorder);
    recorder.on_finish();
    return content(file_);
  }
  /// Of two recorders, between which the file has grown.
  std::string in_two_parts() {
    const std::vector<std::byte> bytes = state_behind_first_part();
    Recorder recorder(run_.system, file_, core::OutputFile::Existing::Kept);
    recorder.on_start(run_.signals());
    core::StateArchive state(bytes);
    recorder.persist(state);
    state.end();
    recorder.file().go_on();
    make_second_part(recorder);
    recorder.on_finish();
    return content(file_);
  }

 private:
  std::vector<std::byte> state_behind_first_part() {
    Recorder recorder(run_.system, file_);
    recorder.on_start(run_.signals());
    make_first_part(recorder);
    core::StateArchive state;
    recorder.persist(state);
    make_second_part(recorder);
    make_second_part(recorder);
    recorder.on_finish();
    return state.bytes();
  }
  void make_first_part(Recorder& recorder) {
    run_.led.numbers<bool>()[0] = false;
    run_.count.numbers<std::int32_t>()[0] = 0;
    run_.set_first();
    recorder.on_communication_point(Time{});
    run_.set_second();
    run_.frame.binaries()[0] = {1, 2};
    recorder.on_message(run_.frame_at(milliseconds(1), false, 0));
    report_activity(recorder, milliseconds(1));
    recorder.on_communication_point(milliseconds(1));
  }
  void make_second_part(Recorder& recorder) {
    run_.numbers.numbers<double>()[3] = 7;
    recorder.on_message(run_.frame_at(milliseconds(2), true, 1));
    report_activity(recorder, milliseconds(2));
    recorder.on_communication_point(milliseconds(2));
    recorder.on_communication_point(milliseconds(3));
  }
  static void report_activity(core::Observer& recorder, Time time) {
    recorder.on_activity({1, core::Activity::Kind::Event, time, time});
  }

  std::filesystem::path file_;
  SampleRun run_;
};

}  // namespace stride::tests

#endif
