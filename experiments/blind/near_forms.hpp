#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

/// An effect of the catalogue in a form that the diagnosing simulator does not have, so that its
/// name must survive what a sensor of other make does.
struct NearForm {
  EffectType type;
  std::vector<std::string> names;  ///< effects of the catalogue that it may rightly be called
};

/// The form called `id` as a form of `effect`; InputError at `place` where there is none.
const NearForm& near_form(std::string_view id, std::string_view effect, std::string_view place);

}  // namespace gyrostat::gap
