#pragma once

#include <cstddef>

/// The numbers that decide verdicts. Gains are nats of the log score: by Scoring::temperature, a
/// gain g stands for odds of exp(g / 3).
namespace gyrostat::gap::thresholds {

/// Family-wise probability below which a reading is said to leave the simulator.
inline constexpr double departure = 0.05;

/// The gap is significant by the lenses, by what the likelihood leaves unexplained, or by the odds
/// of the set: how much of the level each may use (significance.hpp).
inline constexpr double weight_of_lenses = 0.5, weight_of_unexplained = 0.45, weight_of_odds = 0.4;
/// Share of recordings without an effect in which the search finds one, 26 of 1,260 in blind
/// checks; its odds exceed e^x in some e^-x of these.
inline constexpr double chance_of_a_find = 0.02;
/// Share of the gap that is left at least, where what is left is seen.
inline constexpr double least_left = 0.02;
/// Share of what a true cause would gain below which the cause is unknown, where the simulator with
/// it still misses the recording: neither witness alone is enough.
inline constexpr double recovery = 0.6;
/// A simulator misses a recording that scores so many spreads below its replicas, where its
/// readings leave it, too: of true ones with p above .05, 5 of 204 had such a score.
inline constexpr double deficit_of_a_miss = 4.0;
/// So many times stricter than the significance of the gap is that of what is left of it. The
/// causes were fitted, and their form is not exactly nature's; "unknown" is for more than that.
inline constexpr double strictness_after = 0.05;
/// Where what names leave would come about by chance less often than this, unknown is beside them;
/// and first where the likelihood sees it ten times as clearly and as more than a form of nature's
/// own.
inline constexpr double p_of_the_unexplained = 0.01, p_of_the_unknown = 0.001;
/// Where the part that was held back is so far from the simulator with the set, something is there
/// that the other part does not have, and unknown is beside the names, or in the place of none. It
/// is stricter by far: what was fitted was not fitted there.
inline constexpr double p_of_the_unseen = 1e-4;
/// What a form of nature's own leaves, of what the set gained.
inline constexpr double share_of_form = 0.01;
/// Log odds above which an effect is not doubted because readings do not show it, and comes before
/// those below: 99 to 1.
inline constexpr double clear_odds = 4.6;
/// Log odds above which an effect of a refuted set is not taken out of it: as those of what is read
/// off values.
inline constexpr double odds_beyond_misfits = 50.0;
/// Least probability of a cause in the verdict's set.
inline constexpr double member_probability = 0.05;

}  // namespace gyrostat::gap::thresholds
