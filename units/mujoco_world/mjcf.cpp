#include "units/mujoco_world/mjcf.h"

#include <array>
#include <cmath>
#include <iterator>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "units/mujoco_world/hooks.h"
#include "units/xml/file.h"

namespace mujoco_world {
namespace {

namespace fs = std::filesystem;

bool is_joint(int transmission) {
  return transmission == mjTRN_JOINT || transmission == mjTRN_JOINTINPARENT;
}

/// "rad" or "m" for what the actuator's length counts, "" if it is neither. A gear other than 1
/// scales it into something without a name.
std::string length_unit(const mjModel& model, int actuator) {
  const int target = model.actuator_trnid[2 * actuator];
  if (std::abs(model.actuator_gear[6 * actuator]) != 1) return "";
  if (!is_joint(model.actuator_trntype[actuator])) return "";
  switch (model.jnt_type[target]) {
    case mjJNT_HINGE:
      return "rad";
    case mjJNT_SLIDE:
      return "m";
    default:
      return "";
  }
}

/// Reads the actuator's law, force = gain * control + b0 + b1 * length + b2 * velocity: a servo is
/// one whose gain undoes b1 or b2. (MuJoCo documentation, XML reference, "actuator/general".)
std::string control_unit(const mjModel& model, int actuator) {
  const std::string length = length_unit(model, actuator);
  const double* gain = model.actuator_gainprm + mjNGAIN * actuator;
  const double* bias = model.actuator_biasprm + mjNBIAS * actuator;
  if (length.empty() || model.actuator_gaintype[actuator] != mjGAIN_FIXED || gain[0] == 0) {
    return "";
  }
  const bool integrates = model.actuator_dyntype[actuator] == mjDYN_INTEGRATOR;
  if (model.actuator_biastype[actuator] == mjBIAS_AFFINE) {
    if (bias[1] == -gain[0]) return integrates ? length + "/s" : length;
    if (bias[1] == 0 && bias[2] == -gain[0] && !integrates) return length + "/s";
    return "";
  }
  const bool is_motor = model.actuator_biastype[actuator] == mjBIAS_NONE && gain[0] == 1 &&
                        model.actuator_dyntype[actuator] == mjDYN_NONE;
  if (!is_motor) return "";
  return length == "rad" ? "N.m" : "N";
}

std::string joint_unit(int type) { return type == mjJNT_HINGE ? "rad" : "m"; }

std::string sensor_unit(const mjModel& model, int sensor) {
  switch (model.sensor_type[sensor]) {
    case mjSENS_TOUCH:
    case mjSENS_FORCE:
      return "N";
    case mjSENS_TORQUE:
      return "N.m";
    case mjSENS_ACCELEROMETER:
    case mjSENS_FRAMELINACC:
      return "m/s2";
    case mjSENS_VELOCIMETER:
    case mjSENS_FRAMELINVEL:
    case mjSENS_SUBTREELINVEL:
      return "m/s";
    case mjSENS_GYRO:
    case mjSENS_FRAMEANGVEL:
    case mjSENS_BALLANGVEL:
      return "rad/s";
    case mjSENS_FRAMEANGACC:
      return "rad/s2";
    case mjSENS_FRAMEPOS:
    case mjSENS_RANGEFINDER:
    case mjSENS_SUBTREECOM:
      return "m";
    case mjSENS_CLOCK:
      return "s";
    case mjSENS_JOINTPOS:
      return joint_unit(model.jnt_type[model.sensor_objid[sensor]]);
    case mjSENS_JOINTVEL:
      return joint_unit(model.jnt_type[model.sensor_objid[sensor]]) + "/s";
    default:
      return "";
  }
}

std::optional<std::pair<double, double>> control_range(const mjModel& model, int control) {
  if (!model.actuator_ctrllimited[control]) return std::nullopt;
  const double* range = model.actuator_ctrlrange + 2 * control;
  return std::pair(range[0], range[1]);
}

/// Of an actuator on a hinge or slide joint, the index of its position in qpos.
std::optional<int> driven_position(const mjModel& model, int actuator) {
  if (model.actuator_trntype[actuator] != mjTRN_JOINT) return std::nullopt;
  const int joint = model.actuator_trnid[2 * actuator];
  const int type = model.jnt_type[joint];
  if (type != mjJNT_HINGE && type != mjJNT_SLIDE) return std::nullopt;
  return model.jnt_qposadr[joint];
}

std::optional<DriveRipple> drive_ripple(const mjModel& model, int actuator) {
  const std::string name = kDriveRipple + name_of(model, mjOBJ_ACTUATOR, actuator);
  const int id = mj_name2id(&model, mjOBJ_NUMERIC, name.c_str());
  const auto position = driven_position(model, actuator);
  if (id < 0 || !position || model.numeric_size[id] != 2) return std::nullopt;
  const double* data = model.numeric_data + model.numeric_adr[id];
  return DriveRipple{data[0], data[1], *position};
}

std::vector<Actuator> list_actuators(const mjModel& model) {
  std::vector<Actuator> list;
  for (int i = 0; i < api::actuator_count(&model); ++i) {
    const std::string name = name_of(model, mjOBJ_ACTUATOR, i);
    const int first = api::first_control(&model, i);
    const int count = api::control_count(&model, i);
    const std::string unit = count == 1 ? control_unit(model, i) : "";
    for (int k = 0; k < count; ++k) {
      list.push_back({name, unit, i, first + k, count == 1 ? 0 : k + 1,
                      control_range(model, first + k),
                      count == 1 ? drive_ripple(model, i) : std::nullopt});
    }
  }
  return list;
}

std::vector<Joint> list_joints(const mjModel& model) {
  std::vector<Joint> list;
  for (int i = 0; i < model.njnt; ++i) {
    const int type = model.jnt_type[i];
    if (type != mjJNT_HINGE && type != mjJNT_SLIDE) continue;
    list.push_back({name_of(model, mjOBJ_JOINT, i), joint_unit(type), model.jnt_qposadr[i],
                    model.jnt_dofadr[i]});
  }
  return list;
}

std::vector<Site> list_sites(const mjModel& model) {
  std::vector<Site> list;
  for (int i = 0; i < model.nsite; ++i) {
    const char* name = mj_id2name(&model, mjOBJ_SITE, i);
    if (name && *name) list.push_back({name, i});
  }
  return list;
}

std::vector<Sensor> list_sensors(const mjModel& model) {
  std::vector<Sensor> list;
  for (int i = 0; i < model.nsensor; ++i) {
    list.push_back({name_of(model, mjOBJ_SENSOR, i), sensor_unit(model, i), model.sensor_adr[i],
                    model.sensor_dim[i]});
  }
  return list;
}

/// All that have one, of an mjtObj.
std::string names_of(const mjModel& model, int type, int count) {
  std::string names;
  for (int i = 0; i < count; ++i) {
    const char* name = mj_id2name(&model, type, i);
    if (name && *name) names += (names.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  return names.empty() ? "none" : names;
}

/// The words of one of the model's texts; none if it has no such text.
std::vector<std::string> words_of_text(const mjModel& model, const char* name) {
  const int text = mj_name2id(&model, mjOBJ_TEXT, name);
  if (text < 0) return {};
  std::istringstream words(model.text_data + model.text_adr[text]);
  return {std::istream_iterator<std::string>(words), {}};
}

void check_required_sites(const mjModel& model, const fs::path& file) {
  for (const std::string& name : words_of_text(model, kRequiredSites)) {
    if (mj_name2id(&model, mjOBJ_SITE, name.c_str()) >= 0) continue;
    throw std::runtime_error("'" + file.string() + "' has no site '" + name +
                             "', which its <text name=\"" + kRequiredSites +
                             "\"> asks for; its named sites are: " +
                             names_of(model, mjOBJ_SITE, static_cast<int>(model.nsite)));
  }
}

/// What a text of the model may list.
struct Listed {
  const char* text;  ///< its name
  int type;          ///< an mjtObj
  int count;         ///< of those in the model
  const char* what;  ///< they are
};

void check_list(const mjModel& model, const fs::path& file, const Listed& listed) {
  const auto fail = [&](const std::string& name, const std::string& why) {
    throw std::runtime_error("'" + file.string() + "': <text name=\"" + listed.text +
                             "\"> lists '" + name + "'" + why);
  };
  const std::string what = listed.what;
  std::set<std::string> seen;
  for (const std::string& name : words_of_text(model, listed.text)) {
    if (mj_name2id(&model, listed.type, name.c_str()) < 0) {
      fail(name, ", which is no " + what + ": expected names of " + what +
                     "s, separated by blanks; those that have a name are: " +
                     names_of(model, listed.type, listed.count));
    }
    if (!seen.insert(name).second) fail(name, " twice: a " + what + " is listed once");
  }
}

void check_lists(const mjModel& model, const fs::path& file) {
  check_list(model, file, {kLamps, mjOBJ_GEOM, static_cast<int>(model.ngeom), "geom"});
  check_list(model, file, {kFields, mjOBJ_SITE, static_cast<int>(model.nsite), "site"});
}

void check_drive_ripples(const mjModel& model, const fs::path& file) {
  const std::string prefix = kDriveRipple;
  for (int i = 0; i < model.nnumeric; ++i) {
    const std::string name = name_of(model, mjOBJ_NUMERIC, i);
    if (name.rfind(prefix, 0) != 0) continue;
    const int actuator = mj_name2id(&model, mjOBJ_ACTUATOR, name.substr(prefix.size()).c_str());
    if (actuator >= 0 && drive_ripple(model, actuator)) continue;
    throw std::runtime_error(
        "'" + file.string() + "': <numeric name=\"" + name +
        "\">: expected an amplitude and a number of cycles, and the name of an "
        "actuator on a hinge or slide joint after the point");
  }
}

/// The objects that a text of the model lists, as names and ids.
template <class Entry>
std::vector<Entry> list_named(const mjModel& model, const char* text, int type) {
  std::vector<Entry> list;
  for (const std::string& name : words_of_text(model, text)) {
    list.push_back({name, mj_name2id(&model, type, name.c_str())});
  }
  return list;
}

void switch_off_irreproducible(mjModel& model, const fs::path& file) {
  if (!(model.opt.enableflags & api::kIrreproducible)) return;
  model.opt.enableflags &= ~api::kIrreproducible;
  add_warning(file.string() + ": its sensor noise or sleeping is off, runs would not repeat");
}

/// Of a message of MuJoCo; its parser's own, such as "XML parse error 6: Error=XML_ERROR_… Line
/// number=3", is for programmers.
std::string in_words(const std::string& message) {
  if (message.rfind("XML parse error", 0) != 0) return message;
  const std::string mark = "ine number=";
  const std::size_t at = message.find(mark);
  if (at == std::string::npos) return "it is not well-formed XML";
  const std::size_t begin = at + mark.size();
  const std::size_t end = message.find_first_not_of("0123456789", begin);
  return "it is not well-formed XML: look for a mistake in or above line " +
         message.substr(begin, end - begin);
}

}  // namespace

fs::path find_scene(const fs::path& folder) {
  const std::string where = "'" + folder.string() + "'";
  if (!fs::is_directory(folder)) {
    throw std::runtime_error("no folder " + where + ": expected one that holds the world's MJCF");
  }
  if (fs::exists(folder / "scene.xml")) return folder / "scene.xml";
  fs::path found;
  bool has_urdf = false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    has_urdf = has_urdf || entry.path().extension() == ".urdf";
    if (entry.path().extension() != ".xml") continue;
    if (!found.empty()) {
      throw std::runtime_error("several .xml files in " + where +
                               ": call the one that is the world scene.xml");
    }
    found = entry.path();
  }
  if (found.empty()) {
    throw std::runtime_error("no MJCF in " + where + ": put the world there as scene.xml" +
                             (has_urdf ? "; stride-robot convert makes one of a URDF" : ""));
  }
  return found;
}

ModelPointer load_model(const fs::path& file) {
  if (mj_version() != mjVERSION_HEADER) {
    throw std::runtime_error("built for MuJoCo " + std::to_string(mjVERSION_HEADER) + ", but " +
                             std::to_string(mj_version()) + " was loaded: install the former");
  }
  xml::require_file(file.string(), "an MJCF");
  // MuJoCo's parser keeps the last model in a global variable
  static std::mutex parser;
  const std::lock_guard lock(parser);
  std::array<char, 1024> message{};
  ModelPointer model;
  try {
    model.reset(guarded([&] {
      return mj_loadXML(file.string().c_str(), nullptr, message.data(),
                        static_cast<int>(message.size()));
    }));
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot load '" + file.string() + "': " + error.what());
  }
  if (!model) {
    throw std::runtime_error("cannot load '" + file.string() + "': " + in_words(message.data()));
  }
  if (message[0] != '\0') add_warning(file.string() + ": " + message.data());
  switch_off_irreproducible(*model, file);
  check_required_sites(*model, file);
  check_lists(*model, file);
  check_drive_ripples(*model, file);
  return model;
}

Catalogue list(const mjModel& model) {
  return {list_actuators(model),
          list_joints(model),
          list_sites(model),
          list_sensors(model),
          list_named<Lamp>(model, kLamps, mjOBJ_GEOM),
          list_named<Field>(model, kFields, mjOBJ_SITE)};
}

std::string name_of(const mjModel& model, int type, int id) {
  const char* name = mj_id2name(&model, type, id);
  return name && *name ? name : "unnamed_" + std::to_string(id);
}

}  // namespace mujoco_world
