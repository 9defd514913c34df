#include <gyrostat/diagnosis/of_the_sensor.hpp>

#include <utility>

#include <gyrostat/diagnosis/handling.hpp>
#include <gyrostat/diagnosis/known_heading.hpp>
#include <gyrostat/diagnosis/known_motion.hpp>
#include <gyrostat/diagnosis/own_clock.hpp>
#include <gyrostat/diagnosis/own_heading.hpp>
#include <gyrostat/diagnosis/reference_noise.hpp>
#include <gyrostat/diagnosis/unreferenced_turning.hpp>

namespace gyrostat::gap {

Series of_the_sensor(Series recording, std::vector<std::string>& told) {
  for (const auto step :
       {without_handling, without_foreign_heading, without_turning, without_reference_noise,
        at_the_recorders_times, with_known_motion, with_known_heading})
    recording = step(std::move(recording), told);
  return recording;
}

}  // namespace gyrostat::gap
