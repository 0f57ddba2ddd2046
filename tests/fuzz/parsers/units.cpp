// What the units of this repository read: frames from what is wired to them, and files of theirs.
#include <tinyxml2.h>

#include <stride/nfc/frame.h>
#include <stride/nfc/iso14443a.h>

#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"
#include "units/channel/tag_list.h"
#include "units/ground_truth/quantity.h"
#include "units/mujoco_world/robot/urdf.h"
#include "units/mujoco_world/robot/xml_file.h"
#include "units/reader/program.h"

namespace stride::tests {
namespace {

void read_frame(const std::string& bytes) {
  refusing<std::invalid_argument>("", [&] {
    const nfc::Frame frame = nfc::decode({bytes.begin(), bytes.end()});
    ensure(nfc::decode(nfc::encode(frame)) == frame, "a frame reads back");
    const auto content = nfc::to_bytes(frame.bits);
    if (content) nfc::without_crc(*content);
  });
}

std::string frame_bytes() {
  const nfc::Frame frame{time_from_seconds(14.2), 106, nfc::to_bits(nfc::with_crc({2, 7}))};
  const nfc::Bytes bytes = nfc::encode(frame);
  return {bytes.begin(), bytes.end()};
}

void read_program(const std::string& bytes) {
  refusing<std::runtime_error>("x.xml", [&] { reader::parse_program(bytes, "x.xml"); });
}

void read_tag_list(const std::string& bytes) {
  refusing<std::runtime_error>("x.xml:",
                               [&] { channel::parse_tag_list(bytes, "x.xml", "nfc-channel"); });
}

void read_quantity(const std::string& bytes) {
  refusing<std::runtime_error>("x.xml", [&] { ground_truth::parse_quantity(bytes, "x.xml"); });
}

void read_urdf(const std::string& bytes) {
  write_file("robot/arm/meshes/a.stl", "");
  write_file("robot/meshes/b.stl", "");
  const auto file = write_file("robot/x.urdf", bytes);
  refusing<std::runtime_error>("x.urdf", [&] {
    tinyxml2::XMLDocument document;
    tinyxml2::XMLElement& root = mujoco_world::read_xml(document, file);
    if (!mujoco_world::is_urdf(root)) throw std::runtime_error("x.urdf is another model");
    mujoco_world::prepare_urdf(root, file);
  });
}

const Registration kUnitsParsers(
    "units",
    {
        {.name = "nfc_frame",
         .read = read_frame,
         .make_seed = frame_bytes,
         .alphabet = std::string("\0\x01\x7f\xff", 4)},
        {.name = "reader_program",
         .read = read_program,
         .seed_files = {"tests/fuzz/seeds/reader_program", "units/reader/resources/program.xml",
                        "scenarios/nfc_approach/reader/program.xml"}},
        {.name = "tag_list", .read = read_tag_list, .seed_files = {"tests/fuzz/seeds/tag_list"}},
        {.name = "quantity",
         .read = read_quantity,
         .seeds = {"<quantity version=\"1\" unit=\"degC\" difference=\"K\"/>"}},
        {.name = "urdf", .read = read_urdf, .seed_files = {"tests/fuzz/seeds/urdf"}},
    });

}  // namespace
}  // namespace stride::tests
