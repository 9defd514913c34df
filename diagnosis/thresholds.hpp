#pragma once

#include <cstddef>

/// The numbers that decide verdicts. Gains are nats of the log score: by Scoring::temperature, a
/// gain g stands for odds of exp(g / 3).
namespace gyrostat::gap::thresholds {

/// Family-wise probability below which a reading is said to leave the simulator.
inline constexpr double departure = 0.05;

/// Gain that names a cause where the gap itself is significant: odds of four to one. There is
/// something to explain, so the best explanation need not prove that, too.
inline constexpr double gain_of_gap = 4.0;
/// Gain that names a cause where nothing stands out, and any further cause: odds of fourteen to
/// one, for the best of 25 effects gains something by chance.
inline constexpr double gain = 8.0;
/// A further cause also gains this share of what the score still lacks: in long recordings a few
/// nats are always to be had from the small differences between nature's form of an effect and
/// ours.
inline constexpr double share_of_lack = 0.12;
/// Share of what a true cause would gain below which the cause is unknown, where the simulator with
/// it still misses the recording: neither witness alone is enough.
inline constexpr double recovery = 0.6;
/// A simulator misses a recording that scores so many spreads below its replicas: a true one, whose
/// recording is as likely as any replica, hardly ever does.
inline constexpr double deficit_of_a_miss = 4.0;
/// So many times stricter than the significance of the gap is that of what is left of it. The
/// causes were fitted, and their form is not exactly nature's; "unknown" is for more than that.
inline constexpr double strictness_after = 0.1;
/// Least probability of a cause in the verdict's set.
inline constexpr double member_probability = 0.05;

/// A start that gains so many nats fewer than the best one may still win once both are fitted.
inline constexpr double reach_of_a_fit = 15.0;
/// So may one within this share of what the best one gains: where the gap is large, so is what a
/// fit moves.
inline constexpr double share_reach_of_a_fit = 0.4;
/// But the best two always are, so that there is a second to hold the first against.
inline constexpr std::size_t fewest_fitted = 2;
/// What a candidate loses that is not the effect it is called, or that does nothing: more than any
/// score, so that it comes after all the others and is still shown.
inline constexpr double disqualified = 1e6;

/// Samples beyond which a recording is long: an hour at 50 Hz. Its trials take minutes, so it has
/// fewer causes, and further ones only where something is seen to be left.
inline constexpr std::size_t long_recording = 200'000;
inline constexpr int most_effects_of_long = 2;

}  // namespace gyrostat::gap::thresholds
