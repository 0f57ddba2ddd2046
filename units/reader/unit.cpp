// The reader as an FMU. Its axes, and so its variable table, come from the program in its
// resources.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <stride/nfc/in_words.h>
#include <stride/unit.h>

#include "units/reader/idle.h"
#include "units/reader/model.h"

namespace {

reader::Program load(const std::filesystem::path& resources, const std::string& name) {
  if (resources.empty()) {
    throw std::runtime_error("the reader has no resources folder: expected one with " + name);
  }
  return reader::load_program((resources / name).string());
}

/// What of a program the parameters may replace.
struct Choice {
  std::string program = "program.xml";
  std::uint64_t seed = 0;                  // 0: the program's
  double tremor = -1;                      // [rad], less than 0: the program's
  double start_offset = -1;                // likewise
  std::vector<double> waypoint_offsets{};  // [rad], one for each axis that the parameters list

  bool operator==(const Choice& other) const {
    return program == other.program && seed == other.seed && tremor == other.tremor &&
           start_offset == other.start_offset && waypoint_offsets == other.waypoint_offsets;
  }
};

reader::Program load(const std::filesystem::path& resources, const Choice& choice) {
  reader::Program program = load(resources, choice.program);
  if (choice.seed != 0) program.variation.seed = choice.seed;
  if (choice.tremor >= 0) reader::scale_to(program.variation.tremor, choice.tremor);
  if (choice.start_offset >= 0)
    reader::scale_to(program.variation.start_offset, choice.start_offset);
  for (reader::Waypoint& waypoint : program.waypoints) {
    reader::shift(waypoint, choice.waypoint_offsets);
  }
  return program;
}

}  // namespace

class ReaderUnit : public stride::Unit {
 public:
  explicit ReaderUnit(const stride::Setup& setup)
      : resources_(setup.resources), reader_(load(resources_, choice_)), loaded_(choice_) {
    auto& info = describe("Robot with an NFC reader: runs a program of movements and commands");
    info.early_return = true;
    info.split_invariant = true;
    info.promises_idle = true;
    list_variables();
    auto& s = reader_.state();
    state(s.records, s.phase, s.request_start, s.request_end, s.deadline, s.give_up_at, s.retry_at,
          s.last_try, s.reception, s.counts, s.temperature, s.identifier, s.logged, s.measurements,
          reported_);
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
    if (reader_.is_due(end) || has_news()) step.need_event();
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
    if (has_report()) report();
    if (reader_.has_measurement()) tell(reader_.take_measurement(), now);
    const auto next = reader_.next_event_time(now);
    next ? event.next_event(*next) : event.no_next_event();
  }

  stride::Time idle_until(stride::Time now) const override {
    return has_news() ? now : reader::idle_until(reader_, now);
  }

  std::string describe_message(const stride::Variable& variable,
                               const stride::Binary& value) const override {
    const bool is_request = variable.data == &transmit_frame_;
    return nfc::in_words(value, is_request ? nfc::Sender::Reader : nfc::Sender::Tag);
  }

  // a state may come from an instance that runs another program, or with another seed
  void load_state(stride::StateReader&) override {
    if (loaded_ == choice_) return;
    const auto state = reader_.state();
    start_program();
    reader_.state() = state;
  }

 private:
  void list_variables() {
    list_parameters();
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

  void list_parameters() {
    parameter("program", choice_.program)
        .description("file with the program, in the resources folder");
    parameter("seed", choice_.seed)
        .description("seed of tremor and start position; 0 takes the program's");
    parameter("tremor.amplitude", choice_.tremor)
        .unit("rad")
        .range(-1, 0.5)
        .description("of the axis that trembles most; less than 0 takes the program's");
    parameter("start_offset", choice_.start_offset)
        .unit("rad")
        .range(-1, 1)
        .description("largest one of the axes in the first waypoint; less than 0 likewise");
    const auto& axes = reader_.program().axes;
    choice_.waypoint_offsets.resize(axes.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
      parameter("waypoint_offset." + axes[i], choice_.waypoint_offsets[i])
          .unit("rad")
          .range(-6.3, 6.3)
          .description("added to the axis " + axes[i] + " in each waypoint");
    }
  }

  void list_messages() {
    output("transmit.clock", transmit_clock_).description("ticks when a command begins");
    output("transmit.frame", transmit_frame_)
        .clocked_by(transmit_clock_)
        .depends_on({})
        .description("the command's frame");
    input("receive.clock", receive_clock_).description("ticks when a frame arrives");
    input("receive.frame", receive_frame_)
        .clocked_by(receive_clock_)
        .description("the frame that arrives");
    output("report.clock", report_clock_).description("ticks when a command is settled");
    output("report.text", report_text_)
        .clocked_by(report_clock_)
        .depends_on({})
        .description("what was expected of the command, and what came");
    list_counts();
    output("measured.temperature", temperature_)
        .unit("degC")
        .discrete()
        .depends_on({})
        .description("last temperature that the sensor reported, 0 before the first");
    output("measured.identifier", identifier_)
        .depends_on({})
        .description("identifier that the sensor reported, 0 before");
    output("measured.log_size", logged_)
        .depends_on({})
        .description("samples in the log that was read last");
    list_measurement();
  }

  void list_measurement() {
    output("measurement.clock", measurement_clock_)
        .description("ticks for each temperature that was received, each sample of a log");
    const auto list = [&](const char* name, double& value, const char* unit, const char* meaning) {
      output(std::string("measurement.") + name, value)
          .unit(unit)
          .clocked_by(measurement_clock_)
          .depends_on({})
          .description(meaning);
    };
    list("temperature", measurement_, "degC", "the temperature");
    list("age", age_, "s", "minimum age, as the sensor reports it");
    list("age_resolution", age_resolution_, "s",
         "how much older it may be, because ages are rounded down");
  }

  void list_counts() {
    const auto count = [&](const char* name, std::uint64_t& value, const char* meaning) {
      output(std::string("messages.") + name, value).depends_on({}).description(meaning);
    };
    count("sent", shown_.sent, "commands sent, each counted once");
    count("retries", shown_.retries, "frames sent again because an intact answer is missing");
    count("answered", shown_.answered, "commands with an intact answer, whatever its status");
    count("refused", shown_.refused, "answered commands whose status was not OK");
    count("unanswered", shown_.unanswered, "commands without an intact answer in the end");
    count("damaged", shown_.damaged, "unanswered commands whose last answer was damaged");
    count("as_expected", shown_.as_expected, "commands of which came what was expected");
    count("unexpected", shown_.unexpected, "commands of which it did not");
  }

  void start_program() {
    reader::Program program = load(resources_, choice_);
    if (program.axes != reader_.program().axes) {
      throw std::runtime_error(choice_.program +
                               ": its axes are not those of program.xml, from which the " +
                               "variables were made; pack the unit with this program instead");
    }
    reader_ = reader::Reader(std::move(program));
    loaded_ = choice_;
  }

  void show(stride::Time now) {
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i] = reader_.axis(i, now);
    carrier_power_ = reader_.carrier_power(now);
    shown_ = reader_.state().counts;
    temperature_ = reader_.state().temperature;
    identifier_ = reader_.state().identifier;
    logged_ = reader_.state().logged;
  }

  bool has_report() const {
    const auto& records = reader_.state().records;
    return reported_ < records.size() && records[reported_].outcome != reader::Outcome::Waiting;
  }

  bool has_news() const { return has_report() || reader_.has_measurement(); }

  // these two only from event(), because a step may be taken back; the tick brings another
  // iteration, and with it the next report or measurement
  void report() {
    const bool as_expected = reader_.state().records[reported_].as_expected;
    report_text_ = reader_.report(reported_++);
    report_clock_.tick();
    log(as_expected ? stride::Severity::Info : stride::Severity::Warning, report_text_);
  }

  void tell(const reader::Measurement& measurement, stride::Time now) {
    measurement_ = measurement.temperature;
    age_ = stride::to_seconds(measurement.age + (now - measurement.received));
    age_resolution_ = stride::to_seconds(measurement.age_resolution);
    measurement_clock_.tick();
  }

  std::filesystem::path resources_;
  Choice choice_;
  reader::Reader reader_;
  Choice loaded_;               // what reader_ runs
  std::uint64_t reported_ = 0;  // how many records were reported

  stride::Clock transmit_clock_;
  stride::Binary transmit_frame_;
  stride::Clock receive_clock_;
  stride::Binary receive_frame_;
  stride::Clock report_clock_;
  std::string report_text_;
  stride::Clock measurement_clock_;
  double measurement_ = 0.0;     // [degC]
  double age_ = 0.0;             // [s]
  double age_resolution_ = 0.0;  // [s]

  std::vector<double> axes_;
  double carrier_power_ = 0.0;
  reader::Counts shown_;
  double temperature_ = 0.0;
  std::uint32_t identifier_ = 0;
  std::uint32_t logged_ = 0;
};

STRIDE_UNIT(ReaderUnit)
