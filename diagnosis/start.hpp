#pragma once

#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

/// An effect with first parameters.
struct Start {
  Effect effect;
};

}  // namespace gyrostat::gap
