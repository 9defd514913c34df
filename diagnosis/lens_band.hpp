#pragma once

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/gap/instrument.hpp>

namespace gyrostat::gap {

/// A lens of the instrument with where its readings lie, and nothing read yet.
inline Band band_of(const Instrument& instrument, const LensView& lens) {
  Band band;
  band.lens = lens.id;
  band.title = lens.title;
  band.channel = lens.channel;
  band.coordinate = lens.coordinate;
  band.unit = lens.unit;
  for (Eigen::Index i = lens.first; i < lens.first + lens.count; ++i) {
    const auto& at = instrument.at()[static_cast<std::size_t>(i)];
    band.at.push_back(at.is_open() ? at.from : 0.5 * (at.from + at.to));
  }
  return band;
}

}  // namespace gyrostat::gap
