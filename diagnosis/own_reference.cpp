#include <gyrostat/diagnosis/own_reference.hpp>

#include <cmath>
#include <numbers>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {

ReferenceShare share_of_reference(const Series& recording) {
  const auto& gyro = recording.gyro_dps;
  const auto& reference = recording.rate_ref_dps;
  if (reference.empty()) return {};
  double count = 0.0, mean_gyro = 0.0, mean_reference = 0.0;
  const auto for_each_pair = [&](const auto& add) {
    for (std::size_t i = 0; i < gyro.size(); ++i)
      if (!is_missing(gyro[i]) && !is_missing(reference[i])) add(gyro[i], reference[i]);
  };
  for_each_pair([&](double g, double r) {
    count += 1.0;
    mean_gyro += (g - mean_gyro) / count;
    mean_reference += (r - mean_reference) / count;
  });
  double gyro_squares = 0.0, reference_squares = 0.0, products = 0.0;
  for_each_pair([&](double g, double r) {
    gyro_squares += (g - mean_gyro) * (g - mean_gyro);
    reference_squares += (r - mean_reference) * (r - mean_reference);
    products += (g - mean_gyro) * (r - mean_reference);
  });
  if (!(reference_squares > 0.0)) return {};
  return {products / reference_squares, std::sqrt(gyro_squares / reference_squares)};
}

bool is_of_another_axis(const ReferenceShare& share) {
  constexpr double most_misaligned = 0.1;
  return std::abs(share.slope) < most_misaligned && share.motion < most_misaligned;
}

std::string doubt_of_reference(const ReferenceShare& share) {
  constexpr double degree = std::numbers::pi / 180.0, most_apart = 0.1;
  const auto is_near = [&](double slope) {
    return std::abs(share.slope / slope - 1.0) < most_apart &&
           share.motion < (1.0 + most_apart) * std::abs(share.slope);
  };
  if (is_near(degree) || is_near(-degree))
    return "the gyro's rates are a 57th of rate_ref_dps; if they are in radians, say --units "
           "gyro=rad/s";
  if (is_near(1.0 / degree) || is_near(-1.0 / degree))
    return "the gyro's rates are 57 times rate_ref_dps; if that is in radians, say --units "
           "rate_ref=rad/s";
  if (is_near(-1.0))
    return "the gyro turns against rate_ref_dps; if one of them counts the other way round, change "
           "its sign: else it is a scale factor of -200 %";
  return {};
}

}  // namespace gyrostat::gap
