// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's devices that run the words of a law without a core: a drum stick, a bow on a string,
// two coupled levers, a pen, a stylus, a gimbal. Each constructor throws std::invalid_argument for
// a broken image. Documentation: docs/page.md
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/page/law_loop.hpp"
#include "sim/axes_loop/plane_host.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/plant/rotation.hpp"
#include "studies/shape/outline.hpp"

namespace feltgate::page {

/// A lever that a hand leads to `most_rad` at most, either way; or a hand that draws it to and fro.
struct Lever : PlainBody<double> {
  double most_rad = 0, turn_rad = 0, drawn_rad_s = 0;

  explicit Lever(double most, double turn = 0) : most_rad(most), turn_rad(turn) {
    grip = in_angles();
  }
  double within(double rad) const;
  static bool finite(double rad) { return std::isfinite(rad); }
  double hand_rate(double led, double hand, double dt);
  void arrive(double& hand, double wanted) const {
    if (drawn_rad_s == 0) hand = wanted;
  }
  static void sense(ImageLaw& law, double rad, double rad_s) { law.joint(0, rad, rad_s); }
  static double force(const ImageLaw& law, double) { return law.torque_nm(0); }
};

template <class Body>
class LeverLoop : public LawLoop<Body> {
 public:
  using LawLoop<Body>::LawLoop;
  double theta_rad() const { return this->at_; }
  double speed_rad_s() const { return this->speed_; }
  double hand_rad() const { return this->hand_; }
  /// Torque of the law in the last run, and the mean of the last advance() that ran it: a hand
  /// feels the mean.
  double torque_nm() const { return this->force_; }
  double mean_nm() const { return this->mean_; }
};

/// An event of a law.
struct StickEvent {
  std::string name;
  double value = 0;  ///< in SI
  double time_s = 0;
};
struct StickBody : Lever {
  std::vector<StickEvent> told;
  StickBody() : Lever(0.6) {}
  static double start() { return 0.3; }
  void begin() { told.clear(); }
  void note(const ImageLaw& law, double time_s);
};
/// A drum stick.
class StickLoop : public LeverLoop<StickBody> {
 public:
  explicit StickLoop(const std::string& image) : LeverLoop(std::make_unique<ImageLaw>(image)) {}
  /// Events of the last advance(), in order.
  const std::vector<StickEvent>& events() const { return told; }
};

/// A slip of the string under the bow, as the law reports it.
struct StringSlip {
  double time_s = 0;   ///< time of the run that reported it
  double since_s = 0;  ///< time since the previous slip; 0.1 s means 0.1 s or more
};
struct BowBody : Lever {
  StateWord arrives;
  double slip_s = 0;  ///< seconds per LSB of the word of a slip
  std::vector<StringSlip> told;
  std::vector<float> heard;
  explicit BowBody(const StateWord& word) : Lever(1.0, 0.9), arrives(word) {}
  void begin() {
    told.clear();
    heard.clear();
  }
  void note(const ImageLaw& law, double time_s);
};
/// A lever as a bow on a string.
class StringLoop : public LeverLoop<BowBody> {
 public:
  /// Largest |angle| of the hand, and the |angle| at which an automatic bow reverses.
  static constexpr double farthest_rad = 1.0, turn_rad = 0.9;
  /// `heard`: the state that arrives at the bridge. Also throws for an image without slip events.
  StringLoop(const std::string& image, const StateWord& heard);
  /// Draws the bow automatically: the hand moves to and fro so that the bow has this speed, m/s.
  /// With 0 or NaN, lead() moves the hand again, from its present angle.
  void draw(double bow_m_s);
  /// Of the last advance(): the slips, in order, and the velocity at the bridge in each run, m/s.
  const std::vector<StringSlip>& slips() const { return told; }
  const std::vector<float>& heard_m_s() const { return heard; }
};

/// The object that the second of two levers meets.
enum class Met {
  nothing,
  spring,  ///< with a stiffness in Nm/rad, at rest at 0 rad
  wall,    ///< the same from CoupledLoop::wall_rad on
  weight,  ///< a torque towards lower angles, Nm
};
/// A value of each of two levers.
struct Pair {
  double of[2]{};
  double& operator[](std::size_t lever) { return of[lever]; }
  double operator[](std::size_t lever) const { return of[lever]; }
};
inline Pair operator+(Pair a, Pair b) { return {{a[0] + b[0], a[1] + b[1]}}; }
inline Pair operator-(Pair a, Pair b) { return {{a[0] - b[0], a[1] - b[1]}}; }
inline Pair operator*(double k, Pair a) { return {{k * a[0], k * a[1]}}; }
struct CoupledBody : PlainBody<Pair> {
  double inertia_kg_m2 = 0, strength = 0, met_nm = 0, period_s = 0;
  Met met = Met::nothing;
  std::size_t lever = 0;  ///< in the hand
  Pair observed_nm;
  explicit CoupledBody(double inertia) : inertia_kg_m2(inertia) { grip = in_angles(); }
  void sense(ImageLaw& law, const Pair& rad, const Pair& rad_s);
  static Pair force(const ImageLaw& law, const Pair&) {
    return {{law.torque_nm(0), law.torque_nm(1)}};
  }
  Pair acceleration(const Pair& held, const Pair& pushed, const Pair& rad, const Pair&);
};
/// Two levers that only a law couples; the second can meet an object.
class CoupledLoop : public LawLoop<CoupledBody> {
 public:
  static constexpr double most_rad = 1.0;  ///< that the hand is led to, either way
  static constexpr double wall_rad = 0.3;
  /// What the law reads as tau_hat lags by a first-order filter of this time, as an observer does.
  static constexpr double observer_s = 2e-3;

  /// Both levers have this inertia and rest at 0 rad; the hand holds the first.
  CoupledLoop(const std::string& image, double inertia_kg_m2)
      : LawLoop(std::make_unique<ImageLaw>(image), CoupledBody(inertia_kg_m2)) {}
  /// The hand holds lever 0 or 1 from now on, at the lever's position and speed. Throws
  /// std::invalid_argument.
  void hold(int lever);
  /// Chooses the object. Strength: Nm/rad for spring and wall, Nm for the weight. Throws
  /// std::invalid_argument for a negative strength.
  void meet(Met what, double strength);
  void lead(double theta_rad);

  int held() const { return static_cast<int>(lever); }
  double theta_rad(int n) const { return at_[static_cast<std::size_t>(n)]; }
  double hand_rad() const { return hand_[lever]; }
  double torque_nm(int n) const { return force_[static_cast<std::size_t>(n)]; }
  /// Torque of the object on the second lever, Nm.
  double met_nm() const { return CoupledBody::met_nm; }
};

struct Pen : PlainBody<shape::Point> {
  static Place start() { return {0, 0.06}; }
  static bool finite(Place p) { return std::isfinite(p.x) && std::isfinite(p.y); }
  static Place within(Place p);
  static Rate gap(Place to, Place from) { return to - from; }
  static void stop(Place& at, Rate& speed);
  static void sense(ImageLaw& law, Place at, Rate speed);
  static Rate force(const ImageLaw& law, Place at);
};
/// The pen of the pantograph.
class PenLoop : public LawLoop<Pen> {
 public:
  /// Reach of the pen: smallest and largest distance from the motors, smallest distance in front of
  /// them, m.
  static constexpr double nearest_m = 0.04, farthest_m = 0.19, front_m = 0.02;

  explicit PenLoop(const std::string& image) : LawLoop(std::make_unique<ImageLaw>(image)) {}
  /// Replaces the law; pen and hand stay. Throws std::invalid_argument.
  void load(const std::string& image) { law_ = std::make_unique<ImageLaw>(image); }

  shape::Point pen_m() const { return at_; }
  shape::Point velocity_m_s() const { return speed_; }
  shape::Point hand_m() const { return hand_; }
  shape::Point force_n() const { return force_; }
};

/// Mechanics of each axis of a stylus.
struct StylusSlides {
  double mass_kg = 0;
  double friction_ns_m = 0;  ///< viscous
  double capstan_m = 0;      ///< radius of the capstan: force = torque / radius
};
/// The slides of a device file with [slides], which are given as rotation of a capstan.
StylusSlides slides_of(const plant::Parameters& slide);
/// The design for which the law's image is compiled; it need not be built in.
DesignInfo stylus_design();

struct StylusBody : PlainBody<plant::Vec3> {
  StylusSlides slides;
  std::optional<PlaneHost> host;
  Clock host_runs = 0;                 ///< the clock of the host: runs since touch()
  std::map<std::string, double> sent;  ///< values of the plane in the mailbox
  bool limited = false;
  explicit StylusBody(const StylusSlides& s) : slides(s) {}
  static Place start() { return {0, 0, 0.05}; }
  static bool finite(const Place& p) { return std::isfinite(p.x + p.y + p.z); }
  static Place within(const Place& p);
  static void stop(Place& at, Rate& speed);
  void sense(ImageLaw& law, const Place& at, const Rate& speed);
  Rate force(const ImageLaw& law, const Place&);
  /// The hand holds the pen fast: both move as one mass.
  Rate acceleration(const Rate& held, const Rate& pushed, const Place&, const Rate& speed) const {
    return 1 / (grip.mass_kg + slides.mass_kg) * (held - slides.friction_ns_m * speed + pushed);
  }
};
/// A stylus on three slides; a host knows the world and sends nearest planes to the law.
class StylusLoop : public LawLoop<StylusBody> {
 public:
  static constexpr double most_n = 3.3;   ///< largest force per axis, vectors/devices/stylus.toml
  static constexpr double reach_m = 0.1;  ///< reach along each axis, to both sides

  /// The world is empty.
  StylusLoop(const std::string& image, const StylusSlides& slides)
      : LawLoop(std::make_unique<ImageLaw>(image, stylus_design()), StylusBody(slides)) {}
  /// Sets a parameter of the law; touch() sets the values that the host sends.
  void set(const std::string& parameter, double value) {
    LawLoop::set(parameter, value);
    sent.clear();
  }
  /// Changes the host's world, material, rate or age from the next run on. The previous plane holds
  /// until the first new one arrives.
  void touch(const PlaneHostSettings& world);

  plant::Vec3 pen_m() const { return at_; }
  plant::Vec3 velocity_m_s() const { return speed_; }
  plant::Vec3 hand_m() const { return hand_; }
  plant::Vec3 force_n() const { return force_; }
  /// Whether the law demanded more than most_n in the last run.
  bool limited() const { return StylusBody::limited; }
  /// Depth of the pen below the world's surface, m; negative outside; 0 without a world.
  double depth_m() const;
  /// The plane that arrived last; nothing if none has arrived.
  std::optional<Plane> plane() const { return host ? host->plane() : std::nullopt; }
  /// Angle between the normal that arrived last and the world's normal at the pen, and age of the
  /// pose of that plane: at the end of the last advance(), 0 if no plane has arrived.
  double tilt_rad() const { return seen(3); }
  double age_s() const { return seen(4); }
  /// In a hollow of a smaller radius the pen would swing sideways by itself, pressed as it is now,
  /// m: by the linear loop of docs/page.md#a-mesh with the mean age of a plane and the hand's
  /// mass, spring and damping; 0: in none.
  double steady_hollow_m() const;

 private:
  double seen(std::size_t column) const;
  PlaneHostSettings world_;
};

/// The design for which the law's image is compiled; it need not be built in.
DesignInfo gimbal_design();

struct HandleBody : PlainBody<plant::Quaternion, plant::Vec3> {
  int runs_per_host = 1, runs = 0;
  plant::Vec3 way_rad;
  HandleBody() { grip = in_angles(); }
  static Rate gap(const Place& to, const Place& from) { return plant::coupling_nm(1, to, from); }
  static Place moved(const Place& q, const Rate& rad);
  Rate way(const Place&, const Place&) const { return way_rad; }
  void arrive(const Place&, const Place&) { way_rad = {}; }
  void sense(ImageLaw& law, const Place& at, const Rate& speed);
  static Rate force(const ImageLaw& law, const Place&) {
    return {law.torque_nm(0), law.torque_nm(1), law.torque_nm(2)};
  }
};
/// A handle that turns about three axes, and the body of the law rigid_body behind it.
class GimbalLoop : public LawLoop<HandleBody> {
 public:
  static constexpr double host_hz = 1000;  ///< at which a host sends the handle's orientation
  /// The states of the body's quaternion: w, x, y, z.
  using BodyWords = std::array<StateWord, 4>;

  /// Hand, handle and body rest with the axes of the base.
  GimbalLoop(const std::string& image, const BodyWords& body);
  /// The hand turns by this vector, rad, about the axes of the base, at constant speed during the
  /// next advance(). A vector that is not finite is ignored.
  void turn(plant::Vec3 rad) {
    if (std::isfinite(plant::length(rad))) way_rad = way_rad + rad;
  }

  const plant::Quaternion& hand() const { return hand_; }
  const plant::Quaternion& handle() const { return at_; }
  plant::Quaternion body() const;
  plant::Vec3 torque_nm() const { return force_; }
  /// Angle between handle and body, the shorter way, rad.
  double twist_rad() const;

 private:
  BodyWords body_;
};

}  // namespace feltgate::page
