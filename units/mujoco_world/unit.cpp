// Any MJCF world as an FMU: the variable table follows from the model in the resources folder.
#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <stride/unit.h>

#include "units/mujoco_world/film/film.h"
#include "units/mujoco_world/hooks.h"
#include "units/mujoco_world/model.h"
#include "units/mujoco_world/names.h"
#include "units/mujoco_world/recording.h"
#include "units/mujoco_world/scene/scene.h"

namespace {

using mujoco_world::name_part;
using mujoco_world::Vector;
using mujoco_world::World;

std::string indexed(const std::string& name, int index) {
  return name + "[" + std::to_string(index) + "]";
}

// below what matters in use: 0.1 mm at the end of a metre
constexpr double kPositionTolerance = 1e-4;  // [rad], [m], or of a unit vector's element
constexpr double kVelocityTolerance = 1e-3;  // [rad/s], [m/s]
constexpr double kSensorTolerance = 1e-3;    // in the sensor's unit

/// Alone in the unit's own folder of results; otherwise the worlds have the working folder in
/// common, where there is one for each kind of files.
std::filesystem::path results_of(const stride::Setup& setup, const char* kind) {
  if (!setup.results.empty()) return setup.results;
  std::string name = setup.instance_name;
  std::replace(name.begin(), name.end(), '/', '_');
  if (name.find_first_not_of('.') == std::string::npos) name += '_';
  std::error_code ignored;  // without a working folder, as long as there is nothing to write
  return std::filesystem::current_path(ignored) / kind / name;
}

std::filesystem::path film_folder(const stride::Setup& setup) {
  const std::filesystem::path folder = results_of(setup, "film");
  return setup.results.empty() ? folder : folder / "film";
}

std::string per_second(const std::string& unit) { return unit.empty() ? unit : unit + "/s"; }

class MujocoWorld : public stride::Unit {
 public:
  explicit MujocoWorld(const stride::Setup& setup)
      : film_folder_(film_folder(setup)),
        scene_file_(results_of(setup, "scene") / "world.glb"),
        world_(setup.resources) {
    auto& info = describe("A MuJoCo world: its actuators in, its joints, sites and sensors out");
    info.fixed_step = world_.timestep();
    info.promises_idle = true;
    info.split_invariant = true;
    const auto& catalogue = world_.catalogue();
    inputs_.resize(catalogue.actuators.size());
    described_inputs_.resize(inputs_.size());
    joints_.resize(catalogue.joints.size());
    sites_.resize(catalogue.sites.size());
    for (std::size_t i = 0; i < inputs_.size(); ++i) list_actuator(i);
    for (const auto& lamp : catalogue.lamps) list_lamp(lamp);
    for (const auto& field : catalogue.fields) list_field(field);
    for (std::size_t i = 0; i < joints_.size(); ++i) list_joint(i);
    for (std::size_t i = 0; i < sites_.size(); ++i) list_site(i);
    for (const auto& sensor : catalogue.sensors) list_sensor(sensor);
    for (const auto& contact : world_.contacts()) list_contact(contact);
    info.early_return = !world_.contacts().empty();
    list_start();
    list_rest();
    list_film();
    list_scene();
    state();
  }

  void initialize(stride::Time start) override {
    allow_rest();
    world_.reset(start, start_);
    warn_of_flaws();
    says_whose_controls_ = start_.keyframe != mujoco_world::default_start(world_.model()).keyframe;
    set_film();
    set_scene();
    show();
  }

  void step(stride::Step& step) override {
    if (std::exchange(says_whose_controls_, false)) warn_of_controls();
    for (std::size_t i = 0; i < inputs_.size(); ++i) world_.set_input(i, inputs_[i]);
    const bool rests = world_.rests_until() >= step.to();
    if (film_ || scene_) set_display();
    mujoco_world::advance(world_, recordings(), step.to(), step.early_return_allowed());
    if (world_.now() < step.to()) step.return_early(world_.now());
    if (!rests) show();
  }

  void terminate() override {
    if (film_ || scene_) set_display();
    for (mujoco_world::Recording* recording : recordings()) {
      if (recording == nullptr) continue;
      recording->begin();  // of a run without a step
      recording->show_display();
    }
    if (scene_) finish_scene();
  }

  stride::Time idle_until(stride::Time now) const override {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (inputs_[i] != world_.input(i)) return now;
    }
    return world_.rests_until();
  }

  void save_state(stride::StateWriter& writer) const override {
    block_.resize(world_.state_size());
    world_.save(block_.data());
    writer.write_bytes(block_.data(), block_.size() * sizeof(double));
    writer.write(says_whose_controls_);
    writer.write(film_ ? film_->pictures() : std::nullopt);
    (scene_ ? scene_->state() : mujoco_world::scene::SceneState{}).write(writer);
  }

  void load_state(stride::StateReader& reader) override {
    allow_rest();  // the state may be that of an instance with other settings
    block_.resize(world_.state_size());
    reader.read_bytes(block_.data(), block_.size() * sizeof(double));
    world_.restore(block_.data());
    reader.read(says_whose_controls_);
    std::optional<std::size_t> pictures;
    reader.read(pictures);
    mujoco_world::scene::SceneState scene;
    scene.read(reader);
    set_film();
    set_scene();
    if (film_ && !film_->go_on(pictures)) {
      log(stride::Severity::Warning, "the film in '" + film_folder_.string() +
                                         "' lacks pictures of what was before the restored state");
    }
    if (scene_ && !scene_->go_on(scene)) {
      log(stride::Severity::Warning,
          "'" + scene_file_.string() + "' lacks the motion before the restored state");
    }
    show();
  }

 private:
  std::array<mujoco_world::Recording*, 2> recordings() { return {film_.get(), scene_.get()}; }

  void set_display() {
    for (std::size_t i = 0; i < lamps_.size(); ++i) world_.set_lamp(i, lamps_[i]);
    for (std::size_t i = 0; i < fields_.size(); ++i) world_.set_field(i, fields_[i]);
  }

  /// 0 for none. Throws std::invalid_argument for one that would make a run endless.
  static stride::Duration interval_of(const char* parameter, double seconds) {
    constexpr double kLeast = 1e-6;
    if (seconds > 0 && seconds < kLeast) {
      throw std::invalid_argument(std::string(parameter) +
                                  ": too short; expected 0 for none, or at least 1e-6 s");
    }
    return stride::duration_from_seconds(seconds);
  }

  /// There is a film as the parameters want it.
  void set_film() {
    const mujoco_world::film::FilmSettings wanted{interval_of("film.interval", film_interval_),
                                                  view_};
    if (wanted.interval == stride::Duration{}) {
      film_.reset();
    } else if (!film_ || !(film_->settings() == wanted)) {
      film_ = std::make_unique<mujoco_world::film::Film>(world_, wanted, film_folder_);
    }
  }

  void set_scene() {
    const stride::Duration interval = interval_of("scene.interval", scene_interval_);
    if (interval == stride::Duration{}) {
      scene_.reset();
    } else if (!scene_ || scene_->interval() != interval) {
      scene_ = std::make_unique<mujoco_world::scene::Scene>(world_, interval, scene_file_);
    }
  }

  void finish_scene() {
    scene_->write();
    const auto& animation = scene_->animation();
    const mujoco_world::scene::AnimationLimits usual;
    if (animation.tolerance() == usual.tolerance && animation.resolution() == 0) return;
    std::ostringstream text;
    text << "'" << scene_file_.string() << "' would be too long: its poses are within "
         << animation.tolerance() << " m and rad of the sampled ones";
    if (animation.resolution() > 0) {
      text << ", which are " << animation.resolution() << " s apart";
    }
    log(stride::Severity::Info, text.str());
  }

  /// As the importer has set it.
  void allow_rest() {
    if (!max_skip()) return world_.forbid_rest();
    limits_.window = stride::duration_from_seconds(rest_window_);
    mujoco_world::RestSettings& settings = rest_settings_;
    settings.limits = limits_;
    settings.longest = *max_skip();
    auto& tolerances = settings.tolerances;
    tolerances.joint_positions.resize(joints_.size());
    tolerances.joint_velocities.resize(joints_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      tolerances.joint_positions[i] = tolerance_of(joints_[i].position);
      tolerances.joint_velocities[i] = tolerance_of(joints_[i].velocity);
    }
    const auto of_vector = [this](const Vector& vector) {
      return Vector{tolerance_of(vector[0]), tolerance_of(vector[1]), tolerance_of(vector[2])};
    };
    tolerances.site_positions.resize(sites_.size());
    tolerances.site_axes.resize(sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      tolerances.site_positions[i] = of_vector(sites_[i].position);
      tolerances.site_axes[i] = of_vector(sites_[i].axis);
    }
    tolerances.sensors.resize(world_.sensor_numbers());
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      const auto first = static_cast<std::size_t>(world_.catalogue().sensors[i].address);
      for (std::size_t k = 0; k < sensors_[i].size(); ++k) {
        tolerances.sensors[first + k] = tolerance_of(sensors_[i][k]);
      }
    }
    world_.allow_rest(settings);
  }

  /// Of the start pose; once, although the start is computed anew with each input that is set.
  void warn_of_flaws() {
    std::vector<std::string> flaws = world_.flaws();
    if (flaws == flaws_) return;
    flaws_ = std::move(flaws);
    for (const std::string& flaw : flaws_) log(stride::Severity::Warning, flaw);
  }

  /// Before the first step: a keyframe's ctrl are an input's start value only in the description.
  void warn_of_controls() {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (inputs_[i] != described_inputs_[i] || inputs_[i] == world_.input(i)) continue;
      log(stride::Severity::Warning,
          "the input of actuator '" + world_.catalogue().actuators[i].name + "' has its start " +
              "value, " + std::to_string(inputs_[i]) + "; the keyframe '" + start_.keyframe +
              "' has " + std::to_string(world_.input(i)) + ", which is not used: set the input");
    }
  }

  void list_start() {
    parameter("start.keyframe", start_.keyframe)
        .description("of the model, where the world begins; empty: in its reference pose");
    const auto positions = mujoco_world::list_start_positions(world_.model());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      parameter(positions[i].parameter, start_.positions[i])
          .unit(positions[i].unit)
          .description("initial " + positions[i].description + "; NaN: as the keyframe has it");
    }
  }

  void list_rest() {
    parameter("rest.speed", limits_.speed)
        .min(0)
        .description("a world at rest has no joint that moves faster, rad/s or m/s");
    parameter("rest.acceleration", limits_.acceleration)
        .min(0)
        .description("nor one that accelerates more, rad/s2 or m/s2");
    parameter("rest.window", rest_window_)
        .unit("s")
        .range(0, 1e6)
        .description("for how long that has to be so");
  }

  void list_film() {
    parameter("film.interval", film_interval_)
        .unit("s")
        .range(0, 1e6)
        .description("simulated time between the pictures of a film; 0: no film");
    parameter("film.width", view_.width).range(16, 4096).description("of a picture in pixels");
    parameter("film.height", view_.height).range(16, 4096).description("of a picture in pixels");
    parameter("film.camera", view_.camera)
        .description("of the model; empty: the one called film, or one that sees the whole world");
  }

  void list_scene() {
    parameter("scene.interval", scene_interval_)
        .unit("s")
        .range(0, 1e6)
        .description("simulated time between the poses of the scene in world.glb; 0: no scene");
  }

  struct Joint {
    double position = 0;
    double velocity = 0;
  };
  struct Site {
    Vector position{};
    Vector axis{};
    Vector velocity{};
    Vector axis_rate{};
  };

  void list_actuator(std::size_t i) {
    const auto& actuator = world_.catalogue().actuators[i];
    const std::string name = "actuator." + name_part(actuator.name);
    inputs_[i] = described_inputs_[i] = world_.input(i);
    auto row = input(actuator.element == 0 ? name : indexed(name, actuator.element), inputs_[i]);
    row.unit(actuator.unit).description("control of the actuator " + actuator.name);
    if (actuator.range) row.range(actuator.range->first, actuator.range->second);
  }

  void list_lamp(const mujoco_world::Lamp& lamp) {
    input("lamp." + name_part(lamp.name), lamps_.emplace_back(false))
        .discrete()
        .description("whether the geom " + lamp.name + " shines in film and scene");
  }

  void list_field(const mujoco_world::Field& field) {
    input("field." + name_part(field.name), fields_.emplace_back(0.0))
        .unit("m")
        .min(0)
        .description("how far along its axis the field of the coil at the site " + field.name +
                     " reaches, in film and scene; 0: not drawn");
  }

  void list_joint(std::size_t i) {
    const auto& joint = world_.catalogue().joints[i];
    const std::string name = "joint." + name_part(joint.name);
    output(name + ".position", joints_[i].position)
        .unit(joint.unit)
        .depends_on({})
        .derivative(joints_[i].velocity)
        .tolerance(kPositionTolerance)
        .description("position of the joint " + joint.name);
    output(name + ".velocity", joints_[i].velocity)
        .unit(per_second(joint.unit))
        .depends_on({})
        .tolerance(kVelocityTolerance)
        .description("velocity of the joint " + joint.name);
  }

  void list_site(std::size_t i) {
    const std::string& site = world_.catalogue().sites[i].name;
    const std::string name = "site." + name_part(site);
    constexpr const char* kAxes[] = {"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k) {
      output(name + ".position." + kAxes[k], sites_[i].position[k])
          .unit("m")
          .depends_on({})
          .derivative(sites_[i].velocity[k])
          .tolerance(kPositionTolerance)
          .description("position of the site " + site + " in the world");
    }
    for (std::size_t k = 0; k < 3; ++k) {
      output(name + ".axis." + kAxes[k], sites_[i].axis[k])
          .depends_on({})
          .derivative(sites_[i].axis_rate[k])
          .tolerance(kPositionTolerance)
          .description("z axis of the site " + site + " in the world, a unit vector");
    }
  }

  void list_sensor(const mujoco_world::Sensor& sensor) {
    const std::string name = "sensor." + name_part(sensor.name);
    auto& values = sensors_.emplace_back(sensor.dimension);
    for (int k = 0; k < sensor.dimension; ++k) {
      output(sensor.dimension == 1 ? name : indexed(name, k + 1),
             values[static_cast<std::size_t>(k)])
          .unit(sensor.unit)
          .depends_on({})
          .tolerance(kSensorTolerance)
          .description("reading of the sensor " + sensor.name);
    }
  }

  void list_contact(const mujoco_world::WatchedContact& contact) {
    output("contact." + name_part(contact.name), contacts_.emplace_back(false))
        .discrete()
        .depends_on({})
        .description("whether there is contact; a step ends where this changes");
  }

  /// Brings the outputs to the world's present, and MuJoCo's warnings to the log.
  void show() {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      joints_[i] = {world_.joint_position(i), world_.joint_velocity(i)};
    }
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      sites_[i] = {world_.site_position(i), world_.site_axis(i), world_.site_velocity(i),
                   world_.site_axis_rate(i)};
    }
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      for (std::size_t k = 0; k < sensors_[i].size(); ++k) {
        sensors_[i][k] = world_.sensor(i, static_cast<int>(k));
      }
    }
    for (std::size_t i = 0; i < contacts_.size(); ++i) contacts_[i] = world_.touches(i);
    for (const std::string& warning : mujoco_world::take_warnings()) {
      log(stride::Severity::Warning, warning);
    }
  }

  std::filesystem::path film_folder_;
  std::filesystem::path scene_file_;
  World world_;
  mujoco_world::StartPose start_ = mujoco_world::default_start(world_.model());
  std::vector<std::string> flaws_;  // of the start that were reported
  double film_interval_ = 0;
  mujoco_world::film::View view_;
  std::unique_ptr<mujoco_world::film::Film> film_;
  double scene_interval_ = 0;
  std::unique_ptr<mujoco_world::scene::Scene> scene_;
  std::vector<double> inputs_;
  std::vector<double> described_inputs_;  // their start values
  bool says_whose_controls_ = false;
  std::deque<bool> lamps_;
  std::deque<double> fields_;
  std::vector<Joint> joints_;
  std::vector<Site> sites_;
  std::deque<std::vector<double>> sensors_;
  std::deque<bool> contacts_;
  mujoco_world::RestLimits limits_;
  mujoco_world::RestSettings rest_settings_;  // kept to avoid allocation
  double rest_window_ = stride::to_seconds(limits_.window);
  mutable std::vector<double> block_;  // of a state, kept to avoid allocation
};

}  // namespace

STRIDE_UNIT(MujocoWorld)
