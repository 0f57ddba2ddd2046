#include "units/mujoco_world/robot/convert.h"

#include <array>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "units/mujoco_world/hooks.h"
#include "units/mujoco_world/mjcf.h"
#include "units/mujoco_world/robot/encoding.h"
#include "units/mujoco_world/robot/line_keeping.h"
#include "units/mujoco_world/robot/urdf.h"
#include "units/mujoco_world/robot/xml_file.h"
#include "units/xml/file.h"

namespace mujoco_world {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "stride-robot-XXXXXX").string();
    if (!::mkdtemp(pattern.data())) throw std::runtime_error("cannot make '" + pattern + "'");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The model as MuJoCo saves it: includes resolved, a URDF as MJCF. Paths in it are relative to the
/// model's folder.
void save_as_mjcf(const fs::path& model, const fs::path& saved) {
  const ModelPointer loaded = load_robot(model);  // which MuJoCo keeps until it loads another
  std::array<char, 1024> message{};
  const int done = guarded([&] {
    return mj_saveLastXML(saved.c_str(), loaded.get(), message.data(),
                          static_cast<int>(message.size()));
  });
  if (!done) throw std::runtime_error("cannot convert '" + model.string() + "': " + message.data());
}

XMLElement* compiler_of(XMLElement& root) { return root.FirstChildElement("compiler"); }

/// Takes an attribute of <compiler> away and returns what it was.
std::string take_compiler_attribute(XMLElement& root, const char* name) {
  XMLElement* const compiler = compiler_of(root);
  if (!compiler) return "";
  const std::string value = attribute(*compiler, name);
  compiler->DeleteAttribute(name);
  return value;
}

/// A name that is not taken: mesh.stl, mesh_2.stl, …
std::string untaken(const fs::path& file, std::set<std::string>& taken) {
  std::string name = file.filename().string();
  for (int i = 2; !taken.insert(name).second; ++i) {
    name = file.stem().string() + "_" + std::to_string(i) + file.extension().string();
  }
  return name;
}

/// Copies each file that the assets name to the folder `name` beside the output.
void collect_files(XMLElement& root, const fs::path& model_folder, const fs::path& output) {
  const std::string assets = take_compiler_attribute(root, "assetdir");
  std::string meshes = take_compiler_attribute(root, "meshdir");
  std::string textures = take_compiler_attribute(root, "texturedir");
  if (meshes.empty()) meshes = assets;
  if (textures.empty()) textures = assets;
  const fs::path name = output.stem();
  std::set<std::string> taken;
  const auto collect = [&](XMLElement& asset, const char* key, const std::string& folder) {
    const std::string file = attribute(asset, key);
    if (file.empty()) return;
    const fs::path copy = name / untaken(file, taken);
    const fs::path target = output.parent_path() / copy;
    fs::create_directories(target.parent_path());
    const fs::path source = model_folder / folder / file;
    if (!fs::exists(target) || !fs::equivalent(source, target)) {
      fs::copy_file(source, target, fs::copy_options::overwrite_existing);
    }
    if (!asset.Attribute("name")) asset.SetAttribute("name", fs::path(file).stem().c_str());
    asset.SetAttribute(key, copy.c_str());
  };
  for (auto* section = root.FirstChildElement("asset"); section;
       section = section->NextSiblingElement("asset")) {
    for_each_below(*section, [&](XMLElement& asset) {
      const std::string kind = asset.Name();
      if (kind == "mesh" || kind == "hfield" || kind == "skin") collect(asset, "file", meshes);
      if (kind != "texture") return;
      for (const char* key :
           {"file", "fileright", "fileleft", "fileup", "filedown", "filefront", "fileback"}) {
        collect(asset, key, textures);
      }
    });
  }
}

void leave_out_keyframes(XMLElement& root, std::vector<std::string>& remarks) {
  while (XMLElement* const keyframes = root.FirstChildElement("keyframe")) {
    for_each_below(*keyframes, [&](XMLElement& key) {
      std::string text;
      for (const auto* a = key.FirstAttribute(); a; a = a->Next()) {
        text += std::string(" ") + a->Name() + "=\"" + a->Value() + "\"";
      }
      remarks.push_back("left out, since keyframes belong to the scene: <key" + text + "/>");
    });
    root.DeleteChild(keyframes);
  }
}

void leave_out_sizes(XMLElement& root) {
  for (auto* size = root.FirstChildElement("size"); size;) {
    XMLElement* const next = size->NextSiblingElement("size");
    for (const char* buffer : {"njmax", "nconmax", "nstack", "memory", "nkey"}) {
      size->DeleteAttribute(buffer);
    }
    if (!size->FirstAttribute()) root.DeleteChild(size);
    size = next;
  }
}

XMLElement& find_body(XMLElement& root, const Mount& mount) {
  XMLElement* found = nullptr;
  std::string names;
  for_each_below(root, [&](XMLElement& element) {
    if (std::string(element.Name()) != "body") return;
    const std::string name = attribute(element, "name");
    if (name == mount.body) found = &element;
    if (!name.empty()) names += (names.empty() ? "'" : ", '") + name + "'";
  });
  if (found) return *found;
  throw std::runtime_error("there is no body '" + mount.body + "' to mount '" +
                           mount.file.string() +
                           "' on; the named bodies are: " + (names.empty() ? "none" : names));
}

void attach(XMLElement& root, const Mount& mount) {
  XMLElement& body = find_body(root, mount);
  XMLDocument document;
  for (const auto* part = read_xml(document, mount.file).FirstChild(); part;
       part = part->NextSibling()) {
    body.InsertEndChild(part->DeepClone(root.GetDocument()));
  }
}

/// Loads a document in place of the file that it was read from, which errors name.
ModelPointer load_prepared(const XMLDocument& document, const fs::path& file) {
  const TemporaryFolder folder;
  const fs::path prepared = folder.path() / file.filename();
  write_keeping_lines(document, prepared);
  try {
    return load_model(prepared);
  } catch (const std::exception& error) {
    std::string message = error.what();
    const std::size_t at = message.find(prepared.string());
    if (at != message.npos) message.replace(at, prepared.string().size(), file.string());
    throw std::runtime_error(message);
  }
}

/// MuJoCo reads an MJCF, and what it includes, itself, and as UTF-8 whatever it declares.
void require_utf8(const fs::path& mjcf) {
  const std::string bytes = xml::read_file(mjcf.string(), "an MJCF");
  if (decode_xml(bytes, mjcf.string()) == bytes) return;
  throw std::runtime_error(mjcf.string() +
                           ":1: MuJoCo reads an MJCF as UTF-8 only, and this one is not: save it "
                           "with the encoding UTF-8");
}

}  // namespace

ModelPointer load_robot(const fs::path& model) {
  XMLDocument document;
  XMLElement& root = read_xml(document, model);
  if (is_urdf(root)) {
    prepare_urdf(root, model);
    return load_prepared(document, model);
  }
  if (std::string(root.Name()) != "mujoco") {
    throw std::runtime_error("'" + model.string() + "' is a <" + root.Name() +
                             ">: expected an MJCF, <mujoco>, or a URDF, <robot>");
  }
  require_utf8(model);
  return load_model(model);
}

std::vector<std::string> convert(const Conversion& conversion) {
  const TemporaryFolder folder;
  const fs::path saved = folder.path() / "saved.xml";
  save_as_mjcf(conversion.model, saved);
  XMLDocument document;
  XMLElement& root = read_xml(document, saved);
  std::vector<std::string> remarks;
  leave_out_keyframes(root, remarks);
  leave_out_sizes(root);
  for (const Mount& mount : conversion.mounts) attach(root, mount);
  const fs::path output = fs::absolute(conversion.output);
  fs::create_directories(output.parent_path());
  collect_files(root, fs::absolute(conversion.model).parent_path(), output);
  write_xml(document, output);
  return remarks;
}

}  // namespace mujoco_world
