#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_VCD_RECORDER_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_VCD_RECORDER_H

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "master/base/files/output_file.h"
#include "master/engine/model/description.h"
#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"

namespace stride::recorders {

/// A tree of scopes, in the order in which their variables were added.
class VcdScope {
 public:
  explicit VcdScope(std::string name = "") : name_(std::move(name)) {}

  /// The scope of this name in this one, made where there is none.
  VcdScope& scope(std::string_view name);
  /// Declares a variable; the parts of its name before the last dot are scopes.
  void add(std::string_view structured_name, core::ValueType type, std::string_view code);
  /// The declarations within this scope, without its own frame.
  void write(core::OutputFile& file) const;

 private:
  std::string name_;
  std::vector<VcdScope> scopes_;
  std::map<std::string, std::size_t> places_;  ///< of the scopes, by name
  std::vector<std::string> variables_;
};

/// signals.vcd: a value change dump (IEEE 1364) with a time scale of 1 ps, for GTKWave and others;
/// of 1 ns where the stop time is later than the 64 bits of viewers have picoseconds for, 106 days,
/// and so on.
/// The parts of a structured name are scopes. The recorded signals are written at communication
/// points, where they changed; each clock is an event at its exact time, and what it carries is
/// written with it (Binary as a string of hexadecimal digits; strings are GTKWave's extension).
/// Equal runs make equal files: there is no date in it.
class VcdRecorder : public core::Observer {
 public:
  /// As CsvRecorder.
  VcdRecorder(const core::System& system, std::filesystem::path file,
              core::OutputFile::Existing existing = core::OutputFile::Existing::Emptied,
              Time stop = {});

  /// At a communication point, behind on_start(): as core::OutputFile::persist().
  void persist(core::StateArchive& state);
  core::OutputFile& file() { return file_; }

  void on_start(std::span<const core::Signal> signals) override;
  void on_message(const core::Message& message) override;
  void on_communication_point(Time time) override;
  void on_finish() override;

 private:
  /// An element of a recorded signal.
  struct VcdVariable {
    const core::ValueBlock* block;
    std::size_t element;
    std::string code;
    std::uint64_t bits = 0;  ///< the value last written
    std::string text{};      ///< likewise, of String and Binary
  };
  /// How a message of a clocked variable or of a clock is written.
  struct MessageCodes {
    std::vector<std::string> clocks;
    std::vector<std::string> elements;
  };

  std::string next_code();
  void declare_signals(std::span<const core::Signal> signals, VcdScope& top);
  void declare_messages(VcdScope& top);
  std::string declare(VcdScope& top, core::VariableId id, std::size_t element);
  void end_header(Time start);
  void move_to(Time time);
  void write_changes(bool all);

  const core::System& system_;
  core::OutputFile file_;
  std::uint64_t codes_ = 0;
  std::vector<VcdVariable> recorded_;
  std::vector<std::vector<MessageCodes>> messages_;  ///< by component and variable
  std::optional<Time> written_time_;
  Time origin_{};     ///< of the time stamps
  Duration tick_{1};  ///< the time scale
  Time last_point_{};
  bool is_first_point_ = true;
};

}  // namespace stride::recorders

#endif
