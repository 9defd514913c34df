#pragma once

#include <functional>
#include <vector>

#include <gyrostat/diagnosis/likelihood/nameless.hpp>

namespace gyrostat::gap {

/// How well the train part's readings are foretold with nameless parts: a log score.
using ScoreOfParts = std::function<double(const std::vector<Nameless>&)>;

/// Those that the likelihood tells of, less means with which the readings are foretold no better:
/// of a motion's reference the mean of one part need not be that of another.
std::vector<Nameless> without_needless_means(std::vector<Nameless> parts,
                                             const ScoreOfParts& score_of);

/// What `parts`, the nameless ones that the likelihood tells of, still leave of the recording, as a
/// simulator can draw it: these, and more. One after another, a further wander of the rate and of
/// the compass, noise over rate, tails of the compass, the spectrum and the distribution of fast
/// errors, each estimated against replicas of the set with those before it, from the train part
/// alone, and kept where the score is better with it.
std::vector<Nameless> with_what_replicas_lack(const Simulator& simulator, const Series& recording,
                                              const Scenario& set, std::vector<Nameless> parts,
                                              const ScoreOfParts& score_of);

}  // namespace gyrostat::gap
