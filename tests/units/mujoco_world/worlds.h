// Small worlds for the tests, each in a temporary folder.
#ifndef STRIDE_TESTS_UNITS_MUJOCO_WORLD_WORLDS_H
#define STRIDE_TESTS_UNITS_MUJOCO_WORLD_WORLDS_H

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <stdlib.h>

namespace worlds {

/// A folder with an MJCF, removed at the end.
class Folder {
 public:
  explicit Folder(const std::string& mjcf) : Folder() { write("scene.xml", mjcf); }
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "stride_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder: " + pattern);
    path_ = pattern;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// 1 m, let go at 2 rad from the lowest point; the point mass is nearly one: a sphere of 1 cm.
inline const std::string kPendulum = R"(
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001" integrator="RK4" gravity="0 0 -9.81"/>
  <worldbody>
    <body>
      <joint name="pivot" axis="0 1 0"/>
      <geom type="sphere" pos="0 0 -1" size="0.01" mass="1"/>
      <site name="tip" pos="0 0 -1"/>
    </body>
  </worldbody>
  <actuator><motor name="pivot" joint="pivot"/></actuator>
  <sensor>
    <jointpos name="angle" joint="pivot"/>
    <velocimeter name="velocity" site="tip"/>
  </sensor>
  <keyframe><key name="start" qpos="2"/></keyframe>
</mujoco>)";

/// A dark red ball that is a lamp, beside one that is none.
inline const std::string kLamp = R"(
<mujoco>
  <visual><headlight ambient="0.1 0.1 0.1" diffuse="0 0 0" specular="0 0 0"/></visual>
  <custom><text name="lamps" data="led"/></custom>
  <worldbody>
    <geom name="led" type="sphere" size="0.1" rgba="1 0 0 1"/>
    <geom name="ball" type="sphere" pos="0.3 0 0" size="0.1" rgba="1 0 0 1"/>
  </worldbody>
</mujoco>)";

/// A coil whose axis is the world's x, on a body that does not move, and a camera that looks at it.
inline const std::string kField = R"(
<mujoco>
  <custom><text name="fields" data="coil"/></custom>
  <worldbody>
    <camera name="film" pos="0 -3 0" euler="90 0 0"/>
    <body name="reader">
      <geom type="box" size="0.02 0.02 0.02"/>
      <site name="coil" euler="0 90 0" size="0.001" rgba="1 0 0 1"/>
    </body>
  </worldbody>
</mujoco>)";

/// Bodies that tumble onto a floor while a servo pushes them about: contacts, quaternions, warm
/// starts, activations.
inline const std::string kTumble = R"(
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.002"/>
  <worldbody>
    <geom type="plane" size="2 2 0.1"/>
    <body pos="0 0 0.4" euler="0.3 0.5 0.1">
      <freejoint/>
      <geom type="box" size="0.1 0.05 0.08"/>
      <site name="corner" pos="0.1 0.05 0.08"/>
    </body>
    <body pos="0.05 0.02 0.7">
      <freejoint/>
      <geom type="capsule" size="0.04 0.1"/>
      <site name="end" pos="0 0 0.1"/>
    </body>
    <body pos="-0.4 0 0.1">
      <joint name="paddle" axis="0 0 1" damping="0.2"/>
      <geom type="box" pos="0.3 0 0" size="0.3 0.02 0.08" mass="1"/>
      <site name="paddle" pos="0.6 0 0"/>
    </body>
  </worldbody>
  <actuator>
    <general name="paddle" joint="paddle" dyntype="filter" dynprm="0.05" biastype="affine"
             gainprm="40" biasprm="0 -40 -2"/>
  </actuator>
</mujoco>)";

/// A ball of 5 cm that falls from 0.3 m onto a floor and bounces, beside a hinge and a joint that
/// turns any way.
inline const std::string kBounce = R"(
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001"/>
  <default><geom solref="-50000 -5"/></default>
  <custom>
    <tuple name="contact.floor">
      <element objtype="body" objname="ball"/><element objtype="geom" objname="floor"/>
    </tuple>
    <tuple name="contact.any"><element objtype="geom" objname="shell"/></tuple>
    <tuple name="no_contact"><element objtype="site" objname="centre"/></tuple>
  </custom>
  <worldbody>
    <geom name="floor" type="plane" size="2 2 0.1"/>
    <body name="ball" pos="0 0 0.3">
      <freejoint/>
      <geom name="shell" type="sphere" size="0.05" mass="0.1"/>
      <site name="centre"/>
    </body>
    <body name="gate" pos="1 0 0.5">
      <joint name="gate" axis="0 0 1" limited="true" range="-1 1"/>
      <geom type="box" size="0.1 0.01 0.1" mass="1"/>
      <body pos="0 0 0.4">
        <joint name="head" type="ball"/>
        <geom type="sphere" size="0.05" mass="0.1"/>
        <site name="nose" pos="0.1 0 0"/>
      </body>
    </body>
  </worldbody>
  <actuator><position name="gate" joint="gate" kp="10"/></actuator>
  <keyframe>
    <key name="high" qpos="0 0 1 1 0 0 0  0  1 0 0 0"/>
    <key name="open" qpos="0 0 0.3 1 0 0 0  0.5  1 0 0 0" ctrl="0.5"/>
  </keyframe>
</mujoco>)";

/// A joint that pushes itself ever harder.
inline const std::string kRunaway = R"(
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <body name="rotor">
      <joint name="runaway" axis="0 0 1"/>
      <geom size="0.1" mass="1"/>
      <site name="hub"/>
    </body>
  </worldbody>
  <actuator>
    <general name="feedback" joint="runaway" gainprm="1" biastype="affine" biasprm="0 0 0.2"/>
  </actuator>
</mujoco>)";

}  // namespace worlds

#endif
