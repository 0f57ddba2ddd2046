// The reader as an FMU. Its axes, and so its variable table, come from the program in its
// resources.
#include <stdexcept>
#include <string>

#include <stride/unit.h>

#include "units/reader/model.h"

namespace {

reader::Program load(const std::filesystem::path& resources, const std::string& name) {
  if (resources.empty()) {
    throw std::runtime_error("the reader has no resources folder: expected one with " + name);
  }
  return reader::load_program((resources / name).string());
}

std::string text_of(const reader::Record& record) {
  const auto seconds = [](auto time) { return std::to_string(stride::to_seconds(time)) + " s"; };
  switch (record.outcome) {
    case reader::Outcome::kWaiting:
      return "waiting";
    case reader::Outcome::kAnswered:
      return "answered after " + seconds(record.answered_at - record.sent_at);
    case reader::Outcome::kRefused:
      return "refused with status " + std::to_string(static_cast<int>(record.status));
    case reader::Outcome::kUnanswered:
      return "not answered in time";
    case reader::Outcome::kDamaged:
      return "answered by a damaged frame";
  }
  return "";
}

}  // namespace

class ReaderUnit : public stride::Unit {
 public:
  explicit ReaderUnit(const stride::Setup& setup)
      : resources_(setup.resources), reader_(load(resources_, program_)), loaded_(program_) {
    describe("Robot with an NFC reader: runs a program of movements and commands").early_return =
        true;
    list_variables();
    auto& s = reader_.state();
    state(s.records, s.request_end, s.deadline, s.receiving, s.reception, s.counts, s.temperature,
          s.identifier, reported_);
  }

  void initialize(stride::Time start) override {
    start_program();
    reported_ = 0;
    show(start);
  }

  void step(stride::Step& step) override {
    stride::Time end = step.to();
    const auto next = reader_.next_event_time(step.from());
    if (next && *next <= end) {
      if (step.early_return_allowed()) {
        end = *next;
        step.return_early(end);
      }
      step.need_event();
    }
    reader_.advance(end);
    if (reader_.is_due(end)) step.need_event();
    show(end);
  }

  void event(stride::Event& event) override {
    const stride::Time now = event.time();
    reader_.advance(now);
    if (receive_clock_.ticked()) reader_.receive(nfc::decode(receive_frame_));
    reader_.advance(now);  // a frame that comes late may have ended already
    if (const auto frame = reader_.transmit(now)) {
      transmit_frame_ = nfc::encode(*frame);
      transmit_clock_.tick();
    }
    show(now);
    report_finished();
    const auto next = reader_.next_event_time(now);
    next ? event.next_event(*next) : event.no_next_event();
  }

  // a state may come from an instance that runs another program
  void load_state(stride::StateReader&) override {
    if (loaded_ == program_) return;
    const auto state = reader_.state();
    start_program();
    reader_.state() = state;
  }

 private:
  void list_variables() {
    parameter("program", program_).description("file with the program, in the resources folder");
    const auto& axes = reader_.program().axes;
    axes_.resize(axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
      output("axis." + axes[i], axes_[i])
          .unit("rad")
          .depends_on({})
          .description("target of the axis " + axes[i]);
    }
    output("carrier_power", carrier_power_)
        .unit("W")
        .min(0)
        .discrete()
        .depends_on({})
        .description("power into the antenna, 0 while it is off");
    list_messages();
  }

  void list_messages() {
    output("transmit.clock", transmit_clock_).description("ticks when a command begins");
    output("transmit.frame", transmit_frame_)
        .clocked_by(transmit_clock_)
        .depends_on({})
        .description("the command's frame");
    input("receive.clock", receive_clock_).description("ticks when a frame begins to arrive");
    input("receive.frame", receive_frame_)
        .clocked_by(receive_clock_)
        .description("the frame that arrives");
    output("messages.sent", shown_.sent).depends_on({}).description("commands sent");
    output("messages.answered", shown_.answered)
        .depends_on({})
        .description("commands with an intact answer, whatever its status");
    output("messages.refused", shown_.refused)
        .depends_on({})
        .description("answered commands whose status was not OK");
    output("messages.unanswered", shown_.unanswered)
        .depends_on({})
        .description("commands with no answer in time, or with a damaged one");
    output("measured.temperature", temperature_)
        .unit("degC")
        .discrete()
        .depends_on({})
        .description("last temperature that the sensor reported, 0 before the first");
    output("measured.identifier", identifier_)
        .depends_on({})
        .description("identifier that the sensor reported, 0 before");
  }

  void start_program() {
    reader::Program program = load(resources_, program_);
    if (program.axes != reader_.program().axes) {
      throw std::runtime_error(program_ +
                               ": its axes are not those of program.xml, from which the " +
                               "variables were made; pack the unit with this program instead");
    }
    reader_ = reader::Reader(std::move(program));
    loaded_ = program_;
  }

  void show(stride::Time now) {
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i] = reader_.axis(i, now);
    carrier_power_ = reader_.carrier_power(now);
    shown_ = reader_.state().counts;
    temperature_ = reader_.state().temperature;
    identifier_ = reader_.state().identifier;
  }

  // only from event(), because a step may be taken back
  void report_finished() {
    const auto& records = reader_.state().records;
    for (; reported_ < records.size(); ++reported_) {
      const reader::Record& record = records[reported_];
      if (record.outcome == reader::Outcome::kWaiting) return;
      const auto& command = reader_.program().commands[reported_];
      log(stride::Severity::Info, reader::name_of(command.command) + " sent at " +
                                      std::to_string(stride::to_seconds(record.sent_at)) +
                                      " s: " + text_of(record));
    }
  }

  std::filesystem::path resources_;
  std::string program_ = "program.xml";
  reader::Reader reader_;
  std::string loaded_;          // the program that reader_ runs
  std::uint64_t reported_ = 0;  // how many records were logged

  stride::Clock transmit_clock_;
  stride::Binary transmit_frame_;
  stride::Clock receive_clock_;
  stride::Binary receive_frame_;

  std::vector<double> axes_;
  double carrier_power_ = 0.0;
  reader::Counts shown_;
  double temperature_ = 0.0;
  std::uint32_t identifier_ = 0;
};

STRIDE_UNIT(ReaderUnit)
