#include "units/mujoco_world/robot/encoding.h"

#include <string>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/worlds.h"
#include "units/mujoco_world/robot/convert.h"

using Catch::Contains;
using mujoco_world::decode_xml;
using mujoco_world::load_robot;

namespace {

constexpr char kName[] = "Größe";  // of a link

std::string robot(const std::string& encoding, const std::string& name) {
  return "<?xml version='1.0' encoding='" + encoding + "'?>\n<robot name='r'><link name='" + name +
         "'/></robot>\n";
}

/// Of characters below U+0100.
std::string latin1(const std::string& utf8) {
  std::string text;
  for (std::size_t i = 0; i < utf8.size(); ++i) {
    const auto byte = static_cast<unsigned char>(utf8[i]);
    text += byte < 0x80 ? utf8[i] : static_cast<char>((byte & 3) << 6 | (utf8[++i] & 0x3f));
  }
  return text;
}

std::string utf16(const std::string& utf8, bool big_endian) {
  std::string text;
  for (const char c : latin1(utf8))
    text += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return text;
}

bool has_link(const std::string& urdf, const char* name) {
  const worlds::Folder folder;
  folder.write("r.urdf", urdf);
  return mj_name2id(load_robot(folder.path() / "r.urdf").get(), mjOBJ_BODY, name) > 0;
}

}  // namespace

TEST_CASE("a URDF is read in the encoding that it declares", "[robot]") {
  CHECK(has_link(robot("UTF-8", kName), kName));
  CHECK(has_link(latin1(robot("ISO-8859-1", kName)), kName));
  CHECK(has_link(robot("windows-1252", "5 \x80"), "5 €"));
}

TEST_CASE("a URDF in UTF-16 is read, with and without a mark", "[robot]") {
  const std::string text = robot("UTF-16", kName);
  CHECK(has_link("\xff\xfe" + utf16(text, false), kName));
  CHECK(has_link("\xfe\xff" + utf16(text, true), kName));
  CHECK(has_link(utf16(text, false), kName));
  CHECK(has_link(utf16(text, true), kName));
  CHECK(has_link(text, kName));  // which is UTF-8 in fact
}

TEST_CASE("what cannot be decoded is an error with file and line", "[robot]") {
  CHECK_THROWS_WITH(decode_xml(robot("klingon", "a"), "r.urdf"),
                    Contains("r.urdf:1: the encoding 'KLINGON' is not known") && Contains("UTF-8"));
  CHECK_THROWS_WITH(decode_xml(robot("ISO-8859-1//IGNORE", "a"), "r.urdf"), Contains("not known"));
  CHECK_THROWS_WITH(decode_xml(robot("Shift_JIS", "\xff"), "r.urdf"),
                    Contains("r.urdf:2: what is here is no text in the encoding SHIFT_JIS"));
}

TEST_CASE("an MJCF, which MuJoCo reads as UTF-8, is refused in another encoding", "[robot]") {
  const worlds::Folder folder;
  const auto write = [&](const std::string& name) {
    folder.write("r.xml",
                 "<?xml version='1.0' encoding='ISO-8859-1'?>\n<mujoco><worldbody>"
                 "<body name='" +
                     name + "'/></worldbody></mujoco>");
    return folder.path() / "r.xml";
  };
  CHECK(load_robot(write("plain"))->nbody == 2);
  CHECK_THROWS_WITH(load_robot(write(latin1(kName))),
                    Contains("r.xml:1: ") && Contains("save it with the encoding UTF-8"));
}
