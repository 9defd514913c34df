#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/before_rounding.hpp>
#include <gyrostat/diagnosis/likelihood/detectable.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/likelihood/response_left.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/diagnosis/likelihood/tails.hpp>

namespace gyrostat::gap {

/// As read off the values.
void add_mark(std::string_view effect, FoundSet& found);
/// Standard deviation of white noise with what rounding adds.
double white_with_rounding(const Scenario& scenario);

/// find_set() and what may be asked of it afterwards: its moves are in set_moves.cpp and
/// set_exchange.cpp, beginnings from elsewhere in set_beginnings.cpp and
/// set_responding.cpp, what stands for others of the
/// set in set_needless.cpp, what other axes give in set_given.cpp, what is read off values in
/// set_marks.cpp, what a coarse grid hides in set_drawn.cpp, what only sizes of innovations say in
/// set_tails.cpp, where a dead zone ends in set_threshold.cpp, what is asked afterwards in
/// set_afterwards.cpp.
class SetSearcher {
 public:
  SetSearcher(const Simulator& simulator, const Series& recording, const SetSearchOptions& options,
              const SetSearchProgress& progress)
      : simulator_(simulator),
        conditions_(simulator.conditions()),
        recording_(as_converted(simulator, recording, options)),
        options_(options),
        progress_(progress),
        bench_(simulator, recording_, options.without) {}

  FoundSet run();
  Scenario likeliest_baseline();
  /// What of a subset is fitted anew.
  enum class Anew { noise, all };
  Scenario subset_of(const Scenario& whole, const std::vector<std::string>& names, Anew what);
  /// Whether the fast part beside the set has one.
  bool has_law() const { return end_.has_value(); }
  std::optional<Worth> worth_with(std::string_view part, const std::vector<Effect>& effects);
  FoundSet beside(const std::vector<Given>& given);
  std::vector<Nameless> nameless_beside(const Scenario& set) const;
  std::vector<Detectable> detectable();

 private:
  /// With the middles of what was cut off to a grid, or on the grid that values lie about.
  Series as_converted(const Simulator& simulator, Series recording,
                      const SetSearchOptions& options);
  /// What a response without a name has to gain: it has eight sizes, half a nat each by chance.
  static constexpr double clear_response = 20.0;

  /// `left` rounds are to come at least, as far as is known.
  void tell(const std::string& what, std::size_t left) {
    doing_ = what;
    left_ = left;
    tell_share(0.0);
  }
  /// So much of a round is done.
  void tell_share(double of_round) const {
    const auto rounds = static_cast<double>(rounds_);
    if (progress_) progress_(doing_, (rounds + of_round) / (rounds + static_cast<double>(left_)));
  }
  /// One round of the search.
  std::vector<Standing> each_added(const Standing& standing);
  Standing searched(Standing standing);
  /// Of sets with one effect more the best, of those with one of the motion where any is clear.
  std::vector<Standing>::const_iterator foremost(const Standing& standing,
                                                 const std::vector<Standing>& tried) const;
  Standing settled(Standing standing) const;
  /// The best of the sets with two more effects, neither of which pays alone: where both are slow,
  /// one leaves to the walk what hides it. The standing itself where there is none better.
  Standing two_further(const Standing& standing, std::vector<Standing> tried);
  /// Of a further effect of the band, or of the last of the set `with` one more.
  double least_gain(const Standing& standing, EffectBand band) const;
  double least_gain(const Standing& standing, const Standing& with) const;
  EffectBand band_of_last(const Standing& standing) const;
  /// Whether samples are masked that a response in time shows in.
  bool hides_response() const {
    return !hidden_from_response_.empty() && bench_.masked() != hidden_from_response_;
  }
  /// Beside what the named response to the motion lacks, where that shows.
  Standing beside_response(Standing standing);
  /// What the search ends with: exchanges, and beginnings from elsewhere.
  Standing concluded(Standing standing, FoundSet& found);
  /// Adds what is known of the set where the search ended.
  FoundSet described(Standing standing, FoundSet found);
  /// A sine that is on and off while its phase goes on is a line and skirts about it, and was found
  /// as a sine within a narrow band: bursts, where both together show them more clearly than the
  /// band alone.
  void join_gated_sines(const std::vector<char>& hidden, FoundSet& found) const;
  void look_for_transients(const std::vector<char>& hidden, FoundSet& found) const;
  /// With other effects of a part of the sensor.
  static Scenario end_with(std::string_view part, const std::vector<Effect>& effects, Scenario end);
  /// From its noise, and from as much white noise as the fast part of the end calls for beside it.
  Standing refitted_from_either(const Scenario& scenario) const;
  /// As it would be where it stood: polished, and its filters of the noise told otherwise.
  Standing fitted_to_the_end(Standing rival, double to_reach) const;
  /// Every member against all that might stand in its place.
  Standing exchanged(Standing standing, FoundSet& found);
  /// Where several effects colour the noise, these found anew beside its lines, a filter first:
  /// what stands in for that and an angle's errors holds its place against every single exchange.
  Standing coloured_anew(const Standing& standing);
  /// Where a band that is too wide for a line stands among them, what is there found anew beside an
  /// angle's errors: with the slow noise that is left beside these it stands in for both.
  Standing without_wide_lines(const Standing& standing);
  /// Whether what the set leaves still follows the rate.
  bool leaves_of_the_motion(const Standing& standing) const;
  /// A shift and a filter, found together on what is `left`, beside what is marked alone.
  std::vector<Standing> late_beginnings(const Evidence& left, Scenario still) const;
  /// Where the motion is sensed late, its effects found anew from the other way of being late: what
  /// stands in for one of them has moved all others; and where what is left still follows it, from
  /// both ways.
  Standing responding_anew(const Standing& standing);
  /// Where several effects bend the motion, these, or in place of all of its effects one response
  /// without a name: what that explains as well, which is linear in the rate, is not bent.
  Standing responding_without_names(Standing standing);
  /// Of sets found from each of some beginnings, with the effects of a band as candidates or with
  /// all, the best; what stands, where none is better by what its further effects have to gain.
  Standing best_from(const Standing& standing, std::vector<Standing> beginnings,
                     std::optional<EffectBand> band);
  /// Without what stands for something that others of the set have besides: a bias that settles
  /// before a filter or a shift of time has followed the rate, beside which the search finds more,
  /// and sines of a line that they are part of.
  Standing without_what_others_are(Standing standing, FoundSet& found) const;
  /// Without those that are hardly likelier than nothing in their place; they are rivals of that.
  Standing without_the_doubtful(Standing standing, FoundSet& found) const;
  /// With a sine that stands out from a vibration in whose band it is: until it is known to, it has
  /// no price.
  Standing beside_a_line_within(Standing standing, FoundSet& found);
  /// With an ARIMA(1,1,1) that remembers, beside what is there or in place of what colours the
  /// noise.
  Standing beside_memory(const Standing& standing) const;
  /// Samples within reach of the limit: there noise decides what is clipped, and what is left of it
  /// is no longer centred.
  std::vector<char> near_the_limit(const Marks& marks) const;
  /// Of samples about the level of their block, rounding included: the median block's.
  double noise_about_levels(const std::vector<double>& left) const;
  /// What a grid is held against, rounding included. Beside a motion that is not explained, a walk
  /// stands in for noise that steps from sample to sample show; beside noise that remembers, for
  /// noise that samples at rest show about their level.
  double noise_on_grid(const Scenario& begun, const Marks& marks) const;
  /// Effects that are read off the values.
  std::vector<Effect> read_off(const Marks& marks, FoundSet& found);
  /// Where the noise shows clearly an angle in steps as large as the grid of the rates, the grid is
  /// the angle's: there is no other quantization.
  void give_grid_to_angle(const Marks& marks, FoundSet& found) const;
  static void remove(std::vector<Effect>::iterator effect, FoundSet& found);
  /// What acts at the converter, in the order in which it does.
  static void put_in_order(FoundSet& found);
  /// Rounding to more than the noise is not noise: what was rounded is drawn from its law, and
  /// looked at instead.
  void draw_once(const Scenario& scenario);
  /// Drawn and fitted in turn.
  Standing drawn_before_rounding(Standing standing);
  void put_grid_back(Scenario& set) const {
    set.effects.insert(set.effects.begin(), *coarse_grid_);
  }
  /// Log-likelihood that the whole gains on draws from the rest, on average.
  double gain_on_draws(const Scenario& whole, Standing rest);
  /// Without effects that draws show for having been drawn with them.
  Standing without_what_draws_show(Standing standing, FoundSet& found);
  /// The set found anew on draws beside itself, until it stays.
  Standing drawn_anew(Standing standing, FoundSet& found);
  std::vector<char> edges_of_the_dead_zone(const Scenario& scenario) const;
  /// Where rates begin to be sensed at a jump: those samples say it that the search has hidden, by
  /// the least squares of either side.
  void place_threshold(FoundSet& found) const;
  /// Where the motion is not known between samples.
  std::vector<char> unknown_samples(const Scenario& scenario) const {
    return samples_of_unknown_rate(conditions_, scenario, white_with_rounding(scenario));
  }
  /// Log-likelihood that noise which warms, and noise with tails, gain at most where it is only the
  /// grid that makes its size, or its distribution, another with the level.
  struct OfGrid {
    double warmth = 0.0, tails = 0.0;
  };
  /// Of a grid in standard deviations of the rounded noise.
  OfGrid feigned_by_grid(double lsb_of_noise) const;
  /// Log-likelihood that a filter of the noise gains at most where it is only repeats, which are
  /// not told, that make neighbours alike.
  double feigned_by_repeats(const Marks& marks) const;
  /// Whether the noise is averaged between the samples of another clock, now one, now two of them.
  bool slips(const Scenario& set) const {
    return tails_.turns > 0.0 && has(set, "noise_averaging");
  }
  /// What the innovations say of outliers and of noise over temperature, beside the set.
  void judge_tails(const Standing& standing, Past past);
  void add_tails(FoundSet& found) const;
  /// Of noise fitted to samples that are not far off, at all temperatures: without the outliers
  /// among them, and as it is at the reference temperature, where `set` has these effects.
  void leave_to_tails(const Scenario& set, Arima111<double>& fitted) const;
  /// Variance of the error of rounding, which no temperature makes larger, over that of the noise.
  double rounding_over_noise(const Scenario& set) const;
  void add_nameless_tails(FoundSet& found) const;
  /// The set, and what only the sizes of innovations say, in turn.
  Standing searched_beside_tails(Standing standing);

  const Simulator& simulator_;
  const Conditions& conditions_;
  bool is_cut_off_ = false;
  double blur_dps_ = 0.0;  ///< of the noise about a grid
  Series recording_;       ///< as_converted(); where the grid is coarse, before rounding
  SetSearchOptions options_;
  SetSearchProgress progress_;
  SetBench bench_;
  std::vector<char> repeats_;  ///< samples that do not count, whatever the set
  /// Those that do not count for a response in time: it shows where the motion is least known.
  std::vector<char> hidden_from_response_;
  Tails tails_;
  double undithered_lsb_dps_ = 0.0;  ///< of a grid that no motion turns through
  OfGrid feigned_;
  double feigned_colour_ = 0.0;  ///< feigned_by_repeats()
  bool has_outliers_ = false, has_warm_noise_ = false;
  std::vector<const CauseType*> candidates_;
  Marks marks_;
  std::optional<double> white_at_rest_dps_;  ///< where a grid and noise are all there is
  bool is_coarse_ = false;  ///< a grid that hides all else, so that nothing has a law
  std::optional<BeforeRounding> before_rounding_;
  std::optional<Effect> coarse_grid_;  ///< of what was drawn
  Standing bare_, begun_;              ///< without effects; with what is read off
  FoundSet searched_;                  ///< at the end of the search, before it was described
  std::size_t rounds_ = 0;             ///< in which every candidate was tried
  std::size_t left_ = 1;
  std::string doing_;
  std::optional<Standing> end_;     ///< of the search; none where the fast part has no law
  std::vector<char> masked_;        ///< at the end
  std::optional<Effect> response_;  ///< at the end: what of the motion's response has no name
  std::vector<std::pair<std::string, double>> screening_, gains_;
};

}  // namespace gyrostat::gap
