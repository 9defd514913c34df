#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/evidence.hpp>
#include <gyrostat/diagnosis/likelihood/set_fit.hpp>

namespace gyrostat::gap {

/// Log prior odds against any one effect more: of some thirty one or two are there (30 e^-3 = 1.5).
constexpr double prior = 3.0;

/// A set with its fit.
struct Standing {
  Scenario scenario;  ///< every effect but those of the compass
  std::shared_ptr<const SetFitter> fitter;
  SetFit fit;
  double score = -1e300;  ///< log-likelihood less what its parameters cost
  /// The same effects as they were beside one that has just gone.
  std::optional<Scenario> beside_the_last{};
};

bool has(const Scenario& scenario, std::string_view effect);
/// Same in every replica and not slow: taken out of the recording, sample by sample.
bool is_taken_out(const Effect& effect);

/// Fits sets of effects to the train part of one recording, of which some samples may not count.
class SetBench {
 public:
  /// Effects in `without` are left out of the catalogue.
  SetBench(const Simulator& simulator, const Series& recording, std::vector<std::string> without);

  const Conditions& conditions() const { return conditions_; }
  bool is_allowed(std::string_view effect) const;
  /// Found from the values or the sizes of innovations, or given, and not by the likelihood of the
  /// rate.
  bool is_marked(std::string_view effect) const;
  /// These effects are known to be there, and what of them is alike on all axes: that no fit moves,
  /// and it costs nothing.
  void give(std::vector<std::string> effects) { given_ = std::move(effects); }
  const std::vector<std::string>& given() const { return given_; }
  void mark_saturation() { marked_saturation_ = true; }
  void mark_dead_zone() { marked_dead_zone_ = true; }

  /// A sine at this frequency stands out from the random line in whose band it is.
  void tell_of_line(std::optional<double> frequency_hz) { line_that_stands_out_hz_ = frequency_hz; }

  const RateGrid& grid() const { return *grid_; }
  const std::vector<char>& masked() const { return grid_->counted().masked(); }
  void mask_only(std::vector<char> samples);
  void mask_too(const std::vector<char>& samples);

  /// What of the motion's response has no name, and is taken out beside any set.
  const std::optional<Effect>& response() const { return response_; }
  void take_out_response(std::optional<Effect> response) { response_ = std::move(response); }

  /// No noise, no drift and no effects, under the recording's sampling.
  Scenario plain() const;
  /// The effects beside white noise and a walk that are found without a start.
  Standing beside_noise(std::vector<Effect> effects) const;
  /// With an ARIMA(1,1,1) that remembers, in place of the walk.
  Standing beside_memory(const Standing& standing) const;
  /// What the parameters of a set cost, by which a score is less than a log-likelihood: so much for
  /// each that is fitted, and the logarithm of the places looked at for lines. Beyond any where an
  /// effect is not what it is called, or the white noise has passed for memory.
  double price_of(const Scenario& scenario) const;
  Standing fitted(const Scenario& scenario, std::shared_ptr<const SetFitter> fitter, int iterations,
                  Jumping jumping = Jumping::yes) const;
  Standing refitted(const Scenario& scenario, int iterations = fitting_iterations) const {
    return fitted(scenario, fitter_of(scenario), iterations);
  }
  /// With one more effect; a score of -1e300 where it cannot be had. `left` is what the set leaves.
  Standing with(const Standing& standing, const CauseType& cause, const Evidence* left) const;
  /// Refitted with all that may stand in for it, as far as that could bring it near the whole.
  Standing without(const Standing& standing, std::size_t effect) const;
  /// Where one of its effects is no longer what it is called, the best without one of them; else as
  /// it is.
  Standing as_called(const Standing& standing) const;
  /// The parameters of what is taken out, each by parabolas through the likelihood, the noise as it
  /// is; left as they are where passes that gain as much as the last will not bring its score to
  /// `to_reach`.
  Standing polished(Standing standing, double to_reach = -1e300) const;
  /// With one of its effects told otherwise, where that is likelier and could reach `to_reach`.
  Standing told_otherwise(const Standing& standing, std::size_t effect,
                          double to_reach = -1e300) const;
  /// Of the parameters of a fitted set; those of what is taken out from the curvature of the
  /// likelihood, the other effects as they are.
  std::vector<ParameterInterval> intervals_of(const Standing& standing) const;
  /// What starts of a further effect are made from.
  Evidence evidence_of(const Standing& standing) const;
  /// The rate error less what is taken out and its level (take_out_level), NaN where `hidden` (a
  /// flag a sample).
  std::vector<double> rate_left_by(const Scenario& scenario, const std::vector<char>& hidden) const;
  /// What of the gyro's rate is known beside the scenario: what is taken out, and the reference.
  std::vector<double> known_rate(const Scenario& scenario) const;
  /// The reference rate as the scenario's effects have it sensed.
  std::vector<double> sensed_rate(const Scenario& scenario) const;

 private:
  static constexpr int fitting_iterations = 15;

  /// From guesses beside the set; from starts on what it leaves.
  Standing with_guessed(const Standing& standing, const CauseType& cause) const;
  Standing with_started(const Standing& standing, const CauseType& cause,
                        const Evidence& left) const;
  bool is_read_off(const Effect& effect) const;
  bool is_given(std::string_view effect) const;
  /// To the rate that turns, a value a sample.
  std::vector<double> added_by(const std::vector<Effect>& effects) const;
  /// What the acceleration adds to the rate; empty where no effect says so.
  struct Felt {
    std::vector<double> of_samples;
    std::vector<double>
        of_means;  ///< what of it is left to means of clusters, to be fitted to them
    std::vector<KnownSize> known;  ///< of what is not
  };
  Felt felt_under(const Scenario& scenario, std::vector<double> error) const;
  /// Of an effect whose amplitudes an acceleration has, what samples within clusters say of them.
  std::vector<KnownSize> known_within(const Effect& effect, const std::vector<double>& error) const;
  /// The effect with these sizes, where they are known beside the standing.
  std::optional<Effect> sized_within(const Standing& standing, Effect effect) const;
  /// The recording's gyro without what is the same in every replica of the scenario; with what it
  /// feels of the acceleration.
  std::vector<double> gyro_as_felt(const Scenario& scenario) const;
  std::vector<double> gyro_beside(const Scenario& scenario) const;
  std::vector<double> error_of(std::vector<double> gyro) const;
  std::vector<double> rate_error_beside(const Scenario& scenario) const;
  /// None where the scenario leaves other samples than the recording has.
  std::shared_ptr<const SetFitter> fitter_of(const Scenario& scenario) const;
  void add_intervals_of_taken_out(const Scenario& scenario, std::size_t effect,
                                  std::vector<ParameterInterval>& to) const;

  const Simulator& simulator_;
  const Conditions& conditions_;
  const Series& recording_;
  std::vector<std::string> without_, given_;
  bool is_shaken_;
  std::ptrdiff_t missing_ = 0;  ///< samples of the error beside no effect
  std::shared_ptr<const RateGrid> grid_;
  std::optional<Effect> response_;
  std::optional<double> line_that_stands_out_hz_;
  bool marked_saturation_ = false, marked_dead_zone_ = false;
};

}  // namespace gyrostat::gap
