#include <gyrostat/diagnosis/evidence.hpp>

namespace gyrostat::gap {

double Evidence::seconds_of_train() const {
  double samples = 0.0;
  for (const auto& span : conditions().spans(Part::train))
    samples += static_cast<double>(span.size());
  return samples * conditions().interval_s();
}

}  // namespace gyrostat::gap
