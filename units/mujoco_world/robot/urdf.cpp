#include "units/mujoco_world/robot/urdf.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "units/mujoco_world/robot/inertia.h"
#include "units/mujoco_world/robot/xml_file.h"
#include "units/xml/text.h"

namespace mujoco_world {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr const char* kPackage = "package://";
constexpr const char* kFile = "file://";

bool begins_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

/// Where a mesh may be, the likeliest first.
std::vector<fs::path> places_of(const std::string& name, const fs::path& folder,
                                const std::string& meshdir) {
  std::vector<fs::path> places;
  if (begins_with(name, kPackage)) {
    const std::string in_package = name.substr(std::string(kPackage).size());
    for (fs::path above = folder; above != above.root_path(); above = above.parent_path()) {
      places.push_back(above / in_package);
    }
  } else if (begins_with(name, kFile)) {
    places.emplace_back(name.substr(std::string(kFile).size()));
  } else {
    places.push_back(folder / name);
  }
  if (!meshdir.empty()) places.push_back(folder / meshdir / fs::path(name).filename());
  return places;
}

fs::path find_mesh(const XMLElement& mesh, const fs::path& file, const std::string& meshdir) {
  const std::string name = attribute(mesh, "filename");
  const fs::path folder = fs::absolute(file).parent_path();
  std::string tried;
  for (const fs::path& place : places_of(name, folder, meshdir)) {
    if (fs::is_regular_file(place)) return place.lexically_normal();
    tried += "\n  " + place.string();
  }
  throw std::runtime_error(file.string() + ":" + std::to_string(mesh.GetLineNum()) +
                           ": there is no mesh '" + name + "'; it was looked for at" + tried);
}

void discard_visuals(XMLElement& robot) {
  for (auto* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    while (XMLElement* const visual = link->FirstChildElement("visual")) link->DeleteChild(visual);
  }
}

void name_meshes(XMLElement& robot, const fs::path& file, const std::string& meshdir) {
  std::map<std::string, fs::path> found;
  for_each_below(robot, [&](XMLElement& mesh) {
    if (std::string(mesh.Name()) != "mesh") return;
    const fs::path path = find_mesh(mesh, file, meshdir);
    const fs::path& first = found.emplace(path.stem().string(), path).first->second;
    if (first != path) {
      throw std::runtime_error(file.string() + ":" + std::to_string(mesh.GetLineNum()) + ": '" +
                               path.string() + "' is called like '" + first.string() +
                               "', and MuJoCo would take them for one: give one of them another "
                               "name");
    }
    mesh.SetAttribute("filename", path.c_str());
  });
}

/// MuJoCo 2 would crash on them.
void refuse_unknown_joints(const XMLElement& robot, const fs::path& file) {
  std::vector<std::string> known{"revolute", "continuous", "prismatic",
                                 "fixed",    "floating",   "planar"};
  if (mjVERSION_HEADER >= 300) known.emplace_back("spherical");
  for (const auto* joint = robot.FirstChildElement("joint"); joint;
       joint = joint->NextSiblingElement("joint")) {
    const std::string type = attribute(*joint, "type");
    if (std::find(known.begin(), known.end(), type) != known.end()) continue;
    throw std::runtime_error(file.string() + ":" + std::to_string(joint->GetLineNum()) +
                             ": joint '" + attribute(*joint, "name") + "' has the type '" + type +
                             "': expected one of " + xml::quoted_list(known));
  }
}

}  // namespace

bool is_urdf(const XMLElement& root) { return std::string(root.Name()) == "robot"; }

void prepare_urdf(XMLElement& root, const fs::path& file) {
  refuse_unknown_joints(root, file);
  repair_inertias(root, file);
  XMLElement& compiler = find_or_make(find_or_make(root, "mujoco"), "compiler");
  const std::string meshdir = attribute(compiler, "meshdir");
  compiler.DeleteAttribute("meshdir");
  compiler.SetAttribute("strippath", "false");
  compiler.SetAttribute("fusestatic", "false");
  discard_visuals(root);
  name_meshes(root, file, meshdir);
}

}  // namespace mujoco_world
