// stride-robot: from a robot's model to a world that a scenario can use.
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "units/mujoco_world/hooks.h"
#include "units/mujoco_world/robot/convert.h"
#include "units/mujoco_world/robot/reach.h"

namespace {

namespace fs = std::filesystem;
using namespace mujoco_world;

std::string number(double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return std::string(text) == "-0.0000" ? "0.0000" : text;
}

Mount parse_mount(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) {
    throw std::runtime_error("--mount " + text + ": expected BODY=FILE");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void run_convert(const Conversion& conversion, const std::vector<std::string>& mounts) {
  Conversion whole = conversion;
  for (const std::string& mount : mounts) whole.mounts.push_back(parse_mount(mount));
  for (const std::string& remark : convert(whole)) std::cout << remark << "\n";
}

std::string unit_of(const mjModel& model, int joint) {
  return model.jnt_type[joint] == mjJNT_SLIDE ? " m" : " rad";
}

void show_joint(const mjModel& model, int joint, const std::string& indent) {
  std::cout << indent << "joint " << name_of(model, mjOBJ_JOINT, joint);
  const int type = model.jnt_type[joint];
  if (type == mjJNT_FREE || type == mjJNT_BALL) {
    std::cout << (type == mjJNT_FREE ? ", free" : ", ball");
  } else if (model.jnt_limited[joint]) {
    const double* range = model.jnt_range + 2 * joint;
    std::cout << ", " << number(range[0], "%g") << " … " << number(range[1], "%g")
              << unit_of(model, joint);
  }
  std::cout << "\n";
}

void show_body(const mjModel& model, int body, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  std::cout << indent << name_of(model, mjOBJ_BODY, body);
  if (model.body_mass[body] > 0) std::cout << ", " << number(model.body_mass[body], "%g") << " kg";
  std::cout << "\n";
  for (int i = 0; i < model.body_jntnum[body]; ++i) {
    show_joint(model, model.body_jntadr[body] + i, indent + "  ");
  }
  for (int i = 0; i < model.nsite; ++i) {
    if (model.site_bodyid[i] != body) continue;
    std::cout << indent << "  site " << name_of(model, mjOBJ_SITE, i) << "\n";
  }
  for (int i = body + 1; i < model.nbody; ++i) {
    if (model.body_parentid[i] == body) show_body(model, i, depth + 1);
  }
}

void run_show(const fs::path& model) {
  const ModelPointer loaded = load_robot(fs::is_directory(model) ? find_scene(model) : model);
  show_body(*loaded, 0, 0);
  for (const Actuator& actuator : list(*loaded).actuators) {
    if (actuator.element > 1) continue;
    std::cout << "actuator " << actuator.name << (actuator.unit.empty() ? "" : ", " + actuator.unit)
              << "\n";
  }
}

struct ReachRequest {
  fs::path folder;
  std::string site = "reader_coil", target = "tag_coil";
  std::vector<double> distances;
};

std::string pose_name(double distance) {
  std::string name = "at_" + number(100 * distance, "%g") + "_cm";
  for (char& c : name) {
    if (c == '.') c = '_';
  }
  return name;
}

/// An element without children, in lines of 100 characters where that is possible.
std::string element(const std::string& name, const std::vector<std::string>& attributes) {
  constexpr std::size_t kWidth = 100;
  const std::string indent(name.size() + 2, ' ');
  std::string text, line = "<" + name;
  for (const std::string& attribute : attributes) {
    if (line.size() > indent.size() && line.size() + 1 + attribute.size() > kWidth) {
      text += line + "\n";
      line = indent + attribute;
    } else {
      line += " " + attribute;
    }
  }
  return text + line + "/>\n";
}

std::string show_keyframe(const Pose& pose) {
  const auto list_of = [](const std::string& key, const std::vector<double>& values) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : " ") + number(value, "%.4f");
    return key + "=\"" + text + "\"";
  };
  return element(
      "key", {"name=\"start\"", list_of("qpos", pose.positions), list_of("ctrl", pose.commands)});
}

std::string show_pose(const Reach& reach, double distance, const Pose& pose) {
  std::vector<std::string> attributes{"name=\"" + pose_name(distance) + "\""};
  for (const Actuator& actuator : reach.catalogue().actuators) {
    if (actuator.element > 0) continue;
    const double command = pose.commands[static_cast<std::size_t>(actuator.control)];
    attributes.push_back(actuator.name + "=\"" + number(command, "%.4f") + "\"");
  }
  return element("pose", attributes);
}

void show_doubts(const Pose& pose) {
  for (const std::string& pair : pose.contacts) std::cout << "  there " << pair << " touch\n";
  for (const std::string& joint : pose.overload) {
    std::cout << "  the drive of " << joint << " is too weak to hold that\n";
  }
}

void run_reach(const ReachRequest& request) {
  Reach reach(request.folder, request.site, request.target);
  const std::vector<Pose> poses = reach.solve(request.distances);
  std::cout << show_keyframe(poses.front());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::cout << show_pose(reach, request.distances[i], poses[i]);
    show_doubts(poses[i]);
  }
}

void add_commands(CLI::App& app) {
  CLI::App* const show = app.add_subcommand("show", "Show a model's bodies, joints, sites, drives");
  const auto model = std::make_shared<fs::path>();
  show->add_option("MODEL", *model, "An MJCF, a URDF, or a folder with a scene")->required();
  show->callback([model] { run_show(*model); });

  CLI::App* const convert =
      app.add_subcommand("convert", "Make an MJCF to be included, and its meshes, from any model");
  const auto conversion = std::make_shared<Conversion>();
  const auto mounts = std::make_shared<std::vector<std::string>>();
  convert->add_option("MODEL", conversion->model, "An MJCF or a URDF")->required();
  convert->add_option("--output,-o", conversion->output, "The MJCF to write")->required();
  convert->add_option("--mount", *mounts, "BODY=FILE: put into a body what an MJCF's root holds")
      ->allow_extra_args(false);
  convert->callback([=] { run_convert(*conversion, *mounts); });

  CLI::App* const reach = app.add_subcommand(
      "reach", "Find the commands that bring a site above another, face to face");
  const auto request = std::make_shared<ReachRequest>();
  reach->add_option("FOLDER", request->folder, "The world's folder")->required();
  reach->add_option("--site", request->site, "The site that moves")->capture_default_str();
  reach->add_option("--target", request->target, "The site that it faces")->capture_default_str();
  reach->add_option("--distance", request->distances, "Along the target's z axis, in metres")
      ->required();
  reach->callback([request] { run_reach(*request); });
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("From a robot's model to a world for stride", "stride-robot");
  app.require_subcommand(1);
  try {
    add_commands(app);
    app.parse(argc, argv);
    for (const std::string& warning : take_warnings()) {
      std::cerr << "stride-robot: warning: " << warning << "\n";
    }
    return 0;
  } catch (const CLI::Success& request) {  // --help
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    std::cerr << "stride-robot: error: " << error.what() << "\n  hint: see stride-robot --help\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "stride-robot: error: " << error.what() << "\n";
    return 2;
  }
}
