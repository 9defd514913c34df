#pragma once

#include <stdexcept>

#include <gyrostat/generators/effect.hpp>
#include <gyrostat/generators/effects/list.hpp>

namespace gyrostat::gap {

template <class Visit>
void with_type(const Effect& effect, const Visit& visit) {
  Effects::for_each([&]<class Entry>(Entry) {
    if (const auto* any = effect.as<typename Entry::type>()) visit(*any);
  });
}

}  // namespace gyrostat::gap
