#pragma once

#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// What estimates of an effect's parameters are made from.
struct Evidence {
  const Simulator& simulator;
  const Series& recording;
  Scene scene;
  Scenario baseline;  ///< fitted to the recording

  const Conditions& conditions() const { return simulator.conditions(); }
};

}  // namespace gyrostat::gap
