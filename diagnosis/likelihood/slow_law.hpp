#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/noise_law.hpp>
#include <gyrostat/diagnosis/likelihood/reduced_rate.hpp>
#include <gyrostat/diagnosis/likelihood/slow_filter.hpp>

namespace gyrostat::gap {

/// A law as what cluster means have forgotten by the next but one, lines among it, and what they
/// remember.
struct LawBands {
  NoiseLaw fast, slow;
};
LawBands bands_of(const NoiseLaw& law, double cluster_s);

/// The law of cluster means. What is fast has this density, and of its white noise passes
/// `gain_of_white`.
SlowLaw slow_law_of(const ReducedRate& reduced, const LawBands& bands,
                    const std::vector<double>& fast_density,
                    const std::vector<double>& gain_of_white);
/// The same, under the law of samples.
SlowLaw slow_law(const ReducedRate& reduced, const NoiseLaw& law);

}  // namespace gyrostat::gap
