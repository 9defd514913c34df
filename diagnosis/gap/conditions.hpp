#pragma once

#include <array>
#include <optional>
#include <vector>

#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/series.hpp>
#include <gyrostat/diagnosis/gap/local_level.hpp>

namespace gyrostat::gap {

/// The two parts of a recording: what the diagnosis may see, and what it is judged on.
enum class Part { train, held_out };
inline constexpr std::array both_parts = {Part::train, Part::held_out};
inline constexpr std::array train_alone = {Part::train};
constexpr std::size_t index_of(Part part) { return static_cast<std::size_t>(part); }

/// Which of it is held out: two blocks of eight, two others, or nothing.
enum class Split { in_parts, in_other_parts, none };

/// Samples [first, last) of an evenly sampled stretch.
struct Span {
  std::size_t first, last;
  std::size_t size() const { return last - first; }
};

/// What a recording and every replica of it share: when the gyro was sampled, how warm it was, how
/// it moved, where the compass could be used - and how the samples are split in parts.
///
/// Time is cut into eight equal blocks of whole clusters, of which the third and the seventh are
/// held out, or the second and the sixth; what is bridged or averaged never mixes the parts. Fast
/// readings come from single samples, slow ones from the means of `cluster` samples, of which there
/// are about three thousand; or a thousand at least where they would last less than 0.4 s: what a
/// mean hides has no line. Of short recordings there are fewer, of four samples.
class Conditions {
 public:
  /// Of an evenly sampled series; NaN marks a missing sample. Gaps of up to `bridged` samples are
  /// interpolated, longer ones end a span. Without a split all of it is the train part.
  explicit Conditions(const Series& recording, Split split = Split::in_parts);

  static constexpr std::size_t blocks = 8;
  static constexpr std::size_t bridged = 5;

  const Series& series() const { return series_; }
  std::size_t size() const { return series_.size(); }
  double interval_s() const { return interval_s_; }
  double rate_hz() const { return 1.0 / interval_s_; }
  std::size_t cluster() const { return cluster_; }
  double slow_interval_s() const { return interval_s_ * static_cast<double>(cluster_); }

  Part part_of(std::size_t sample) const;
  const std::vector<Span>& spans(Part part) const { return fast_[static_cast<int>(part)]; }
  const std::vector<Span>& slow_spans(Part part) const { return slow_[static_cast<int>(part)]; }
  std::size_t slow_size() const { return slow_time_s_.size(); }

  bool has_temperature() const { return !series_.temperature_C.empty(); }
  bool has_motion() const { return !motion_dps_s_.empty(); }
  bool has_heading() const { return !series_.heading_deg.empty(); }
  bool has_acceleration() const { return !series_.acc_x_mps2.empty(); }

  const std::vector<double>& slow_time_s() const { return slow_time_s_; }
  const std::vector<double>& slow_temperature_C() const { return slow_temperature_C_; }
  /// Change of the temperature over ten seconds, per second, [B eq. 5].
  const std::vector<double>& slow_warming_C_per_s() const { return slow_warming_; }
  /// Derivative of the reference rate, dps/s; empty where it never changes.
  const std::vector<double>& motion_dps_s() const { return motion_dps_s_; }
  /// Integral of the reference rate, deg, from 0.
  const std::vector<double>& turned_deg() const { return turned_deg_; }

  /// 1, T - T(0), and T' over ten seconds as well as from cluster to cluster: recorders differ in
  /// what they call T'. slow_size() x 4, or x 1 without a temperature that changes.
  const Eigen::MatrixXd& drift_regressors() const { return drift_regressors_; }
  /// Their coefficients in slow values of the train part, by least squares generalised for the
  /// random walk that the recording shows.
  Eigen::VectorXd drift_of(const std::vector<double>& slow) const;
  /// The values at the slow points of the train part, the only ones that drift_of() looks at.
  Eigen::VectorXd train_values(const std::vector<double>& slow) const;
  /// All regressors but the constant at those points.
  Eigen::MatrixXd train_regressors() const;
  /// The slow points of the train part.
  const std::vector<std::size_t>& train_points() const { return train_points_; }

  /// The drift with these coefficients at every slow point.
  std::vector<double> drift(const Eigen::VectorXd& coefficients) const;
  /// `values` with its short gaps bridged.
  void bridge(std::vector<double>& values) const;
  /// The mean of every cluster, NaN values passed over.
  std::vector<double> slow_means(const std::vector<double>& values) const;

 private:
  void find_spans();
  void find_drift();

  Series series_;
  double interval_s_ = 0.0;
  std::size_t cluster_ = 1;
  std::vector<Part> parts_;  ///< of the clusters; what is beyond the last is of its part
  std::array<std::vector<Span>, 2> fast_, slow_;
  std::vector<Span> gaps_;
  std::vector<double> slow_time_s_, slow_temperature_C_, slow_warming_, motion_dps_s_, turned_deg_;
  Eigen::MatrixXd drift_fit_, drift_regressors_;
  std::optional<LocalLevel> level_;
  std::vector<std::size_t> train_points_;
};

}  // namespace gyrostat::gap
