#include "units/channel/unit.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <stride/nfc/in_words.h>

#include "units/channel/decibels.h"
#include "units/channel/tag_list.h"

namespace channel {
namespace {

constexpr const char* kFrameType = "application/x-stride-nfc-frame";

// Each member is listed once, for writing and for reading.
template <class Visitor, class R>
void visit_reception(const Visitor& visit, R& r) {
  visit(r.sent.start), visit(r.sent.bit_rate), visit(r.sent.bits);
  auto& t = r.transit;
  visit(t.begin), visit(t.header), visit(t.symbol), visit(t.bits_per_symbol), visit(t.trailer);
  visit(t.header_bits), visit(t.propagation), visit(t.delay), visit(t.is_stored);
  visit(r.tag), visit(r.number), visit(r.end), visit(r.heard), visit(r.has_header);
  visit(r.lost), visit(r.deaf), visit(r.strongest), visit(r.next_observation);
}

template <class Visitor, class O>
void visit_observation(const Visitor& visit, O& o) {
  visit(o.time), visit(o.carrier_power), visit(o.signals);
}

template <class Visitor, class S>
void visit_counters(const Visitor& visit, S& s) {
  visit(s.forgotten), visit(s.frames_down), visit(s.frames_up);
}

template <class Item, class Visit>
void save(stride::StateWriter& writer, const std::vector<Item>& items, const Visit& visit_item) {
  writer.write(items.size());
  const auto write = [&](const auto& value) { writer.write(value); };
  for (const Item& item : items) visit_item(write, item);
}

template <class Item, class Visit>
void load(stride::StateReader& reader, std::vector<Item>& items, const Visit& visit_item) {
  std::size_t count = 0;
  reader.read(count);
  items.clear();
  const auto read = [&](auto& value) { reader.read(value); };
  for (; count > 0; --count) visit_item(read, items.emplace_back());
}

}  // namespace

std::vector<TagName> tag_names(const stride::Setup& setup, const std::string& root) {
  const std::filesystem::path file = std::filesystem::path(setup.resources) / "channel.xml";
  if (setup.resources.empty() || !std::filesystem::exists(file)) return {TagName{}};
  std::vector<TagName> tags;
  for (const std::string& name : read_tag_list(file.string(), root)) tags.push_back({name});
  return tags;
}

void ChannelUnit::Port::send(const nfc::Frame& heard) {
  frame = nfc::encode(heard);
  clock.tick();
}

ChannelUnit::ChannelUnit(std::vector<TagName> tags)
    : names_(std::move(tags)), ports_(names_.size()), outputs_(names_.size()) {
  inputs_.tag_coils.resize(names_.size());
}

void ChannelUnit::initialize(stride::Time) {
  make();
  shown_.reset();
}

void ChannelUnit::step(stride::Step& step) {
  update_outputs();
  air().observe(step.from());
  const auto end = air().next_end();
  if (end && *end <= step.to()) step.need_event();
}

void ChannelUnit::event(stride::Event& event) {
  update_outputs();
  air().observe(event.time());
  // a sender that could not end its step where its frame began may send more of this step
  if (take_frames()) return event.iterate();
  hand_over(event);
  const auto end = air().next_end();
  end ? event.next_event(*end) : event.no_next_event();
}

void ChannelUnit::update_outputs() {
  move(inputs_);
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i] = outputs_of(link(i));
  shown_ = inputs_;
}

ChannelUnit::Outputs ChannelUnit::outputs_of(const Link& link) {
  return {link.distance,         link.coupling,
          link.field_strength,   link.tag_voltage,
          link.tag_power,        decibels(link.snr_down),
          decibels(link.snr_up), link.bit_error_rate_down,
          link.bit_error_rate_up};
}

stride::Time ChannelUnit::idle_until(stride::Time now) const {
  return air().is_quiet() && shown_ == inputs_ ? stride::Time::max() : now;
}

std::string ChannelUnit::describe_message(const stride::Variable& variable,
                                          const stride::Binary& value) const {
  const auto is_to_tag = [&](const TagPorts& tag) { return variable.data == &tag.to.frame; };
  const bool is_request =
      variable.data == &from_reader_.frame || std::any_of(ports_.begin(), ports_.end(), is_to_tag);
  return nfc::in_words(value, is_request ? nfc::Sender::Reader : nfc::Sender::Tag);
}

void ChannelUnit::save_state(stride::StateWriter& writer) const {
  const Air::State& s = air().state();
  const auto write = [&](const auto& value) { writer.write(value); };
  save(writer, s.observed, [](const auto& v, const auto& o) { visit_observation(v, o); });
  visit_counters(write, s);
  for (const auto* frames : {&s.down, &s.up}) {
    save(writer, *frames, [](const auto& v, const auto& r) { visit_reception(v, r); });
  }
  writer.write(shown_ == inputs_);
}

// the state may come from an instance with other parameters
void ChannelUnit::load_state(stride::StateReader& reader) {
  make();
  Air::State& s = air().state();
  const auto read = [&](auto& value) { reader.read(value); };
  load(reader, s.observed, [](const auto& v, auto& o) { visit_observation(v, o); });
  visit_counters(read, s);
  for (auto* frames : {&s.down, &s.up}) {
    load(reader, *frames, [](const auto& v, auto& r) { visit_reception(v, r); });
  }
  const auto unknown = [this](const Reception& r) { return r.tag >= names_.size(); };
  const auto other = [this](const Observation& o) { return o.signals.size() != names_.size(); };
  if (s.frames_up.size() != names_.size() ||
      std::any_of(s.observed.begin(), s.observed.end(), other) ||
      std::any_of(s.down.begin(), s.down.end(), unknown) ||
      std::any_of(s.up.begin(), s.up.end(), unknown)) {
    throw std::runtime_error("the saved state is that of a channel with other tags");
  }
  bool shows_inputs = false;
  reader.read(shows_inputs);
  shown_.reset();
  if (shows_inputs) shown_ = inputs_;
}

void ChannelUnit::list_pose(const std::string& name, Pose& pose, const std::string& place,
                            const std::string& axis) {
  for (int i = 0; i < 3; ++i) {
    input(name + ".position." + "xyz"[i], pose.position[i]).unit("m").description(place);
  }
  for (int i = 0; i < 3; ++i) {
    input(name + ".axis." + "xyz"[i], pose.axis[i]).description(axis);
  }
}

void ChannelUnit::list_reader_pose(const std::string& place, const std::string& axis) {
  list_pose("reader_coil", inputs_.reader_coil, place, axis);
}

void ChannelUnit::describe_channel(const std::string& description) {
  auto& info = describe(description);
  info.promises_idle = true;
  info.split_invariant = true;
}

void ChannelUnit::list_tag_pose(std::size_t tag, const std::string& place,
                                const std::string& axis) {
  list_pose(names_[tag].coil(), inputs_.tag_coils[tag], place, axis);
}

void ChannelUnit::list_antenna_poses(const std::string& axis) {
  list_reader_pose("the reader's antenna", axis);
  for (std::size_t i = 0; i < names_.size(); ++i) {
    list_tag_pose(i, "the antenna of the " + names_[i].text(), axis);
  }
}

void ChannelUnit::list_carrier_power(const std::string& description) {
  input("carrier_power", inputs_.carrier_power)
      .unit("W")
      .min(0)
      .discrete()
      .description(description);
}

std::vector<std::string> ChannelUnit::poses_of(std::size_t tag) const {
  std::vector<std::string> names;
  for (const std::string& coil : {std::string("reader_coil"), names_[tag].coil()}) {
    for (const char* part : {".position.", ".axis."}) {
      for (const char* axis : {"x", "y", "z"}) names.push_back(coil + part + axis);
    }
  }
  return names;
}

std::vector<std::string> ChannelUnit::inputs_of(std::size_t tag) const {
  std::vector<std::string> names = poses_of(tag);
  names.emplace_back("carrier_power");
  return names;
}

void ChannelUnit::list_outputs(const Meanings& meanings) {
  for (std::size_t i = 0; i < names_.size(); ++i) list_outputs(i, meanings);
}

void ChannelUnit::list_outputs(std::size_t tag, const Meanings& meanings) {
  const TagName& name = names_[tag];
  Outputs& outputs = outputs_[tag];
  const std::vector<std::string> poses = poses_of(tag);
  const std::vector<std::string> all = inputs_of(tag);
  const auto list = [&](const std::string& text, double& value, const std::string& what) {
    return output(text, value).depends_on(all).description(what);
  };
  output(name.variable("distance"), outputs.distance)
      .unit("m")
      .min(0)
      .depends_on(poses)
      .description(meanings.distance);
  output(name.variable("coupling"), outputs.coupling)
      .range(0, 1)
      .depends_on(poses)
      .description(meanings.coupling);
  list(name.variable("field_strength"), outputs.field_strength, meanings.field_strength)
      .unit("A/m")
      .min(0);
  list(name.variable("voltage", "tag_voltage"), outputs.voltage, meanings.voltage).unit("V").min(0);
  list(name.variable("power", "tag_power"), outputs.power, meanings.power).unit("W").min(0);
  list(name.variable("snr.down"), outputs.snr_down,
       meanings.snr + " at the tag" + meanings.bit_rate)
      .unit("dB")
      .range(-200, 200);
  list(name.variable("snr.up"), outputs.snr_up, meanings.snr + " at the reader" + meanings.bit_rate)
      .unit("dB")
      .range(-200, 200);
  list(name.variable("bit_error_rate.down"), outputs.bit_error_rate_down,
       "probability of a wrong bit at the tag" + meanings.bit_rate)
      .range(0, 0.5);
  list(name.variable("bit_error_rate.up"), outputs.bit_error_rate_up,
       "probability of a wrong bit at the reader" + meanings.bit_rate)
      .range(0, 0.5);
}

void ChannelUnit::list_frames() {
  list_input("from_reader", from_reader_, "the reader");
  for (std::size_t i = 0; i < names_.size(); ++i) {
    list_output(names_[i].variable("to", "to_tag"), ports_[i].to, "the " + names_[i].text());
    list_input(names_[i].variable("from", "from_tag"), ports_[i].from, "the " + names_[i].text());
  }
  list_output("to_reader", to_reader_, "the reader");
}

void ChannelUnit::list_input(const std::string& name, Port& port, const std::string& sender) {
  input(name + ".clock", port.clock).description("ticks when a frame of " + sender + " begins");
  input(name + ".frame", port.frame)
      .clocked_by(port.clock)
      .mime_type(kFrameType)
      .description("the frame as " + sender + " sends it");
}

void ChannelUnit::list_output(const std::string& name, Port& port, const std::string& receiver) {
  output(name + ".clock", port.clock)
      .description("ticks when a frame has ended that " + receiver + " receives");
  output(name + ".frame", port.frame)
      .clocked_by(port.clock)
      .mime_type(kFrameType)
      .depends_on({})
      .description("the frame as " + receiver + " receives it, with bit errors");
}

bool ChannelUnit::take_frames() {
  bool any = from_reader_.clock.ticked();
  if (any) air().from_reader(nfc::decode(from_reader_.frame));
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const Port& from = ports_[i].from;
    if (!from.clock.ticked()) continue;
    air().from_tag(i, nfc::decode(from.frame));
    any = true;
  }
  return any;
}

// One frame to each receiver; where there might be another, in the next iteration.
void ChannelUnit::hand_over(stride::Event& event) {
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const auto frame = air().to_tag(i);
    if (!frame) continue;
    ports_[i].to.send(*frame);
    event.iterate();
  }
  if (const auto frame = air().to_reader()) {
    to_reader_.send(*frame);
    event.iterate();
  }
}

}  // namespace channel
