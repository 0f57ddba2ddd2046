// A packet radio between a reader and tags: frames both ways, no power to live on.
#ifndef STRIDE_UNITS_RF_CHANNEL_MODEL_H
#define STRIDE_UNITS_RF_CHANNEL_MODEL_H

#include <cstdint>
#include <vector>

#include <stride/time.h>

#include "units/channel/air.h"
#include "units/rf_channel/parameters.h"

namespace rf_channel {

/// The link to one tag at one instant, for what is sent in it.
struct Link {
  double distance = 0.0;        ///< between the antennas [m]
  double gain = 0.0;            ///< share of the sent power that is received, 0 to 1
  double field_strength = 0.0;  ///< magnetic, of the reader's wave at the tag, effective [A/m]
  double tag_voltage = 0.0;     ///< amplitude at the tag's receiver, of 50 Ohm [V]
  channel::Signals signals;     ///< what each receiver gets [W]
  double snr_down = 0.0;        ///< over noise and interference in the receiver's bandwidth, linear
  double snr_up = 0.0;
  double bit_error_rate_down = 0.0;
  double bit_error_rate_up = 0.0;
};

/// At each instant move() before observe() (channel::Air).
///
/// Each side hands its frames to its radio over a wire, at the frame's bit rate. The radio takes in
/// the whole frame, sends it as one packet as soon as it has no other on the air, and the radio
/// that hears it passes the bits on so that the last comes when the packet has ended. So the
/// receiver is told of the frame as it was sent, later by the packet and the way. A frame that its
/// sender cuts short is not sent.
class Channel : public channel::Air {
 public:
  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

  /// The poses are in the same coordinates, one for each tag; carrier power in [W] is what the
  /// reader's radio sends with, 0 if it is off and hears nothing either. Throws
  /// std::invalid_argument for an axis of length zero, a negative power or what is no number,
  /// naming it.
  void move(const Pose& reader, const std::vector<Pose>& tags, double carrier_power);

  const Link& link(std::size_t tag = 0) const { return links_[tag]; }

 protected:
  double carrier_power() const override { return carrier_power_; }
  channel::Signals signals(std::size_t tag, double carrier_power) const override;
  double least_signal(channel::Direction direction, std::size_t tag) const override;
  double bit_error_probability(channel::Direction direction, std::size_t tag,
                               std::uint32_t bit_rate, double signal, double others) const override;
  /// Throws std::invalid_argument for a frame that no packet can hold.
  channel::Transit transit(const nfc::Frame& frame, std::size_t tag,
                           stride::Time free) const override;

 private:
  void move_tag(std::size_t index, const Pose& reader, const Pose& tag);

  Parameters parameters_;
  double reader_noise_;             // [W]
  std::vector<double> tag_noises_;  // [W]
  double carrier_power_ = 0.0;
  std::vector<Link> links_;
};

}  // namespace rf_channel

#endif
