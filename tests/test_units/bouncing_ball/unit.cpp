// A ball that falls and bounces, in closed form: between two impacts the height is a parabola from
// the last one, so it does not depend on the communication steps. Each impact is the root of the
// parabola; the ball stops there and sends a message.
#include <cmath>
#include <cstdint>

#include <stride/unit.h>

namespace {

class BouncingBall : public stride::Unit {
 public:
  BouncingBall() {
    describe("Falls from rest, bounces, comes to rest").early_return = true;
    output("h", h_).unit("m").depends_on({}).derivative(v_).description("height");
    output("v", v_).unit("m/s").depends_on({}).description("speed, upwards");
    output("impacts", impacts_).depends_on({});
    output("resting", resting_).depends_on({});
    output("impact.clock", clock_);
    output("impact.number", number_).clocked_by(clock_).description("1, 2, …");
    output("impact.picoseconds", picoseconds_).clocked_by(clock_).description("when it is");
    parameter("start_height", start_height_).unit("m").min(0);
    parameter("restitution", restitution_).range(0, 1).description("rebound speed / impact speed");
    parameter("gravity", gravity_).unit("m/s2").min(1e-3);
    parameter("rest_speed", rest_speed_)
        .unit("m/s")
        .min(1e-6)
        .description("a slower rebound is none");
    state(flight_start_, launch_height_, launch_speed_, next_impact_);
  }

  void initialize(stride::Time start) override {
    impacts_ = 0;
    resting_ = false;
    launch(start, start_height_, 0);
    move_to(start);
  }

  void step(stride::Step& step) override {
    stride::Time to = step.to();
    if (!resting_ && next_impact_ <= to) {
      step.need_event();
      if (step.early_return_allowed() && next_impact_ > step.from()) to = next_impact_;
    }
    if (to < step.to()) step.return_early(to);
    move_to(to);
  }

  // One impact, unless the importer does not allow an early return and comes too late for several.
  void event(stride::Event& event) override {
    if (resting_ || next_impact_ > event.time()) return;
    while (!resting_ && next_impact_ <= event.time()) bounce();
    move_to(event.time());
    clock_.tick();
  }

 private:
  double impact_speed() const {
    return std::sqrt(launch_speed_ * launch_speed_ + 2 * gravity_ * launch_height_);
  }

  void launch(stride::Time from, double height, double speed) {
    flight_start_ = from;
    launch_height_ = height;
    launch_speed_ = speed;
    next_impact_ = from + stride::duration_from_seconds((speed + impact_speed()) / gravity_);
  }

  void bounce() {
    const double rebound = restitution_ * impact_speed();
    picoseconds_ = next_impact_.time_since_epoch().count();
    number_ = ++impacts_;
    resting_ = rebound < rest_speed_;
    launch(next_impact_, 0, resting_ ? 0 : rebound);
  }

  void move_to(stride::Time time) {
    const double t = stride::to_seconds(time - flight_start_);
    h_ = resting_ ? 0 : std::fmax(0, launch_height_ + (launch_speed_ - gravity_ / 2 * t) * t);
    v_ = resting_ ? 0 : launch_speed_ - gravity_ * t;
  }

  double h_ = 0;
  double v_ = 0;
  std::int64_t impacts_ = 0;
  bool resting_ = false;
  stride::Clock clock_;
  std::int64_t number_ = 0;
  std::int64_t picoseconds_ = 0;
  double start_height_ = 1;
  double restitution_ = 0.8;
  double gravity_ = 9.81;
  double rest_speed_ = 0.01;

  stride::Time flight_start_{};
  double launch_height_ = 0;
  double launch_speed_ = 0;
  stride::Time next_impact_{};
};

}  // namespace

STRIDE_UNIT(BouncingBall)
