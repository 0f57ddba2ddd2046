// The channel between a reader's antenna and its tags': power one way, frames both ways.
#ifndef STRIDE_UNITS_NFC_CHANNEL_MODEL_H
#define STRIDE_UNITS_NFC_CHANNEL_MODEL_H

#include <array>
#include <cstdint>
#include <vector>

#include <stride/time.h>

#include "units/channel/model.h"
#include "units/nfc_channel/circuit.h"
#include "units/nfc_channel/coil.h"
#include "units/nfc_channel/parameters.h"

namespace nfc_channel {

/// In which a tag of class 1 has to work, effective [A/m] (ISO/IEC 14443-2, Hmin).
inline constexpr double kLeastField = 1.5;

/// The coupling is the coils' coupling factor k; the field strength is along the tag's axis, the
/// mean over its coil; the tag's voltage and power are those of its antenna as a source
/// (Circuit::source()). Signals: down the power that goes with this voltage, U^2 / (8 Rp), Rp being
/// the resistance of the tag's circuit alone; up both sidebands of the load modulation. The ratios
/// are Eb/N0; they and the probabilities are those of Parameters::bit_rate.
struct Link : channel::Link {
  double mutual = 0.0;       ///< mutual inductance [H]
  double field_reach = 0.0;  ///< of kLeastField along the reader's axis, with this tag [m]
};

/// What a receiver needs: a tag the rectified voltage of its demodulator, the reader its
/// sensitivity.
class Channel : public channel::Model<Link> {
 public:
  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

 protected:
  void move_tag(std::size_t index, const Pose& reader_coil, const Pose& tag_coil,
                Link& link) override;
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
    double least_signal;  // [W]
  };

  channel::Signals signals_at(std::size_t tag, double carrier_power) const;

  Parameters parameters_;
  std::vector<Tag> tags_;
  double reader_noise_density_;
};

}  // namespace nfc_channel

#endif
