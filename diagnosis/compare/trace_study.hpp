#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/diagnosis/compare/added.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// One trace with the set of effects that it shows.
class TraceStudy {
 public:
  /// Effects in `without` are not looked for.
  TraceStudy(const Series& trace, std::uint64_t seed, std::vector<std::string> without,
             const Interrupt& interrupt, const SetSearchProgress& progress);

  const Series& series() const { return series_; }
  const Conditions& conditions() const { return simulator_->conditions(); }
  double resolution_dps() const { return simulator_->resolution_dps(); }
  const FoundSet& found() const { return found_; }
  /// The fitted effects of that name.
  std::vector<Effect> effects(std::string_view name) const;
  /// Log odds of the set against the best with something else in place of that effect; 0 where it
  /// is not in the set.
  double log_odds(std::string_view name) const;
  /// The rate error of a gyro under the trace's conditions, without a drift fitted to it; its
  /// values are rounded to `resolution_dps` before (0: not).
  std::vector<double> error_dps(std::vector<double> gyro_dps, double resolution_dps) const;
  /// The trace with that added (with_added), its own grid, limit, decimals and repeated samples as
  /// they were.
  Series mended(const Addition& addition, const Noise& noise) const;

  /// Standard errors of the fields of the first effect of that name; NaN where none is known.
  std::vector<double> errors_of(std::string_view name) const;

  /// Log odds of the set against it without that effect, whatever else could stand there; 0 where
  /// it is not in the set.
  double worth(std::string_view name) const;
  /// Effects of the other side that join its set wherever a loss is asked for, starting from these
  /// parameters: what the one explains by them and the other by something else is no difference.
  void allow(std::vector<Effect> effects);
  /// The log-likelihood that the trace loses where the effects of that name have the parameters of
  /// `others`, all else fitted anew; 0 where the effect has no law, or is a slow curve.
  double loss_with(std::string_view name, const std::vector<Effect>& others) const;
  /// The same with another white noise, or with another walk.
  double loss_with_white(double std_dps) const;
  double loss_with_walk(double dps_per_sqrt_s) const;
  /// Whether what wanders is remembered (ARIMA), and so is no walk of a K.
  bool has_memory() const;
  double white_std_dps() const;
  double walk_dps_per_sqrt_s() const;

 private:
  void prepare() const;
  /// With all fitted but what is held.
  double best_likelihood(const Scenario& scenario, std::string_view held) const;
  /// With the effects allowed or without, whichever is likelier.
  double best_allowed(const Scenario& scenario, std::string_view held) const;
  double loss_of(const Scenario& other, std::string_view held) const;

  Series series_;
  std::vector<std::string> without_;
  std::unique_ptr<Simulator> simulator_;
  FoundSet found_;
  mutable std::unique_ptr<SetBench> bench_;
  mutable Standing standing_;
  std::vector<Effect> allowed_;
  mutable std::optional<double> free_likelihood_;
};

}  // namespace gyrostat::gap
