// XML files, read and written, and their elements, visited.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_ROBOT_XML_FILE_H
#define STRIDE_UNITS_MUJOCO_WORLD_ROBOT_XML_FILE_H

#include <filesystem>
#include <stdexcept>
#include <string>

#include <tinyxml2.h>

#include "units/mujoco_world/robot/encoding.h"
#include "units/xml/file.h"

namespace mujoco_world {

/// Reads a document of any encoding that decode_xml() knows; in memory it is UTF-8. Throws
/// std::runtime_error with the file and what is wrong with it, also if it has no element.
inline tinyxml2::XMLElement& read_xml(tinyxml2::XMLDocument& document,
                                      const std::filesystem::path& file) {
  const std::string bytes = xml::read_file(file.string(), "an XML file");
  const std::string text = decode_xml(bytes, file.string());
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS ||
      !document.RootElement()) {
    throw std::runtime_error("cannot read '" + file.string() + "': " + document.ErrorStr());
  }
  auto* const declaration = document.FirstChild()->ToDeclaration();
  if (declaration && text != bytes) declaration->SetValue("xml version=\"1.0\"");
  return *document.RootElement();
}

inline void write_xml(tinyxml2::XMLDocument& document, const std::filesystem::path& file) {
  if (document.SaveFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("cannot write '" + file.string() + "': " + document.ErrorStr());
  }
}

/// The first child of that name; made if missing.
inline tinyxml2::XMLElement& find_or_make(tinyxml2::XMLElement& parent, const char* name) {
  tinyxml2::XMLElement* const found = parent.FirstChildElement(name);
  return found ? *found : *parent.InsertNewChildElement(name);
}

/// Calls visit(element) for each element below, in the order of the file, parents first.
template <typename Visit>
void for_each_below(tinyxml2::XMLElement& parent, const Visit& visit) {
  for (auto* child = parent.FirstChildElement(); child; child = child->NextSiblingElement()) {
    visit(*child);
    for_each_below(*child, visit);
  }
}

inline std::string attribute(const tinyxml2::XMLElement& element, const char* name) {
  const char* const value = element.Attribute(name);
  return value ? value : "";
}

}  // namespace mujoco_world

#endif
