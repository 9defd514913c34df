#pragma once

#include <vector>

namespace gyrostat::gap {

struct Evidence;
struct Start;

/// What `starts` estimates of an effect with a slow signature beside the random walk that is the
/// recording's own: the baseline's was inflated by the effect. The first start may gain no more
/// than half its squared t-statistic.
std::vector<Start> beside_its_own_walk(std::vector<Start> (*starts)(const Evidence&),
                                       const Evidence& evidence);

}  // namespace gyrostat::gap
