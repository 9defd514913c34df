#pragma once

#include <optional>

#include <gyrostat/diagnosis/likelihood/nameless.hpp>
#include <gyrostat/diagnosis/remainder/replicated.hpp>

namespace gyrostat::gap {

/// The filter that gives the fast errors of replicas the recording's spectrum: the logarithm of the
/// ratio of both as a sum of cosines (Bloomfield, Biometrika 60, 1973), of which as many are taken
/// as have the least Akaike criterion, each coefficient having the variance that it has from
/// replica to replica. None where that gains no more than chance would: a chance of e^-8
/// (Lundberg's bound of the largest sum of chi-squared / 2 - 1).
std::optional<Nameless> filter_part(const Replicated& replicated, double rate_hz);

}  // namespace gyrostat::gap
