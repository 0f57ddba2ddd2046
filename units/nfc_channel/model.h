// The channel between a reader's antenna and its tags': power one way, frames both ways.
#ifndef STRIDE_UNITS_NFC_CHANNEL_MODEL_H
#define STRIDE_UNITS_NFC_CHANNEL_MODEL_H

#include <array>
#include <cstdint>
#include <vector>

#include <stride/time.h>

#include "units/channel/air.h"
#include "units/nfc_channel/circuit.h"
#include "units/nfc_channel/coil.h"
#include "units/nfc_channel/parameters.h"

namespace nfc_channel {

/// The link to one tag at one instant. Ratios and probabilities are those of Parameters::bit_rate.
struct Link {
  double distance = 0.0;        ///< between the coils' centres [m]
  double mutual = 0.0;          ///< mutual inductance [H]
  double coupling = 0.0;        ///< k, 0 to 1
  double field_strength = 0.0;  ///< along the tag's axis, mean over its coil, effective [A/m]
  double tag_voltage = 0.0;     ///< amplitude at the chip [V]
  double tag_power = 0.0;       ///< into the tag's load [W]
  channel::Signals signals;     ///< down: what the tag's load would get without the limiter;
                                ///< up: both sidebands of the load modulation
  double snr_down = 0.0;        ///< Eb/N0, linear
  double snr_up = 0.0;
  double bit_error_rate_down = 0.0;
  double bit_error_rate_up = 0.0;
};

/// At each instant move() before observe() (channel::Air). What a receiver needs: a tag its power
/// threshold, the reader its sensitivity.
class Channel : public channel::Air {
 public:
  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

  /// The poses are in the same coordinates, one for each tag; carrier power in [W], 0 for an
  /// antenna that is off. Throws std::invalid_argument for an axis of length zero, a negative power
  /// or what is no number, naming it.
  void move(const Pose& reader_coil, const std::vector<Pose>& tag_coils, double carrier_power);

  const Link& link(std::size_t tag = 0) const { return links_[tag]; }

 protected:
  double carrier_power() const override { return carrier_power_; }
  channel::Signals signals(std::size_t tag, double carrier_power) const override;
  double least_signal(channel::Direction direction, std::size_t tag) const override;
  double bit_error_probability(channel::Direction direction, std::size_t tag,
                               std::uint32_t bit_rate, double signal, double others) const override;

 private:
  struct Tag {
    TagParameters parameters;
    Circuit circuit;
    std::array<BitSignal, 4> down, up;  // of each bit rate
    double noise_density;
  };

  void move_tag(std::size_t index, const Pose& reader_coil, const Pose& tag_coil);
  channel::Signals signals_at(std::size_t tag, double carrier_power) const;

  Parameters parameters_;
  std::vector<Tag> tags_;
  double reader_noise_density_;

  double carrier_power_ = 0.0;
  std::vector<Link> links_;
};

}  // namespace nfc_channel

#endif
