#pragma once

#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// What estimates of an effect's parameters are made from.
struct Evidence {
  const Simulator& simulator;
  const Series& recording;
  Scene scene;
  Scenario baseline;     ///< fitted to the recording
  double white_std_dps;  ///< of the recording, from its single steps

  const Conditions& conditions() const { return simulator.conditions(); }
  double seconds_of_train() const;
};

}  // namespace gyrostat::gap
