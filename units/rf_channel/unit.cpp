// The channel as an FMU: the variable table, and the way from the variables to the model.
#include "units/channel/unit.h"

#include <string>

#include <stride/unit.h>

#include "units/rf_channel/model.h"

using rf_channel::Channel;
using rf_channel::TagParameters;

class RfChannel : public channel::ModelUnit<Channel, rf_channel::Parameters> {
 public:
  explicit RfChannel(const stride::Setup& setup)
      : ModelUnit(channel::tag_names(setup, "rf-channel")) {
    describe_channel("Packet radio between a reader and tags over a ground: frames, no power");
    list_antenna_poses("direction of the dipole, of any length but zero");
    list_carrier_power("what the reader's radio sends with, 0 while it is off");
    const Meanings meanings{"distance between the antennas",
                            "amplitude received over amplitude sent",
                            "magnetic field at the tag while the reader sends, effective value",
                            "amplitude at the tag's receiver while the reader sends",
                            "power to live on that the tag's antenna delivers: none",
                            "signal to noise and interference",
                            ""};
    list_outputs(meanings);
    list_frames();
    for (TagParameters& tag : p_.tags) list_tag_parameters(tag);
    list_radio("reader", p_.reader);
    list_common_parameters();
    state();
  }

 private:
  void list_radio(const std::string& name, rf_channel::Radio& radio) {
    parameter(name + ".antenna_gain", radio.antenna_gain)
        .unit("dB")
        .range(-100, 100)
        .description("of the antenna in its best direction, over an isotropic one");
    parameter(name + ".noise_figure", radio.noise_figure)
        .unit("dB")
        .range(0, 100)
        .description("of the receiver, over the thermal noise of 290 K");
    parameter(name + ".interference", radio.interference)
        .unit("W")
        .min(0)
        .description("power of other senders in the receiver's bandwidth");
    parameter(name + ".sensitivity", radio.sensitivity)
        .unit("W")
        .min(0)
        .description("a receiver with less receives nothing");
  }

  void list_tag_parameters(TagParameters& tag) {
    list_radio(tag.name.prefix(), tag.radio);
    parameter(tag.name.prefix() + ".transmit_power", tag.transmit_power)
        .unit("W")
        .min(0)
        .description("what the radio of the " + tag.name.text() + " sends with");
  }

  void list_common_parameters() {
    parameter("frequency", p_.frequency).unit("Hz").range(1e8, 1e11).description("of the carrier");
    parameter("modulation", p_.modulation)
        .items({{"oqpsk", 0}, {"gfsk", 1}})
        .description("O-QPSK of IEEE 802.15.4, or GFSK as Bluetooth Low Energy has it");
    parameter("antenna", p_.antenna)
        .items({{"isotropic_vertical", 0}, {"isotropic_horizontal", 1}, {"dipole", 2}})
        .description("pattern and polarisation of both antennas");
    parameter("ground.reflects", p_.ground.reflects)
        .description("whether there is a ground, and so a second ray");
    parameter("ground.height", p_.ground.height).unit("m").description("z of the ground's surface");
    parameter("ground.permittivity", p_.ground.permittivity)
        .min(1)
        .description("relative permittivity of the ground");
    parameter("ground.conductivity", p_.ground.conductivity)
        .unit("S/m")
        .min(0)
        .description("of the ground");
    parameter("seed", p_.seed).description("seed of the bit errors");
  }
};

STRIDE_UNIT(RfChannel)
