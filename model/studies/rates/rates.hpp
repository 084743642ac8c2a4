// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures one scene at several rates: error of the torque, stability margin, clocks and time; for
// one lever and for a device with several axes. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "feltgate/design_info.hpp"
#include "sim/axes_loop/axes_scene.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/parameters.hpp"
#include "studies/rates/margin.hpp"
#include "studies/rates/slow_law.hpp"
#include "studies/stability/bit_loop.hpp"

namespace feltgate::rates {

// Laws for the engine that equal the core's scenes, so that the scenes can run at any rate.

/// A scene of the core and the law that demands the same torque.
struct BlockLaw {
  std::string scene;
  std::string file;  ///< name in rtl/laws; empty: `text` is the law
  std::string text;
  std::vector<std::string> names;  ///< the scene's parameters, docs/registers.md
  /// Computes the law's parameters, in the units of its file, from the scene's parameters and the
  /// angle of a count.
  using Values = std::map<std::string, double>;
  std::function<Values(const Values&, double count_rad)> parameters;
};

/// The law of a scene; nullptr if the scene has no torque law of its own.
const BlockLaw* block_law(const std::string& scene);

/// The scene with its law in place of the core's block, without expectations. `design` has the
/// block and gives the values that the scene does not set. Throws config::ConfigError for a scene
/// that changes to another one.
Scenario as_law(const Scenario& scene, const BlockLaw& law, const DesignInfo& design);

/// Throws config::ConfigError when the scene changes to another one or uses the voltage mode.
void require_one_law(const Scenario& scene);

// The margin of a law's whole torque at a place of rest: by the linear loop, and by the swing of
// the core's own bits, whose law counts that many times.

/// Where the law comes to rest if the device is held at the angles of `place`: with its states and
/// lines. Nothing if its torque still changes after 0.3 s. `nm`: its torques there.
std::optional<Place> at_rest(const law::Law& law, const Place& place, double run_s,
                             const HostWords& words, Eigen::VectorXd* nm);

/// Growth of a swing: the logarithm of its size, from one period to the next.
class Envelope {
 public:
  /// From `from_s` on; ends after `periods` or when the swing is smaller or larger than that.
  Envelope(double from_s, double period_s, double smallest_rad, double largest_rad, int periods)
      : next_s_(from_s),
        period_s_(period_s),
        least_(smallest_rad),
        most_(largest_rad),
        left_(periods) {}
  /// The angles of all axes at a time, some dozen times a period; false when enough was seen.
  bool add(double time_s, const Eigen::VectorXd& angles_rad);
  /// +-infinity where the swing ended within three periods.
  double growth_1_s() const;

 private:
  double next_s_, period_s_, least_, most_;
  int left_;
  bool begun_ = false;
  Eigen::VectorXd low_, high_;
  std::vector<double> times_s_, logs_;
  double last_ = 0, first_ = 0;
};

/// A margin of the whole torque.
struct GainMargin {
  std::string of;           ///< "alone", or "with the scene's hand"
  double linear = 0;        ///< factor on the torque at which the linear loop stops being stable
  double rad_s = 0;         ///< of its swing there
  double swing_counts = 0;  ///< how large the swing of the bits begins
  double bits = std::numeric_limits<double>::quiet_NaN();  ///< factor at which bits begin to grow
  double swing_nm = 0;  ///< and the law's torque in it, at the border
  /// The swing spans 6 counts and 2.5 steps of the duty: less says nothing of a linear loop.
  bool large = false;
  bool disagrees = false;  ///< the bits were tried and show no border near
  std::string why;         ///< why bits are missing
};

/// Finds the factor at which a swing neither grows nor dies, near `linear`, to 1 % and
/// interpolated; NaN where none is between 0.5 and 2 times `linear`.
double border_of(double linear, const std::function<double(double factor)>& growth_1_s);

/// How far to deflect the device from rest along `direction`: at most `most_rad`, and so little
/// that the law's torque is linear within 2 %; 0: not even 5 counts.
double linear_range_rad(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                        double count_rad, double most_rad, const HostWords& words);

/// Whether the law's torque in a swing of that size, and as fast, is that of a small one, to 3 % of
/// what has the frequency of the swing.
bool swings_linearly(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                     double by, double rad_s, double run_s, const HostWords& words);

/// A scene with its torque renewed at one rate.
struct RateRow {
  double rate_hz = 0;
  int ticks = 1;       ///< between two updates
  bool block = false;  ///< true: the core's own block; false: the engine runs a law
  int runs = 1;        ///< runs of the engine per update
  ErrorFigure error;   ///< of the torque reference against the continuous law, Nm; of all axes
  double mean_error_nm = 0;          ///< of the first axis
  std::vector<ErrorFigure> of_axes;  ///< as `error`, for each axis
  Margin margin;
  double swing_nm = 0;              ///< several axes: largest swing of a torque in the last quarter
  int expected = 0;                 ///< bounds that the scene sets for its figures; of several axes
  std::vector<std::string> broken;  ///< of these, a line each
  int clocks_used = 0;              ///< clocks of the engine per run
  int clocks_available = 0;         ///< clocks between its runs; 0 for a block
  int instructions = 0;
  double cpu_s_per_s = 0;  ///< of the closed loop with the twin, per simulated second
  std::int64_t mismatches = 0, clocks_compared = 0;  ///< RTL and twin in lock-step
  std::string first_mismatch;
  std::string fault;  ///< first fault that opened the gates, with its time; empty: none
};

/// Another design at the same scene, by its linear loop and its velocity estimate in double.
struct Beside {
  std::string path;
  ErrorFigure floor;            ///< of its counts and velocity, held over its tick
  std::vector<Margin> margins;  ///< for each row; of a block in the design's own tick
};

struct Report {
  std::string scene, title, law, plant;  ///< plant: or device
  int axes = 1;
  double simulated_s = 0;
  double largest_nm = 0;  ///< of the continuous law
  Slope slope;
  ErrorFigure floor;               ///< of counts and estimated velocity, at every tick, all axes
  double damping_nm_s_rad = 0;     ///< of the lever or each joint, for the margins
  std::vector<RateRow> rows;       ///< the slowest rate first
  std::vector<Beside> beside;      ///< as the options name them
  std::optional<Place> place;      ///< of a margin of the whole torque
  std::vector<GainMargin> gains;   ///< of the last row at rest, beside the bits; if asked for
  std::vector<std::string> notes;  ///< why rates or margins are missing
};

struct Options {
  std::vector<double> rates_hz{144, 490, 1e3, 10e3, 40e3, 100e3};
  bool lock_step = false;                          ///< the RTL beside the twin
  std::function<void(double done)> progress = {};  ///< 0..1; may be empty
  bool gains = false;                              ///< Report::gains
  bool bits = false;                               ///< of those, also by the bits
  bool whole_torque = false;                       ///< margins of the whole torque, of any law
  std::vector<design::Elaborated> beside = {};     ///< of one lever: Report::beside
  /// Of one lever: the design whose block, or whose engine for a scene "law", runs; empty: those
  /// below. Its block then has no margin here.
  std::string design = {};
};

/// The designs on which blocks and laws run.
inline constexpr const char* block_design = "lever";
inline constexpr const char* law_design = "lever_law";

/// Measures a scene of one lever. The fastest rate is always measured: that of the law, and the
/// tick rate if a block renders the scene; the options add slower rates. `law` is the scene's law,
/// or the law for its block. `e` is the design of the law. Throws as require_one_law(), LawError,
/// and std::invalid_argument for a law of several axes.
Report measure(const Scenario& scene, const LawSource& law, const plant::Parameters& plant,
               const design::Elaborated& e, const Options& options);

/// The same for a device with several axes; `e` is its design "DEVICE_law". The law runs at each
/// rate on the twin, or on RTL and twin. Throws LawError, and std::invalid_argument for a design
/// that this program lacks or a law that is not for these axes.
Report measure(const AxesScene& scene, const LawSource& law, const design::Elaborated& e,
               const Options& options);

/// The report as text tables, and as JSON (schema feltgate-rates/1).
std::string report_text(const Report& report);
/// The gains beside the bits as text.
std::string gains_text(const Report& report);
std::string reports_json(const std::vector<Report>& reports);

/// A rate as text: "490 Hz", "1 kHz", "0.5 MHz".
std::string rate_text(double hz);

}  // namespace feltgate::rates
