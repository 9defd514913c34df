#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/likelihood/detectable.hpp>
#include <gyrostat/diagnosis/likelihood/nameless.hpp>
#include <gyrostat/diagnosis/likelihood/set_fit.hpp>
#include <gyrostat/diagnosis/likelihood/transient.hpp>
#include <gyrostat/diagnosis/likelihood/unexplained.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

struct SetSearchOptions {
  std::vector<std::string> without;  ///< effects left out of the catalogue
  std::size_t most_effects = 8;
  bool is_cut_off = false;  ///< values are known to be cut off towards zero
};

/// An effect of the set, with what speaks for it.
struct Member {
  std::string effect;
  double log_odds;        ///< of the set against the set without it
  bool read_off = false;  ///< of the values themselves, by no law of noise
  bool given = false;     ///< as all axes have it; `log_odds` is of them together
  double p_equal = 1.0;   ///< then: as Given
};

/// A set that was tried in place of the best one.
struct Rival {
  Effect found;        ///< fitted
  std::string effect;  ///< that stands where `instead_of` does; alone where that is empty
  std::string instead_of;
  double log_odds;  ///< against the best set, at most 0 or so
};

/// An effect that a set is given, since the axes beside it have it (alike_on_axes()): what of it is
/// alike stays as it is.
struct Given {
  Effect effect;
  double log_odds = 0.0;  ///< that this axis has it, of all axes together
  double p_equal = 1.0;   ///< that chance makes equal axes differ as each alone was found to
  std::vector<Rival> rivals{};
  /// 95 %, of each field; NaN where it is not alike, or no axis says.
  std::vector<std::array<double, 2>> intervals{};
};

/// What a set is worth with other effects of one part of the sensor (CauseType::part).
struct Worth {
  double score;  ///< log-likelihood less its cost, without that of what is alike
  double cost;   ///< of what is alike
};

struct FoundSet {
  Scenario baseline;  ///< no effects, fitted
  Scenario scenario;  ///< the set, fitted, with drift
  std::vector<Member> members{};
  /// Log odds of what stands in the scenario under the nearest name, where the effect that it has
  /// the form of is not in the catalogue; 0: all has its name.
  double nameless_log_odds = 0.0;
  std::vector<Rival> rivals{};
  std::vector<ParameterInterval>
      intervals{};                         ///< of parameters of `scenario`, where they are known
  std::vector<Unexplained> unexplained{};  ///< beside the set
  /// The clearest of each part, by index_of(Part); its frequency is none of the set's.
  std::array<std::optional<Transient>, 2> transients{};
  /// What rounds to it, where nothing but noise rests on a few values of a grid.
  std::optional<double> level_on_grid_dps{};
  /// Where a grid is coarser than the noise: the gyro's rate as it was drawn; else empty.
  std::vector<double> before_rounding_dps{};
  double score = 0.0;  ///< log-likelihood of the rate's set, less its cost
  double gain = 0.0;   ///< log-likelihood of the rate's set, less its cost, beyond the baseline's
  /// Of all that was found, beyond white noise and a walk; none where samples do not count, as
  /// repeats and outliers: what they would say is not known.
  std::optional<double> log_score_gained{};
  /// What each effect would have gained at each step of the search.
  std::vector<std::pair<std::string, double>> screening{};
  /// The scenario with those effects of the set alone that have one of the names, its noise fitted
  /// anew. Outlives neither the simulator nor the recording.
  std::function<Scenario(const std::vector<std::string>&)> subset{};
  /// The same, the parameters of these effects fitted anew, too.
  std::function<Scenario(const std::vector<std::string>&)> anew{};
  /// What no name explains, beside the set with its drift; likewise.
  std::function<std::vector<Nameless>(const Scenario&)> nameless{};
  /// With these effects of a part of the sensor as they are, in place of the set's; nothing where
  /// they cannot be had. Empty where what is fast has no law; likewise.
  std::function<std::optional<Worth>(std::string_view part, const std::vector<Effect>&)> worth{};
  /// The set that is found beside these, in place of what the set has of their parts; it is then
  /// that set which is asked. As `worth`.
  std::function<FoundSet(const std::vector<Given>&)> beside{};
  /// What would have been found beside the set; likewise.
  std::function<std::vector<Detectable>()> detectable{};
};

using SetSearchProgress = std::function<void(const std::string&, double)>;

/// White noise, a random walk and white compass noise: those under which the train part of a
/// recording is likeliest.
Scenario likeliest_baseline(const Simulator& simulator, const Series& recording);

/// The set of effects under which the train part of a recording is likeliest, by a search forward,
/// backward and by exchange.
FoundSet find_set(const Simulator& simulator, const Series& recording,
                  const SetSearchOptions& options, const SetSearchProgress& progress = {});

}  // namespace gyrostat::gap
